//! Building the four-wide tree from obvhs' binary one.

use super::packet::Packet;
use super::{Bvh, LEAF, Node};
use crate::triangle::Triangle;
use glam::{Vec3A, Vec4};
use obvhs::aabb::Aabb;
use obvhs::bvh2::Bvh2;
use obvhs::bvh2::builder::build_bvh2;
use obvhs::{Boundable, BvhBuildParams};

/// Boxes are widened by this × (|coordinate| + radius of the scene), or rays leak through shared edges.
const PADDING: f32 = 3e-7;

/// Triangles of a leaf.
const WIDTH: u32 = 4;

struct Padded(Aabb);

impl Boundable for Padded {
    fn aabb(&self) -> Aabb {
        self.0
    }
}

impl Bvh {
    /// Builds over triangles with finite corners; `masked` tells which materials cut holes. The number of triangles must
    /// be below 2³¹.
    pub(crate) fn new(triangles: &[Triangle], masked: impl Fn(u32) -> bool) -> Self {
        if triangles.is_empty() {
            return Self::default();
        }
        let boxes = padded_boxes(triangles);
        let params = BvhBuildParams { max_prims_per_leaf: WIDTH, ..BvhBuildParams::medium_build() };
        let binary = build_bvh2(&boxes, params, &mut core::time::Duration::default());
        let counts = subtree_counts(&binary);

        let mut this = Self::default();
        let pack = |this: &mut Self, node: usize| {
            let members = primitives(&binary, node);
            this.packets.push(Packet::new(members.into_iter().map(|index| {
                let triangle = &triangles[index as usize];
                (index, triangle.positions, masked(triangle.material))
            })));
            LEAF | (this.packets.len() - 1) as u32
        };
        if counts[0] <= WIDTH {
            this.root = Some(pack(&mut this, 0));
            return this;
        }
        // Wide nodes in the order of their creation; each takes its binary node from `sources`.
        this.root = Some(0);
        let mut sources = vec![0usize];
        let mut next = 0;
        while let Some(&source) = sources.get(next) {
            next += 1;
            let mut node =
                Node { bounds: [[Vec4::INFINITY, Vec4::NEG_INFINITY]; 3], child: [LEAF; WIDTH as usize] };
            for (lane, child) in widen(&binary, &counts, source).into_iter().enumerate() {
                let bounds = binary.nodes[child].aabb();
                for axis in 0..3 {
                    node.bounds[axis][0][lane] = bounds.min[axis];
                    node.bounds[axis][1][lane] = bounds.max[axis];
                }
                node.child[lane] = if counts[child] <= WIDTH {
                    pack(&mut this, child)
                } else {
                    sources.push(child);
                    (sources.len() - 1) as u32
                };
            }
            this.nodes.push(node);
        }
        this
    }
}

fn padded_boxes(triangles: &[Triangle]) -> Vec<Padded> {
    let boxes = triangles.iter().map(|triangle| {
        let [a, b, c] = triangle.positions.map(Vec3A::from);
        Aabb { min: a.min(b).min(c), max: a.max(b).max(c) }
    });
    let boxes: Vec<Aabb> = boxes.collect();
    let (min, max) = boxes
        .iter()
        .fold((Vec3A::INFINITY, Vec3A::NEG_INFINITY), |(min, max), b| (min.min(b.min), max.max(b.max)));
    let radius = 0.5 * (max - min).length();
    let pad = |b: &Aabb| PADDING * (b.min.abs().max(b.max.abs()) + radius);
    boxes.iter().map(|b| Padded(Aabb { min: b.min - pad(b), max: b.max + pad(b) })).collect()
}

/// The two children of an inner node.
fn children(binary: &Bvh2, node: usize) -> [usize; 2] {
    let first = binary.nodes[node].first_index as usize;
    [first, first + 1]
}

/// Number of triangles below each binary node.
fn subtree_counts(binary: &Bvh2) -> Vec<u32> {
    let mut counts = vec![0; binary.nodes.len()];
    let mut order = vec![0];
    let mut next = 0;
    while let Some(&node) = order.get(next) {
        next += 1;
        if !binary.nodes[node].is_leaf() {
            order.extend(children(binary, node));
        }
    }
    for &node in order.iter().rev() {
        let this = &binary.nodes[node];
        counts[node] = if this.is_leaf() {
            this.prim_count
        } else {
            children(binary, node).iter().map(|&child| counts[child]).sum()
        };
    }
    counts
}

/// Up to four descendants that replace an inner node's children: the largest box is opened first.
fn widen(binary: &Bvh2, counts: &[u32], node: usize) -> Vec<usize> {
    let mut out = Vec::with_capacity(WIDTH as usize);
    out.extend(children(binary, node));
    while out.len() < WIDTH as usize {
        let area = |node: usize| binary.nodes[node].aabb().half_area();
        let candidates = (0..out.len()).filter(|&i| counts[out[i]] > WIDTH);
        let Some(largest) = candidates.max_by(|&i, &j| area(out[i]).total_cmp(&area(out[j]))) else { break };
        let [left, right] = children(binary, out[largest]);
        out[largest] = left;
        out.push(right);
    }
    out
}

/// Scene indices of the triangles below a binary node.
fn primitives(binary: &Bvh2, node: usize) -> Vec<u32> {
    let mut out = Vec::with_capacity(WIDTH as usize);
    let mut open = vec![node];
    while let Some(node) = open.pop() {
        let this = &binary.nodes[node];
        if this.is_leaf() {
            let first = this.first_index as usize;
            out.extend(&binary.primitive_indices[first..first + this.prim_count as usize]);
        } else {
            open.extend(children(binary, node));
        }
    }
    out.sort_unstable();
    out
}
