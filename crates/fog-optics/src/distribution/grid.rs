//! The diameters that sums over droplets run over.

use crate::error::OpticsError;
use fog_core::math::f64::{exp, ln};

/// Most diameters of a grid.
const MAX_COUNT: usize = 100_001;

/// Ascending diameters, at equal steps or at equal ratios, with the weights of the trapezoidal rule.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DiameterGrid {
    first_um: f64,
    last_um: f64,
    spacing: Spacing,
    count: usize,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Spacing {
    /// Step in µm.
    Steps(f64),
    /// Natural logarithm of the ratio of neighbours.
    Ratios(f64),
}

impl DiameterGrid {
    /// Diameters from `first_um` to `last_um` inclusive in steps of `step_um`, all in µm.
    ///
    /// # Errors
    /// Unless 0 < first < last and the step, > 0, divides their distance into at most 100 000 parts (to 1e-6 of a step).
    pub fn new(first_um: f64, last_um: f64, step_um: f64) -> Result<Self, OpticsError> {
        let parts = ((last_um - first_um) / step_um).round();
        let fits = (first_um + parts * step_um - last_um).abs() <= 1e-6 * step_um;
        if !(first_um > 0.0 && last_um > first_um && step_um > 0.0 && parts < MAX_COUNT as f64 && fits) {
            return Err(OpticsError::Settings(format!(
                "diameters from {first_um} to {last_um} µm by {step_um} µm; valid: 0 < first < last, a step that divides \
                 their distance into at most 100000 parts"
            )));
        }
        let count = parts as usize + 1;
        let last_um = first_um + step_um * parts;
        Ok(Self { first_um, last_um, spacing: Spacing::Steps(step_um), count })
    }

    /// `count` diameters from `first_um` to `last_um` (µm) inclusive, each the same multiple of the one before it: for
    /// spectra that reach over decades.
    ///
    /// # Errors
    /// Unless 0 < first < last < ∞ and the count is 2 to 100 001.
    pub fn geometric(first_um: f64, last_um: f64, count: usize) -> Result<Self, OpticsError> {
        let valid = first_um > 0.0 && last_um > first_um && last_um.is_finite();
        if !(valid && (2..=MAX_COUNT).contains(&count)) {
            return Err(OpticsError::Settings(format!(
                "{count} diameters at equal ratios from {first_um} to {last_um} µm; valid: 0 < first < last, 2 to 100001 \
                 of them"
            )));
        }
        let spacing = Spacing::Ratios(ln(last_um / first_um) / (count - 1) as f64);
        Ok(Self { first_um, last_um, spacing, count })
    }

    /// Diameters from `first_um` to `last_um` inclusive in the largest equal steps that are at most `step_um`, all in µm.
    ///
    /// # Errors
    /// As [`DiameterGrid::new`].
    pub fn covering(first_um: f64, last_um: f64, step_um: f64) -> Result<Self, OpticsError> {
        let parts = ((last_um - first_um) / step_um - 1e-9).ceil().max(1.0);
        Self::new(first_um, last_um, (last_um - first_um) / parts)
    }

    /// The grid of Sec. 5.3 for a range of diameters in µm: steps of 0.1 µm.
    ///
    /// # Errors
    /// As [`DiameterGrid::new`].
    pub fn fine(range_um: [f64; 2]) -> Result<Self, OpticsError> {
        Self::new(range_um[0], range_um[1], 0.1)
    }

    /// Number of diameters.
    #[must_use]
    pub fn count(&self) -> usize {
        self.count
    }

    /// Diameter `i` in µm.
    #[must_use]
    pub fn diameter_um(&self, i: usize) -> f64 {
        match self.spacing {
            Spacing::Steps(step) => self.first_um + step * i as f64,
            Spacing::Ratios(_) if i + 1 >= self.count => self.last_um,
            Spacing::Ratios(ln_ratio) => self.first_um * exp(ln_ratio * i as f64),
        }
    }

    /// Weight of diameter `i` in the trapezoidal rule, in µm.
    #[must_use]
    pub fn weight_um(&self, i: usize) -> f64 {
        match self.spacing {
            Spacing::Steps(step) if i == 0 || i + 1 == self.count => 0.5 * step,
            Spacing::Steps(step) => step,
            Spacing::Ratios(_) => {
                0.5 * (self.diameter_um((i + 1).min(self.count - 1)) - self.diameter_um(i.saturating_sub(1)))
            }
        }
    }

    /// ∫ f(d) dd over the grid by the trapezoidal rule, d in µm.
    #[must_use]
    pub fn integrate(&self, f: impl Fn(f64) -> f64) -> f64 {
        (0..self.count).map(|i| self.weight_um(i) * f(self.diameter_um(i))).sum()
    }

    /// Least and greatest diameter in µm.
    #[must_use]
    pub fn range_um(&self) -> [f64; 2] {
        [self.first_um, self.last_um]
    }

    /// First and last diameter and step in µm: what identifies the grid. At equal ratios, in place of the step: minus the
    /// logarithm of the ratio.
    #[must_use]
    pub fn bounds_um(&self) -> [f64; 3] {
        match self.spacing {
            Spacing::Steps(step) => [self.first_um, self.last_um, step],
            Spacing::Ratios(ln_ratio) => [self.first_um, self.last_um, -ln_ratio],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn grids_hold_their_ends() {
        let grid = DiameterGrid::fine([0.5, 60.0]).unwrap();
        assert_eq!(grid.count(), 596);
        assert!((grid.diameter_um(595) - 60.0).abs() < 1e-12);
        assert!((grid.integrate(|_| 1.0) - 59.5).abs() < 1e-10);
        for (a, b, c) in
            [(0.0, 1.0, 0.1), (2.0, 1.0, 0.1), (1.0, 2.0, 0.3), (1.0, 2.0, f64::NAN), (1.0, 2.0, -0.1)]
        {
            assert!(DiameterGrid::new(a, b, c).is_err(), "{a} {b} {c}");
        }
        let grid = DiameterGrid::covering(1.0, 2.05, 0.1).unwrap();
        assert!(grid.count() == 12 && (grid.range_um()[1] - 2.05).abs() < 1e-12);
        assert_eq!(DiameterGrid::covering(0.5, 60.0, 0.1).unwrap().count(), 596);
        assert!(DiameterGrid::covering(2.0, 1.0, 0.1).is_err());
    }

    #[test]
    fn equal_ratios_reach_over_decades() {
        let grid = DiameterGrid::geometric(0.01, 100.0, 401).unwrap();
        let ratio = grid.diameter_um(1) / grid.diameter_um(0);
        assert!((grid.diameter_um(399) * ratio / 100.0 - 1.0).abs() < 1e-12);
        assert_eq!((grid.diameter_um(400), grid.range_um()), (100.0, [0.01, 100.0]));
        assert!((grid.integrate(|_| 1.0) / 99.99 - 1.0).abs() < 1e-12);
        assert!((grid.integrate(|d| 1.0 / d) / ln(1e4) - 1.0).abs() < 1e-4);
        for (a, b, n) in [(0.0, 1.0, 9), (2.0, 1.0, 9), (1.0, f64::INFINITY, 9), (1.0, 2.0, 1)] {
            assert!(DiameterGrid::geometric(a, b, n).is_err(), "{a} {b} {n}");
        }
    }
}
