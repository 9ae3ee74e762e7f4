//! The shape of a droplet spectrum over diameter, per droplet: what every fog is made of.
//!
//! A [`SizeDistribution`] is a density over a finite range of diameters. Sums over droplets run over its
//! [`DiameterGrid`] by the trapezoidal rule, which integrates the density that is linear between the grid's diameters
//! exactly; [`DiameterSampler`] draws from that same density. What a continuous spectrum has outside of the range is cut
//! off and not made up for: [`SizeDistribution::share_in_range`] says how much is left.

mod cover;
mod lognormals;
mod modified_gamma;
mod moments;
mod optics;
mod sampler;
mod tabulated;

pub use lognormals::LognormalMode;
pub use modified_gamma::ModifiedGamma;
pub use moments::DropletMoments;
pub use optics::MeanOptics;
pub use sampler::DiameterSampler;

use crate::distribution::{DiameterGrid, SpectrumShape};
use crate::error::OpticsError;
use tabulated::Tabulated;

/// Least share of the droplets that must lie in the range of a distribution.
const LEAST_SHARE: f64 = 1e-3;

/// Shape of a droplet spectrum over diameter, per droplet, over a finite range. Make it with one of its functions.
///
/// ```
/// use fog_optics::size::SizeDistribution;
/// let fog = SizeDistribution::gamma(5.0, 0.1)?;
/// assert!((fog.effective_radius_um() / 5.0 - 1.0).abs() < 1e-5);
/// let water_g_m3 = 1e8 * fog.mass_g(); // 100 droplets per cm³
/// assert!((0.02..0.06).contains(&water_g_m3));
/// # Ok::<(), fog_optics::error::OpticsError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct SizeDistribution {
    kind: Kind,
    grid: DiameterGrid,
    /// Density in µm⁻¹ at the grid's diameters.
    nodes: Vec<f64>,
}

#[derive(Clone, Debug, PartialEq)]
enum Kind {
    LognormalGaussian(SpectrumShape),
    ModifiedGamma(ModifiedGamma),
    Lognormals(Vec<LognormalMode>),
    Tabulated(Tabulated),
}

impl Kind {
    fn density_1_um(&self, d_um: f64) -> f64 {
        match self {
            Self::LognormalGaussian(shape) => shape.density_1_um(d_um),
            Self::ModifiedGamma(gamma) => gamma.density_1_um(d_um),
            Self::Lognormals(modes) => lognormals::density_1_um(modes, d_um),
            Self::Tabulated(table) => table.density_1_um(d_um),
        }
    }
}

impl SizeDistribution {
    /// Lognormal and Gaussian (Kolářová, Lachiver & Wilkie 2024, Eq. 1–3) over the diameters of `grid`. The density is not
    /// renormalised over the grid.
    ///
    /// # Errors
    /// If a width is not above 0, a parameter is not finite, the ratio is negative, or less than a thousandth of the
    /// droplets lies on the grid.
    pub fn lognormal_gaussian(shape: SpectrumShape, grid: DiameterGrid) -> Result<Self, OpticsError> {
        let SpectrumShape { mu_l, sigma_l, mu_g, sigma_g, gl_ratio } = shape;
        let finite = [mu_l, sigma_l, mu_g, sigma_g, gl_ratio].iter().all(|x| x.is_finite());
        if !(finite && sigma_l > 0.0 && sigma_g > 0.0 && gl_ratio >= 0.0) {
            return Err(refused(format!(
                "{shape:?} makes no spectrum; valid: finite, widths above 0, ratio 0 or more"
            )));
        }
        Self::unchecked(shape, grid).checked()
    }

    /// As [`SizeDistribution::lognormal_gaussian`], for a shape that has been checked.
    pub(crate) fn unchecked(shape: SpectrumShape, grid: DiameterGrid) -> Self {
        Self::tabulate(Kind::LognormalGaussian(shape), grid)
    }

    /// The gamma distribution of Hansen & Travis 1974 (Eq. 2.56), n(r) ∝ r^((1−3v)/v) exp(−r/(r_eff v)), by effective
    /// radius r_eff in µm, 0.01 to 500, and effective variance v, 0.001 to 0.33 (from 1/3 on the density has no maximum).
    /// Its range of diameters leaves out 1e-6 of the droplets below (and all below 0.001 µm) and 1e-6 of the water above.
    ///
    /// # Errors
    /// If a value is outside of its range.
    pub fn gamma(effective_radius_um: f64, effective_variance: f64) -> Result<Self, OpticsError> {
        Self::modified_gamma(ModifiedGamma::from_effective(effective_radius_um, effective_variance)?)
    }

    /// The modified gamma distribution (Deirmendjian 1969), n(r) ∝ r^α exp(−b r^γ) over the *radius* r in µm, over a range
    /// of diameters chosen as in [`SizeDistribution::gamma`].
    ///
    /// # Errors
    /// If the parameters are outside of the ranges of [`ModifiedGamma`], or reach outside of 0.001 to 5000 µm.
    pub fn modified_gamma(parameters: ModifiedGamma) -> Result<Self, OpticsError> {
        parameters.check()?;
        let grid = cover::grid(&|d_um| parameters.density_1_um(d_um))?;
        Self::modified_gamma_on(parameters, grid)
    }

    /// As [`SizeDistribution::modified_gamma`], over the diameters of `grid`.
    ///
    /// # Errors
    /// As there, or if less than a thousandth of the droplets lies on the grid.
    pub fn modified_gamma_on(parameters: ModifiedGamma, grid: DiameterGrid) -> Result<Self, OpticsError> {
        parameters.check()?;
        Self::tabulate(Kind::ModifiedGamma(parameters), grid).checked()
    }

    /// A sum of lognormals; their shares are divided by their sum. The range of diameters is chosen as in
    /// [`SizeDistribution::gamma`].
    ///
    /// # Errors
    /// If there are none or more than 16, or a value is outside of the ranges of [`LognormalMode`].
    pub fn lognormals(modes: &[LognormalMode]) -> Result<Self, OpticsError> {
        let modes = lognormals::normalised(modes)?;
        let grid = cover::grid(&|d_um| lognormals::density_1_um(&modes, d_um))?;
        Self::tabulate(Kind::Lognormals(modes), grid).checked()
    }

    /// A spectrum from rows (diameter in µm, density in any unit), linear between them and 0 outside. The density is
    /// divided by its integral.
    ///
    /// # Errors
    /// If there are fewer than two rows, the diameters do not ascend within 0.001 to 5000 µm, or a density is negative or
    /// not finite, or all are 0.
    pub fn tabulated(rows: &[(f64, f64)]) -> Result<Self, OpticsError> {
        Self::from_table(Tabulated::linear(rows)?)
    }

    /// A spectrum from counts in bins: `edges_um` are the bounds of the bins in µm, one more than there are `counts`;
    /// the density is even within a bin and the whole is divided by the sum.
    ///
    /// # Errors
    /// As [`SizeDistribution::tabulated`].
    pub fn binned(edges_um: &[f64], counts: &[f64]) -> Result<Self, OpticsError> {
        Self::from_table(Tabulated::steps(edges_um, counts)?)
    }

    fn from_table(table: Tabulated) -> Result<Self, OpticsError> {
        let grid = table.grid()?;
        let integral = grid.integrate(|d_um| table.density_1_um(d_um));
        if integral <= 0.0 || integral.is_nan() {
            return Err(refused("the tabulated spectrum has no droplets".to_owned()));
        }
        Self::tabulate(Kind::Tabulated(table.scaled(1.0 / integral)), grid).checked()
    }

    fn tabulate(kind: Kind, grid: DiameterGrid) -> Self {
        let nodes = (0..grid.count()).map(|i| kind.density_1_um(grid.diameter_um(i))).collect();
        Self { kind, grid, nodes }
    }

    fn checked(self) -> Result<Self, OpticsError> {
        let share = self.share_in_range();
        let valid = self.nodes.iter().all(|n| n.is_finite() && *n >= 0.0);
        if valid && share > LEAST_SHARE && share.is_finite() {
            return Ok(self);
        }
        let [low, high] = self.grid.range_um();
        Err(refused(format!(
            "a share of {share} of the droplets lies between {low} and {high} µm; valid: above {LEAST_SHARE}"
        )))
    }

    /// Density per droplet in µm⁻¹ at diameter `d_um` (µm); 0 outside of the range.
    #[must_use]
    pub fn density_1_um(&self, d_um: f64) -> f64 {
        let [low, high] = self.grid.range_um();
        if (low..=high).contains(&d_um) { self.kind.density_1_um(d_um) } else { 0.0 }
    }

    /// Diameters that sums over droplets run over.
    #[must_use]
    pub fn grid(&self) -> &DiameterGrid {
        &self.grid
    }

    /// Density in µm⁻¹ at the grid's diameters.
    #[must_use]
    pub fn densities_1_um(&self) -> &[f64] {
        &self.nodes
    }

    /// Diameter in µm below which the share `u` (clamped to 0 to 1) of the droplets in the range lies. For many quantiles
    /// keep [`SizeDistribution::by_number`], whose `sample` this is.
    #[must_use]
    pub fn quantile_um(&self, u: f64) -> f64 {
        self.by_number().sample(u)
    }

    /// Draws the diameter of a droplet of the range, each with the same probability.
    #[must_use]
    pub fn by_number(&self) -> DiameterSampler {
        DiameterSampler::new(self.grid, self.nodes.clone())
    }
}

fn refused(problem: String) -> OpticsError {
    OpticsError::Distribution(problem)
}

#[cfg(test)]
mod tests;
