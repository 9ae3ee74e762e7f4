//! Choosing one of many lamps: a tree over them, descended by how much light each half may send.
//!
//! After Conty Estevez & Kulla, *Importance Sampling of Many Lights with Adaptive Tree Splitting* (2018), without the
//! splitting: a node knows a sphere around its lamps, the sum of their strengths and a cone around all directions that they
//! shine in. Half a tree whose cone cannot reach the receiver is never chosen; of one lamp the exact value counts.

use crate::lamp::Lamp;
use fog_core::Vec3A;
use fog_core::math;

/// Levels that are split by cost; below them halves are of equal count, which bounds the depth.
const COST_LEVELS: u32 = 24;
/// Smallest probability of either half where both may give light: rounding must not make it 0.
const LEAST: f32 = 1e-6;
/// Squared distance below which lamps count as no nearer, in m².
const NEAREST_M2: f32 = 1e-6;
/// What a cone's cosine test is widened by, against rounding.
const COS_MARGIN: f32 = 1e-4;

/// The lamps of a scene, ready to be chosen from.
#[derive(Clone, Debug, Default)]
pub struct LampTree {
    lamps: Vec<Lamp>,
    nodes: Vec<Node>,
    /// Right and left turns (1 and 0, from the root in the lowest bit) to each lamp.
    turns: Vec<u64>,
}

#[derive(Clone, Copy, Debug)]
struct Node {
    centre: Vec3A,
    radius: f32,
    strength: f32,
    cone: Reach,
    kind: Kind,
}

#[derive(Clone, Copy, Debug)]
enum Kind {
    Lamp(u32),
    /// The left child follows its parent.
    Split {
        right: u32,
    },
}

/// All directions that some lamps shine in.
#[derive(Clone, Copy, Debug)]
struct Reach {
    axis: Vec3A,
    /// Half-angle in radians; π for every direction.
    angle: f32,
}

/// What receives light.
#[derive(Clone, Copy, Debug)]
pub enum Receiver {
    /// A point.
    Point(Vec3A),
    /// The points `origin + t · direction` (a unit vector) for t from `enter` to `exit`, which may be infinite.
    Segment {
        /// Start of the ray.
        origin: Vec3A,
        /// Its direction.
        direction: Vec3A,
        /// Distance of the first point.
        enter: f32,
        /// Distance of the last point.
        exit: f32,
    },
}

impl LampTree {
    /// Builds the tree; lamps without light are left out. The result depends on the lamps' order only in ties.
    #[must_use]
    pub fn new(lamps: impl IntoIterator<Item = Lamp>) -> Self {
        let lamps: Vec<Lamp> = lamps.into_iter().filter(|l| l.strength() > 0.0).collect();
        let mut tree =
            Self { nodes: Vec::with_capacity(2 * lamps.len()), turns: vec![0; lamps.len()], lamps };
        let mut order: Vec<u32> = (0..tree.lamps.len() as u32).collect();
        if !order.is_empty() {
            tree.build(&mut order, 0, 0);
        }
        tree
    }

    /// The lamps; [`LampTree::choose`] gives indices of them.
    #[must_use]
    pub fn lamps(&self) -> &[Lamp] {
        &self.lamps
    }

    fn build(&mut self, order: &mut [u32], turns: u64, depth: u32) {
        let index = self.nodes.len();
        self.nodes.push(bound(&self.lamps, order));
        if let [lamp] = *order {
            self.nodes[index].kind = Kind::Lamp(lamp);
            self.turns[lamp as usize] = turns;
            return;
        }
        let middle = split(&self.lamps, order, depth < COST_LEVELS);
        let (left, right) = order.split_at_mut(middle);
        self.build(left, turns, depth + 1);
        self.nodes[index].kind = Kind::Split { right: self.nodes.len() as u32 };
        self.build(right, turns | 1 << depth, depth + 1);
    }

    /// Chooses a lamp: its index and the probability of the choice. `None` if no lamp reaches the receiver.
    #[must_use]
    pub fn choose(&self, receiver: &Receiver, mut pick: f64) -> Option<(usize, f32)> {
        let mut index = 0;
        let mut probability = 1.0;
        loop {
            match self.nodes.get(index)?.kind {
                Kind::Lamp(lamp) => return Some((lamp as usize, probability)),
                Kind::Split { right } => {
                    let left = self.left_share(index, right, receiver)?;
                    if pick < f64::from(left) {
                        pick /= f64::from(left);
                        probability *= left;
                        index += 1;
                    } else {
                        pick = (pick - f64::from(left)) / (1.0 - f64::from(left));
                        probability *= 1.0 - left;
                        index = right as usize;
                    }
                }
            }
        }
    }

    /// Probability with which [`LampTree::choose`] finds this lamp.
    #[must_use]
    pub fn probability(&self, lamp: usize, receiver: &Receiver) -> f32 {
        let mut turns = self.turns[lamp];
        let mut index = 0;
        let mut probability = 1.0;
        while let Kind::Split { right } = self.nodes[index].kind {
            let Some(left) = self.left_share(index, right, receiver) else { return 0.0 };
            if turns & 1 == 0 {
                probability *= left;
                index += 1;
            } else {
                probability *= 1.0 - left;
                index = right as usize;
            }
            turns >>= 1;
        }
        probability
    }

    /// Probability of the left child; `None` if neither reaches the receiver.
    #[inline]
    fn left_share(&self, parent: usize, right: u32, receiver: &Receiver) -> Option<f32> {
        let a = self.importance(&self.nodes[parent + 1], receiver);
        let b = self.importance(&self.nodes[right as usize], receiver);
        let share = a / (a + b);
        match (a > 0.0, b > 0.0) {
            (false, false) => None,
            (true, true) => Some(share.clamp(LEAST, 1.0 - LEAST)),
            _ => Some(share),
        }
    }

    #[inline]
    fn importance(&self, node: &Node, receiver: &Receiver) -> f32 {
        match *receiver {
            Receiver::Point(point) => {
                let offset = point - node.centre;
                let squared = offset.length_squared();
                let falloff = match node.kind {
                    Kind::Lamp(lamp) => {
                        let away = offset.try_normalize().unwrap_or(Vec3A::Y);
                        self.lamps[lamp as usize].falloff(away)
                    }
                    Kind::Split { .. } if node.misses(offset, squared) => 0.0,
                    Kind::Split { .. } => 1.0,
                };
                node.strength * falloff / squared.max(node.radius * node.radius).max(NEAREST_M2)
            }
            // ∫ dt / d² along the segment, of the sphere's centre, not nearer than the sphere's edge.
            Receiver::Segment { origin, direction, enter, exit } => {
                let offset = node.centre - origin;
                let nearest = offset.dot(direction);
                let from_line = (offset - direction * nearest).length();
                let d = f64::from(from_line.max(node.radius).max(NEAREST_M2.sqrt()));
                let angle = |t: f32| math::f64::atan2(f64::from(t - nearest), d);
                let seen = ((angle(exit) - angle(enter)) / d) as f32;
                node.strength * seen.max(f32::MIN_POSITIVE)
            }
        }
    }
}

impl Node {
    /// True if no lamp of the node shines at a point at `offset` from its centre.
    #[inline]
    fn misses(&self, offset: Vec3A, squared: f32) -> bool {
        if self.cone.angle >= math::PI_F32 || squared <= self.radius * self.radius {
            return false;
        }
        // The point is seen from all of the sphere within this angle of the direction from its centre.
        let distance = squared.sqrt();
        let spread = math::f32::asin((self.radius / distance).min(1.0));
        let limit = self.cone.angle + spread;
        limit < math::PI_F32 && offset.dot(self.cone.axis) < distance * (math::f32::cos(limit) - COS_MARGIN)
    }
}

impl Reach {
    fn of(lamp: &Lamp) -> Self {
        match lamp.cone {
            Some(cone) => Self { axis: cone.axis, angle: math::f32::acos(cone.cos_outer.clamp(-1.0, 1.0)) },
            None => Self { axis: Vec3A::Y, angle: math::PI_F32 },
        }
    }

    /// A cone around both.
    fn join(self, other: Self) -> Self {
        let (wide, narrow) = if self.angle >= other.angle { (self, other) } else { (other, self) };
        let between = math::f32::acos(wide.axis.dot(narrow.axis).clamp(-1.0, 1.0));
        if between + narrow.angle <= wide.angle {
            return wide;
        }
        let angle = 0.5 * (wide.angle + between + narrow.angle);
        let all = Self { axis: wide.axis, angle: math::PI_F32 };
        if angle >= math::PI_F32 {
            return all;
        }
        // Turn the wide cone's axis towards the narrow one's until both edges touch.
        let turn = angle - wide.angle;
        let side = narrow.axis - wide.axis * wide.axis.dot(narrow.axis);
        side.try_normalize().map_or(all, |side| Self {
            axis: wide.axis * math::f32::cos(turn) + side * math::f32::sin(turn),
            angle,
        })
    }

    /// Solid angle over 2π.
    fn measure(self) -> f32 {
        1.0 - math::f32::cos(self.angle)
    }
}

fn bound(lamps: &[Lamp], order: &[u32]) -> Node {
    let mut lower = Vec3A::splat(f32::INFINITY);
    let mut upper = -lower;
    let mut strength = 0.0f64;
    let mut cone: Option<Reach> = None;
    for lamp in order.iter().map(|&i| &lamps[i as usize]) {
        lower = lower.min(lamp.position);
        upper = upper.max(lamp.position);
        strength += f64::from(lamp.strength());
        let own = Reach::of(lamp);
        cone = Some(cone.map_or(own, |c| c.join(own)));
    }
    let centre = 0.5 * (lower + upper);
    let cone = cone.unwrap_or(Reach { axis: Vec3A::Y, angle: math::PI_F32 });
    // Rounded up, so that every lamp is inside.
    let radius = if order.len() == 1 { 0.0 } else { 0.5 * (upper - lower).length() * (1.0 + 1e-5) };
    Node { centre, radius, strength: strength as f32, cone, kind: Kind::Lamp(0) }
}

/// Orders lamps along the axis of the cheapest split (strength × squared extent × solid angle of the cones, both sides
/// together) and returns the size of the first part.
fn split(lamps: &[Lamp], order: &mut [u32], by_cost: bool) -> usize {
    let n = order.len();
    let cost = |node: &Node| node.strength * node.radius * node.radius * node.cone.measure();
    let whole = bound(lamps, order);
    let sort = |order: &mut [u32], axis: usize| {
        let key = |i: u32| lamps[i as usize].position[axis];
        order.sort_by(|&a, &b| key(a).total_cmp(&key(b)).then(a.cmp(&b)));
    };
    let mut best = (f32::INFINITY, longest_axis(lamps, order), n / 2);
    // Prefixes of many lamps are measured at a few places only: 8 or so cuts are as good as all.
    let cuts: Vec<usize> = if n <= 16 { (1..n).collect() } else { (1..8).map(|k| n * k / 8).collect() };
    if by_cost && whole.radius > 0.0 {
        for axis in 0..3 {
            sort(order, axis);
            for &cut in &cuts {
                let total = cost(&bound(lamps, &order[..cut])) + cost(&bound(lamps, &order[cut..]));
                if total < best.0 {
                    best = (total, axis, cut);
                }
            }
        }
    }
    sort(order, best.1);
    best.2
}

fn longest_axis(lamps: &[Lamp], order: &[u32]) -> usize {
    let positions = || order.iter().map(|&i| lamps[i as usize].position);
    let extent = positions().reduce(Vec3A::max).unwrap_or_default()
        - positions().reduce(Vec3A::min).unwrap_or_default();
    (0..3).max_by(|&a, &b| extent[a].total_cmp(&extent[b])).unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lamp::Cone;
    use fog_core::random::PathRng;
    use fog_core::warp;

    fn lamps(n: u64) -> Vec<Lamp> {
        (0..n)
            .map(|i| {
                let mut rng = PathRng::new(3, 1, i);
                let mut place = || 200.0 * (rng.uniform() - 0.5);
                let position = Vec3A::new(place(), 0.05 * place(), place());
                let cone = (i % 3 > 0).then(|| {
                    let cos_outer = 0.95 * rng.uniform();
                    Cone { axis: warp::uniform_sphere(rng.uniform2()), cos_inner: 0.97, cos_outer }
                });
                Lamp { position, intensity: [0.1 + 100.0 * rng.uniform().powi(4); 3], cone }
            })
            .collect()
    }

    #[test]
    fn probabilities_sum_to_one_and_choices_follow_them() {
        for n in [1, 2, 7, 300] {
            let tree = LampTree::new(lamps(n));
            for k in 0..40 {
                let mut rng = PathRng::new(9, n, k);
                let point = Vec3A::new(240.0 * (rng.uniform() - 0.5), 5.0, 240.0 * (rng.uniform() - 0.5));
                let direction = warp::uniform_sphere(rng.uniform2());
                let exit = if k % 4 == 0 { f32::INFINITY } else { 50.0 };
                let segment = Receiver::Segment { origin: point, direction, enter: 1.0, exit };
                for receiver in [Receiver::Point(point), segment] {
                    let all: Vec<f32> = (0..n as usize).map(|i| tree.probability(i, &receiver)).collect();
                    let sum: f32 = all.iter().sum();
                    // None may be reached at all; then there is no choice.
                    let lit = |l: &Lamp| l.falloff((point - l.position).normalize()) > 0.0;
                    if matches!(receiver, Receiver::Point(_)) {
                        for (lamp, &p) in tree.lamps().iter().zip(&all) {
                            assert!(!lit(lamp) || p > 0.0, "a lamp that shines here is never chosen");
                        }
                    } else {
                        assert!(all.iter().all(|&p| p > 0.0));
                    }
                    for _ in 0..50 {
                        match tree.choose(&receiver, rng.uniform_f64()) {
                            Some((lamp, p)) => assert_eq!(p.to_bits(), all[lamp].to_bits()),
                            None => assert!(sum < 0.9999),
                        }
                    }
                    assert!(sum < 1.0001);
                    if !matches!(receiver, Receiver::Point(_)) {
                        assert!((sum - 1.0).abs() < 1e-4, "{n} {k}: {sum}");
                    }
                }
            }
        }
    }

    #[test]
    fn near_and_strong_lamps_are_preferred() {
        // With all lamps equal and all around, the tree should come near to intensity over squared distance.
        let at = |x: f32, strength| Lamp { position: Vec3A::X * x, intensity: [strength; 3], cone: None };
        let tree = LampTree::new((0..100).map(|i| at(10.0 * i as f32, 1.0)));
        let here = Receiver::Point(Vec3A::new(500.0, 3.0, 0.0));
        // Even odds would be 0.01.
        assert!(tree.probability(50, &here) > 0.1, "{}", tree.probability(50, &here));
        assert!(tree.probability(0, &here) < 0.005, "{}", tree.probability(0, &here));
        let two = LampTree::new([at(0.0, 3.0), at(2.0, 1.0), at(5.0, 0.0)]);
        assert_eq!(two.lamps().len(), 2);
        assert!((two.probability(0, &Receiver::Point(Vec3A::X)) - 0.75).abs() < 1e-6);
        assert!(LampTree::default().choose(&here, 0.5).is_none());
    }

    #[test]
    fn cones_contain_what_they_join() {
        for k in 0..2000 {
            let mut rng = PathRng::new(4, 4, k);
            let mut cone =
                || Reach { axis: warp::uniform_sphere(rng.uniform2()), angle: 1.6 * rng.uniform() };
            let (a, b) = (cone(), cone());
            let both = a.join(b);
            for one in [a, b] {
                let edge = warp::spherical(math::f32::cos(one.angle), math::f32::sin(one.angle), k as f32);
                let direction = warp::frame(one.axis) * edge;
                let angle = math::f32::acos(direction.dot(both.axis).clamp(-1.0, 1.0));
                assert!(angle <= both.angle + 1e-3, "{k}: {angle} outside {}", both.angle);
            }
        }
    }
}
