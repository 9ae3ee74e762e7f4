//! Walking a ray through the hierarchy: the nearest hit, or any hit.

use super::packet::PacketHit;
use super::ray::{Ray, longest_axis};
use super::{Bvh, Hit, LEAF, Node};
use glam::{Vec3A, Vec4};

/// Widens the far side of a box test by its rounding error (Ize, "Robust BVH ray traversal", JCGT 2(2), 2013).
const FAR_SLACK: f32 = 1.000_000_5;

/// Nodes to visit: enough for trees of a million triangles; deeper ones spill to the heap.
struct Stack {
    entries: [(f32, u32); 48],
    len: usize,
    spilled: Vec<(f32, u32)>,
}

impl Stack {
    #[inline(always)]
    fn new() -> Self {
        Self { entries: [(0.0, 0); 48], len: 0, spilled: Vec::new() }
    }

    #[inline(always)]
    fn push(&mut self, entry: (f32, u32)) {
        if let Some(slot) = self.entries.get_mut(self.len) {
            *slot = entry;
            self.len += 1;
        } else {
            self.spilled.push(entry);
        }
    }

    #[inline(always)]
    fn pop(&mut self) -> Option<(f32, u32)> {
        if self.len == 0 {
            return self.spilled.pop();
        }
        self.len -= 1;
        self.entries.get(self.len).copied()
    }
}

impl Node {
    /// Children whose boxes the ray meets before `t_max` (a bit each), and where it enters them.
    #[inline(always)]
    fn enter<const Z: usize>(&self, ray: &Ray<Z>, t_max: f32) -> (u32, Vec4) {
        let side = |axis: usize, far: usize| {
            (self.bounds[axis][(ray.negative[axis] ^ far) & 1] - ray.origin[axis]) * ray.inverse[axis]
        };
        let near = side(0, 0).max(side(1, 0)).max(side(2, 0)).max(Vec4::ZERO);
        let far = side(0, 1).min(side(1, 1)).min(side(2, 1)) * FAR_SLACK;
        (near.cmple(far.min(Vec4::splat(t_max))).bitmask(), near)
    }
}

/// Calls `f` with each set bit's position.
#[inline(always)]
fn for_each_lane(mut lanes: u32, mut f: impl FnMut(usize)) {
    while lanes != 0 {
        f((lanes.trailing_zeros() & 3) as usize);
        lanes &= lanes - 1;
    }
}

impl Bvh {
    /// Nearest hit at 0 < t < `t_max`; of hits at one t that of the lowest triangle. `solid(triangle, u, v)` is asked
    /// where a material cuts holes.
    #[inline]
    pub(crate) fn nearest(
        &self,
        origin: Vec3A,
        direction: Vec3A,
        t_max: f32,
        solid: impl Fn(u32, f32, f32) -> bool,
    ) -> Option<Hit> {
        match longest_axis(direction) {
            0 => self.nearest_along::<0>(origin, direction, t_max, solid),
            1 => self.nearest_along::<1>(origin, direction, t_max, solid),
            _ => self.nearest_along::<2>(origin, direction, t_max, solid),
        }
    }

    /// True if anything is hit at 0 < t < `t_max`; stops at the first hit.
    #[inline]
    pub(crate) fn any(
        &self,
        origin: Vec3A,
        direction: Vec3A,
        t_max: f32,
        solid: impl Fn(u32, f32, f32) -> bool,
    ) -> bool {
        match longest_axis(direction) {
            0 => self.any_along::<0>(origin, direction, t_max, solid),
            1 => self.any_along::<1>(origin, direction, t_max, solid),
            _ => self.any_along::<2>(origin, direction, t_max, solid),
        }
    }

    fn nearest_along<const Z: usize>(
        &self,
        origin: Vec3A,
        direction: Vec3A,
        t_max: f32,
        solid: impl Fn(u32, f32, f32) -> bool,
    ) -> Option<Hit> {
        let mut current = self.root?;
        let ray = Ray::<Z>::new(origin, direction);
        let mut stack = Stack::new();
        let mut found = false;
        // No triangle is lower than 0: a hit at exactly t_max does not count.
        let mut best = Hit { t: t_max, triangle: 0, u: 0.0, v: 0.0 };
        loop {
            if current & LEAF != 0 {
                let packet = &self.packets[(current & !LEAF) as usize];
                let PacketHit { lanes, t, u, v } = packet.intersect(&ray, best.t);
                for_each_lane(lanes, |lane| {
                    let (t, triangle) = (t[lane], packet.triangle[lane]);
                    let nearer = t < best.t || (t == best.t && triangle < best.triangle);
                    if nearer && (packet.masked >> lane & 1 == 0 || solid(triangle, u[lane], v[lane])) {
                        best = Hit { t, triangle, u: u[lane], v: v[lane] };
                        found = true;
                    }
                });
            } else {
                let node = &self.nodes[current as usize];
                let (lanes, near) = node.enter(&ray, best.t);
                if lanes != 0 {
                    current = push_farther(&mut stack, node, lanes, near);
                    continue;
                }
            }
            loop {
                match stack.pop() {
                    Some((t, node)) if t <= best.t => {
                        current = node;
                        break;
                    }
                    Some(_) => {}
                    None => return found.then_some(best),
                }
            }
        }
    }

    fn any_along<const Z: usize>(
        &self,
        origin: Vec3A,
        direction: Vec3A,
        t_max: f32,
        solid: impl Fn(u32, f32, f32) -> bool,
    ) -> bool {
        let Some(mut current) = self.root else { return false };
        let ray = Ray::<Z>::new(origin, direction);
        let mut stack = Stack::new();
        loop {
            if current & LEAF != 0 {
                let packet = &self.packets[(current & !LEAF) as usize];
                let PacketHit { lanes, t, u, v } = packet.intersect(&ray, t_max);
                let mut hit = false;
                for_each_lane(lanes, |lane| {
                    hit = hit
                        || (t[lane] < t_max
                            && (packet.masked >> lane & 1 == 0
                                || solid(packet.triangle[lane], u[lane], v[lane])));
                });
                if hit {
                    return true;
                }
            } else {
                let node = &self.nodes[current as usize];
                let (lanes, near) = node.enter(&ray, t_max);
                if lanes != 0 {
                    current = push_farther(&mut stack, node, lanes, near);
                    continue;
                }
            }
            match stack.pop() {
                Some((_, node)) => current = node,
                None => return false,
            }
        }
    }
}

/// The nearest of the children in `lanes` (at least one); the others go onto the stack, farthest first.
#[inline(always)]
fn push_farther(stack: &mut Stack, node: &Node, lanes: u32, near: Vec4) -> u32 {
    if lanes & (lanes - 1) == 0 {
        return node.child[(lanes.trailing_zeros() & 3) as usize];
    }
    let near = near.to_array();
    let mut order = [(0.0f32, 0u32); 4];
    let mut n = 0;
    for_each_lane(lanes, |lane| {
        let entry = (near[lane], node.child[lane]);
        let mut i = n;
        while i > 0 && order[(i - 1) & 3].0 < entry.0 {
            order[i & 3] = order[(i - 1) & 3];
            i -= 1;
        }
        order[i & 3] = entry;
        n += 1;
    });
    for entry in order.iter().take(n - 1) {
        stack.push(*entry);
    }
    order[(n - 1) & 3].1
}
