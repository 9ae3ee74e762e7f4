//! The modified gamma distribution and its special case by effective radius and variance.

use crate::error::{OpticsError, check_range};
use fog_core::math::f64::{exp, ln, ln_gamma, pow};

/// Parameters of n(r) ∝ r^α exp(−b r^γ), r the radius in µm (Deirmendjian, *Electromagnetic Scattering on Spherical
/// Polydispersions*, 1969).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ModifiedGamma {
    /// Exponent of the rise, 0 to 1000.
    pub alpha: f64,
    /// Rate of the fall in µm^−γ, 1e-20 to 1e12.
    pub b: f64,
    /// Exponent in the fall, 0.25 to 8.
    pub gamma: f64,
}

impl ModifiedGamma {
    /// The gamma distribution of Hansen & Travis 1974 (Eq. 2.56) by effective radius r_eff in µm, 0.01 to 500, and effective
    /// variance v, 0.001 to 0.33: α = (1 − 3v)/v, b = 1/(r_eff v), γ = 1.
    ///
    /// # Errors
    /// If a value is outside of its range.
    pub fn from_effective(effective_radius_um: f64, effective_variance: f64) -> Result<Self, OpticsError> {
        check_range("effective_radius_um", effective_radius_um, 0.01, 500.0)?;
        check_range("effective_variance", effective_variance, 0.001, 0.33)?;
        Ok(Self {
            alpha: (1.0 - 3.0 * effective_variance) / effective_variance,
            b: 1.0 / (effective_radius_um * effective_variance),
            gamma: 1.0,
        })
    }

    /// By α, γ and the radius in µm at which the density is greatest, r_mode = (α/(bγ))^(1/γ).
    ///
    /// # Errors
    /// If the radius is not above 0, α is 0, or the parameters are outside of their ranges.
    pub fn from_mode(alpha: f64, gamma: f64, mode_radius_um: f64) -> Result<Self, OpticsError> {
        check_range("mode_radius_um", mode_radius_um, 1e-3, 500.0)?;
        check_range("modified gamma alpha", alpha, 1e-3, 1000.0)?;
        let parameters = Self { alpha, b: alpha / (gamma * pow(mode_radius_um, gamma)), gamma };
        parameters.check()?;
        Ok(parameters)
    }

    /// Radius in µm at which the density is greatest; 0 for α = 0.
    #[must_use]
    pub fn mode_radius_um(&self) -> f64 {
        pow(self.alpha / (self.b * self.gamma), 1.0 / self.gamma)
    }

    /// Density per droplet over the *diameter* in µm⁻¹, at diameter `d_um` in µm; 0 for d ≤ 0. Its integral over all
    /// diameters is 1.
    #[must_use]
    pub fn density_1_um(&self, d_um: f64) -> f64 {
        if d_um <= 0.0 {
            return 0.0;
        }
        let ln_r = ln(0.5 * d_um);
        let order = (self.alpha + 1.0) / self.gamma;
        let ln_norm = ln(self.gamma) + order * ln(self.b) - ln_gamma(order);
        0.5 * exp(ln_norm + self.alpha * ln_r - self.b * exp(self.gamma * ln_r))
    }

    pub(super) fn check(&self) -> Result<(), OpticsError> {
        check_range("modified gamma alpha", self.alpha, 0.0, 1000.0)?;
        check_range("modified gamma b", self.b, 1e-20, 1e12)?;
        check_range("modified gamma gamma", self.gamma, 0.25, 8.0)
    }
}
