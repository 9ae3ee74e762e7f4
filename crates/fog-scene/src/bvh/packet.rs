//! Four triangles at once against a ray, without gaps between neighbours.

use super::ray::Ray;
use glam::{Vec3, Vec4};

/// Up to four triangles, their corners' coordinates side by side; unused lanes are NaN, which nothing hits.
#[derive(Clone, Debug)]
pub(super) struct Packet {
    /// `corners[corner][axis]`.
    corners: [[Vec4; 3]; 3],
    /// Index of each triangle in the scene.
    pub(super) triangle: [u32; 4],
    /// Bit per lane: the material cuts holes.
    pub(super) masked: u32,
}

/// Lanes that a ray hits, with distances and the weights of the second and third corner.
pub(super) struct PacketHit {
    pub(super) lanes: u32,
    pub(super) t: Vec4,
    pub(super) u: Vec4,
    pub(super) v: Vec4,
}

impl Packet {
    /// Packs up to four triangles (scene index, corners, has holes).
    pub(super) fn new(triangles: impl Iterator<Item = (u32, [Vec3; 3], bool)>) -> Self {
        let mut packet = Self { corners: [[Vec4::NAN; 3]; 3], triangle: [0; 4], masked: 0 };
        for (lane, (index, corners, masked)) in triangles.take(4).enumerate() {
            for (packed, corner) in packet.corners.iter_mut().zip(corners) {
                for axis in 0..3 {
                    packed[axis][lane] = corner[axis];
                }
            }
            packet.triangle[lane] = index;
            packet.masked |= u32::from(masked) << lane;
        }
        packet
    }

    /// Lanes hit at 0 < t ≤ `t_max`.
    ///
    /// Woop, Benthin & Wald, "Watertight ray/triangle intersection", JCGT 2(1), 2013: the edge functions of neighbours
    /// are exact negatives of each other, and zeros are decided in f64, so no ray passes between them.
    #[inline(always)]
    pub(super) fn intersect<const Z: usize>(&self, ray: &Ray<Z>, t_max: f32) -> PacketHit {
        let (x_axis, y_axis) = ((Z + 1) % 3, (Z + 2) % 3);
        // Corners relative to the origin, sheared so that the ray is +z.
        let sheared = self.corners.each_ref().map(|corner| {
            let z = corner[Z] - ray.origin[Z];
            let x = (corner[x_axis] - ray.origin[x_axis]) - ray.shear[0] * z;
            let y = (corner[y_axis] - ray.origin[y_axis]) - ray.shear[1] * z;
            [x, y, z * ray.shear[2]]
        });
        let [a, b, c] = sheared;

        let mut wa = c[0] * b[1] - c[1] * b[0];
        let mut wb = a[0] * c[1] - a[1] * c[0];
        let mut wc = b[0] * a[1] - b[1] * a[0];
        let zero = Vec4::ZERO;
        let edges = wa.cmpeq(zero) | wb.cmpeq(zero) | wc.cmpeq(zero);
        if edges.any() {
            exact_edges(&sheared, edges.bitmask(), [&mut wa, &mut wb, &mut wc]);
        }

        let outside = (wa.cmplt(zero) | wb.cmplt(zero) | wc.cmplt(zero))
            & (wa.cmpgt(zero) | wb.cmpgt(zero) | wc.cmpgt(zero));
        let det = wa + wb + wc;
        let scale = det.recip();
        let t = (wa * a[2] + wb * b[2] + wc * c[2]) * scale;
        let lanes = (!outside & det.cmpne(zero) & t.cmpgt(zero) & t.cmple(Vec4::splat(t_max))).bitmask();
        PacketHit { lanes, t, u: wb * scale, v: wc * scale }
    }
}

/// Edge functions in f64 for the lanes that hit an edge exactly.
#[cold]
fn exact_edges(sheared: &[[Vec4; 3]; 3], lanes: u32, weights: [&mut Vec4; 3]) {
    let [a, b, c] = sheared;
    for (weight, (p, q)) in weights.into_iter().zip([(c, b), (a, c), (b, a)]) {
        for lane in (0..4).filter(|lane| lanes >> lane & 1 == 1) {
            let at = |v: &[Vec4; 3], axis: usize| f64::from(v[axis][lane]);
            weight[lane] = (at(p, 0) * at(q, 1) - at(p, 1) * at(q, 0)) as f32;
        }
    }
}
