//! Section `fog`.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{
    droplets::{DropletsFile, VerticalFile},
    or_none::{Example, OrNone},
    patchiness::PatchinessFile,
    phase::PhaseFile,
};
use crate::ranges;

/// A fog layer. Which keys apply depends on `model`.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(default, deny_unknown_fields)]
#[schemars(rename = "Fog")]
pub(crate) struct FogFile {
    /// Which fog.
    pub(crate) model: Option<FogModelName>,
    /// Thickness of the layer above the datum, in metres (advection, droplets, homogeneous, linear_gradient).
    #[schemars(range(min = ranges::LAYER_HEIGHT_M.min, max = ranges::LAYER_HEIGHT_M.max))]
    pub(crate) height_m: Option<f64>,
    /// Factor on the droplets' number density (advection). Absent: 1.
    #[schemars(extend("exclusiveMinimum" = 0), range(max = ranges::DENSITY_SCALE.max))]
    pub(crate) number_density_scale: Option<f64>,
    /// Path of a fog model file (YAML, as `fogbank fit` writes it), relative to the current folder: the advection model,
    /// wherever the fog takes something from it. Absent: the shipped model.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) coefficients: Option<String>,
    /// The spectrum of the droplets (droplets): a name, or one of {gamma: …}, {modified_gamma: …}, {lognormals: …},
    /// {file: …}.
    pub(crate) droplets: Option<DropletsFile>,
    /// Droplets per cubic metre in the mean over altitude (droplets). Absent: the number of the named or measured spectrum,
    /// or what `visibility` asks for.
    #[schemars(extend("exclusiveMinimum" = 0), range(max = ranges::NUMBER_DENSITY_1_M3.max))]
    pub(crate) number_density_1_m3: Option<f64>,
    /// Number of droplets by altitude (droplets). Absent: uniform.
    pub(crate) vertical: Option<VerticalFile>,
    /// Extinction coefficient in 1/m, at every wavelength (homogeneous). Absent: the mean over altitude of the advection
    /// layer's at 550 nm.
    #[schemars(range(min = ranges::SIGMA_T_1_M.min, max = ranges::SIGMA_T_1_M.max))]
    pub(crate) sigma_t_1_m: Option<f64>,
    /// Extinction coefficient at the bottom in 1/m (linear_gradient). Absent: the least of the advection layer's.
    #[schemars(range(min = ranges::SIGMA_T_1_M.min, max = ranges::SIGMA_T_1_M.max))]
    pub(crate) sigma_t_base_1_m: Option<f64>,
    /// Extinction coefficient at the top in 1/m (linear_gradient). Absent: the greatest of the advection layer's.
    #[schemars(range(min = ranges::SIGMA_T_1_M.min, max = ranges::SIGMA_T_1_M.max))]
    pub(crate) sigma_t_top_1_m: Option<f64>,
    /// Path of a CSV file with columns `altitude_m,sigma_t_1_m` (layered): linear between rows, 0 outside them.
    pub(crate) file: Option<String>,
    /// Share of extinction that is scattering (homogeneous, linear_gradient, layered). Absent: 1.
    #[schemars(range(min = ranges::ALBEDO.min, max = ranges::ALBEDO.max))]
    pub(crate) single_scattering_albedo: Option<f64>,
    /// Where scattered light goes.
    pub(crate) phase: PhaseFile,
    /// Which scattering coefficient the droplets give (advection, and homogeneous or linear_gradient whose extinction is
    /// taken from an advection layer). Absent: integral.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) coefficient: Option<CoefficientFile>,
    /// How `phase: mie` is sampled. Absent: table.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) sampling: Option<SamplingFile>,
    /// Scales the layer so that it has this visibility.
    pub(crate) visibility: Option<VisibilityFile>,
    /// Random billows of density and top, or `none`. Absent: the layer is even.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) patchiness: Option<OrNone<PatchinessFile>>,
    /// World height of altitude 0, in metres.
    #[schemars(range(min = ranges::DATUM_M.min, max = ranges::DATUM_M.max))]
    pub(crate) datum_m: f64,
}

impl Default for FogFile {
    fn default() -> Self {
        Self {
            model: None,
            height_m: None,
            number_density_scale: None,
            coefficients: None,
            droplets: None,
            number_density_1_m3: None,
            vertical: None,
            sigma_t_1_m: None,
            sigma_t_base_1_m: None,
            sigma_t_top_1_m: None,
            file: None,
            single_scattering_albedo: None,
            phase: PhaseFile::Mie,
            coefficient: None,
            sampling: None,
            visibility: None,
            patchiness: None,
            datum_m: 0.0,
        }
    }
}

impl Example for FogFile {
    const EXAMPLE: &'static str = "{model: advection, height_m: 180}";
}

/// The fog models.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
#[schemars(rename = "FogModel")]
pub(crate) enum FogModelName {
    /// Droplet sizes by altitude, after Kolářová et al. 2024.
    Advection,
    /// Droplets of any spectrum, with any number by altitude.
    Droplets,
    /// The same extinction everywhere in the layer.
    Homogeneous,
    /// Extinction linear in altitude.
    LinearGradient,
    /// Extinction from a file.
    Layered,
}

impl FogModelName {
    /// The name as written.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Advection => "advection",
            Self::Droplets => "droplets",
            Self::Homogeneous => "homogeneous",
            Self::LinearGradient => "linear_gradient",
            Self::Layered => "layered",
        }
    }
}

/// What the droplets of a layer add up to.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
#[schemars(rename = "Coefficient")]
pub(crate) enum CoefficientFile {
    /// Extinction by all droplets: the integral of n(d) C(d) over their diameters.
    Integral,
    /// The convention of Kolářová et al. 2024, Eq. 4: N σ(d) with the density at the sampled diameter taken for a number,
    /// averaged over diameters sampled by number; 15 to 29 times less.
    Paper,
}

/// How a direction is found in which droplets scatter.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
#[schemars(rename = "Sampling")]
pub(crate) enum SamplingFile {
    /// From the phase function of all droplets together.
    Table,
    /// From that of one droplet, drawn by how much it scatters: the same light in the mean, with more noise.
    Diameter,
}

/// A visibility at an altitude.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema, Serialize)]
#[serde(default, deny_unknown_fields)]
#[schemars(rename = "Visibility")]
pub(crate) struct VisibilityFile {
    /// Meteorological optical range in metres: −ln 0.05 / σ at 550 nm.
    #[schemars(range(min = ranges::MOR_M.min, max = ranges::MOR_M.max))]
    pub(crate) mor_m: Option<f64>,
    /// Altitude above the datum in metres where it holds: inside the layer.
    #[schemars(range(min = ranges::VISIBILITY_ALTITUDE_M.min, max = ranges::VISIBILITY_ALTITUDE_M.max))]
    pub(crate) altitude_m: Option<f64>,
}
