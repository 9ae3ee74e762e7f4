//! Cylinders, limbs, balls, rings and tubes.

use super::{Grid, lathe};
use crate::mesh::Mesh;
use crate::place::sin_cos;
use fog_core::Vec3;
use glam::{Affine3A, Mat3A};

/// The frame that carries +Y onto the way from `a` to `b`, and the origin to `a`.
fn along(a: Vec3, b: Vec3) -> Affine3A {
    let y = (b - a).normalize_or(Vec3::Y);
    let x = y.any_orthonormal_vector();
    let columns = Mat3A::from_cols(x.into(), y.into(), x.cross(y).into());
    Affine3A { matrix3: columns, translation: a.into() }
}

/// A cylinder or truncated cone from `a` to `b` with flat ends.
pub(crate) fn cylinder(a: Vec3, b: Vec3, ra: f32, rb: f32, n: usize) -> Mesh {
    let l = (b - a).length();
    // Rows doubled at the edges keep them sharp.
    let mut mesh = lathe(&[[ra, 0.0], [rb, l]], n);
    mesh.add(&lathe(&[[0.0, 0.0], [ra, 0.0]], n));
    mesh.add(&lathe(&[[rb, l], [0.0, l]], n));
    mesh.placed(along(a, b))
}

/// A thin cylinder without ends.
pub(crate) fn rod(a: Vec3, b: Vec3, radius: f32, n: usize) -> Mesh {
    lathe(&[[radius, 0.0], [radius, (b - a).length()]], n).placed(along(a, b))
}

/// A tapering body with round ends about the points `a` and `b`.
pub(crate) fn limb(a: Vec3, b: Vec3, ra: f32, rb: f32, n: usize) -> Mesh {
    let l = (b - a).length();
    let quarter = (n / 4).max(2);
    let cap = |r: f32, y: f32, from: f32| {
        (0..=quarter).map(move |k| {
            let (s, c) = sin_cos(from + 90.0 * k as f32 / quarter as f32);
            [(r * c).max(0.0), y + r * s]
        })
    };
    let profile: Vec<[f32; 2]> = cap(ra, 0.0, -90.0).chain(cap(rb, l, 0.0)).collect();
    lathe(&profile, n).placed(along(a, b))
}

/// An ellipsoid.
pub(crate) fn ball(centre: Vec3, radii: Vec3, n: usize) -> Mesh {
    ball_part(centre, radii, n, -90.0, 90.0)
}

/// The part of an ellipsoid between two latitudes in degrees.
pub(crate) fn ball_part(centre: Vec3, radii: Vec3, n: usize, from: f32, to: f32) -> Mesh {
    let rings = (n / 2).max(3);
    let ring = |k: usize| {
        let (s, c) = sin_cos(from + (to - from) * k as f32 / rings as f32);
        [c.max(0.0), s]
    };
    let profile: Vec<[f32; 2]> = (0..=rings).map(ring).collect();
    lathe(&profile, n).placed(Affine3A::from_translation(centre) * Affine3A::from_scale(radii))
}

/// A torus about the x axis: radius of the ring, radius of its section, sides around each.
pub(crate) fn ring(radius: f32, section: f32, n: usize, m: usize) -> Mesh {
    let row = |i: usize| {
        let (s, c) = sin_cos(360.0 * (i % n) as f32 / n as f32);
        let point = |j: usize| {
            let (sj, cj) = sin_cos(360.0 * (j % m) as f32 / m as f32);
            let r = radius + section * cj;
            Vec3::new(section * sj, r * s, r * c)
        };
        (0..=m).rev().map(point).collect()
    };
    Grid::new((0..=n).map(row).collect()).mesh()
}

/// A round pipe through points, with round joints.
pub(crate) fn tube(points: &[Vec3], radius: f32, n: usize) -> Mesh {
    let mut mesh = Mesh::default();
    for pair in points.windows(2) {
        mesh.add(&limb(pair[0], pair[1], radius, radius, n));
    }
    mesh
}

#[cfg(test)]
mod tests {
    use super::super::{block, rounded_box};
    use super::*;

    /// Volume by the divergence theorem: right only if closed and facing outward.
    fn volume(mesh: &Mesh) -> f32 {
        let corner = |i: u32| mesh.positions[i as usize];
        mesh.indices.chunks_exact(3).map(|t| corner(t[0]).cross(corner(t[1])).dot(corner(t[2])) / 6.0).sum()
    }

    #[test]
    fn bodies_are_closed_and_face_outward() {
        let pi = core::f32::consts::PI;
        let (a, b) = (Vec3::new(1.0, 2.0, 3.0), Vec3::new(2.0, 4.0, 1.0));
        let close = |mesh: &Mesh, want: f32| {
            let got = volume(mesh);
            assert!((got / want - 1.0).abs() < 0.03, "{got} {want}");
            for t in mesh.indices.chunks_exact(3) {
                let [p, q, r] = [0, 1, 2].map(|k| mesh.positions[t[k] as usize]);
                let n: Vec3 = (0..3).map(|k| mesh.normals[t[k] as usize]).sum();
                assert!((q - p).cross(r - p).dot(n) > 0.0);
            }
        };
        close(&cylinder(a, b, 0.5, 0.5, 48), pi * 0.25 * 3.0);
        close(&limb(a, b, 0.5, 0.5, 48), pi * 0.25 * 3.0 + pi / 6.0);
        close(&ball(a, Vec3::new(1.0, 2.0, 0.5), 48), pi * 4.0 / 3.0);
        close(&ring(2.0, 0.3, 64, 32), 2.0 * pi * pi * 2.0 * 0.09);
        close(&block(Vec3::ZERO, Vec3::new(1.0, 2.0, 3.0)), 6.0);
        close(&rounded_box(Vec3::ZERO, Vec3::new(1.0, 2.0, 3.0), 0.01, 4), 6.0);
    }
}
