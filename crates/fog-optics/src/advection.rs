//! The advection-fog model of Kolářová, Lachiver & Wilkie 2024: droplet spectra by relative altitude and fog height.

mod model_file;

use crate::distribution::{DiameterGrid, SpectrumShape};
use crate::error::{OpticsError, check_range};
use crate::size::{DropletMoments, SizeDistribution};
use fog_core::math::f64::exp;

/// The shipped model: text of `tables/advection/arcata.yaml` (its comments say what is the paper's and what is inferred).
pub const ARCATA: &str = include_str!("../../../tables/advection/arcata.yaml");

/// Least and greatest fog height in m that the model accepts; it was measured in far fewer
/// ([`AdvectionModel::measured_heights_m`]).
pub const HEIGHT_RANGE_M: [f64; 2] = [1.0, 2000.0];

/// Polynomials over ζ = z/H, and over ζ and H for the number of droplets.
#[derive(Clone, Debug, PartialEq)]
pub struct AdvectionModel {
    diameters: DiameterGrid,
    measured_heights_m: Vec<f64>,
    mu_l: Vec<f64>,
    sigma_l: Vec<f64>,
    mu_g: Vec<f64>,
    sigma_g: Vec<f64>,
    ln_gl_ratio: Vec<f64>,
    number_density: Vec<Vec<f64>>,
    number_density_scale: f64,
}

impl AdvectionModel {
    /// Reads a model from YAML text of the form of `tables/advection/arcata.yaml`.
    ///
    /// # Errors
    /// If the text is not YAML of that form (with line and column), or its values make no sense.
    pub fn from_yaml(text: &str) -> Result<Self, OpticsError> {
        model_file::parse(text)
    }

    /// The shipped model, [`ARCATA`].
    ///
    /// # Errors
    /// None in a released version: a test reads it.
    pub fn arcata() -> Result<Self, OpticsError> {
        Self::from_yaml(ARCATA)
    }

    /// Diameters that sums over droplets run over: the file's range in steps of 0.1 µm.
    #[must_use]
    pub fn diameters(&self) -> &DiameterGrid {
        &self.diameters
    }

    /// Fog heights in m that the model was fitted to, ascending.
    #[must_use]
    pub fn measured_heights_m(&self) -> &[f64] {
        &self.measured_heights_m
    }

    /// True if `height_m` lies outside the measured heights, so that the model extrapolates: say so to the user.
    #[must_use]
    pub fn extrapolates(&self, height_m: f64) -> bool {
        let heights = &self.measured_heights_m;
        !(heights[0]..=heights[heights.len() - 1]).contains(&height_m)
    }

    /// Refuses a fog height outside [`HEIGHT_RANGE_M`].
    ///
    /// # Errors
    /// If `height_m` is not in that range.
    pub fn check_height(&self, height_m: f64) -> Result<(), OpticsError> {
        check_range("fog height_m", height_m, HEIGHT_RANGE_M[0], HEIGHT_RANGE_M[1])
    }

    /// Parameters of the spectrum at relative altitude ζ = z/H (clamped to [0, 1]), Sec. 4.3.
    #[must_use]
    pub fn shape(&self, zeta: f64) -> SpectrumShape {
        let zeta = zeta.clamp(0.0, 1.0);
        SpectrumShape {
            mu_l: polynomial(&self.mu_l, zeta),
            sigma_l: polynomial(&self.sigma_l, zeta),
            mu_g: polynomial(&self.mu_g, zeta),
            sigma_g: polynomial(&self.sigma_g, zeta),
            gl_ratio: exp(polynomial(&self.ln_gl_ratio, zeta)),
        }
    }

    /// Number density N(ζ, H) in m⁻³ by the scaling matrix of Sec. 4.3, over all diameters (a share of about 0.998 of them
    /// lies in the model's range); 0 outside 0 ≤ ζ ≤ 1 and where the polynomial is negative.
    #[must_use]
    pub fn number_density_1_m3(&self, zeta: f64, height_m: f64) -> f64 {
        if !(0.0..=1.0).contains(&zeta) {
            return 0.0;
        }
        polynomial(&self.number_polynomial(height_m), zeta).max(0.0)
    }

    /// Coefficients over ζ of the number density in 1/m³ at a fog height in m.
    pub(crate) fn number_polynomial(&self, height_m: f64) -> Vec<f64> {
        self.number_density.iter().map(|row| self.number_density_scale * polynomial(row, height_m)).collect()
    }

    /// Density of droplets over diameter, n(d, z) in m⁻³ µm⁻¹ (Eq. 1), for a diameter in µm and a fog height in m.
    #[must_use]
    pub fn density_1_m3_um(&self, d_um: f64, zeta: f64, height_m: f64) -> f64 {
        self.number_density_1_m3(zeta, height_m) * self.shape(zeta).density_1_um(d_um)
    }

    /// The droplet spectrum at relative altitude ζ = z/H (clamped to [0, 1]), over [`AdvectionModel::diameters`].
    #[must_use]
    pub fn distribution(&self, zeta: f64) -> SizeDistribution {
        SizeDistribution::unchecked(self.shape(zeta), self.diameters)
    }

    /// Moments of [`AdvectionModel::distribution`] at ζ.
    #[must_use]
    pub fn moments(&self, zeta: f64) -> DropletMoments {
        self.distribution(zeta).moments()
    }

    /// Liquid water content in g/m³ at ζ in a fog of height `height_m`.
    #[must_use]
    pub fn liquid_water_content_g_m3(&self, zeta: f64, height_m: f64) -> f64 {
        self.number_density_1_m3(zeta, height_m) * self.moments(zeta).mass_g
    }

    /// The polynomials that fix the shapes of the spectra, in the order of the file, for a fingerprint.
    pub(crate) fn shape_coefficients(&self) -> [&[f64]; 5] {
        [&self.mu_l, &self.sigma_l, &self.mu_g, &self.sigma_g, &self.ln_gl_ratio]
    }
}

/// c0 + c1 x + c2 x² + …, for `coefficients` c0, c1, c2, … as a model file lists them; 0 without any.
#[must_use]
pub fn polynomial(coefficients: &[f64], x: f64) -> f64 {
    coefficients.iter().rev().fold(0.0, |sum, c| sum * x + c)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn printed_numbers_of_fig_3_come_out() {
        let shape = AdvectionModel::arcata().unwrap().shape(0.5);
        assert!((shape.mu_l - 2.13).abs() < 1e-12 && (shape.sigma_l - 0.79).abs() < 1e-12);
        assert!((shape.mu_g - 8.82).abs() < 1e-12 && (shape.sigma_g - 2.21).abs() < 1e-12);
        assert!((shape.gl_ratio / (3.89 / 1.99) - 1.0).abs() < 2e-4);
    }

    #[test]
    fn density_is_number_times_shape_and_moments_are_plausible() {
        let model = AdvectionModel::arcata().unwrap();
        let n = model.number_density_1_m3(0.4, 150.0);
        let sum = model.diameters().integrate(|d| model.density_1_m3_um(d, 0.4, 150.0));
        assert!(sum < n && sum > 0.98 * n, "{sum} of {n}");
        for i in 0..=10 {
            let m = model.moments(f64::from(i) / 10.0);
            assert!(m.mean_diameter_um > 6.0 && m.mean_diameter_um < 20.0, "{m:?}");
            assert!(2.0 * m.effective_radius_um > m.mean_diameter_um, "{m:?}");
        }
        assert_eq!(model.number_density_1_m3(1.0001, 100.0), 0.0);
        assert_eq!(model.number_density_1_m3(f64::NAN, 100.0), 0.0);
    }

    #[test]
    fn heights_are_checked() {
        let model = AdvectionModel::arcata().unwrap();
        for bad in [0.0, -10.0, 5000.0, f64::NAN] {
            assert!(model.check_height(bad).is_err(), "{bad}");
        }
        assert!(model.check_height(180.0).is_ok());
        assert!(model.extrapolates(99.0) && model.extrapolates(261.0) && !model.extrapolates(260.0));
    }
}
