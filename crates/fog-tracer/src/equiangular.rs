//! Points of a flight chosen by how near they are to a lamp.
//!
//! A lamp lights the fog around it by 1/d², which free flights know nothing of: the few that end near the lamp are bright.
//! Points whose density along the flight is that of 1/d² (Kulla & Fajardo, *Importance Sampling Techniques for Path Tracing
//! in Participating Media*, 2012) leave none of that in the weights. Both kinds of points are used, weighted by the balance
//! heuristic: their densities are closed forms, for the layer's transmittance is exact.

use fog_core::{Vec3A, math};
use fog_scene::light_tree::Receiver;

/// Distance from the line below which a lamp counts as no nearer, in metres.
const NEAREST_M: f64 = 1e-3;

/// The part of a flight that lies in the fog and before any surface.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Segment {
    pub(crate) origin: Vec3A,
    pub(crate) direction: Vec3A,
    /// Distances of its ends; the second may be infinite.
    pub(crate) enter: f64,
    pub(crate) exit: f64,
}

/// Distances along a segment whose density is 1/d² of a lamp.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Equiangular {
    nearest: f64,
    from_line: f64,
    first: f64,
    range: f64,
}

impl Segment {
    /// For the choice of a lamp.
    pub(crate) fn receiver(&self) -> Receiver {
        let Self { origin, direction, enter, exit } = *self;
        Receiver::Segment { origin, direction, enter: enter as f32, exit: exit as f32 }
    }

    /// Distances by nearness to a lamp.
    pub(crate) fn near(&self, lamp: Vec3A) -> Equiangular {
        let offset = (lamp - self.origin).as_dvec3();
        let direction = self.direction.as_dvec3();
        let nearest = offset.dot(direction);
        let from_line = (offset - direction * nearest).length().max(NEAREST_M);
        let angle = |t: f64| math::f64::atan2(t - nearest, from_line);
        let first = angle(self.enter);
        Equiangular { nearest, from_line, first, range: angle(self.exit) - first }
    }
}

impl Equiangular {
    /// A distance for `u` uniform in [0, 1); `None` if the segment is too short or too far to be told from a point.
    pub(crate) fn sample(&self, u: f64) -> Option<f64> {
        let t = self.nearest + self.from_line * math::f64::tan(self.first + u * self.range);
        (self.range > 0.0 && t.is_finite() && t >= 0.0).then_some(t)
    }

    /// Density of [`Equiangular::sample`], in 1/m.
    pub(crate) fn pdf(&self, t: f64) -> f64 {
        if self.range <= 0.0 {
            return 0.0;
        }
        let offset = t - self.nearest;
        self.from_line / (self.range * (self.from_line * self.from_line + offset * offset))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use fog_core::random::PathRng;

    #[test]
    fn distances_follow_their_density() {
        let direction = Vec3A::new(2.0, 1.0, 0.0).normalize();
        for (lamp, exit) in [(Vec3A::new(10.0, 6.0, 1.0), 40.0), (Vec3A::X * -5.0, f64::INFINITY)] {
            let segment = Segment { origin: Vec3A::ZERO, direction, enter: 2.0, exit };
            let near = segment.near(lamp);
            // Counts in even cells over [2, 42) against the density's integral over each.
            let (mut counts, n, cells) = ([0u32; 20], 200_000, 20);
            let mut rng = PathRng::new(5, 5, 5);
            for _ in 0..n {
                let t = near.sample(rng.uniform_f64()).unwrap();
                assert!(t >= 2.0 - 1e-9 && t <= exit + 1e-9);
                if t < 42.0 {
                    counts[((t - 2.0) / 2.0).min(19.0) as usize] += 1;
                }
            }
            let mut chi = 0.0;
            for (cell, &count) in counts.iter().enumerate().take(cells) {
                let steps = 200;
                let t = |k: usize| 2.0 + 2.0 * (cell as f64 + (k as f64 + 0.5) / steps as f64);
                let inside = |t: f64| if t < exit { near.pdf(t) } else { 0.0 };
                let share: f64 = (0..steps).map(|k| inside(t(k))).sum::<f64>() * 2.0 / steps as f64;
                let expected = share * f64::from(n);
                if expected > 5.0 {
                    chi += (f64::from(count) - expected).powi(2) / expected;
                }
            }
            // 20 cells: the 99.9th percentile is 45.
            assert!(chi < 45.0, "{lamp}: {chi}");
        }
    }
}
