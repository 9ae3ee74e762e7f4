//! Section `runway`.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::ranges;

/// The runway that the record of a frame is about (key `aviation`). Absent keys are those of the scene, if it says (`extras.runway`, as
/// `generate: runway` has it); without them threshold_m, heading_deg, length_m and width_m belong together.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema, Serialize)]
#[serde(default, deny_unknown_fields)]
#[schemars(rename = "Runway")]
pub(crate) struct RunwayFile {
    /// Middle of the threshold, world coordinates x, y, z in metres.
    #[schemars(inner(range(min = ranges::POSITION_M.min, max = ranges::POSITION_M.max)))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) threshold_m: Option<[f64; 3]>,
    /// Direction of landing as a heading, in degrees: 0 is north (−Z), 90 is east (+X).
    #[schemars(range(min = ranges::HEADING_DEG.min, max = ranges::HEADING_DEG.max))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) heading_deg: Option<f64>,
    /// Length in metres.
    #[schemars(range(min = ranges::SITE_LENGTH_M.min, max = ranges::SITE_LENGTH_M.max))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) length_m: Option<f64>,
    /// Width in metres.
    #[schemars(range(min = ranges::SITE_WIDTH_M.min, max = ranges::SITE_WIDTH_M.max))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) width_m: Option<f64>,
    /// Angle of the glide path in degrees. Absent: the scene's, or 3.
    #[schemars(range(min = ranges::GLIDE_SLOPE_DEG.min, max = ranges::GLIDE_SLOPE_DEG.max))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) glide_slope_deg: Option<f64>,
    /// Distance of the aiming point beyond the threshold in metres. Absent: the scene's, or 310.896 (1020 ft).
    #[schemars(range(min = ranges::TOUCHDOWN_M.min, max = ranges::TOUCHDOWN_M.max))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) touchdown_m: Option<f64>,
    /// Luminance in cd/m² that lights are seen against; it decides from which illuminance they are seen (ICAO Annex 3). Absent: the
    /// median of the picture.
    #[schemars(range(min = ranges::BACKGROUND_CD_M2.min, max = ranges::BACKGROUND_CD_M2.max))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) background_luminance_cd_m2: Option<f64>,
}
