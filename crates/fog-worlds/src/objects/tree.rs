//! Broad-leaved trees: a trunk, branches, and leaves as small tilted quads.

use crate::glb::{Glb, Shape};
use crate::mesh::{Mesh, Model};
use crate::noise::Chance;
use crate::paint::Paint;
use crate::place::sin_cos;
use crate::shapes::limb;
use fog_core::Vec3;

/// How finely a tree is made.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Leaves {
    /// To be seen from some metres away.
    Fine,
    /// To be seen from some hundred metres away.
    Coarse,
}

impl Leaves {
    /// Number of leaves and their edge in metres: each stands for a bunch.
    fn count_and_edge(self) -> (usize, f32) {
        match self {
            Self::Fine => (1700, 0.30),
            Self::Coarse => (350, 0.65),
        }
    }
}

/// Tree number `index` of a scene: 6 to 10 m high.
pub(crate) fn tree(glb: &mut Glb, seed: u64, index: u64, leaves: Leaves) -> Shape {
    let mut chance = Chance::new(seed, "tree", index);
    let bark = glb.material(&Paint::lambertian("bark", [0.09, 0.065, 0.045]));
    let greens = [[0.05f32, 0.12, 0.02], [0.08, 0.16, 0.035], [0.10, 0.17, 0.03]].map(|green| {
        let name = format!("leaves {}", (green[0] * 100.0).round());
        glb.material(&Paint { double_sided: true, ..Paint::lambertian(&name, green) })
    });
    let mut model = Model::default();
    let height = chance.between(6.0, 10.0);
    let fork = 0.32 * height;
    model.add(bark, &limb(Vec3::ZERO, Vec3::Y * fork, 0.024 * height, 0.017 * height, 8));
    let blobs: Vec<(Vec3, f32)> = (0..7)
        .map(|k| {
            let (s, c) = sin_cos(360.0 * k as f32 / 6.0 + chance.between(-20.0, 20.0));
            let out = if k == 6 { 0.0 } else { chance.between(0.16, 0.24) * height };
            let up = if k == 6 { 0.80 } else { chance.between(0.5, 0.72) };
            (Vec3::new(out * s, up * height, out * c), chance.between(0.15, 0.21) * height)
        })
        .collect();
    for &(centre, _) in &blobs {
        model.add(bark, &limb(Vec3::Y * (fork - 0.1), centre, 0.011 * height, 0.003 * height, 6));
    }
    let (count, edge) = leaves.count_and_edge();
    for _ in 0..count {
        let &(centre, radius) = chance.pick(&blobs);
        let direction = on_sphere(&mut chance);
        let r = radius * chance.between(0.2, 1.0).sqrt();
        leaf(model.part(*chance.pick(&greens)), centre + direction * r, (direction, edge), &mut chance);
    }
    glb.shape(&format!("tree {index}"), &model)
}

fn on_sphere(chance: &mut Chance) -> Vec3 {
    let y = chance.between(-1.0, 1.0);
    let (s, c) = sin_cos(chance.between(0.0, 360.0));
    let r = (1.0 - y * y).max(0.0).sqrt();
    Vec3::new(r * s, y, r * c)
}

/// A bunch of leaves about a point, more or less facing outward, of an edge.
fn leaf(mesh: &mut Mesh, at: Vec3, (outward, edge): (Vec3, f32), chance: &mut Chance) {
    let normal = (outward + 0.8 * on_sphere(chance)).normalize_or(Vec3::Y);
    let u = normal.any_orthonormal_vector() * edge * chance.between(0.6, 1.0);
    let v = normal.cross(u);
    mesh.quad(at - 0.5 * (u + v), u, v);
}
