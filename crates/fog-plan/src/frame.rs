//! What one frame is: every value resolved, checked and in SI units.

use std::path::{Path, PathBuf};

use fog_core::lens::Lens;
use serde::{Serialize, Serializer, ser::SerializeMap};

use crate::{
    droplets::{DropletsSpec, VerticalSpec},
    labels::LabelsSpec,
    lens::{IntrinsicsSpec, LensSpec, ShutterSpec},
    light_groups::{LightGroupSpec, is_one},
    patchiness::PatchinessSpec,
    path::PathSpec,
    rig::RigSpec,
    runway::RunwaySpec,
    scene::SceneSpec,
    sensor::{ExposureSpec, SensorModelSpec},
    share::Share,
    sky::{MoonSpec, SkySpec},
};

/// A frame of the plan. Serialises to JSON whose keys carry the units.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FrameSpec {
    /// Readable slug of the axis values and the first 16 hex digits of `digest`: `[a-z0-9._-]`, unique in a plan, fit for
    /// a file name.
    pub id: String,
    /// Position in the plan, from 0.
    pub index: usize,
    /// 16 hex digits that frames share which differ in `fog` alone.
    pub pair_id: String,
    /// Seed of all random numbers of the frame: a function of the configuration's seed and the frame's content.
    pub seed: u64,
    /// Hex of blake3 over the canonical JSON of the content: `scene` to `outputs` below.
    pub digest: String,
    /// The axes' values as written, by dotted path.
    #[serde(serialize_with = "as_map")]
    pub axes: Vec<(String, serde_json::Value)>,
    /// The scene; none is empty space.
    pub scene: Option<SceneSpec>,
    /// The fog.
    pub fog: FogSpec,
    /// Pose of the camera.
    pub camera: CameraSpec,
    /// The rig that the camera is on. Absent, and then not written: none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rig: Option<RigSpec>,
    /// The path that the camera is on. Absent, and then not written: none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub path: Option<PathSpec>,
    /// Pose of the camera when the lower edge of the image is exposed; `camera` is then that of the upper edge. Absent, and then
    /// not written: all rows are exposed at once.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub readout_end: Option<CameraSpec>,
    /// Image plane.
    pub sensor: SensorSpec,
    /// Light sources.
    pub lighting: LightingSpec,
    /// Sampling.
    pub render: RenderSpec,
    /// What surfaces are called, and which things count as detectable. Not written where it is the default.
    #[serde(skip_serializing_if = "LabelsSpec::is_default")]
    pub labels: LabelsSpec,
    /// What is written, in the order of [`Output`], each once.
    pub outputs: Vec<Output>,
    /// What the configuration says about the runway of the record; left out where it says nothing.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub runway: Option<RunwaySpec>,
}

fn as_map<S: Serializer>(axes: &[(String, serde_json::Value)], serializer: S) -> Result<S::Ok, S::Error> {
    let mut map = serializer.serialize_map(Some(axes.len()))?;
    for (path, value) in axes {
        map.serialize_entry(path, value)?;
    }
    map.end()
}

/// The fog of a frame.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FogSpec {
    /// Which fog, with its parameters.
    #[serde(flatten)]
    pub model: FogModel,
    /// File of the advection model as written in the configuration, if the fog takes something from it; absent: the shipped
    /// model. Not written where absent, so that it is no part of old digests.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub coefficients: Option<PathBuf>,
    /// Where scattered light goes.
    pub phase: Phase,
    /// What the droplets add up to. Not written where it is the default, so that it is no part of old digests.
    #[serde(skip_serializing_if = "Coefficient::is_default")]
    pub coefficient: Coefficient,
    /// How `phase` `Mie` is sampled. Not written where it is the default.
    #[serde(skip_serializing_if = "Sampling::is_default")]
    pub sampling: Sampling,
    /// Scales extinction so that the layer has this visibility.
    pub visibility: Option<Visibility>,
    /// Random billows; absent, and then not written: the layer is even.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub patchiness: Option<PatchinessSpec>,
    /// World height (y) of altitude 0, in metres; −500 to 9000.
    pub datum_m: f64,
}

/// A fog model and its parameters.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(tag = "model", rename_all = "snake_case")]
pub enum FogModel {
    /// No fog: `phase` is `Mie`, `visibility` absent and `datum_m` 0.
    None,
    /// Droplet sizes by altitude (Kolářová, Lachiver & Wilkie 2024).
    Advection {
        /// Thickness of the layer in metres, 1 to 5000.
        height_m: f64,
        /// Factor on the number density, above 0 up to 100.
        number_density_scale: f64,
    },
    /// Droplets of any spectrum, with any number by altitude.
    Droplets {
        /// Thickness of the layer in metres, 1 to 5000.
        height_m: f64,
        /// The spectrum.
        droplets: DropletsSpec,
        /// Droplets per m³ in the mean over altitude; absent: the number of the named or measured spectrum, or any if a
        /// visibility is to be met.
        number_density_1_m3: Option<f64>,
        /// Number of droplets by altitude.
        vertical: VerticalSpec,
    },
    /// The same extinction in the whole layer, at every wavelength.
    Homogeneous {
        /// Thickness of the layer in metres, 1 to 5000.
        height_m: f64,
        /// Extinction coefficient in 1/m, 0 to 10; absent: mean over altitude of the advection layer's at 550 nm.
        sigma_t_1_m: Option<f64>,
        /// Scattering over extinction, 0 to 1.
        single_scattering_albedo: f64,
    },
    /// Extinction linear in altitude, at every wavelength.
    LinearGradient {
        /// Thickness of the layer in metres, 1 to 5000.
        height_m: f64,
        /// Extinction coefficient at the bottom in 1/m, 0 to 10; absent: the least of the advection layer's at 550 nm.
        sigma_t_base_1_m: Option<f64>,
        /// Extinction coefficient at the top in 1/m, 0 to 10; absent: the greatest of the advection layer's at 550 nm.
        sigma_t_top_1_m: Option<f64>,
        /// Scattering over extinction, 0 to 1.
        single_scattering_albedo: f64,
    },
    /// Extinction from a CSV file with columns `altitude_m,sigma_t_1_m`.
    Layered {
        /// Path as written in the configuration.
        file: PathBuf,
        /// Scattering over extinction, 0 to 1.
        single_scattering_albedo: f64,
    },
}

impl FogModel {
    /// The model's name in configurations: `none`, `advection`, ….
    #[must_use]
    pub fn name(&self) -> &'static str {
        match self {
            Self::None => "none",
            Self::Advection { .. } => "advection",
            Self::Droplets { .. } => "droplets",
            Self::Homogeneous { .. } => "homogeneous",
            Self::LinearGradient { .. } => "linear_gradient",
            Self::Layered { .. } => "layered",
        }
    }
}

/// Phase function of the fog.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Phase {
    /// Mie scattering of the fog's droplets by wavelength; of a model without droplets, and of advection, that of the
    /// advection model's, by altitude relative to the layer too.
    Mie,
    /// Henyey–Greenstein.
    Hg(MeanCosine),
    /// Mie scattering of the mean droplet (the paper's table).
    MieMeanDiameter,
    /// The closed form of Jendersie & d'Eon 2023.
    JendersieDeon {
        /// Diameter of the droplets in µm, above 0 up to 50; absent: the mean diameter of the advection model's droplets.
        diameter_um: Option<f64>,
    },
}

/// Mean cosine of a phase function.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum MeanCosine {
    /// −0.999 to 0.999; serialises to this number.
    Value(f64),
    /// The mean over altitude of the droplets' g at 550 nm, weighted by what the layer scatters; serialises to `layer`.
    Layer,
}

impl Serialize for MeanCosine {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Value(g) => serializer.serialize_f64(*g),
            Self::Layer => serializer.serialize_str("layer"),
        }
    }
}

/// Scattering coefficient of a layer of droplets.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Coefficient {
    /// ∫ n(d) C(d) dd over all droplets.
    #[default]
    Integral,
    /// N·σ(d) averaged over diameters sampled by number (Kolářová, Lachiver & Wilkie 2024, Eq. 4).
    Paper,
}

impl Coefficient {
    fn is_default(&self) -> bool {
        *self == Self::default()
    }
}

/// What `Phase::Mie` samples.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Sampling {
    /// The phase function of all droplets together.
    #[default]
    Table,
    /// That of one droplet, drawn with probability ∝ n(d) C_sca(d).
    Diameter,
}

impl Sampling {
    fn is_default(&self) -> bool {
        *self == Self::default()
    }
}

/// A visibility to be met.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Visibility {
    /// Meteorological optical range in metres, −ln 0.05 / σ at 550 nm; 1 to 100 000.
    pub mor_m: f64,
    /// Altitude above the datum in metres where it holds.
    pub altitude_m: f64,
}

/// Pose of the camera.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct CameraSpec {
    /// Height above the fog's datum in metres.
    pub altitude_m: f64,
    /// World position in metres; y is datum + altitude.
    pub position_m: [f64; 3],
    /// Clockwise seen from above, in degrees: 0 looks along −Z, 90 along +X.
    pub heading_deg: f64,
    /// Upwards, in degrees.
    pub pitch_deg: f64,
    /// To the right, in degrees.
    pub roll_deg: f64,
}

/// Image plane and lens.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SensorSpec {
    /// Width in pixels, 1 to 16 384.
    pub width_px: u32,
    /// Height in pixels, 1 to 16 384.
    pub height_px: u32,
    /// Horizontal field of view in degrees of the lens without its distortion, 0.1 to 170, of a fisheye or an equirectangular
    /// image to 360. Absent, and then not written, where there are intrinsics.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub horizontal_fov_deg: Option<f64>,
    /// Focal lengths and principal point as configured; absent, and then not written, where there is a field of view.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub intrinsics: Option<IntrinsicsSpec>,
    /// The lens. Not written where it is a pinhole, so that it is no part of old digests.
    #[serde(skip_serializing_if = "LensSpec::is_pinhole")]
    pub lens: LensSpec,
    /// What all that makes: which direction each image point shows. Not written.
    #[serde(skip)]
    pub projection: Lens,
    /// When the rows are exposed. Absent, and then not written: all at once.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub shutter: Option<ShutterSpec>,
    /// Factor on linear values before sRGB encoding, or where it comes from.
    pub exposure: ExposureSpec,
    /// The sensor that `raw` and `image` are taken with. Absent, and then not written: the picture is ideal.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub model: Option<SensorModelSpec>,
}

/// Light sources of a frame.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct LightingSpec {
    /// Name of the preset that the values come from, but for those that the configuration overrides.
    pub preset: Option<&'static str>,
    /// Light of the surroundings.
    pub environment: Option<EnvironmentSpec>,
    /// A sky with structure; then there is no environment. Left out of records where there is none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sky: Option<SkySpec>,
    /// The sun.
    pub sun: Option<SunSpec>,
    /// The moon; only with a clear sky. Left out of records where there is none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub moon: Option<MoonSpec>,
    /// Whether the scene file's emitting surfaces and lights shine.
    pub scene_emitters: bool,
    /// Luminance in cd/m² that the radiance 1 stands for in the scene file and the sky; left out of records where it is 1.
    #[serde(skip_serializing_if = "is_one")]
    pub luminance_of_one_cd_m2: f64,
    /// Groups of lights whose light is told apart; left out of records where there are none.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub groups: Vec<LightGroupSpec>,
}

impl LightingSpec {
    /// File of the image of the surroundings, as written in the configuration.
    #[must_use]
    pub fn image(&self) -> Option<&Path> {
        match &self.environment {
            Some(EnvironmentSpec::Image { image, .. }) => Some(image),
            _ => None,
        }
    }
}

/// Light of the surroundings.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(untagged)]
pub enum EnvironmentSpec {
    /// The same from every direction.
    Uniform {
        /// Radiance with the spectrum of D65, R = G = B = this; with `wavelength_nm` the spectral radiance there.
        radiance: f64,
        /// Wavelength in nanometres that `radiance` is meant at; then equal to the frame's `render.wavelength_nm`.
        wavelength_nm: Option<f64>,
    },
    /// That of an equirectangular image.
    Image {
        /// Path as written in the configuration, relative to the current folder.
        image: PathBuf,
        /// Factor on its values, above 0.
        scale: f64,
        /// Heading in degrees that its centre shows.
        rotation_deg: f64,
    },
}

/// A disc of even radiance in the sky.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct SunSpec {
    /// Above the horizon, in degrees, −90 to 90.
    pub elevation_deg: f64,
    /// Direction towards the sun as a heading, in degrees.
    pub azimuth_deg: f64,
    /// Irradiance on a plane normal to the beam; spectrum as the radiance of [`EnvironmentSpec::Uniform`] unless it has a colour
    /// temperature. Absent with a clear sky, and only then: the air says what is left of the sun's light.
    pub irradiance: Option<f64>,
    /// Correlated colour temperature of daylight in K, 4000 to 25 000. Left out of records where absent: that of D65.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub color_temperature_k: Option<f64>,
    /// Angular diameter in degrees, 0 (parallel beam) to 10.
    pub angular_diameter_deg: f64,
    /// Wavelength in nanometres that `irradiance` is meant at; then equal to the frame's `render.wavelength_nm`.
    pub wavelength_nm: Option<f64>,
}

/// Sampling of a frame.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct RenderSpec {
    /// Paths per pixel, 1 to 1 000 000; with a noise target the first ones, at least 16.
    pub samples: u32,
    /// Sampling goes on until the noise is low. Absent, and then not written: no more than `samples`.
    #[serde(flatten)]
    pub stop: Option<StopSpec>,
    /// Which pixels get more samples than others. Absent, and then not written: none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub allocate: Option<Allocate>,
    /// What is not exact. Absent, and then not written: nothing.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub approximation: Option<Approximation>,
    /// Longest path in edges from camera to light (1: only light that comes straight from its source); absent: no limit.
    pub max_depth: Option<u32>,
    /// The only wavelength rendered, in nanometres, 380 to 780; absent: the visible spectrum.
    pub wavelength_nm: Option<f64>,
    /// Which other frames of the plan the paths are shared with. Absent, and then not written: none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub share: Option<Share>,
}

/// What a rendering does that is not exact.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Approximation {
    /// Paths that have scattered often see fog of fewer scatterings that turn more, in which light spreads alike.
    Similarity,
}

/// How the samples of a frame, `samples` for each of its pixels, are shared out.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Allocate {
    /// So that the mean relative squared error over the pixels is least.
    RelativeError,
}

/// When enough of a pixel has been sampled.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct StopSpec {
    /// Relative standard error of a pixel's luminance to be reached, above 0 up to 1; luminances below 1 % of the frame's
    /// mean count as that.
    pub noise: f64,
    /// Paths per pixel after which sampling ends all the same, `samples` to 1 000 000.
    pub max_samples: u32,
}

/// A quantity written for each frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Output {
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
    /// Standard error of each pixel's luminance.
    StandardError,
    /// Number of samples of each pixel.
    Samples,
    /// An estimate of `Hdr`, which is then there too, without its noise.
    Denoised,
    /// Unit normals in the world.
    Normals,
    /// Positions in the world, in metres.
    Position,
    /// Base colour of the first surface.
    Albedo,
    /// Class of the first surface.
    Semantic,
    /// Instance of the first surface.
    Instance,
    /// Optical flow to the next frame of the path.
    Flow,
    /// Records of the things in the picture.
    Objects,
    /// The sensor's raw picture.
    Raw,
    /// The same view in clear air.
    Pair,
}
