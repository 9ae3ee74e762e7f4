//! Motion of nodes over time (glTF 2.0, sec. 3.11 and appendix C).

use fog_core::{DMat4, math};
use glam::{DQuat, DVec3};

/// How the values between two key frames come about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Interpolation {
    Step,
    Linear,
    /// Three values a key frame: tangent that leads in, value, tangent that leads out.
    CubicSpline,
}

/// One property of a node over time.
#[derive(Clone, Debug)]
pub(crate) struct Track<const N: usize> {
    /// Seconds, increasing; at least one.
    pub(crate) times: Vec<f64>,
    /// One for each time, or three.
    pub(crate) values: Vec<[f32; N]>,
    pub(crate) interpolation: Interpolation,
}

/// A node's translation, rotation and scale where nothing moves it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Rest {
    pub(crate) translation: DVec3,
    pub(crate) rotation: DQuat,
    pub(crate) scale: DVec3,
}

/// A node: where it is below its parent.
#[derive(Clone, Debug, Default)]
pub(crate) struct MovingNode {
    pub(crate) parent: Option<usize>,
    /// Its matrix where no track moves it.
    pub(crate) local: DMat4,
    /// What its tracks replace; none where there are none.
    pub(crate) rest: Option<Rest>,
    pub(crate) translation: Option<Track<3>>,
    pub(crate) rotation: Option<Track<4>>,
    pub(crate) scale: Option<Track<3>>,
}

/// All animations of a scene, which play together from time 0. Before its first key frame and after its last a property keeps
/// their values.
#[derive(Clone, Debug, Default)]
pub struct Animation {
    pub(crate) nodes: Vec<MovingNode>,
    /// Node of each object.
    pub(crate) objects: Vec<usize>,
}

impl MovingNode {
    pub(crate) fn moves(&self) -> bool {
        self.translation.is_some() || self.rotation.is_some() || self.scale.is_some()
    }

    /// Its matrix at a time.
    pub(crate) fn local_at(&self, time_s: f64) -> DMat4 {
        let Some(rest) = &self.rest else { return self.local };
        let vector = |track: &Option<Track<3>>, rest: DVec3| {
            track.as_ref().map_or(rest, |track| DVec3::from_array(track.at(time_s)))
        };
        let rotation = self.rotation.as_ref().map_or(rest.rotation, |track| track.rotation_at(time_s));
        DMat4::from_scale_rotation_translation(
            vector(&self.scale, rest.scale),
            rotation,
            vector(&self.translation, rest.translation),
        )
    }
}

impl Animation {
    /// With the parents of its nodes, which are a tree, and the nodes of the objects.
    pub(crate) fn in_tree(mut self, parents: &[Option<usize>], objects: Vec<usize>) -> Self {
        for (node, parent) in self.nodes.iter_mut().zip(parents) {
            node.parent = *parent;
        }
        self.objects = objects;
        self
    }

    /// Whether an object, or a node above it, moves.
    #[must_use]
    pub fn moves(&self, object: u32) -> bool {
        self.chain(object).any(|node| node.moves())
    }

    /// World from the object's own space at a time in seconds.
    #[must_use]
    pub fn world_from_object(&self, object: u32, time_s: f64) -> DMat4 {
        self.chain(object).fold(DMat4::IDENTITY, |below, node| node.local_at(time_s) * below)
    }

    /// The last key frame's time in seconds.
    #[must_use]
    pub fn duration_s(&self) -> f64 {
        let last = |times: Option<&Vec<f64>>| times.and_then(|t| t.last().copied()).unwrap_or(0.0);
        let of_node = |node: &MovingNode| {
            last(node.translation.as_ref().map(|t| &t.times))
                .max(last(node.rotation.as_ref().map(|t| &t.times)))
                .max(last(node.scale.as_ref().map(|t| &t.times)))
        };
        self.nodes.iter().map(of_node).fold(0.0, f64::max)
    }

    /// The object's node and those above it.
    fn chain(&self, object: u32) -> impl Iterator<Item = &MovingNode> {
        let first = self.objects.get(object as usize).and_then(|&node| self.nodes.get(node));
        std::iter::successors(first, |node| node.parent.and_then(|parent| self.nodes.get(parent)))
    }
}

/// Where a time lies among the key frames.
enum Between {
    /// At or beyond one of them.
    Key(usize),
    /// After this one: share of the way to the next, and the seconds between them.
    After(usize, f64, f64),
}

impl<const N: usize> Track<N> {
    fn find(&self, time_s: f64) -> Between {
        let next = self.times.partition_point(|t| *t <= time_s);
        if next == 0 || next == self.times.len() {
            return Between::Key(next.saturating_sub(1));
        }
        let (from, to) = (self.times[next - 1], self.times[next]);
        Between::After(next - 1, (time_s - from) / (to - from), to - from)
    }

    /// The value of a key frame.
    fn key(&self, i: usize) -> [f64; N] {
        let i = if self.interpolation == Interpolation::CubicSpline { 3 * i + 1 } else { i };
        self.values[i].map(f64::from)
    }

    fn at(&self, time_s: f64) -> [f64; N] {
        match (self.find(time_s), self.interpolation) {
            (Between::Key(i), _) | (Between::After(i, ..), Interpolation::Step) => self.key(i),
            (Between::After(i, u, _), Interpolation::Linear) => {
                let (a, b) = (self.key(i), self.key(i + 1));
                core::array::from_fn(|c| a[c] + u * (b[c] - a[c]))
            }
            (Between::After(i, u, seconds), Interpolation::CubicSpline) => {
                let (s, t) = (u * u, u * u * u);
                let (a, b) = (self.key(i), self.key(i + 1));
                let (out, into) = (self.values[3 * i + 2], self.values[3 * i + 3]);
                core::array::from_fn(|c| {
                    (2.0 * t - 3.0 * s + 1.0) * a[c]
                        + seconds * (t - 2.0 * s + u) * f64::from(out[c])
                        + (3.0 * s - 2.0 * t) * b[c]
                        + seconds * (t - s) * f64::from(into[c])
                })
            }
        }
    }
}

impl Track<4> {
    fn rotation_at(&self, time_s: f64) -> DQuat {
        let unit = |q: [f64; 4]| DQuat::from_array(q).normalize();
        match (self.find(time_s), self.interpolation) {
            (Between::After(i, u, _), Interpolation::Linear) => {
                slerp(unit(self.key(i)), unit(self.key(i + 1)), u)
            }
            _ => unit(self.at(time_s)),
        }
    }
}

/// The shorter way from one rotation to the other, at an even rate.
fn slerp(a: DQuat, b: DQuat, share: f64) -> DQuat {
    let dot = a.dot(b);
    let (b, cos) = if dot < 0.0 { (-b, -dot) } else { (b, dot) };
    // Nearly parallel: the chord will do, and the sine would divide by next to nothing.
    if cos > 1.0 - 1e-12 {
        return (a * (1.0 - share) + b * share).normalize();
    }
    let angle = math::f64::acos(cos);
    let sin = math::f64::sin(angle);
    let (first, second) = (math::f64::sin((1.0 - share) * angle), math::f64::sin(share * angle));
    a * (first / sin) + b * (second / sin)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rotations_turn_evenly_the_shorter_way() {
        let turn = |deg: f64| {
            let half = (0.5 * deg).to_radians();
            DQuat::from_xyzw(0.0, math::f64::sin(half), 0.0, math::f64::cos(half))
        };
        for (share, want) in [(0.0, 10.0), (0.25, 40.0), (0.5, 70.0), (1.0, 130.0)] {
            for b in [turn(130.0), -turn(130.0)] {
                assert!(slerp(turn(10.0), b, share).dot(turn(want)).abs() > 1.0 - 1e-12, "{share}");
            }
        }
    }

    #[test]
    fn values_between_and_beyond_key_frames() {
        let track =
            |values: Vec<[f32; 3]>, interpolation| Track { times: vec![1.0, 3.0], values, interpolation };
        let x = |track: &Track<3>, time: f64| track.at(time)[0];
        let two = vec![[2.0, 0.0, 0.0], [6.0, 0.0, 0.0]];
        let step = track(two.clone(), Interpolation::Step);
        assert_eq!([0.0, 1.0, 2.9, 3.0, 9.0].map(|t| x(&step, t)), [2.0, 2.0, 2.0, 6.0, 6.0]);
        let linear = track(two, Interpolation::Linear);
        assert_eq!([0.0, 1.0, 1.5, 3.0, 9.0].map(|t| x(&linear, t)), [2.0, 2.0, 3.0, 6.0, 6.0]);
        // x = t² from 1 to 9 has tangents 2t.
        let squares =
            vec![[0.0; 3], [1.0, 0.0, 0.0], [2.0, 0.0, 0.0], [6.0, 0.0, 0.0], [9.0, 0.0, 0.0], [0.0; 3]];
        let cubic = track(squares, Interpolation::CubicSpline);
        for t in [1.0, 1.3, 2.0, 2.8, 3.0] {
            assert!((x(&cubic, t) - t * t).abs() < 1e-12, "{t}");
        }
    }
}
