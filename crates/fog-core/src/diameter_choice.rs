//! Which droplet scatters: the choice of a diameter by altitude and wavelength.

use crate::optics_table::MAX_COLUMNS;
use crate::phase_lookup::interpolating_row;
use crate::spectrum::{LANES, LaneWeights, Spectrum};
use std::sync::Arc;

/// Probabilities of the diameters of a [droplet table](crate::droplet_table), by relative altitude and wavelength; cheap to
/// clone. At a wavelength between two of the table's, they are those of the two, mixed linearly.
#[derive(Clone, Debug)]
pub struct DiameterChoice {
    zeta: Arc<[f64]>,
    diameters: usize,
    wavelengths: usize,
    /// \[ζ\]\[λ\]\[diameter\]: probability of this diameter or a smaller one.
    cumulative: Arc<[f64]>,
    /// \[ζ\]\[diameter\]\[λ\].
    probability: Arc<[f32]>,
}

/// A diameter drawn at the hero's wavelength.
#[derive(Clone, Copy, Debug)]
pub struct ChosenDiameter {
    /// Its row in the droplet table.
    pub row: usize,
    /// Where the lanes fall in the droplet's phase function. Given the diameter, the two wavelengths of the table that a
    /// lane lies between have other odds than before: by Bayes' rule, each counts by its probability of this diameter.
    pub lanes: LaneWeights,
    /// Probability of the diameter at each lane over that at the hero.
    pub probability_ratio: Spectrum,
}

impl DiameterChoice {
    /// Choice at relative altitudes `zeta` (ascending) with probabilities proportional to `weights`, \[ζ\]\[diameter\]\[λ\].
    ///
    /// # Errors
    /// A description, if the lengths do not fit, there are more than 64 wavelengths, `zeta` does not ascend, a weight is
    /// negative or not finite, or all weights of an altitude and wavelength are 0.
    pub fn new(zeta: &[f64], wavelengths: usize, weights: &[f64]) -> Result<Self, String> {
        let cells = zeta.len() * wavelengths;
        if cells == 0
            || wavelengths > MAX_COLUMNS
            || weights.is_empty()
            || !weights.len().is_multiple_of(cells)
        {
            let found = weights.len();
            return Err(format!("{found} weights for {} altitudes × {wavelengths} wavelengths", zeta.len()));
        }
        if zeta.windows(2).any(|w| w[0].is_nan() || w[0] >= w[1]) {
            return Err("relative altitudes do not ascend".to_owned());
        }
        let diameters = weights.len() / cells;
        let mut cumulative = vec![0.0; weights.len()];
        let mut probability = vec![0.0; weights.len()];
        for z in 0..zeta.len() {
            for l in 0..wavelengths {
                let at = |d: usize| (z * diameters + d) * wavelengths + l;
                let sum: f64 = (0..diameters).map(|d| weights[at(d)]).sum();
                let valid = (0..diameters).all(|d| weights[at(d)] >= 0.0) && sum > 0.0 && sum.is_finite();
                if !valid {
                    return Err(format!(
                        "weights at altitude {} and wavelength {l} sum up to {sum}",
                        zeta[z]
                    ));
                }
                let cdf = &mut cumulative[(z * wavelengths + l) * diameters..][..diameters];
                let mut below = 0.0;
                for d in 0..diameters {
                    below += weights[at(d)];
                    cdf[d] = below / sum;
                    if weights[at(d)] > 0.0 {
                        // What can be drawn has a probability, however small.
                        probability[at(d)] = ((weights[at(d)] / sum) as f32).max(f32::MIN_POSITIVE);
                    }
                }
            }
        }
        let zeta = zeta.into();
        Ok(Self {
            zeta,
            diameters,
            wavelengths,
            cumulative: cumulative.into(),
            probability: probability.into(),
        })
    }

    /// The row of altitude whose probabilities a scattering at `zeta` has, for `u` uniform in [0, 1): over many of them,
    /// linear interpolation.
    #[inline]
    #[must_use]
    pub fn row(&self, zeta: f32, u: f32) -> usize {
        interpolating_row(&self.zeta, zeta, u)
    }

    /// Draws a diameter at the hero's wavelength in altitude row `row`: `pick` chooses between the hero's two neighbouring
    /// wavelengths of the table, whose cumulative distribution is inverted at `u`; both uniform in [0, 1).
    #[inline]
    #[must_use]
    pub fn sample(&self, row: usize, lanes: &LaneWeights, u: f64, pick: f32) -> ChosenDiameter {
        let (w, d) = (self.wavelengths, self.diameters);
        let lower = lanes.index[0] as usize;
        let column = if pick < lanes.weight[0] { lower + 1 } else { lower }.min(w - 1);
        let cdf = &self.cumulative[(row * w + column) * d..][..d];
        let chosen = cdf.partition_point(|&c| c <= u).min(d - 1);
        self.chosen(row, chosen, lanes)
    }

    #[inline]
    fn chosen(&self, row: usize, diameter: usize, lanes: &LaneWeights) -> ChosenDiameter {
        let w = self.wavelengths;
        let mut column = [0.0f32; MAX_COLUMNS];
        column[..w].copy_from_slice(&self.probability[(row * self.diameters + diameter) * w..][..w]);
        let probability = lanes.gather(&column);
        let mut lanes = *lanes;
        for lane in 0..LANES {
            let upper = column[(lanes.index[lane] as usize + 1) & (MAX_COLUMNS - 1)];
            let share = lanes.weight[lane] * upper / probability[lane];
            lanes.weight[lane] = if share.is_finite() { share.min(1.0) } else { 0.0 };
        }
        let probability_ratio = probability / Spectrum::splat(probability[0]);
        ChosenDiameter { row: diameter, lanes, probability_ratio }
    }

    /// Probability of each diameter in altitude row `row` and wavelength row `wavelength_row`, by diameter.
    #[must_use]
    pub fn probabilities(&self, row: usize, wavelength_row: usize) -> Vec<f64> {
        let cdf = &self.cumulative[(row * self.wavelengths + wavelength_row) * self.diameters..];
        (0..self.diameters).map(|d| cdf[d] - if d > 0 { cdf[d - 1] } else { 0.0 }).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spectrum::Wavelengths;

    /// Two altitudes, three diameters, two wavelengths.
    const WEIGHTS: [f64; 12] = [1.0, 3.0, 2.0, 0.0, 1.0, 1.0, 0.5, 0.5, 0.25, 0.25, 0.25, 0.25];

    #[test]
    fn probabilities_are_mixed_and_odds_follow_bayes() {
        let choice = DiameterChoice::new(&[0.0, 1.0], 2, &WEIGHTS).unwrap();
        assert_eq!(choice.probabilities(0, 0), [0.25, 0.5, 0.25]);
        assert_eq!(choice.probabilities(0, 1), [0.75, 0.0, 0.25]);
        let mut nm = [475.0; LANES];
        (nm[1], nm[2]) = (400.0, 500.0);
        let lanes = LaneWeights::new(&[400.0, 500.0], &Wavelengths { nm });
        // The hero's own odds: ¾ of the second column.
        let first = choice.sample(0, &lanes, 0.1, 0.9);
        let p = 0.25 * 0.25 + 0.75 * 0.75;
        assert_eq!(first.row, 0);
        assert!((first.probability_ratio[0] - 1.0).abs() < 1e-6);
        assert!((first.probability_ratio[1] - 0.25 / p).abs() < 1e-6);
        assert!((first.lanes.weight[0] - 0.75 * 0.75 / p).abs() < 1e-6);
        // The second diameter does not exist at the upper wavelength.
        let second = choice.sample(0, &lanes, 0.5, 0.9);
        assert_eq!((second.row, second.lanes.weight[0]), (1, 0.0));
        assert_eq!((second.probability_ratio[2], second.lanes.weight[2]), (0.0, 0.0));
        let third = choice.sample(0, &lanes, 0.9999, 0.1);
        assert_eq!(third.row, 2);
        assert_eq!([choice.row(0.5, 0.4), choice.row(0.5, 0.6)], [1, 0]);
    }

    #[test]
    fn bad_weights_are_refused() {
        for (zeta, w, weights) in [
            (&[][..], 1, &[1.0][..]),
            (&[0.0], 1, &[]),
            (&[0.0], 2, &[1.0]),
            (&[1.0, 0.0], 1, &[1.0, 1.0]),
            (&[0.0], 1, &[0.0, 0.0]),
            (&[0.0], 1, &[2.0, -1.0]),
            (&[0.0], 1, &[f64::NAN, 1.0]),
        ] {
            assert!(DiameterChoice::new(zeta, w, weights).is_err(), "{zeta:?} {w} {weights:?}");
        }
    }
}
