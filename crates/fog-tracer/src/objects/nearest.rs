//! The nearest point of a surface.

use fog_core::DVec3;
use fog_scene::Triangle;

/// Least distance of triangles from a point; infinite without triangles.
pub(super) fn distance<'t>(point: DVec3, triangles: impl Iterator<Item = &'t Triangle>) -> f64 {
    let squared = |triangle: &Triangle| {
        let corners = triangle.positions.map(|corner| corner.as_dvec3() - point);
        closest_to_origin(corners).length_squared()
    };
    triangles.map(squared).fold(f64::INFINITY, f64::min).sqrt()
}

/// Point of a triangle that is closest to the origin: by the region of the plane that the origin's foot lies in (Ericson,
/// Real-Time Collision Detection, 2005, Sec. 5.1.5).
fn closest_to_origin([a, b, c]: [DVec3; 3]) -> DVec3 {
    let (ab, ac) = (b - a, c - a);
    let (d1, d2) = (-ab.dot(a), -ac.dot(a));
    if d1 <= 0.0 && d2 <= 0.0 {
        return a;
    }
    let (d3, d4) = (-ab.dot(b), -ac.dot(b));
    if d3 >= 0.0 && d4 <= d3 {
        return b;
    }
    let (d5, d6) = (-ab.dot(c), -ac.dot(c));
    if d6 >= 0.0 && d5 <= d6 {
        return c;
    }
    let of_c = d1 * d4 - d3 * d2;
    if of_c <= 0.0 && d1 >= 0.0 && d3 <= 0.0 {
        return a + ab * (d1 / (d1 - d3));
    }
    let of_b = d5 * d2 - d1 * d6;
    if of_b <= 0.0 && d2 >= 0.0 && d6 <= 0.0 {
        return a + ac * (d2 / (d2 - d6));
    }
    let of_a = d3 * d6 - d5 * d4;
    if of_a <= 0.0 && d4 >= d3 && d5 >= d6 {
        return b + (c - b) * ((d4 - d3) / ((d4 - d3) + (d5 - d6)));
    }
    let sum = of_a + of_b + of_c;
    a + ab * (of_b / sum) + ac * (of_c / sum)
}

#[cfg(test)]
mod tests {
    use super::*;
    use fog_core::Vec3;

    #[test]
    fn closest_points_of_faces_edges_and_corners() {
        let triangle = [Triangle::flat([Vec3::ZERO, Vec3::new(4.0, 0.0, 0.0), Vec3::new(0.0, 4.0, 0.0)])];
        let from = |x: f64, y: f64, z: f64| distance(DVec3::new(x, y, z), triangle.iter());
        for (found, want) in [
            (from(1.0, 1.0, 3.0), 3.0),
            (from(-3.0, -4.0, 0.0), 5.0),
            (from(2.0, -2.0, 0.0), 2.0),
            (from(-2.0, 2.0, 0.0), 2.0),
            (from(4.0, 4.0, 0.0), 8f64.sqrt()),
            (from(7.0, 0.0, 4.0), 5.0),
            (from(0.0, 7.0, -4.0), 5.0),
        ] {
            assert!((found - want).abs() < 1e-12, "{found} {want}");
        }
        assert_eq!(distance(DVec3::ZERO, [].iter()), f64::INFINITY);
    }
}
