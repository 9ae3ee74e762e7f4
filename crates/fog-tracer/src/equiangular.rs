//! Points of a flight chosen by how near they are to a lamp, and by how much of its light the fog turns there into the flight.
//!
//! A lamp lights the fog around it by 1/d², and droplets turn most of that hardly at all; free flights know nothing of either: the
//! few that end where a lamp's light is strong are bright. Points whose density along the flight is 1/d² times the phase function
//! ([`fog_scene::phase_angles`]; equiangular sampling after Kulla & Fajardo, *Importance Sampling Techniques for Path Tracing in
//! Participating Media*, 2012, with angles that follow the phase function) leave none of that in the weights. Both kinds
//! of points are used, weighted by the balance heuristic: their densities are closed forms, for the layer's transmittance is exact.

use fog_core::{Vec3A, math};
use fog_scene::light_tree::Receiver;
use fog_scene::phase_angles::PhaseAngles;

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

/// Distances along a segment whose density is 1/d² of a lamp times the phase function.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Equiangular<'a> {
    angles: &'a PhaseAngles,
    nearest: f64,
    from_line: f64,
    /// Share of angles before the segment, and in it.
    first: f64,
    range: f64,
}

impl Segment {
    /// For the choice of a lamp.
    pub(crate) fn receiver<'a>(&self, angles: &'a PhaseAngles) -> Receiver<'a> {
        let Self { origin, direction, enter, exit } = *self;
        let (enter, exit) = (enter as f32, exit as f32);
        Receiver::Segment { origin, direction, enter, exit, angles: Some(angles) }
    }

    /// Distances by nearness to a lamp.
    pub(crate) fn near<'a>(&self, lamp: Vec3A, angles: &'a PhaseAngles) -> Equiangular<'a> {
        let offset = (lamp - self.origin).as_dvec3();
        let direction = self.direction.as_dvec3();
        let nearest = offset.dot(direction);
        let from_line = (offset - direction * nearest).length().max(NEAREST_M);
        let below = |t: f64| angles.below(math::f64::atan2(from_line, nearest - t));
        let first = below(self.enter);
        Equiangular { angles, nearest, from_line, first, range: below(self.exit) - first }
    }
}

impl Equiangular<'_> {
    /// A distance for `u` uniform in [0, 1); `None` if the segment is too short or too far to be told from a point.
    pub(crate) fn sample(&self, u: f64) -> Option<f64> {
        let alpha = self.angles.angle(self.first + u * self.range);
        let t = self.nearest - self.from_line / math::f64::tan(alpha);
        (self.range > 0.0 && t.is_finite() && t >= 0.0).then_some(t)
    }

    /// Density of [`Equiangular::sample`], in 1/m.
    pub(crate) fn pdf(&self, t: f64) -> f64 {
        if self.range <= 0.0 {
            return 0.0;
        }
        let before = self.nearest - t;
        let density = self.angles.density(math::f64::atan2(self.from_line, before));
        density * self.from_line / (self.range * (self.from_line * self.from_line + before * before))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use fog_core::phase::HenyeyGreenstein;
    use fog_core::random::PathRng;
    use fog_scene::phase::PhaseView;

    #[test]
    fn distances_follow_their_density() {
        let direction = Vec3A::new(2.0, 1.0, 0.0).normalize();
        let hg = HenyeyGreenstein::new(0.9).unwrap();
        let angles = PhaseAngles::new(&PhaseView::HenyeyGreenstein(hg));
        for (lamp, exit) in [(Vec3A::new(10.0, 6.0, 1.0), 40.0), (Vec3A::X * -5.0, f64::INFINITY)] {
            let segment = Segment { origin: Vec3A::ZERO, direction, enter: 2.0, exit };
            let near = segment.near(lamp, &angles);
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
