//! Droplet-size distributions: the two parts of Eq. 1–3 of Kolářová, Lachiver & Wilkie 2024, and sums over diameters.

mod grid;

pub use grid::DiameterGrid;

use fog_core::math::f64::{exp, ln};

const SQRT_TAU: f64 = 2.506_628_274_631_000_5; // √(2π)

/// Lognormal density in µm⁻¹ at diameter `d_um` > 0 (µm), Eq. 2; `mu` and `sigma` are those of ln(d / 1 µm). 0 for d ≤ 0.
#[must_use]
pub fn lognormal(d_um: f64, mu: f64, sigma: f64) -> f64 {
    if d_um <= 0.0 {
        return 0.0;
    }
    let t = (ln(d_um) - mu) / sigma;
    exp(-0.5 * t * t) / (SQRT_TAU * sigma * d_um)
}

/// Gaussian density in µm⁻¹ at diameter `d_um` (µm), Eq. 3; `mu` and `sigma` in µm.
#[must_use]
pub fn gaussian(d_um: f64, mu: f64, sigma: f64) -> f64 {
    let t = (d_um - mu) / sigma;
    exp(-0.5 * t * t) / (SQRT_TAU * sigma)
}

/// Shape of a droplet spectrum: a lognormal and a Gaussian with the ratio of their areas (Eq. 1, per droplet).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpectrumShape {
    /// Mean of ln(d / 1 µm) of the lognormal part.
    pub mu_l: f64,
    /// Standard deviation of ln d of the lognormal part, > 0.
    pub sigma_l: f64,
    /// Centre of the Gaussian part in µm.
    pub mu_g: f64,
    /// Width of the Gaussian part in µm, > 0.
    pub sigma_g: f64,
    /// Area of the Gaussian over that of the lognormal, G : L, ≥ 0.
    pub gl_ratio: f64,
}

impl SpectrumShape {
    /// μ_L, σ_L, μ_G, σ_G and ln(G : L): what a model file has polynomials for, in its order. ln(G : L) is −inf without a
    /// Gaussian part.
    #[must_use]
    pub fn parameters(&self) -> [f64; 5] {
        [self.mu_l, self.sigma_l, self.mu_g, self.sigma_g, ln(self.gl_ratio)]
    }

    /// Density per droplet in µm⁻¹ at diameter `d_um`: (logn + r·Gauss)/(1 + r).
    ///
    /// Its integral over all diameters is 1; it is not renormalised over a truncated range, nor for the part of the
    /// Gaussian below zero diameter.
    #[must_use]
    pub fn density_1_um(&self, d_um: f64) -> f64 {
        let r = self.gl_ratio;
        let sum = lognormal(d_um, self.mu_l, self.sigma_l) + r * gaussian(d_um, self.mu_g, self.sigma_g);
        sum / (1.0 + r)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn densities_integrate_to_one() {
        let grid = DiameterGrid::new(0.001, 400.001, 0.002).err();
        assert!(grid.is_some(), "200000 parts are too many");
        let grid = DiameterGrid::new(0.005, 400.005, 0.005).unwrap();
        assert!((grid.integrate(|d| lognormal(d, 2.13, 0.79)) - 1.0).abs() < 1e-6);
        assert!((grid.integrate(|d| gaussian(d, 8.82, 1.2)) - 1.0).abs() < 1e-9);
        let shape = SpectrumShape { mu_l: 2.13, sigma_l: 0.79, mu_g: 9.0, sigma_g: 1.2, gl_ratio: 1.95 };
        assert!((grid.integrate(|d| shape.density_1_um(d)) - 1.0).abs() < 1e-6);
        let mean = grid.integrate(|d| d * lognormal(d, 2.0, 0.5));
        assert!((mean / exp(2.0 + 0.125) - 1.0).abs() < 1e-6);
        assert_eq!(lognormal(0.0, 2.0, 0.5), 0.0);
    }
}
