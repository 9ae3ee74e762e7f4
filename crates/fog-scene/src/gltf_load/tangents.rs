//! Tangents for normal maps of meshes that bring none, by MikkTSpace, as glTF asks (specification 2.0, sec. 3.7.2.1), along the axes of
//! the map's image.

use super::primitives::Primitive;
use crate::texture::Texture;
use bevy_mikktspace::{Geometry, Ops, TangentSpace, generate_tangents};
use fog_core::math;
use glam::Vec3;

/// Tangent and sign of the bitangent (normal × tangent) at the corners of each triangle, in the mesh's space. Empty if the
/// vertices are not such that tangents can be made: without texture coordinates, or with values that are not finite.
pub(super) fn generate(primitive: &Primitive, set: u8, texture: &Texture) -> Vec<[[f32; 4]; 3]> {
    let uv = &primitive.uv[usize::from(set & 1)];
    let finite = uv.as_flattened().iter().all(|x| x.is_finite())
        && primitive.positions.as_flattened().iter().all(|x| x.is_finite())
        && primitive.normals.as_flattened().iter().all(|x| x.is_finite());
    if uv.is_empty() || !finite {
        return Vec::new();
    }
    let out = vec![[[0.0; 4]; 3]; primitive.triangles.len()];
    let mut mesh = Mesh { primitive, uv, texture, out };
    match generate_tangents::<_, Portable>(&mut mesh) {
        Ok(()) => mesh.out,
        Err(_) => Vec::new(),
    }
}

struct Mesh<'a> {
    primitive: &'a Primitive,
    uv: &'a [[f32; 2]],
    texture: &'a Texture,
    out: Vec<[[f32; 4]; 3]>,
}

/// Functions that give the same bits on every machine.
struct Portable;

impl Ops for Portable {
    fn sqrt(x: f32) -> f32 {
        x.sqrt()
    }

    fn acos(x: f32) -> f32 {
        math::f64::acos(f64::from(x)) as f32
    }
}

impl Geometry<Portable> for Mesh<'_> {
    fn num_faces(&self) -> usize {
        self.primitive.triangles.len()
    }

    fn num_vertices_of_face(&self, _face: usize) -> usize {
        3
    }

    fn position(&self, face: usize, corner: usize) -> [f32; 3] {
        self.primitive.positions[self.primitive.triangles[face][corner] as usize]
    }

    fn normal(&self, face: usize, corner: usize) -> [f32; 3] {
        let vertices = self.primitive.triangles[face];
        if let Some(&normal) = self.primitive.normals.get(vertices[corner] as usize) {
            return normal;
        }
        let [a, b, c] = vertices.map(|v| Vec3::from(self.primitive.positions[v as usize]));
        (b - a).cross(c - a).normalize_or_zero().to_array()
    }

    fn tex_coord(&self, face: usize, corner: usize) -> [f32; 2] {
        self.texture.image_coordinates(self.uv[self.primitive.triangles[face][corner] as usize])
    }

    fn set_tangent(&mut self, space: Option<TangentSpace>, face: usize, corner: usize) {
        let [x, y, z, sign] = space.unwrap_or_default().tangent_encoded();
        // MikkTSpace counts v upwards, glTF downwards.
        self.out[face][corner] = [x, y, z, -sign];
    }
}
