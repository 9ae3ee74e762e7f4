//! Keys `fog.droplets` and `fog.vertical`.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::ranges;

/// The spectrum of the droplets: a name of the literature, or a map with one key.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(rename_all = "snake_case")]
#[schemars(rename = "Droplets")]
pub(crate) enum DropletsFile {
    /// Heavy advection fog (Shettle & Fenn 1979, model 1).
    ShettleFennAdvectionHeavy,
    /// Moderate advection fog (Shettle & Fenn 1979, model 2).
    ShettleFennAdvectionModerate,
    /// Heavy radiation fog (Shettle & Fenn 1979, model 3).
    ShettleFennRadiationHeavy,
    /// Moderate radiation fog (Shettle & Fenn 1979, model 4).
    ShettleFennRadiationModerate,
    /// Cumulus cloud C.1 (Deirmendjian 1969).
    DeirmendjianCloudC1,
    /// Cloud C.2, mode radius 4 µm, narrow (Deirmendjian 1969).
    DeirmendjianCloudC2,
    /// Cloud C.3, mode radius 2 µm, narrow (Deirmendjian 1969).
    DeirmendjianCloudC3,
    /// Cloud C.5, mode radius 6 µm (Deirmendjian 1975).
    DeirmendjianCloudC5,
    /// Large drops of cloud C.6, mode radius 20 µm (Deirmendjian 1975).
    DeirmendjianCloudC6,
    /// Maritime haze M (Deirmendjian 1969), of water.
    DeirmendjianHazeM,
    /// Continental haze L (Deirmendjian 1969), of water.
    DeirmendjianHazeL,
    /// Stratospheric haze H (Deirmendjian 1969), of water.
    DeirmendjianHazeH,
    /// Gamma distribution by effective radius and variance.
    Gamma(GammaFile),
    /// n(r) ∝ r^alpha exp(−b r^gamma), r the radius in µm.
    ModifiedGamma(ModifiedGammaFile),
    /// A sum of lognormals.
    Lognormals(#[schemars(length(min = 1, max = 16))] Vec<LognormalFile>),
    /// Path of a CSV file with a measured spectrum; its header says what the numbers are: `diameter_um` with
    /// `density_1_um`, `density_1_m3_um` or `density_1_cm3_um`, or `lower_um,upper_um` with `count`, `number_1_m3` or
    /// `number_1_cm3`.
    File(String),
}

impl DropletsFile {
    /// The name of a spectrum of the literature, as written.
    pub(crate) fn name(&self) -> Option<String> {
        Some(serde_json::to_value(self).ok()?.as_str()?.to_owned())
    }
}

/// The gamma distribution of Hansen & Travis 1974.
#[derive(Clone, Copy, Debug, Default, Deserialize, JsonSchema, Serialize)]
#[serde(default, deny_unknown_fields)]
#[schemars(rename = "Gamma")]
pub(crate) struct GammaFile {
    /// Effective radius ∫n r³ / ∫n r², in micrometres.
    #[schemars(range(min = ranges::EFFECTIVE_RADIUS_UM.min, max = ranges::EFFECTIVE_RADIUS_UM.max))]
    pub(crate) effective_radius_um: Option<f64>,
    /// Effective variance, dimensionless: 0.1 is usual in fog and cloud.
    #[schemars(range(min = ranges::EFFECTIVE_VARIANCE.min, max = ranges::EFFECTIVE_VARIANCE.max))]
    pub(crate) effective_variance: Option<f64>,
}

/// The modified gamma distribution of Deirmendjian 1969 over the radius in µm.
#[derive(Clone, Copy, Debug, Default, Deserialize, JsonSchema, Serialize)]
#[serde(default, deny_unknown_fields)]
#[schemars(rename = "ModifiedGamma")]
pub(crate) struct ModifiedGammaFile {
    /// Exponent of the rise.
    #[schemars(range(min = ranges::ALPHA.min, max = ranges::ALPHA.max))]
    pub(crate) alpha: Option<f64>,
    /// Rate of the fall in µm^−gamma.
    #[schemars(range(min = ranges::B.min, max = ranges::B.max))]
    pub(crate) b: Option<f64>,
    /// Exponent in the fall. Absent: 1.
    #[schemars(range(min = ranges::GAMMA.min, max = ranges::GAMMA.max))]
    pub(crate) gamma: Option<f64>,
}

/// One lognormal of a sum.
#[derive(Clone, Copy, Debug, Default, Deserialize, JsonSchema, Serialize)]
#[serde(default, deny_unknown_fields)]
#[schemars(rename = "Lognormal")]
pub(crate) struct LognormalFile {
    /// Number of droplets relative to the other lognormals. Absent: 1.
    #[schemars(extend("exclusiveMinimum" = 0), range(max = ranges::SHARE.max))]
    pub(crate) share: Option<f64>,
    /// Median diameter in micrometres.
    #[schemars(range(min = ranges::MEDIAN_DIAMETER_UM.min, max = ranges::MEDIAN_DIAMETER_UM.max))]
    pub(crate) median_diameter_um: Option<f64>,
    /// Geometric standard deviation.
    #[schemars(range(min = ranges::GEOMETRIC_SD.min, max = ranges::GEOMETRIC_SD.max))]
    pub(crate) geometric_sd: Option<f64>,
}

/// Number of droplets by altitude, relative to its mean over the layer.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(rename_all = "snake_case")]
#[schemars(rename = "Vertical")]
pub(crate) enum VerticalFile {
    /// The same at every altitude.
    Uniform,
    /// As in the advection model's layer of the same height.
    Advection,
    /// (1 − altitude / height)^p with this p: a radiation fog that is densest at the ground.
    Thinning(#[schemars(range(min = ranges::THINNING.min, max = ranges::THINNING.max))] f64),
    /// Rows [altitude / height, number in any unit]: linear between them, 0 outside.
    Rows(#[schemars(length(min = 2))] Vec<[f64; 2]>),
    /// Path of a CSV file with columns `relative_altitude,relative_number_density`: rows as above.
    File(String),
}
