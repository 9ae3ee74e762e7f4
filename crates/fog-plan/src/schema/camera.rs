//! Sections `camera`, `sensor`, `render` and `outputs`.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{
    exposure::ExposureFile,
    lens::{IntrinsicsFile, LensFile},
    path::ShutterFile,
    sensor_model::SensorModelFile,
};
use crate::ranges;

/// Pose of the camera.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(default, deny_unknown_fields)]
#[schemars(rename = "Camera")]
pub(crate) struct CameraFile {
    /// Height above the fog's datum, in metres.
    #[schemars(range(min = ranges::CAMERA_ALTITUDE_M.min, max = ranges::CAMERA_ALTITUDE_M.max))]
    pub(crate) altitude_m: f64,
    /// World position x, y, z in metres; y is replaced by datum + altitude_m.
    #[schemars(inner(range(min = ranges::POSITION_M.min, max = ranges::POSITION_M.max)))]
    pub(crate) position_m: [f64; 3],
    /// Clockwise seen from above, in degrees: 0 looks along −Z (north), 90 along +X (east).
    #[schemars(range(min = ranges::HEADING_DEG.min, max = ranges::HEADING_DEG.max))]
    pub(crate) heading_deg: f64,
    /// Upwards, in degrees.
    #[schemars(range(min = ranges::PITCH_DEG.min, max = ranges::PITCH_DEG.max))]
    pub(crate) pitch_deg: f64,
    /// To the right, in degrees.
    #[schemars(range(min = ranges::ROLL_DEG.min, max = ranges::ROLL_DEG.max))]
    pub(crate) roll_deg: f64,
}

impl Default for CameraFile {
    fn default() -> Self {
        Self { altitude_m: 2.0, position_m: [0.0; 3], heading_deg: 0.0, pitch_deg: 0.0, roll_deg: 0.0 }
    }
}

/// Image plane and lens.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(default, deny_unknown_fields)]
#[schemars(rename = "Sensor")]
pub(crate) struct SensorFile {
    /// Width in pixels.
    #[schemars(range(min = ranges::IMAGE_PX.min, max = ranges::IMAGE_PX.max))]
    pub(crate) width_px: i64,
    /// Height in pixels.
    #[schemars(range(min = ranges::IMAGE_PX.min, max = ranges::IMAGE_PX.max))]
    pub(crate) height_px: i64,
    /// Horizontal field of view in degrees, of the lens without its distortion; up to 170, of a fisheye or an equirectangular
    /// image up to 360. Absent, and without intrinsics: 60, of a fisheye 180, of an equirectangular image 360.
    #[schemars(range(min = ranges::FOV_DEG.min, max = ranges::WIDE_FOV_DEG.max))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) horizontal_fov_deg: Option<f64>,
    /// Focal lengths and principal point, instead of a field of view.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) intrinsics: Option<IntrinsicsFile>,
    /// `pinhole`, {opencv: {k1: …}}, {fisheye: {k1: …}} or `equirectangular`. Absent: pinhole.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) lens: Option<LensFile>,
    /// `global`, or {rolling: {readout_s: …}}: on a path, rows see it one after another. Absent: global.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) shutter: Option<ShutterFile>,
    /// Factor on linear values before sRGB encoding, or where it comes from: `auto`, {percentile: …, target: …} or
    /// {iso: …, shutter_s: …, f_number: …}.
    pub(crate) exposure: ExposureFile,
    /// The sensor: lens, noise, converter and colour filters of `raw` and, developed, of `image`. Absent: none, the picture is
    /// ideal.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) model: Option<SensorModelFile>,
}

impl Default for SensorFile {
    fn default() -> Self {
        Self {
            width_px: 320,
            height_px: 180,
            horizontal_fov_deg: None,
            intrinsics: None,
            lens: None,
            shutter: None,
            exposure: ExposureFile::Factor(1.0),
            model: None,
        }
    }
}

/// Sampling.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(default, deny_unknown_fields)]
#[schemars(rename = "Render")]
pub(crate) struct RenderFile {
    /// Paths per pixel; with `noise` the first ones of each pixel, at least 16.
    #[schemars(range(min = ranges::SAMPLES.min, max = ranges::SAMPLES.max))]
    pub(crate) samples: i64,
    /// Samples each pixel until the standard error of its luminance, and that of its neighbours, is this share of the
    /// luminance (0.02: 2 %); luminances below 1 % of the frame's mean count as that. Absent: `samples` paths and no more.
    #[schemars(extend("exclusiveMinimum" = 0), range(max = ranges::NOISE.max))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) noise: Option<f64>,
    /// Paths per pixel after which sampling for `noise` ends all the same. With `noise` and without this: 8192, or `samples`
    /// if that is more.
    #[schemars(range(min = ranges::SAMPLES.min, max = ranges::SAMPLES.max))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) max_samples: Option<i64>,
    /// Which pixels the frame's `samples` times its pixels go to. Absent: `even`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) allocate: Option<AllocateFile>,
    /// Takes the fog for a simpler one along paths that have scattered often. Absent: the fog as it is.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) approximation: Option<ApproximationFile>,
    /// Longest path in edges from camera to light; 1: only light that comes straight from its source. Absent: no limit.
    #[schemars(range(min = ranges::MAX_DEPTH.min, max = ranges::MAX_DEPTH.max))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) max_depth: Option<i64>,
    /// Renders this wavelength alone, in nanometres. Absent: the visible spectrum.
    #[schemars(range(min = ranges::WAVELENGTH_NM.min, max = ranges::WAVELENGTH_NM.max))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) wavelength_nm: Option<f64>,
    /// Traces frames together that are alike but for this. Absent: each frame alone.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) share: Option<ShareFile>,
}

/// What a rendering may do that is not exact.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
#[schemars(rename = "Approximation")]
pub(crate) enum ApproximationFile {
    /// After 8 scatterings, six of ten further ones are taken for none, and the others turn the more, so that light spreads
    /// alike: faster in deep fog. docs/performance.md says how much, and how far off. Not in patchy fog, and not with single
    /// droplets.
    Similarity,
}

/// How samples are shared out over the pixels.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
#[schemars(rename = "Allocate")]
pub(crate) enum AllocateFile {
    /// Alike.
    Even,
    /// By the relative error that each pixel is left with, as told by its neighbours from a quarter of the samples: the least
    /// relative squared error of the picture in the same number of paths. Dark and noisy parts gain, even ones lose.
    RelativeError,
}

/// What frames that share paths may differ in.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
#[schemars(rename = "Share")]
pub(crate) enum ShareFile {
    /// The intensities of their light groups: costs nothing.
    Lights,
    /// Those, and the fog, up to eight: pays where fogs are thin and differ little (docs/performance.md says how much); in
    /// deep fog each frame alone is faster.
    Fog,
}

impl Default for RenderFile {
    fn default() -> Self {
        Self {
            samples: 64,
            noise: None,
            max_samples: None,
            allocate: None,
            approximation: None,
            max_depth: None,
            wavelength_nm: None,
            share: None,
        }
    }
}

/// A quantity written for each frame.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "snake_case")]
#[schemars(rename = "Output")]
pub(crate) enum OutputFile {
    /// sRGB picture.
    Image,
    /// Linear radiance.
    Hdr,
    /// Planar depth in metres.
    Depth,
    /// Range to the first surface in metres.
    Distance,
    /// Transmittance to the first surface.
    Transmittance,
    /// Optical depth to the first surface at 550 nm.
    Tau,
    /// Light that came straight through.
    Direct,
    /// Light that the fog scattered.
    Airlight,
    /// Standard error of each pixel's luminance; only where it is named.
    StandardError,
    /// Number of samples of each pixel; only where it is named.
    Samples,
    /// A guess at `hdr` without its noise, by Open Image Denoise, in files of its own beside it; only where it is named.
    Denoised,
    /// Normals in the world: interpolated vertex normals on the side that is seen; only where it is named.
    Normals,
    /// Positions in the world, in metres; only where it is named.
    Position,
    /// Linear base colour of the first surface; only where it is named.
    Albedo,
    /// Class of the first surface as a picture of 8-bit numbers; only where it is named.
    Semantic,
    /// Instance of the first surface as a picture of 16-bit numbers; only where it is named.
    Instance,
    /// Optical flow to the path's next pose, in pixels, with its validity; only where it is named.
    Flow,
    /// Boxes, occlusion, contrast and detectability of each thing in the picture; only where it is named.
    Objects,
    /// The raw picture of `sensor.model`, a mosaic of up to 16 bits; only where it is named.
    Raw,
    /// The same view in clear air at the same exposure, radiance and picture; only where it is named.
    Pair,
}

impl OutputFile {
    /// What a configuration without `outputs` gets.
    pub(crate) const DEFAULT: [Self; 8] = [
        Self::Image,
        Self::Hdr,
        Self::Depth,
        Self::Distance,
        Self::Transmittance,
        Self::Tau,
        Self::Direct,
        Self::Airlight,
    ];
}
