//! YAML to a checked schema to a plan of frames: the only crate that knows the configuration format.
//!
//! A configuration is one document that describes a frame, and axes that override dotted paths in it. [`load`] reads it
//! into a [`Plan`], which makes each [`FrameSpec`] from its index. A mistake is reported with the place where it was
//! written: every value is kept with its line and column until the frame is checked.
//!
//! Data path: text → `yaml` → tree of `node`s → `include` (files under it, by `merge`) → `fill` (defaults) → `set` (`--set`,
//! axes) → `presets` → `read` and `de` (types of `schema`) → `validate` → [`FrameSpec`].

mod axis;
mod canonical;
mod check;
mod de;
mod de_error;
mod diff;
mod draws;
mod droplets;
mod error;
mod fill;
mod filter;
mod fog_sources;
mod frame;
mod identity;
mod include;
mod labels;
mod layout;
mod lens;
mod light_groups;
mod load;
mod merge;
mod node;
mod origin;
mod patchiness;
mod path;
mod plan;
mod presets;
mod ranges;
mod read;
mod rig;
mod runway;
mod scene;
mod schema;
mod sensor;
mod set;
mod share;
mod sky;
mod sweep;
mod text_file;
mod validate;
mod words;
mod yaml;

pub use droplets::{DropletsSpec, LognormalSpec, VerticalSpec};
pub use error::{PlanError, Problem};
pub use filter::Filter;
pub use frame::{
    Allocate, Approximation, CameraSpec, Coefficient, EnvironmentSpec, FogModel, FogSpec, FrameSpec,
    LightingSpec, MeanCosine, Output, Phase, RenderSpec, Sampling, SensorSpec, StopSpec, SunSpec, Visibility,
};
pub use labels::{ClassPatternSpec, ClassSpec, LabelsSpec};
pub use lens::{IntrinsicsSpec, LensSpec, ShutterSpec};
pub use light_groups::{LightGroupSpec, LightsSpec};
pub use load::{load, parse};
pub use origin::Origin;
pub use patchiness::PatchinessSpec;
pub use path::{ApproachSpec, NextSpec, PathSpec};
pub use plan::{AxisSummary, Plan};
pub use rig::{PoseSpec, RigSpec};
pub use runway::RunwaySpec;
pub use scene::{ApproachSystem, SceneLimits, SceneSource, SceneSpec, SignStyle, WorldSpec};
pub use schema::schema_json;
pub use sensor::{BayerSpec, ExposureSpec, PsfSpec, ResponseSpec, SensorModelSpec, VignettingSpec};
pub use share::Share;
pub use sky::{MoonSpec, SkyBrightness, SkySpec};
pub use text_file::read_table;
