//! Bounding volume hierarchy: obvhs' binary tree, collapsed to four children a node with four triangles a leaf.

mod build;
mod packet;
mod ray;
mod traverse;

use glam::Vec4;
use packet::Packet;

/// Marks a child that is a leaf: the other bits index a packet of triangles.
const LEAF: u32 = 1 << 31;

/// Four children, their boxes as one vector a side.
#[derive(Clone, Debug)]
struct Node {
    /// `bounds[axis]`: lower sides, upper sides. A missing child has an inside-out box, which no ray hits.
    bounds: [[Vec4; 2]; 3],
    child: [u32; 4],
}

/// Hierarchy over the triangles of a scene.
#[derive(Clone, Debug, Default)]
pub(crate) struct Bvh {
    nodes: Vec<Node>,
    packets: Vec<Packet>,
    /// Node or leaf to begin with; `None` without triangles.
    root: Option<u32>,
}

/// A ray and the nearest triangle on it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// Distance in lengths of the ray's direction, > 0.
    pub t: f32,
    /// Index of the triangle.
    pub triangle: u32,
    /// Barycentric weight of the triangle's second corner.
    pub u: f32,
    /// Barycentric weight of the triangle's third corner.
    pub v: f32,
}
