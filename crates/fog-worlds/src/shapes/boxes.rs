//! Boxes with sharp and with round edges.

use super::Grid;
use crate::mesh::Mesh;
use crate::place::sin_cos;
use fog_core::Vec3;

/// The box between two corners, all six faces, each with the whole texture upright.
pub(crate) fn block(min: Vec3, max: Vec3) -> Mesh {
    let d = max - min;
    let (x, y, z) = (Vec3::X * d.x, Vec3::Y * d.y, Vec3::Z * d.z);
    let mut mesh = Mesh::default();
    mesh.quad(min + z, x, y);
    mesh.quad(max - y, -z, y);
    mesh.quad(min + x, -x, y);
    mesh.quad(min, z, y);
    mesh.quad(min + y + z, x, -z);
    mesh.quad(min, x, z);
    mesh
}

/// The box between two corners with edges rounded by a radius (less than half of each edge), in `steps` per quarter turn.
pub(crate) fn rounded_box(min: Vec3, max: Vec3, radius: f32, steps: usize) -> Mesh {
    let (middle, half) = (0.5 * (min + max), 0.5 * (max - min) - Vec3::splat(radius));
    // Angles of the poles' and the equator's quadrants; each quadrant has its own corner of the inner box.
    let quarter =
        |from: f32, signs: f32| (0..=steps).map(move |k| (from + 90.0 * k as f32 / steps as f32, signs));
    let latitudes: Vec<(f32, f32)> = quarter(-90.0, -1.0).chain(quarter(0.0, 1.0)).collect();
    let corners = [(1.0, 1.0), (1.0, -1.0), (-1.0, -1.0), (-1.0, 1.0)];
    let longitudes: Vec<(f32, (f32, f32))> = (0..4)
        .flat_map(|q| (0..=steps).map(move |k| (90.0 * (q as f32 + k as f32 / steps as f32), corners[q])))
        .collect();
    let row = |&(latitude, sign_y): &(f32, f32)| {
        let (sin_lat, cos_lat) = sin_cos(latitude);
        let point = |&(longitude, (sign_x, sign_z)): &(f32, (f32, f32))| {
            let (s, c) = sin_cos(longitude);
            let inner = half * Vec3::new(sign_x, sign_y, sign_z);
            middle + inner + radius * Vec3::new(s * cos_lat, sin_lat, c * cos_lat)
        };
        longitudes.iter().chain(&longitudes[..1]).rev().map(point).collect()
    };
    // Caps: the flat middle of top and bottom.
    let mut mesh = Grid::new(latitudes.iter().map(row).collect()).mesh();
    let (x, z) = (Vec3::X * 2.0 * half.x, Vec3::Z * 2.0 * half.z);
    mesh.quad(middle - half + z + Vec3::Y * (2.0 * half.y + radius), x, -z);
    mesh.quad(middle - half - Vec3::Y * radius, x, z);
    mesh
}
