//! Triangles with normals and texture coordinates, and how objects are put together of them.

use fog_core::{Vec2, Vec3};
use glam::Affine3A;

/// Triangles; front faces wind counterclockwise. Every vertex has a unit normal and a texture coordinate.
#[derive(Clone, Debug, Default)]
pub(crate) struct Mesh {
    pub(crate) positions: Vec<Vec3>,
    pub(crate) normals: Vec<Vec3>,
    pub(crate) uv: Vec<Vec2>,
    pub(crate) indices: Vec<u32>,
}

impl Mesh {
    /// Adds a vertex; returns its index.
    pub(crate) fn vertex(&mut self, position: Vec3, normal: Vec3, uv: Vec2) -> u32 {
        self.positions.push(position);
        self.normals.push(normal);
        self.uv.push(uv);
        self.positions.len() as u32 - 1
    }

    /// Adds a flat convex polygon, counterclockwise seen from its front, with texture coordinates by corner.
    pub(crate) fn polygon(&mut self, corners: &[(Vec3, Vec2)]) {
        let normal = newell(corners.iter().map(|c| c.0));
        let first = self.positions.len() as u32;
        for &(position, uv) in corners {
            self.vertex(position, normal, uv);
        }
        for i in 2..corners.len() {
            let [a, b, c] = [0, i - 1, i].map(|k| corners[k].0);
            if has_area(a, b, c) {
                self.indices.extend([0, i - 1, i].map(|k| first + k as u32));
            }
        }
    }

    /// Adds the parallelogram of corner `o` and edges `u`, `v`; its front is where u × v points. The texture's upper left
    /// is at o + v.
    pub(crate) fn quad(&mut self, o: Vec3, u: Vec3, v: Vec3) {
        self.tiled(o, u, v, Vec2::ONE);
    }

    /// The same with the texture repeated `repeats` times along u and v.
    pub(crate) fn tiled(&mut self, o: Vec3, u: Vec3, v: Vec3, repeats: Vec2) {
        let (s, t) = (repeats.x, repeats.y);
        self.polygon(&[
            (o, Vec2::new(0.0, t)),
            (o + u, Vec2::new(s, t)),
            (o + u + v, Vec2::new(s, 0.0)),
            (o + v, Vec2::ZERO),
        ]);
    }

    /// Adds all of another mesh.
    pub(crate) fn add(&mut self, other: &Mesh) {
        let first = self.positions.len() as u32;
        self.positions.extend_from_slice(&other.positions);
        self.normals.extend_from_slice(&other.normals);
        self.uv.extend_from_slice(&other.uv);
        self.indices.extend(other.indices.iter().map(|i| first + i));
    }

    /// The mesh moved, turned, stretched or mirrored.
    pub(crate) fn placed(mut self, frame: Affine3A) -> Self {
        let inverse_transpose = frame.matrix3.inverse().transpose();
        for p in &mut self.positions {
            *p = frame.transform_point3(*p);
        }
        for n in &mut self.normals {
            *n = (inverse_transpose * glam::Vec3A::from(*n)).normalize_or_zero().into();
        }
        if frame.matrix3.determinant() < 0.0 {
            for triangle in self.indices.chunks_exact_mut(3) {
                triangle.swap(1, 2);
            }
        }
        self
    }

    /// The mesh and its mirror image in the plane x = 0.
    pub(crate) fn mirrored(self) -> Self {
        let mut both = self.clone().placed(crate::place::stretch(-1.0, 1.0, 1.0));
        both.add(&self);
        both
    }
}

/// Whether a triangle is more than a line or a point: 0.1 mm² and more, so that it stays one wherever it is put.
pub(crate) fn has_area(a: Vec3, b: Vec3, c: Vec3) -> bool {
    (b - a).cross(c - a).length_squared() > 4e-14
}

/// Unit normal of a closed loop of points (Newell's sum).
fn newell(points: impl Iterator<Item = Vec3> + Clone) -> Vec3 {
    let origin = points.clone().next().unwrap_or_default();
    let next = points.clone().skip(1).chain([origin]);
    let sum = points.zip(next).fold(Vec3::ZERO, |sum, (a, b)| sum + (a - origin).cross(b - origin));
    sum.normalize_or(Vec3::Y)
}

/// A material of the file that is being written.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Mat(pub(crate) usize);

/// An object: meshes by material.
#[derive(Clone, Debug, Default)]
pub(crate) struct Model {
    pub(crate) parts: Vec<(Mat, Mesh)>,
}

impl Model {
    /// The mesh of one material.
    pub(crate) fn part(&mut self, material: Mat) -> &mut Mesh {
        let index = self.parts.iter().position(|p| p.0 == material).unwrap_or_else(|| {
            self.parts.push((material, Mesh::default()));
            self.parts.len() - 1
        });
        &mut self.parts[index].1
    }

    /// Adds a mesh.
    pub(crate) fn add(&mut self, material: Mat, mesh: &Mesh) {
        self.part(material).add(mesh);
    }

    /// Adds another object, moved.
    pub(crate) fn join(&mut self, other: &Model, frame: Affine3A) {
        for (material, mesh) in &other.parts {
            self.add(*material, &mesh.clone().placed(frame));
        }
    }
}
