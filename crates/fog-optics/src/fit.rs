//! A fog model from measured droplet counts (paper, Sec. 4.2–4.3).
//!
//! [`parse`] reads counts by fog height, altitude and diameter bin; [`fit`] makes an [`AdvectionModel`](crate::advection::AdvectionModel) of them:
//!
//! 1. each altitude by itself: N and the shape (lognormal + Gaussian, Eq. 1–3, integrated over the bins) that make the
//!    counts likeliest, by bounded Levenberg–Marquardt from ten starts; bins that stand out are set aside. Starts that fit
//!    equally well are told apart: the Gaussian is the narrower part, and neighbours in ζ should agree;
//! 2. altitudes are normalised, ζ = z/H, and the sets of all heights merged;
//! 3. each shape parameter over ζ: polynomials weighted by the standard errors, degree by cross-validation, altitudes that
//!    stand out rejected;
//! 4. all counts at once: the coefficients of those polynomials that make all counts likeliest, each altitude's N left free
//!    (optional; the stages before are the paper's path);
//! 5. the number density over ζ and H: the scaling matrix, degrees by cross-validation.
//!
//! Outlier rule everywhere: a deviation of more than `outlier_mads` times the robust standard deviation, 1.4826 times the
//! median absolute deviation (and never less than what counting noise explains). The result depends on the measurements
//! and settings alone, not on threads.
//!
//! ```
//! use fog_optics::{advection::AdvectionModel, fit};
//! let arcata = AdvectionModel::arcata()?;
//! let flights = fit::synthetic::measurements(&arcata, &fit::synthetic::FlightSettings::arcata())?;
//! let found = fit::fit(&flights, &fit::FitSettings::default(), &|_done| ())?;
//! assert!((found.model.shape(0.5).mu_g / arcata.shape(0.5).mu_g - 1.0).abs() < 0.02);
//! # Ok::<(), fog_optics::error::OpticsError>(())
//! ```

mod altitude;
mod assemble;
mod basis;
mod bins;
mod csv;
mod degrees;
mod joint;
mod least_squares;
mod linear;
mod markdown;
mod measurements;
mod model_text;
mod number;
mod outcome;
mod poisson;
mod report;
mod shapes;
mod starts;
mod survey;
pub mod synthetic;
#[cfg(test)]
mod tests;
mod trend;

pub use altitude::BINS_MIN;
pub use csv::{parse, write_counts};
pub use degrees::DegreeStep;
pub use measurements::{Bin, Measurements, Observation, Quantity, Spectrum};
pub use outcome::{AltitudeFit, Fit, NumberFit, OwnFit, ParameterFit, SHAPE_KEYS, Standing};
pub use trend::{CrossValidation, Degrees};

use crate::error::{OpticsError, check_range};

/// How to fit.
#[derive(Clone, Debug, PartialEq)]
pub struct FitSettings {
    /// Range of diameters in µm that the model's sums over droplets run over, a multiple of 0.1 µm wide; `None`: the paper's
    /// 0.5 to 60 µm (Sec. 5.3), widened to the measured bins.
    pub diameter_range_um: Option<[f64; 2]>,
    /// Greatest degree of the shape polynomials over ζ, 0 to 6.
    pub max_shape_degree: usize,
    /// Greatest degree of the number density over ζ, 0 to 8.
    pub max_number_degree: usize,
    /// Greatest degree of the number density over the height, 0 to 3; never more than the number of heights less one.
    pub max_height_degree: usize,
    /// Folds of the cross-validation, 2 to 50.
    pub folds: usize,
    /// Deviation in robust standard deviations beyond which a bin or an altitude is set aside, 3 to 100.
    pub outlier_mads: f64,
    /// Whether to fit all counts at once after the stages.
    pub refine: bool,
}

impl Default for FitSettings {
    /// Degrees up to 4 for shapes, 6 and 2 for the number density; 10 folds; 5 deviations; refined.
    fn default() -> Self {
        Self {
            diameter_range_um: None,
            max_shape_degree: 4,
            max_number_degree: 6,
            max_height_degree: 2,
            folds: 10,
            outlier_mads: 5.0,
            refine: true,
        }
    }
}

impl FitSettings {
    fn check(&self) -> Result<(), OpticsError> {
        check_range("greatest degree of shapes", self.max_shape_degree as f64, 0.0, 6.0)?;
        check_range("greatest degree of the number density", self.max_number_degree as f64, 0.0, 8.0)?;
        check_range("greatest degree over height", self.max_height_degree as f64, 0.0, 3.0)?;
        check_range("number of folds", self.folds as f64, 2.0, 50.0)?;
        check_range("outlier limit in deviations", self.outlier_mads, 3.0, 100.0)
    }
}

/// Fits a fog model to measurements; `progress` is told the share of the work that is done, from any thread.
///
/// # Errors
/// [`OpticsError::Range`] for settings out of range; [`OpticsError::Fit`] if no model follows from the measurements: no
/// droplets at all, no altitude with [`BINS_MIN`] bins, fewer than four altitudes whose own fits succeed; and what
/// [`AdvectionModel::from_yaml`](crate::advection::AdvectionModel::from_yaml) refuses.
pub fn fit(
    measurements: &Measurements,
    settings: &FitSettings,
    progress: &(dyn Fn(f64) + Sync),
) -> Result<Fit, OpticsError> {
    settings.check()?;
    // Each altitude by itself, twice: the second time knowing its neighbours.
    let mut survey = survey::survey(measurements, settings, &|done| progress(0.3 * done))?;
    // Shape parameters over ζ, then of all counts at once.
    let shapes = shapes::shapes(&mut survey, settings, &|done| progress(0.3 + 0.6 * done))?;
    // Number density of each altitude with those shapes, over ζ and height.
    let number = number::number(&mut survey, &shapes, settings)?;
    progress(0.95);
    let found = assemble::assemble(measurements, settings, survey, shapes, number);
    progress(1.0);
    found
}
