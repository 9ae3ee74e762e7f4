//! Choosing one of many lights: a tree over them, descended by how much light each half may send.
//!
//! After Conty Estevez & Kulla, *Importance Sampling of Many Lights with Adaptive Tree Splitting* (2018), without the
//! splitting: a node knows a sphere around its lights, the sum of their strengths and a cone around all directions that they
//! shine in. Half a tree whose cone cannot reach the receiver is never chosen; of one light its own value counts.

use crate::phase_angles::PhaseAngles;
use fog_core::Vec3A;
use fog_core::math;

/// Levels that are split by cost; below them halves are of equal count, which bounds the depth.
const COST_LEVELS: u32 = 24;
/// Places at which the lights along an axis may be split.
const CUTS: usize = 8;
/// Smallest probability of either half where both may give light: rounding must not make it 0.
const LEAST: f32 = 1e-6;
/// Squared distance below which lights count as no nearer, in m².
const NEAREST_M2: f32 = 1e-6;
/// What a cone's cosine test is widened by, against rounding.
const COS_MARGIN: f32 = 1e-4;

/// What a tree must know of a light.
pub trait Light {
    /// Whether light leaves by the cosine to a normal, as from surfaces: a cone's middle, all but the outer 90°, is that of
    /// the normals.
    const COSINE: bool;

    /// Where it is, how strong it is and where it shines.
    fn bound(&self) -> Bound;

    /// Share of its strength that goes to a receiver at `offset` from the centre of its bound, in [0, 1]; `squared` is the
    /// offset's squared length. 0 only if no part of it shines there.
    fn share(&self, offset: Vec3A, squared: f32) -> f32;
}

/// Extent, strength and directions of a light, or of several.
#[derive(Clone, Copy, Debug)]
pub struct Bound {
    /// Lowest corner of the box around them, in metres.
    pub lower: Vec3A,
    /// Highest corner.
    pub upper: Vec3A,
    /// Intensity up to a common factor; 0 or less is left out of a tree.
    pub strength: f64,
    /// All directions that they shine in.
    pub reach: Reach,
}

/// A cone of directions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reach {
    /// Its axis, a unit vector.
    pub axis: Vec3A,
    /// Its half-angle in radians; π for every direction.
    pub angle: f32,
}

/// Lights, ready to be chosen from.
#[derive(Clone, Debug)]
pub struct LightTree<L> {
    lights: Vec<L>,
    nodes: Vec<Node>,
    /// Right and left turns (1 and 0, from the root in the lowest bit) to each light.
    turns: Vec<u64>,
}

#[derive(Clone, Copy, Debug)]
struct Node {
    centre: Vec3A,
    axis: Vec3A,
    radius: f32,
    strength: f32,
    /// Cosine and sine of the cone's half-angle; none for every direction.
    cone: Option<[f32; 2]>,
    kind: Kind,
}

#[derive(Clone, Copy, Debug)]
enum Kind {
    Light(u32),
    /// The left child follows its parent.
    Split {
        right: u32,
    },
}

/// What receives light.
#[derive(Clone, Copy, Debug)]
pub enum Receiver<'a> {
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
        /// How the points scatter light into the segment's direction; `None`: alike whatever the angle.
        angles: Option<&'a PhaseAngles>,
    },
}

impl<L> Default for LightTree<L> {
    fn default() -> Self {
        Self { lights: Vec::new(), nodes: Vec::new(), turns: Vec::new() }
    }
}

impl<L: Light> LightTree<L> {
    /// Builds the tree; lights without strength are left out. The result depends on the lights' order only in ties.
    #[must_use]
    pub fn new(lights: impl IntoIterator<Item = L>) -> Self {
        let lights: Vec<L> = lights.into_iter().filter(|l| l.bound().strength > 0.0).collect();
        let bounds: Vec<Bound> = lights.iter().map(Light::bound).collect();
        let mut tree =
            Self { nodes: Vec::with_capacity(2 * lights.len()), turns: vec![0; lights.len()], lights };
        let mut order: Vec<u32> = (0..bounds.len() as u32).collect();
        if !order.is_empty() {
            tree.build(&bounds, &mut order, 0, 0);
        }
        tree
    }

    /// The lights; [`LightTree::choose`] gives indices of them.
    #[must_use]
    pub fn lights(&self) -> &[L] {
        &self.lights
    }

    fn build(&mut self, bounds: &[Bound], order: &mut [u32], turns: u64, depth: u32) {
        let index = self.nodes.len();
        let whole = Bound::around(bounds, order);
        self.nodes.push(Node::new(&whole));
        if let [light] = *order {
            self.nodes[index].kind = Kind::Light(light);
            self.turns[light as usize] = turns;
            return;
        }
        let middle = split(bounds, order, &whole, depth < COST_LEVELS);
        let (left, right) = order.split_at_mut(middle);
        self.build(bounds, left, turns, depth + 1);
        self.nodes[index].kind = Kind::Split { right: self.nodes.len() as u32 };
        self.build(bounds, right, turns | 1 << depth, depth + 1);
    }
    /// Chooses a light: its index and the probability of the choice. `None` if no light reaches the receiver.
    #[must_use]
    pub fn choose(&self, receiver: &Receiver<'_>, mut pick: f64) -> Option<(usize, f32)> {
        let mut index = 0;
        let mut probability = 1.0;
        loop {
            match self.nodes.get(index)?.kind {
                Kind::Light(light) => return Some((light as usize, probability)),
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

    /// Probability with which [`LightTree::choose`] finds this light.
    #[must_use]
    pub fn probability(&self, light: usize, receiver: &Receiver<'_>) -> f32 {
        let mut turns = self.turns[light];
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
    fn left_share(&self, parent: usize, right: u32, receiver: &Receiver<'_>) -> Option<f32> {
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
    fn importance(&self, node: &Node, receiver: &Receiver<'_>) -> f32 {
        match *receiver {
            Receiver::Point(point) => {
                let offset = point - node.centre;
                let squared = offset.length_squared();
                let share = match node.kind {
                    Kind::Light(light) => self.lights[light as usize].share(offset, squared),
                    Kind::Split { .. } => node.share(offset, squared, L::COSINE),
                };
                node.strength * share / squared.max(node.radius * node.radius).max(NEAREST_M2)
            }
            // ∫ p(α) dt / d² along the segment, of the sphere's centre, not nearer than the sphere's edge.
            Receiver::Segment { origin, direction, enter, exit, angles } => {
                let offset = node.centre - origin;
                let nearest = offset.dot(direction);
                let from_line = (offset - direction * nearest).length();
                let d = f64::from(from_line.max(node.radius).max(NEAREST_M2.sqrt()));
                let angle = |t: f32| math::f64::atan2(d, f64::from(nearest - t));
                let shares = [enter, exit].map(|t| angles.map_or(angle(t), |p| p.below(angle(t))));
                let seen = ((shares[1] - shares[0]) / d) as f32;
                node.strength * seen.max(f32::MIN_POSITIVE)
            }
        }
    }
}

impl Node {
    fn new(bound: &Bound) -> Self {
        let Bound { lower, upper, strength, reach } = *bound;
        let cone =
            (reach.angle < math::PI_F32).then(|| [math::f32::cos(reach.angle), math::f32::sin(reach.angle)]);
        // Rounded up, so that everything is inside.
        let radius = 0.5 * (upper - lower).length() * (1.0 + 1e-5);
        let (centre, axis) = (0.5 * (lower + upper), reach.axis);
        Self { centre, axis, radius, strength: strength as f32, cone, kind: Kind::Light(0) }
    }

    /// At least the share of the node's strength that goes to a point at `offset` from its centre; 0 only if none does.
    #[inline]
    fn share(&self, offset: Vec3A, squared: f32, cosine: bool) -> f32 {
        let Some([cos_cone, sin_cone]) = self.cone else { return 1.0 };
        if squared <= self.radius * self.radius {
            return 1.0;
        }
        // The point's angle to the axis as seen from the centre, less what it may be as seen from elsewhere in the sphere.
        let inverse = 1.0 / squared.sqrt();
        let cos = (offset.dot(self.axis) * inverse).clamp(-1.0, 1.0);
        let sin = (1.0 - cos * cos).sqrt();
        let sin_seen = (self.radius * inverse).min(1.0);
        let cos_seen = (1.0 - sin_seen * sin_seen).sqrt();
        let (cos, sin) = if cos >= cos_seen {
            (1.0, 0.0)
        } else {
            (cos * cos_seen + sin * sin_seen, (sin * cos_seen - cos * sin_seen).max(0.0))
        };
        if !cosine {
            return if cos < cos_cone - COS_MARGIN { 0.0 } else { 1.0 };
        }
        // The cone is that of the normals, widened by 90°: what is left of the angle beyond the former.
        let (cos_normals, sin_normals) = (sin_cone, -cos_cone);
        if cos >= cos_normals { 1.0 } else { (cos * cos_normals + sin * sin_normals + COS_MARGIN).max(0.0) }
    }
}

impl Reach {
    /// Every direction.
    pub const ALL: Self = Self { axis: Vec3A::Y, angle: math::PI_F32 };

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

impl Bound {
    /// Around nothing.
    const NONE: Self =
        Self { lower: Vec3A::INFINITY, upper: Vec3A::NEG_INFINITY, strength: 0.0, reach: Reach::ALL };

    fn join(self, other: Self) -> Self {
        if self.strength == 0.0 {
            return other;
        }
        if other.strength == 0.0 {
            return self;
        }
        Self {
            lower: self.lower.min(other.lower),
            upper: self.upper.max(other.upper),
            strength: self.strength + other.strength,
            reach: self.reach.join(other.reach),
        }
    }

    fn around(bounds: &[Self], order: &[u32]) -> Self {
        order.iter().map(|&i| bounds[i as usize]).fold(Self::NONE, Self::join)
    }

    /// Strength × squared extent × solid angle of the cone.
    fn cost(&self) -> f64 {
        self.strength * f64::from((self.upper - self.lower).length_squared() * self.reach.measure())
    }
}

/// Orders lights along the axis of the split that costs least, both sides together, and returns the size of the first part.
fn split(bounds: &[Bound], order: &mut [u32], whole: &Bound, by_cost: bool) -> usize {
    let n = order.len();
    let extent = whole.upper - whole.lower;
    let sort = |order: &mut [u32], axis: usize| {
        let key = |i: u32| bounds[i as usize].lower[axis] + bounds[i as usize].upper[axis];
        order.sort_by(|&a, &b| key(a).total_cmp(&key(b)).then(a.cmp(&b)));
    };
    let longest = (0..3).max_by(|&a, &b| extent[a].total_cmp(&extent[b])).unwrap_or(0);
    let mut best = (f64::INFINITY, longest, n / 2);
    if by_cost && extent.max_element() > 0.0 {
        let pieces = n.min(CUTS);
        let at = |k: usize| n * k / pieces;
        for axis in 0..3 {
            sort(order, axis);
            // Bounds of what lies between neighbouring cuts, and of all after each.
            let between: Vec<Bound> =
                (0..pieces).map(|k| Bound::around(bounds, &order[at(k)..at(k + 1)])).collect();
            let mut after = between.clone();
            for k in (0..pieces - 1).rev() {
                after[k] = after[k].join(after[k + 1]);
            }
            let mut before = Bound::NONE;
            for k in 1..pieces {
                before = before.join(between[k - 1]);
                let total = before.cost() + after[k].cost();
                if total < best.0 {
                    best = (total, axis, at(k));
                }
            }
        }
    }
    sort(order, best.1);
    best.2
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lamp::{Cone, Lamp, Pattern};
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
                let lamp = Lamp::even(position, [0.1 + 100.0 * rng.uniform().powi(4); 3]);
                Lamp { pattern: cone.map_or(Pattern::Even, Pattern::Cone), ..lamp }
            })
            .collect()
    }

    #[test]
    fn probabilities_sum_to_one_and_choices_follow_them() {
        for n in [1, 2, 7, 300] {
            let tree = LightTree::new(lamps(n));
            for k in 0..40 {
                let mut rng = PathRng::new(9, n, k);
                let point = Vec3A::new(240.0 * (rng.uniform() - 0.5), 5.0, 240.0 * (rng.uniform() - 0.5));
                let direction = warp::uniform_sphere(rng.uniform2());
                let exit = if k % 4 == 0 { f32::INFINITY } else { 50.0 };
                let segment = Receiver::Segment { origin: point, direction, enter: 1.0, exit, angles: None };
                for receiver in [Receiver::Point(point), segment] {
                    let all: Vec<f32> = (0..n as usize).map(|i| tree.probability(i, &receiver)).collect();
                    let sum: f32 = all.iter().sum();
                    // None may be reached at all; then there is no choice.
                    let lit = |l: &Lamp| l.falloff((point - l.position).normalize()) > 0.0;
                    if matches!(receiver, Receiver::Point(_)) {
                        for (lamp, &p) in tree.lights().iter().zip(&all) {
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
        let at = |x: f32, strength| Lamp::even(Vec3A::X * x, [strength; 3]);
        let tree = LightTree::new((0..100).map(|i| at(10.0 * i as f32, 1.0)));
        let here = Receiver::Point(Vec3A::new(500.0, 3.0, 0.0));
        // Even odds would be 0.01.
        assert!(tree.probability(50, &here) > 0.1, "{}", tree.probability(50, &here));
        assert!(tree.probability(0, &here) < 0.005, "{}", tree.probability(0, &here));
        let two = LightTree::new([at(0.0, 3.0), at(2.0, 1.0), at(5.0, 0.0)]);
        assert_eq!(two.lights().len(), 2);
        assert!((two.probability(0, &Receiver::Point(Vec3A::X)) - 0.75).abs() < 1e-6);
        assert!(LightTree::<Lamp>::default().choose(&here, 0.5).is_none());
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
