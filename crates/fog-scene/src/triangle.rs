//! One triangle of the scene, and the points on it.

use glam::{DVec3, Vec3, Vec3A};

/// A triangle in world space, its corners counter-clockwise when seen from its front.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Triangle {
    /// Corners in metres; finite, and not on one line.
    pub positions: [Vec3; 3],
    /// Unit normals at the corners, on the front side.
    pub normals: [Vec3; 3],
    /// Texture coordinates of glTF's sets 0 and 1 at the corners.
    pub uv: [[[f32; 2]; 3]; 2],
    /// Index of its material.
    pub material: u32,
    /// Index of the object that it belongs to.
    pub object: u32,
}

impl Triangle {
    /// A triangle without texture coordinates whose normals are its own; material and object 0.
    #[must_use]
    pub fn flat(positions: [Vec3; 3]) -> Self {
        let normal = unit_normal(positions);
        Self { positions, normals: [normal; 3], uv: [[[0.0; 2]; 3]; 2], material: 0, object: 0 }
    }

    /// Area in m².
    #[must_use]
    pub fn area(&self) -> f32 {
        (0.5 * area_vector(self.positions).length()) as f32
    }

    /// Unit normal of the plane, on the front side.
    #[must_use]
    pub fn normal(&self) -> Vec3A {
        unit_normal(self.positions).into()
    }

    /// True if the corners lie on one line, or in one point.
    #[must_use]
    pub fn is_degenerate(&self) -> bool {
        !area_vector(self.positions).length_squared().is_normal()
    }

    /// Texture coordinates of both sets at a point of barycentric weights (1 − u − v, u, v).
    #[inline]
    #[must_use]
    pub fn uv_at(&self, u: f32, v: f32) -> [[f32; 2]; 2] {
        self.uv.map(|[a, b, c]| core::array::from_fn(|i| a[i] + (b[i] - a[i]) * u + (c[i] - a[i]) * v))
    }

    /// The point of barycentric weights (1 − u − v, u, v).
    ///
    /// Position and plane normal are computed in f64: the position is off the plane by its rounding to f32 alone.
    #[inline]
    #[must_use]
    pub fn surface(&self, u: f32, v: f32) -> SurfacePoint {
        let [a, b, c] = self.positions.map(|p| p.as_dvec3());
        let (ab, ac) = (b - a, c - a);
        let position = (a + ab * f64::from(u) + ac * f64::from(v)).as_vec3a();
        let geometric_normal = ab.cross(ac).normalize_or_zero().as_vec3a();
        // A normal that leaves the front side, by interpolation or by a wrong file, gives way to the plane's.
        let [n0, n1, n2] = self.normals.map(Vec3A::from);
        let smooth = (n0 * (1.0 - u - v) + n1 * u + n2 * v).normalize_or_zero();
        let shading_normal = if smooth.dot(geometric_normal) > 1e-3 { smooth } else { geometric_normal };
        SurfacePoint {
            position,
            geometric_normal,
            shading_normal,
            uv: self.uv_at(u, v),
            material: self.material,
            object: self.object,
            extent: ab.abs().max(ac.abs()).max_element() as f32,
        }
    }
}

/// Cross product of two edges: twice the area along the normal.
fn area_vector(positions: [Vec3; 3]) -> DVec3 {
    let [a, b, c] = positions.map(|p| p.as_dvec3());
    (b - a).cross(c - a)
}

fn unit_normal(positions: [Vec3; 3]) -> Vec3 {
    area_vector(positions).normalize_or_zero().as_vec3()
}

/// A point on a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfacePoint {
    /// Position in metres.
    pub position: Vec3A,
    /// Unit normal of the plane; the corners run counter-clockwise around it.
    pub geometric_normal: Vec3A,
    /// Unit interpolated vertex normal, in the hemisphere of `geometric_normal`.
    pub shading_normal: Vec3A,
    /// Texture coordinates of glTF's sets 0 and 1.
    pub uv: [[f32; 2]; 2],
    /// Index of the material.
    pub material: u32,
    /// Index of the object.
    pub object: u32,
    /// Largest edge component of the triangle in metres: sets the error of a ray test against it.
    pub extent: f32,
}

impl SurfacePoint {
    /// Origin of a ray that leaves this point along `direction` and does not hit the triangle that it starts on.
    ///
    /// [`offset_origin`], and beyond it the error that testing against a large triangle makes.
    #[inline]
    #[must_use]
    pub fn spawn_origin(&self, direction: Vec3A) -> Vec3A {
        let n = self.geometric_normal;
        let side = if direction.dot(n) < 0.0 { -n } else { n };
        offset_origin(self.position, n, direction) + side * (4e-7 * self.extent)
    }
}

/// Moves a point off the surface of unit normal `n`, to the side that `direction` points to.
///
/// Wächter & Binder, "A fast and robust method for avoiding self-intersection", Ray Tracing Gems (2019), ch. 6: some units
/// in the last place along the normal, or n/65536 m near zero coordinates. 32 units here, not their 256: positions of
/// [`SurfacePoint`] are right to half a unit, and 256 would be 2 cm at 1 km.
#[inline]
#[must_use]
pub fn offset_origin(p: Vec3A, n: Vec3A, direction: Vec3A) -> Vec3A {
    const NEAR_ZERO: f32 = 1.0 / 32.0;
    const ABSOLUTE: f32 = 1.0 / 65536.0;
    const UNITS: f32 = 32.0;
    let n = if direction.dot(n) < 0.0 { -n } else { n };
    let component = |p: f32, n: f32| {
        if p.abs() < NEAR_ZERO {
            p + ABSOLUTE * n
        } else {
            let units = (UNITS * n) as i32;
            f32::from_bits(p.to_bits().wrapping_add_signed(if p < 0.0 { -units } else { units }))
        }
    };
    Vec3A::new(component(p.x, n.x), component(p.y, n.y), component(p.z, n.z))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn offsets_follow_the_side_of_the_direction() {
        for p in [Vec3A::ZERO, Vec3A::new(1000.0, -3.0, 0.01)] {
            for n in [Vec3A::X, Vec3A::NEG_Y, Vec3A::new(0.6, 0.0, -0.8)] {
                assert!((offset_origin(p, n, n) - p).dot(n) > 0.0);
                assert!((offset_origin(p, n, -n) - p).dot(n) < 0.0);
                assert!((offset_origin(p, n, n) - p).length() < 0.05);
            }
        }
    }

    #[test]
    fn wrong_normals_give_way_to_the_plane() {
        let mut t = Triangle::flat([Vec3::ZERO, Vec3::X, Vec3::Y]);
        assert_eq!(t.normal(), Vec3A::Z);
        assert!((t.area() - 0.5).abs() < 1e-7);
        t.normals = [Vec3::NEG_Z; 3];
        let s = t.surface(0.25, 0.5);
        assert_eq!((s.position, s.shading_normal), (Vec3A::new(0.25, 0.5, 0.0), Vec3A::Z));
        assert!(Triangle::flat([Vec3::ZERO, Vec3::X, Vec3::X * 2.0]).is_degenerate());
    }
}
