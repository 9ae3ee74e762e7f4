//! The configuration file as it is written: names, units, defaults. Meaning is checked in `validate`.
//!
//! Keys that an axis may supply are optional here even where a frame needs them.

mod camera;
mod droplets;
mod exposure;
mod fog;
mod labels;
mod lens;
mod light;
mod or_none;
mod patchiness;
mod path;
mod phase;
mod runway;
mod scene;
mod sensor_model;
mod sky;
mod sweep;

use std::collections::BTreeMap;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

pub(crate) use camera::{
    AllocateFile, ApproximationFile, CameraFile, OutputFile, RenderFile, SensorFile, ShareFile,
};
pub(crate) use droplets::{DropletsFile, GammaFile, LognormalFile, ModifiedGammaFile, VerticalFile};
pub(crate) use exposure::{ExposureFile, ExposureMap, LENS_TRANSMISSION, PERCENTILE, TARGET};
pub(crate) use fog::{CoefficientFile, FogFile, FogModelName, SamplingFile, VisibilityFile};
pub(crate) use labels::{ClassesFile, LabelsFile, NameFile, NamesFile};
pub(crate) use lens::{IntrinsicsFile, LensFile};
pub(crate) use light::{
    EnvironmentFile, LUMINANCE_OF_ONE_CD_M2, LightGroupFile, LightingFile, LightingMap, Preset, SunFile,
};
pub(crate) use or_none::OrNone;
pub(crate) use patchiness::PatchinessFile;
pub(crate) use path::{
    DispersionFile, DriveFile, EachFile, GlideSlopeFile, LardFile, LineFile, LookFile, PathFile,
    PathPoseFile, RigCameraFile, ShutterFile,
};
pub(crate) use phase::{MeanCosineFile, PhaseFile};
pub(crate) use runway::RunwayFile;
pub(crate) use scene::{ApproachFile, LimitsFile, SceneFile, StyleFile, WorldName};
pub(crate) use sensor_model::{
    BayerFile, PsfFile, ResponseFile, SensorModelFile, SensorModelMap, SensorModelWord, SensorPreset,
    VignettingFile,
};
pub(crate) use sky::{
    AEROSOL_OPTICAL_DEPTH, GROUND_ALBEDO, MoonFile, NIGHT_LUMINANCE_CD_M2, OZONE_DU, SkyFile, SkyModelName,
};
pub(crate) use sweep::{AxisRange, SweepFile, SweepMode};

/// A Fogbank configuration: one document that describes a frame, and optionally axes that override parts of it, frame
/// by frame.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema, Serialize)]
#[serde(default, deny_unknown_fields)]
#[schemars(rename = "Fogbank configuration", extend("required" = ["version", "name"]))]
pub(crate) struct ConfigFile {
    /// Files that this one is laid over, relative to it: later ones lie over earlier ones. Maps are merged, all else is replaced.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) include: Option<IncludeFile>,
    /// Version of this format: 1.
    #[schemars(required, range(min = 1, max = 1))]
    pub(crate) version: Option<i64>,
    /// Name of the data set: letters, digits, `.`, `_` and `-`.
    #[schemars(required, length(min = 1, max = 100), regex(pattern = "^[A-Za-z0-9._-]+$"))]
    pub(crate) name: Option<String>,
    /// Seed of all random numbers of the data set.
    #[schemars(default = "default_seed")]
    pub(crate) seed: Option<u64>,
    /// The scene, or `none` for empty space.
    pub(crate) scene: Option<OrNone<SceneFile>>,
    /// The fog, or `none`.
    pub(crate) fog: Option<OrNone<FogFile>>,
    /// Where the camera stands and looks; with `cameras`, the rig. Absent with `path`.
    pub(crate) camera: CameraFile,
    /// Poses over time, instead of `camera`: each makes a frame.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) path: Option<PathFile>,
    /// A rig's cameras by name: each makes a frame.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) cameras: Option<BTreeMap<String, RigCameraFile>>,
    /// The image plane.
    pub(crate) sensor: SensorFile,
    /// A preset or a map of light sources.
    pub(crate) lighting: LightingFile,
    /// How the picture is computed.
    pub(crate) render: RenderFile,
    /// Classes of surfaces by names of nodes, meshes (with all that is below such nodes) and materials; `*` in a name stands for
    /// any text. The first class whose name fits counts, before any class that the scene file gives. Names other than those of
    /// Cityscapes and of the made scenes become new classes.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) classes: Option<ClassesFile>,
    /// When a thing counts as detectable in the output `objects`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) labels: Option<LabelsFile>,
    /// What is written for each frame.
    #[schemars(extend("uniqueItems" = true), length(min = 1))]
    pub(crate) outputs: Outputs,
    /// The runway that the records are about. Absent: the scene's, if it has one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) runway: Option<RunwayFile>,
    /// Axes whose values are multiplied out into frames.
    pub(crate) sweep: Option<SweepFile>,
}

/// One path or several.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(untagged)]
#[schemars(rename = "Include")]
pub(crate) enum IncludeFile {
    /// A file.
    One(String),
    /// Files.
    Several(Vec<String>),
}

/// Seed of a configuration that names none.
pub(crate) const DEFAULT_SEED: u64 = 1;

fn default_seed() -> u64 {
    DEFAULT_SEED
}

/// Names of the outputs; unless said otherwise those up to `airlight`.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(transparent)]
pub(crate) struct Outputs(pub(crate) Vec<OutputFile>);

impl Default for Outputs {
    fn default() -> Self {
        Self(OutputFile::DEFAULT.to_vec())
    }
}

/// The JSON Schema (draft 2020-12) of a configuration file, for editors.
///
/// ```
/// let schema = fog_plan::schema_json();
/// assert_eq!(schema["additionalProperties"], false);
/// ```
#[must_use]
pub fn schema_json() -> serde_json::Value {
    schemars::schema_for!(ConfigFile).to_value()
}
