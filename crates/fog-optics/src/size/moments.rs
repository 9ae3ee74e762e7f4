//! Sums over the droplets of a spectrum.

use super::SizeDistribution;
use fog_core::math::PI;

/// Density of liquid water in g/m³, 1 g/cm³ (0.3 % more than at 25 °C).
const WATER_G_M3: f64 = 1e6;

/// Sums over the droplets of one spectrum, per droplet.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DropletMoments {
    /// Share of the droplets whose diameters lie in the range, ∫ n̂ dd; N times it is the number that is there.
    pub share_in_range: f64,
    /// Number-mean diameter ∫n d / ∫n in µm.
    pub mean_diameter_um: f64,
    /// Effective radius ½ ∫n d³ / ∫n d² in µm (Hansen & Travis 1974, Eq. 2.53).
    pub effective_radius_um: f64,
    /// Effective variance ∫n d⁴ ∫n d² / (∫n d³)² − 1, dimensionless (Hansen & Travis 1974, Eq. 2.54).
    pub effective_variance: f64,
    /// Mass of water per droplet in g: 10⁶ g/m³ · (π/6) ∫n̂ d³, with n̂ not renormalised over the range.
    pub mass_g: f64,
}

impl SizeDistribution {
    /// ∫ n̂ d^k dd over the range, in µm^k, by the trapezoidal rule.
    #[must_use]
    pub fn moment(&self, k: i32) -> f64 {
        (self.nodes.iter().enumerate())
            .map(|(i, n)| self.grid.weight_um(i) * n * self.grid.diameter_um(i).powi(k))
            .sum()
    }

    /// Share of the droplets whose diameters lie in the range: [`SizeDistribution::moment`] 0. 1 for a tabulated spectrum;
    /// less where the tails of a continuous one are cut off.
    #[must_use]
    pub fn share_in_range(&self) -> f64 {
        self.moment(0)
    }

    /// Number-mean diameter in µm.
    #[must_use]
    pub fn mean_diameter_um(&self) -> f64 {
        self.moments().mean_diameter_um
    }

    /// Effective radius in µm: ½ ∫n d³ / ∫n d².
    #[must_use]
    pub fn effective_radius_um(&self) -> f64 {
        self.moments().effective_radius_um
    }

    /// Effective variance, dimensionless: ∫n d⁴ ∫n d² / (∫n d³)² − 1.
    #[must_use]
    pub fn effective_variance(&self) -> f64 {
        self.moments().effective_variance
    }

    /// Mass of water per droplet in g: liquid water content in g/m³ = N in 1/m³ × this.
    #[must_use]
    pub fn mass_g(&self) -> f64 {
        self.moments().mass_g
    }

    /// The sums that a fog is described by, in one pass.
    #[must_use]
    pub fn moments(&self) -> DropletMoments {
        let mut m = [0.0; 5];
        for (i, density) in self.nodes.iter().enumerate() {
            let d = self.grid.diameter_um(i);
            let mut n = self.grid.weight_um(i) * density;
            for sum in &mut m {
                *sum += n;
                n *= d;
            }
        }
        DropletMoments {
            share_in_range: m[0],
            mean_diameter_um: m[1] / m[0],
            effective_radius_um: 0.5 * m[3] / m[2],
            effective_variance: (m[4] * m[2] / (m[3] * m[3]) - 1.0).max(0.0),
            mass_g: WATER_G_M3 * PI / 6.0 * m[3] * 1e-18,
        }
    }
}
