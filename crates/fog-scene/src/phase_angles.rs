//! Scattering angles in proportion to the phase function, along a line past a lamp.
//!
//! A point of a line scatters a lamp's light by the angle α between the line and the direction to the lamp, which grows from
//! nearly 0 far before the lamp to nearly π far behind it. With h the lamp's distance from the line, dt/d² = dα/h: light that is
//! scattered once on the way is ∫ σ T p(α) dα I/h, and points whose angles follow p(α), not the solid angle's p(α) sin α, leave
//! the transmittances alone in the weights. (By 1/d² alone α is even: Kulla & Fajardo 2012.) Droplets scatter half of their light
//! within a degree, a hundred times and more what an even choice of α expects there.
//!
//! One table serves all altitudes and wavelengths: the mean of the phase functions, with a share of even angles.

use crate::phase::PhaseView;
use fog_core::colour::{VISIBLE_MAX_NM, VISIBLE_MIN_NM};
use fog_core::math;
use fog_core::spectrum::{LANES, Wavelengths};

/// Intervals of α, whose ends are π (k / `STEPS`)².
const STEPS: usize = 1024;
/// Share of even angles.
const EVEN: f64 = 0.15;
/// Rows of a table that the mean is over, at most.
const ROWS: usize = 32;

/// Distribution of scattering angles α in [0, π].
#[derive(Clone, Debug, PartialEq)]
pub struct PhaseAngles {
    /// Share of angles below the end of each interval, from 0 to 1.
    cumulative: Vec<f64>,
}

impl PhaseAngles {
    /// The angles of a phase function.
    #[must_use]
    pub fn new(phase: &PhaseView<'_>) -> Self {
        let nm = core::array::from_fn(|lane| {
            VISIBLE_MIN_NM + (VISIBLE_MAX_NM - VISIBLE_MIN_NM) * (lane as f32 + 0.5) / LANES as f32
        });
        let lanes = phase.lanes(&Wavelengths { nm });
        let step = phase.row_count().div_ceil(ROWS);
        let at = |k: usize| {
            let s = math::f64::sin(0.5 * end(k));
            let values = (0..phase.row_count()).step_by(step);
            // m = 1 − cos α = 2 sin²(α/2), which keeps its digits near 0.
            values.map(|row| f64::from(phase.eval(row, (2.0 * s * s) as f32, &lanes).mean())).sum::<f64>()
        };
        let mut cumulative = vec![0.0];
        let mut before = at(0);
        for k in 1..=STEPS {
            let here = at(k);
            cumulative.push(cumulative[k - 1] + 0.5 * (before + here) * (end(k) - end(k - 1)));
            before = here;
        }
        let whole = cumulative[STEPS];
        for (k, c) in cumulative.iter_mut().enumerate() {
            let shaped = if whole > 0.0 { *c / whole } else { end(k) / core::f64::consts::PI };
            *c = (1.0 - EVEN) * shaped + EVEN * end(k) / core::f64::consts::PI;
        }
        Self { cumulative }
    }

    /// Share of angles below α in [0, π].
    #[inline]
    #[must_use]
    pub fn below(&self, alpha: f64) -> f64 {
        let k = interval(alpha);
        self.cumulative[k] + self.density_in(k) * (alpha - end(k))
    }

    /// Density of the angle α per radian.
    #[inline]
    #[must_use]
    pub fn density(&self, alpha: f64) -> f64 {
        self.density_in(interval(alpha))
    }

    /// The angle below which this share of angles lies: the inverse of [`PhaseAngles::below`].
    #[inline]
    #[must_use]
    pub fn angle(&self, share: f64) -> f64 {
        let k = self.cumulative.partition_point(|&c| c <= share).clamp(1, STEPS) - 1;
        end(k) + (share - self.cumulative[k]) / self.density_in(k)
    }

    #[inline]
    fn density_in(&self, k: usize) -> f64 {
        (self.cumulative[k + 1] - self.cumulative[k]) / (end(k + 1) - end(k))
    }
}

/// Lower end of an interval.
#[inline]
fn end(k: usize) -> f64 {
    let x = k as f64 / STEPS as f64;
    core::f64::consts::PI * x * x
}

#[inline]
fn interval(alpha: f64) -> usize {
    let k = ((alpha / core::f64::consts::PI).max(0.0).sqrt() * STEPS as f64) as usize;
    k.min(STEPS - 1)
}

#[cfg(test)]
mod tests {
    use super::*;
    use fog_core::phase::HenyeyGreenstein;

    #[test]
    fn shares_angles_and_densities_belong_together() {
        let hg = HenyeyGreenstein::new(0.98).unwrap();
        let angles = PhaseAngles::new(&PhaseView::HenyeyGreenstein(hg));
        assert_eq!((angles.below(0.0), angles.cumulative[0]), (0.0, 0.0));
        assert!((angles.below(core::f64::consts::PI) - 1.0).abs() < 1e-12);
        for i in 0..1000 {
            let share = (f64::from(i) + 0.5) / 1000.0;
            let alpha = angles.angle(share);
            assert!((0.0..=core::f64::consts::PI).contains(&alpha));
            assert!((angles.below(alpha) - share).abs() < 1e-12, "{share}");
            let d = 1e-7;
            let slope = (angles.below(alpha + d) - angles.below(alpha - d)) / (2.0 * d);
            assert!((slope / angles.density(alpha) - 1.0).abs() < 0.05, "{alpha}: {slope}");
        }
        // In proportion to the phase function, less the even share.
        let even = EVEN / core::f64::consts::PI;
        let ratio = |alpha: f64| (angles.density(alpha) - even) / hg.eval(1.0 - math::f64::cos(alpha));
        assert!((ratio(0.02) / ratio(0.5) - 1.0).abs() < 0.05, "{} {}", ratio(0.02), ratio(0.5));
    }
}
