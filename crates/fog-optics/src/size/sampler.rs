//! Draws diameters from a density that is linear between the diameters of a grid.

use crate::distribution::DiameterGrid;

/// A density over diameter, linear between the grid's diameters, and its inversion.
#[derive(Clone, Debug, PartialEq)]
pub struct DiameterSampler {
    grid: DiameterGrid,
    /// Density in µm⁻¹ at the grid's diameters; its integral is 1.
    density: Vec<f64>,
    /// Probability of a smaller diameter, at each of the grid's.
    below: Vec<f64>,
    /// Sum of the trapezoidal rule's shares up to each of the grid's diameters, itself included.
    shares: Vec<f64>,
}

impl DiameterSampler {
    /// From values ≥ 0 in any unit, not all 0, at the diameters of `grid`.
    pub(super) fn new(grid: DiameterGrid, mut density: Vec<f64>) -> Self {
        let (mut below, mut sum) = (vec![0.0; density.len()], 0.0);
        for i in 1..density.len() {
            sum += 0.5 * (density[i - 1] + density[i]) * (grid.diameter_um(i) - grid.diameter_um(i - 1));
            below[i] = sum;
        }
        below.iter_mut().for_each(|b| *b /= sum);
        density.iter_mut().for_each(|n| *n /= sum);
        let mut total = 0.0;
        let mut shares: Vec<f64> = (density.iter().enumerate())
            .map(|(i, n)| {
                total += grid.weight_um(i) * n;
                total
            })
            .collect();
        shares.iter_mut().for_each(|s| *s /= total);
        Self { grid, density, below, shares }
    }

    /// The diameter in µm below which the share `u` lies, for `u` uniform in [0, 1): exact inversion of the density that is
    /// linear between the grid's diameters. Never falls as u rises; u is clamped to [0, 1], NaN counts as 0.
    #[must_use]
    pub fn sample(&self, u: f64) -> f64 {
        let u = if u > 0.0 { u.min(1.0) } else { 0.0 };
        let mut i = self.below.partition_point(|&b| b <= u).clamp(1, self.below.len() - 1);
        // At u = 1 the last intervals can be empty of droplets: step back to one that is not.
        while i > 1 && self.below[i] <= self.below[i - 1] {
            i -= 1;
        }
        let (low, high) = (self.grid.diameter_um(i - 1), self.grid.diameter_um(i));
        let (n0, n1) = (self.density[i - 1], self.density[i]);
        // Fraction t of the interval with n0 t + (n1 − n0) t²/2 = share of the interval's mean density.
        let mass = self.below[i] - self.below[i - 1];
        let share = if mass > 0.0 { ((u - self.below[i - 1]) / mass).clamp(0.0, 1.0) } else { 0.0 };
        let wanted = share * 0.5 * (n0 + n1);
        let root = (n0 * n0 + 2.0 * (n1 - n0) * wanted).max(0.0).sqrt();
        let t = if n0 + root > 0.0 { (2.0 * wanted / (n0 + root)).min(1.0) } else { 0.0 };
        (low + t * (high - low)).min(high)
    }

    /// Density of [`DiameterSampler::sample`] in µm⁻¹ at diameter `d_um`: its integral is 1; 0 outside of the range.
    #[must_use]
    pub fn pdf(&self, d_um: f64) -> f64 {
        let [first, last] = self.grid.range_um();
        if !(first..=last).contains(&d_um) {
            return 0.0;
        }
        let low = self.interval(d_um);
        let high = low + 1;
        let (d0, d1) = (self.grid.diameter_um(low), self.grid.diameter_um(high));
        let t = ((d_um - d0) / (d1 - d0)).clamp(0.0, 1.0);
        self.density[low] + (self.density[high] - self.density[low]) * t
    }

    /// Probability of a diameter up to `d_um`: the inverse of [`DiameterSampler::sample`].
    #[must_use]
    pub fn cdf(&self, d_um: f64) -> f64 {
        let [first, last] = self.grid.range_um();
        if d_um.is_nan() || d_um <= first {
            return 0.0;
        }
        if d_um >= last {
            return 1.0;
        }
        let low = self.interval(d_um);
        let width = d_um - self.grid.diameter_um(low);
        (self.below[low] + 0.5 * width * (self.density[low] + self.pdf(d_um))).min(1.0)
    }

    /// Interval of the grid that holds a diameter of its range.
    fn interval(&self, d_um: f64) -> usize {
        let (mut low, mut high) = (0, self.grid.count() - 1);
        while high - low > 1 {
            let middle = low.midpoint(high);
            if self.grid.diameter_um(middle) <= d_um {
                low = middle;
            } else {
                high = middle;
            }
        }
        low
    }

    /// One of the grid's diameters by its index, for `u` uniform in [0, 1): drawn with its share of the trapezoidal rule,
    /// so that means over draws are what sums over the grid are.
    #[must_use]
    pub fn sample_node(&self, u: f64) -> usize {
        self.shares.partition_point(|&s| s <= u).min(self.shares.len() - 1)
    }

    /// Probability of the grid's diameter `i` in [`DiameterSampler::sample_node`].
    #[must_use]
    pub fn node_share(&self, i: usize) -> f64 {
        self.shares[i] - if i == 0 { 0.0 } else { self.shares[i - 1] }
    }

    /// The grid between whose diameters the density is linear.
    #[must_use]
    pub fn grid(&self) -> &DiameterGrid {
        &self.grid
    }
}
