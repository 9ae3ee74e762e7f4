//! Keys `sensor.intrinsics` and `sensor.lens`.

use schemars::{JsonSchema, Schema};
use serde::{Deserialize, Serialize};

use crate::ranges;

/// Focal lengths and principal point in OpenCV's convention: pixel centres at integer coordinates.
#[derive(Clone, Copy, Debug, Default, Deserialize, JsonSchema, Serialize)]
#[serde(default, deny_unknown_fields)]
#[schemars(rename = "Intrinsics", extend("required" = ["fx_px", "fy_px", "cx_px", "cy_px"]))]
pub(crate) struct IntrinsicsFile {
    /// Horizontal focal length in pixels.
    #[schemars(extend("exclusiveMinimum" = 0), range(max = ranges::FOCAL_PX.max))]
    pub(crate) fx_px: Option<f64>,
    /// Vertical focal length in pixels.
    #[schemars(extend("exclusiveMinimum" = 0), range(max = ranges::FOCAL_PX.max))]
    pub(crate) fy_px: Option<f64>,
    /// Column of the principal point.
    #[schemars(range(min = ranges::CENTRE_PX.min, max = ranges::CENTRE_PX.max))]
    pub(crate) cx_px: Option<f64>,
    /// Row of the principal point.
    #[schemars(range(min = ranges::CENTRE_PX.min, max = ranges::CENTRE_PX.max))]
    pub(crate) cy_px: Option<f64>,
}

/// The lens.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(rename_all = "snake_case")]
#[schemars(rename = "Lens", transform = also_without_value)]
pub(crate) enum LensFile {
    /// Straight lines stay straight.
    Pinhole,
    /// OpenCV's radial and tangential distortion.
    Opencv(OpencvFile),
    /// OpenCV's fisheye. Without a value: equidistant.
    Fisheye(Option<FisheyeFile>),
    /// Columns are longitudes, rows latitudes. Without a value: all latitudes.
    Equirectangular(Option<EquirectangularFile>),
}

/// The JSON Schema of variants whose value may be left out: their names alone will do.
fn also_without_value(schema: &mut Schema) {
    if let Some(serde_json::Value::Array(variants)) = schema.get_mut("oneOf") {
        variants.push(serde_json::json!({ "const": "fisheye", "description": "Equidistant fisheye." }));
        variants.push(serde_json::json!({
            "const": "equirectangular",
            "description": "All longitudes and latitudes."
        }));
    }
}

/// Coefficients of cv2.projectPoints; absent ones are 0.
#[derive(Clone, Copy, Debug, Default, Deserialize, JsonSchema, Serialize)]
#[serde(default, deny_unknown_fields)]
#[schemars(rename = "OpencvLens")]
pub(crate) struct OpencvFile {
    /// Radial, r².
    pub(crate) k1: f64,
    /// Radial, r⁴.
    pub(crate) k2: f64,
    /// Tangential.
    pub(crate) p1: f64,
    /// Tangential.
    pub(crate) p2: f64,
    /// Radial, r⁶.
    pub(crate) k3: f64,
    /// Radial, r² of the denominator.
    pub(crate) k4: f64,
    /// Radial, r⁴ of the denominator.
    pub(crate) k5: f64,
    /// Radial, r⁶ of the denominator.
    pub(crate) k6: f64,
}

/// Coefficients of cv2.fisheye; absent ones are 0.
#[derive(Clone, Copy, Debug, Default, Deserialize, JsonSchema, Serialize)]
#[serde(default, deny_unknown_fields)]
#[schemars(rename = "FisheyeLens")]
pub(crate) struct FisheyeFile {
    /// θ³.
    pub(crate) k1: f64,
    /// θ⁵.
    pub(crate) k2: f64,
    /// θ⁷.
    pub(crate) k3: f64,
    /// θ⁹.
    pub(crate) k4: f64,
    /// Full angle in degrees that the lens sees; the image is black beyond. Absent: 360.
    #[schemars(extend("exclusiveMinimum" = 0), range(max = ranges::WIDE_FOV_DEG.max))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) field_of_view_deg: Option<f64>,
}

/// What an equirectangular image shows.
#[derive(Clone, Copy, Debug, Default, Deserialize, JsonSchema, Serialize)]
#[serde(default, deny_unknown_fields)]
#[schemars(rename = "EquirectangularLens")]
pub(crate) struct EquirectangularFile {
    /// Latitudes in degrees of the lower and the upper edge. Absent: [-90, 90].
    #[schemars(inner(range(min = ranges::LATITUDE_DEG.min, max = ranges::LATITUDE_DEG.max)))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) latitude_deg: Option<[f64; 2]>,
}
