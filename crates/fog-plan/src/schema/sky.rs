//! Section `lighting`: the sky and the moon.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::ranges;

/// A sky with its ground. Which keys apply depends on `model`. Its light is absolute: divided by luminance_of_one_cd_m2.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema, Serialize)]
#[serde(default, deny_unknown_fields)]
#[schemars(rename = "Sky")]
pub(crate) struct SkyFile {
    /// Which sky.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) model: Option<SkyModelName>,
    /// Type of the CIE standard general sky (cie): 1 and 3 overcast, 5 the same everywhere, 7 and 8 partly cloudy, 12 clear,
    /// 15 turbid. All but 1, 3 and 5 need lighting.sun for their shape.
    #[schemars(range(min = 1, max = 15))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) cie_type: Option<i64>,
    /// Luminance of the zenith in cd/m² (cie, overcast): this or horizontal_illuminance_lx.
    #[schemars(extend("exclusiveMinimum" = 0), range(max = ranges::SKY_CD_M2.max))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) zenith_luminance_cd_m2: Option<f64>,
    /// Illuminance of the sky alone on level ground in lux (cie, overcast).
    #[schemars(extend("exclusiveMinimum" = 0), range(max = ranges::SKY_LX.max))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) horizontal_illuminance_lx: Option<f64>,
    /// Correlated colour temperature of daylight in kelvins (cie, overcast). Absent: that of D65.
    #[schemars(range(min = ranges::COLOR_TEMPERATURE_K.min, max = ranges::COLOR_TEMPERATURE_K.max))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) color_temperature_k: Option<f64>,
    /// Optical depth of the aerosol at 550 nm straight up (clear). Absent: 0.1.
    #[schemars(range(min = ranges::AEROSOL_DEPTH.min, max = ranges::AEROSOL_DEPTH.max))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) aerosol_optical_depth: Option<f64>,
    /// Ozone in Dobson units (clear). Absent: 300.
    #[schemars(range(min = ranges::OZONE_DU.min, max = ranges::OZONE_DU.max))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) ozone_du: Option<f64>,
    /// Luminance of the night sky behind all else, stars and airglow, in cd/m² (clear). Absent: 1.7e-4, a sky of 22 magnitudes
    /// per square arc second.
    #[schemars(range(min = ranges::NIGHT_CD_M2.min, max = ranges::NIGHT_CD_M2.max))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) night_luminance_cd_m2: Option<f64>,
    /// Albedo of the level ground that surrounds the scene, lit by the sky (clear: and by sun and moon). Absent: 0.2.
    #[schemars(range(min = ranges::ALBEDO.min, max = ranges::ALBEDO.max))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) ground_albedo: Option<f64>,
}

/// Name of a sky model.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub(crate) enum SkyModelName {
    /// Sunlight, moonlight and the night sky in clear air, by day and in twilight: lighting.sun and lighting.moon say where they
    /// stand, the air what is left of them.
    Clear,
    /// A type of the CIE standard general sky.
    Cie,
    /// The CIE overcast sky.
    Overcast,
}

impl SkyModelName {
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Clear => "clear",
            Self::Cie => "cie",
            Self::Overcast => "overcast",
        }
    }
}

/// The moon under a clear sky.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema, Serialize)]
#[serde(default, deny_unknown_fields)]
#[schemars(rename = "Moon")]
pub(crate) struct MoonFile {
    /// Above the horizon, in degrees.
    #[schemars(range(min = ranges::ELEVATION_DEG.min, max = ranges::ELEVATION_DEG.max))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) elevation_deg: Option<f64>,
    /// Direction towards the moon as a heading, in degrees: 0 is north (−Z), 90 is east (+X).
    #[schemars(range(min = ranges::HEADING_DEG.min, max = ranges::HEADING_DEG.max))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) azimuth_deg: Option<f64>,
    /// Phase angle in degrees: 0 is full, 90 a half moon, 180 new. Absent: 0.
    #[schemars(range(min = ranges::MOON_PHASE_DEG.min, max = ranges::MOON_PHASE_DEG.max))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) phase_deg: Option<f64>,
}

/// Optical depth of the aerosol unless said otherwise.
pub(crate) const AEROSOL_OPTICAL_DEPTH: f64 = 0.1;
/// Ozone unless said otherwise, in Dobson units.
pub(crate) const OZONE_DU: f64 = 300.0;
/// Luminance of the night sky unless said otherwise, in cd/m².
pub(crate) const NIGHT_LUMINANCE_CD_M2: f64 = 1.7e-4;
/// Albedo of the ground around the scene unless said otherwise.
pub(crate) const GROUND_ALBEDO: f64 = 0.2;
