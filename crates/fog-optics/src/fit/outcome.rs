//! What a fit found: everything that a report or a figure of it needs.

use super::degrees::DegreeStep;
use super::measurements::Spectrum;
use super::trend::{CrossValidation, Degrees};
use crate::advection::AdvectionModel;
use crate::distribution::SpectrumShape;

/// Names of the shape parameters, as the keys of a model file.
pub const SHAPE_KEYS: [&str; 5] = ["mu_L", "sigma_L", "mu_G", "sigma_G", "ln_gl_ratio"];

/// A fitted fog model with all that led to it.
#[derive(Clone, Debug, PartialEq)]
pub struct Fit {
    /// The model.
    pub model: AdvectionModel,
    /// The model as the text of its file, from which `model` was read.
    pub model_yaml: String,
    /// Name of the measurements.
    pub source: String,
    /// Fog heights in m, ascending.
    pub heights_m: Vec<f64>,
    /// Whether the sampled volumes were known, so that weights and errors come from counting noise.
    pub counting_noise_known: bool,
    /// Variance of the counts around the fits over that of counting noise: median over the altitudes of deviance per degree
    /// of freedom, at least 1 where the volumes are known. Standard errors are multiplied by its root.
    pub dispersion: f64,
    /// The same around the common shape polynomials instead of the altitudes' own fits: larger if shapes scatter.
    pub common_dispersion: f64,
    /// Every altitude of the measurements, by height, then altitude.
    pub altitudes: Vec<AltitudeFit>,
    /// The five shape parameters over ζ, in the order of [`SHAPE_KEYS`].
    pub shapes: [ParameterFit; 5],
    /// Number density over ζ and height.
    pub number: NumberFit,
    /// True if the shape polynomials were refined over all counts at once; false if they are those of the stages.
    pub refined: bool,
    /// The last round of the search for the degrees of the refined polynomials: no step was worth taking, and why.
    pub degree_steps: Vec<DegreeStep>,
    /// Deviations, in robust standard deviations, beyond which bins and altitudes were set aside.
    pub outlier_mads: f64,
    /// What the user should know before using the model.
    pub warnings: Vec<String>,
}

/// How far an altitude took part.
#[derive(Clone, Debug, PartialEq)]
pub enum Standing {
    /// In every stage.
    Used,
    /// Not fitted by itself, or not well enough to enter the polynomials of the stages: used where all altitudes are fitted
    /// at once, and for the number density.
    Weak(String),
    /// Left out, for this reason.
    Rejected(String),
}

impl Standing {
    /// One word for tables.
    #[must_use]
    pub fn word(&self) -> &'static str {
        match self {
            Self::Used => "used",
            Self::Weak(_) => "weak",
            Self::Rejected(_) => "rejected",
        }
    }

    /// The reason, or nothing.
    #[must_use]
    pub fn reason(&self) -> &str {
        match self {
            Self::Used => "",
            Self::Weak(reason) | Self::Rejected(reason) => reason,
        }
    }
}

/// One altitude in fog of one height.
#[derive(Clone, Debug, PartialEq)]
pub struct AltitudeFit {
    /// What was measured.
    pub spectrum: Spectrum,
    /// Bins that were set aside as bad, by index.
    pub bad_bins: Vec<usize>,
    /// The altitude's own fit (paper, Sec. 4.2), if it has one.
    pub own: Option<OwnFit>,
    /// How far the altitude took part.
    pub standing: Standing,
    /// Number density in m⁻³ with the model's shape, and its standard error, if the altitude took part.
    pub number_density: Option<[f64; 2]>,
    /// True if that number density was set aside as an outlier.
    pub number_rejected: bool,
    /// Root relative squared error of the final model here (see [`OwnFit::rrse`]).
    pub model_rrse: f64,
}

/// Lognormal and Gaussian fitted to one altitude.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OwnFit {
    /// Number density L + G in m⁻³ over all diameters.
    pub number_density_1_m3: f64,
    /// Its relative standard error.
    pub number_density_error: f64,
    /// The shape.
    pub shape: SpectrumShape,
    /// Standard errors of μ_L, σ_L, μ_G, σ_G and ln(G : L).
    pub shape_errors: [f64; 5],
    /// Root relative squared error: √(Σ(y − f)² / Σ(y − ȳ)²) with densities y of the bins that were kept and f of the fit.
    pub rrse: f64,
    /// Deviance of the counts per degree of freedom: 1 if counting noise is all that there is.
    pub deviance_per_freedom: f64,
    /// Number of starts that led to this fit or one as good.
    pub agreeing_starts: usize,
    /// Whether the minimiser came to rest.
    pub converged: bool,
}

/// One shape parameter over ζ.
#[derive(Clone, Debug, PartialEq)]
pub struct ParameterFit {
    /// Key of the model file.
    pub key: &'static str,
    /// Coefficients c₀, c₁, … over powers of ζ, as in the model file.
    pub coefficients: Vec<f64>,
    /// Coefficients of the staged fit alone, before all counts were fitted at once.
    pub staged: Vec<f64>,
    /// Degrees that cross-validation compared.
    pub cross_validation: Vec<CrossValidation>,
    /// Standard deviation of the altitudes' own values around the polynomial beyond their standard errors.
    pub scatter: f64,
    /// ζ, value and standard error of the polynomial at 21 places from 0 to 1.
    pub curve: Vec<[f64; 3]>,
}

/// Number density over ζ and fog height: the paper's scaling parameter matrix.
#[derive(Clone, Debug, PartialEq)]
pub struct NumberFit {
    /// Coefficients c_ij of ζⁱ Hʲ in m⁻³ (H in m), as in the model file.
    pub coefficients: Vec<Vec<f64>>,
    /// Degrees over ζ and height.
    pub degrees: Degrees,
    /// Degrees that cross-validation compared.
    pub cross_validation: Vec<CrossValidation>,
    /// Relative standard deviation of the altitudes' values around the polynomial beyond their standard errors.
    pub scatter: f64,
    /// Share of the variance of the altitudes' values that the polynomial explains.
    pub r_squared: f64,
    /// Root mean square of (measured − polynomial) / polynomial.
    pub rms_relative: f64,
    /// Height, ζ, value and standard error of the polynomial at 21 ζ for each measured height.
    pub curves: Vec<[f64; 4]>,
}
