//! The runway that a frame's record is about.

use serde::Serialize;

/// What the configuration says about the runway; absent keys, which are not written, are those of the scene.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct RunwaySpec {
    /// Middle of the threshold in world coordinates, m.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub threshold_m: Option<[f64; 3]>,
    /// Direction of landing, clockwise from −Z seen from above, in degrees.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub heading_deg: Option<f64>,
    /// Length in m, 100 to 10 000.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub length_m: Option<f64>,
    /// Width in m, 5 to 200.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub width_m: Option<f64>,
    /// Angle of the glide path in degrees, 1 to 10.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub glide_slope_deg: Option<f64>,
    /// Distance of the aiming point beyond the threshold in m, 0 to 2000.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub touchdown_m: Option<f64>,
    /// Luminance in cd/m² that lights are seen against, 0 to 1e6; absent: the median of the picture.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub background_luminance_cd_m2: Option<f64>,
}
