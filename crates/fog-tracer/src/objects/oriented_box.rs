//! Boxes around things in the world.

use fog_core::{DMat3, DVec3};
use fog_scene::LoadedScene;
use fog_scene::labels::Instance;

/// A box with axes of its own.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OrientedBox {
    /// Its middle in the world, in metres.
    pub centre: DVec3,
    /// World from its axes: unit vectors to its right, up and back, as of a node that looks along −Z.
    pub axes: DMat3,
    /// Its extent along these axes in metres.
    pub size: DVec3,
    /// True if the axes are those of the thing's first node, false if they make the base area least.
    pub is_of_node: bool,
}

/// The node's box is taken unless one about the vertical has less than this share of its volume.
const MUCH_SMALLER: f64 = 0.9;
/// Most directions that are tried.
const MOST_EDGES: usize = 512;

impl OrientedBox {
    /// Box around all triangles of a thing: in the axes of its first node, unless a box about the vertical is much smaller. Of
    /// that box the front is the side to which the node's front is nearest.
    pub(super) fn of(loaded: &LoadedScene, instance: &Instance) -> Self {
        let triangles = loaded.geometry.triangles();
        let corners = instance.triangles.iter().flat_map(|&t| triangles[t as usize].positions);
        let points: Vec<DVec3> = corners.map(|corner| corner.as_dvec3()).collect();
        let node = instance.nodes.first().and_then(|&node| loaded.nodes.get(node as usize));
        let axes = node.and_then(|node| unit_axes(DMat3::from_mat4(node.world))).unwrap_or(DMat3::IDENTITY);
        let own = Self::along(axes, &points, true);
        let upright = Self::about_the_vertical(&points, -axes.z_axis);
        let volume = |b: &Self| b.size.x * b.size.y * b.size.z;
        if volume(&upright) < MUCH_SMALLER * volume(&own) { upright } else { own }
    }

    /// The box in these axes.
    fn along(axes: DMat3, points: &[DVec3], is_of_node: bool) -> Self {
        let inverse = axes.transpose();
        let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        for &point in points {
            let local = inverse * point;
            (low, high) = (low.min(local), high.max(local));
        }
        Self { centre: axes * (0.5 * (low + high)), axes, size: high - low, is_of_node }
    }

    /// The box about the vertical whose base has the least area: one of its sides lies along an edge of the convex hull.
    fn about_the_vertical(points: &[DVec3], front: DVec3) -> Self {
        let hull = hull(points);
        let skip = hull.len().div_ceil(MOST_EDGES).max(1);
        let mut best: Option<(f64, [f64; 2])> = None;
        for i in (0..hull.len()).step_by(skip) {
            let (p, q) = (hull[i], hull[(i + 1) % hull.len()]);
            let (dx, dz) = (q[0] - p[0], q[1] - p[1]);
            let length = (dx * dx + dz * dz).sqrt();
            if length == 0.0 {
                continue;
            }
            let [u, w] = [dx / length, dz / length];
            let extent = |f: &dyn Fn(&[f64; 2]) -> f64| {
                let (low, high) = hull
                    .iter()
                    .map(f)
                    .fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| (l.min(v), h.max(v)));
                high - low
            };
            let area = extent(&|p| p[0] * u + p[1] * w) * extent(&|p| p[1] * u - p[0] * w);
            if best.is_none_or(|(least, _)| area < least) {
                best = Some((area, [u, w]));
            }
        }
        let [u, w] = best.map_or([1.0, 0.0], |(_, along)| along);
        let sides = [[u, w], [-u, -w], [-w, u], [w, -u]];
        let towards = |s: &[f64; 2]| s[0] * front.x + s[1] * front.z;
        let nearest = sides.iter().fold(sides[0], |a, b| if towards(b) > towards(&a) { *b } else { a });
        let back = DVec3::new(-nearest[0], 0.0, -nearest[1]);
        Self::along(DMat3::from_cols(DVec3::Y.cross(back), DVec3::Y, back), points, false)
    }
}

/// Unit axes at right angles, of the same hand: the third and the second column decide. `None` if they are no axes.
fn unit_axes(matrix: DMat3) -> Option<DMat3> {
    let back = matrix.z_axis.try_normalize()?;
    let up = (matrix.y_axis - back * back.dot(matrix.y_axis)).try_normalize()?;
    Some(DMat3::from_cols(up.cross(back), up, back))
}

/// Convex hull of points seen from above, as (x, z) in order (Andrew's monotone chain, 1979).
fn hull(points: &[DVec3]) -> Vec<[f64; 2]> {
    let mut flat: Vec<[f64; 2]> = points.iter().map(|p| [p.x, p.z]).collect();
    flat.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    flat.dedup();
    if flat.len() < 3 {
        return flat;
    }
    let turns_left = |o: [f64; 2], a: [f64; 2], b: [f64; 2]| {
        (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0]) > 0.0
    };
    let mut hull: Vec<[f64; 2]> = Vec::new();
    let mut chain = |points: &mut dyn Iterator<Item = &[f64; 2]>| {
        let start = hull.len();
        for &p in points {
            while hull.len() >= start + 2 && !turns_left(hull[hull.len() - 2], hull[hull.len() - 1], p) {
                hull.pop();
            }
            hull.push(p);
        }
        hull.pop();
    };
    chain(&mut flat.iter());
    chain(&mut flat.iter().rev());
    hull
}
