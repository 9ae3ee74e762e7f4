//! The scene of a frame: a file, or one made by formula.

use std::{fmt, path::PathBuf};

use serde::Serialize;

/// A scene.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SceneSpec {
    /// Where it comes from.
    #[serde(flatten)]
    pub source: SceneSource,
    /// Time in seconds at which what moves in it is shown: `scene.time_s`, plus on a path that of the pose. Not written where it
    /// is 0.
    #[serde(skip_serializing_if = "is_zero")]
    pub time_s: f64,
    /// What it may cost. Not written: it decides whether there is a frame, not what it shows.
    #[serde(skip)]
    pub limits: SceneLimits,
}

fn is_zero(time_s: &f64) -> bool {
    *time_s == 0.0
}

/// Where a scene comes from. Displays as what a message calls it.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(untagged)]
pub enum SceneSource {
    /// A file.
    File {
        /// Path as written in the configuration (`.glb` or `.gltf`), relative to the current folder.
        file: PathBuf,
    },
    /// Made by formula.
    Made(WorldSpec),
}

/// A scene by formula and its options; absent ones, which are not written, are the formula's own.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(tag = "generate", rename_all = "snake_case")]
pub enum WorldSpec {
    /// The street of Kolářová, Lachiver & Wilkie 2024.
    Street,
    /// A street in a town.
    Urban {
        /// Decides what the options leave open.
        seed: u64,
        /// Length in metres, 80 to 600.
        #[serde(skip_serializing_if = "Option::is_none")]
        length_m: Option<f64>,
        /// Whose signs.
        #[serde(skip_serializing_if = "Option::is_none")]
        style: Option<SignStyle>,
        /// How full lanes and kerbs are, 0 to 1.
        #[serde(skip_serializing_if = "Option::is_none")]
        traffic: Option<f64>,
        /// How full the pavements are, 0 to 1.
        #[serde(skip_serializing_if = "Option::is_none")]
        people: Option<f64>,
        /// Speed limit on the signs, 5 to 130 km/h (vienna) or mph (mutcd).
        #[serde(skip_serializing_if = "Option::is_none")]
        limit: Option<u32>,
    },
    /// A motorway.
    Highway {
        /// Decides what the options leave open.
        seed: u64,
        /// Length in metres, 200 to 5000.
        #[serde(skip_serializing_if = "Option::is_none")]
        length_m: Option<f64>,
        /// Whose signs.
        #[serde(skip_serializing_if = "Option::is_none")]
        style: Option<SignStyle>,
        /// How full the lanes are, 0 to 1.
        #[serde(skip_serializing_if = "Option::is_none")]
        traffic: Option<f64>,
        /// Distance between gantries in metres, 100 to 5000.
        #[serde(skip_serializing_if = "Option::is_none")]
        gantries_m: Option<f64>,
    },
    /// A runway and its lights.
    Runway {
        /// Decides what the options leave open.
        seed: u64,
        /// Length in metres, 1200 to 5000.
        #[serde(skip_serializing_if = "Option::is_none")]
        length_m: Option<f64>,
        /// Width in metres: 30, 45 or 60.
        #[serde(skip_serializing_if = "Option::is_none")]
        width_m: Option<f64>,
        /// What is painted at the near end.
        #[serde(skip_serializing_if = "Option::is_none")]
        designator: Option<String>,
        /// Lights before the threshold.
        #[serde(skip_serializing_if = "Option::is_none")]
        approach: Option<ApproachSystem>,
        /// Glide path of the PAPI in degrees, 2 to 5.
        #[serde(skip_serializing_if = "Option::is_none")]
        papi_deg: Option<f64>,
        /// Intensity of all lights in percent of the full one, 0.01 to 100.
        #[serde(skip_serializing_if = "Option::is_none")]
        lights_percent: Option<f64>,
        /// Whether the sequenced flashers are lit.
        #[serde(skip_serializing_if = "Option::is_none")]
        flashers: Option<bool>,
    },
    /// Targets at known places.
    Targets {
        /// Distances of the boards in metres, 1 to 5 of them.
        #[serde(skip_serializing_if = "Option::is_none")]
        boards_m: Option<Vec<f64>>,
        /// Distances of the black targets in metres, 1 to 8 of them.
        #[serde(skip_serializing_if = "Option::is_none")]
        black_m: Option<Vec<f64>>,
        /// Width that each black target subtends, in degrees, 0.1 to 4.
        #[serde(skip_serializing_if = "Option::is_none")]
        black_deg: Option<f64>,
        /// Altitude of the eye in metres, 0.5 to 100.
        #[serde(skip_serializing_if = "Option::is_none")]
        eye_m: Option<f64>,
    },
}

/// Whose signs, plates and markings.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum SignStyle {
    /// Vienna Convention.
    Vienna,
    /// Manual on Uniform Traffic Control Devices (USA).
    Mutcd,
}

/// A system of approach lights.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum ApproachSystem {
    /// No approach lights.
    None,
    /// Medium intensity with alignment lights.
    Malsr,
    /// High intensity, categories II and III.
    Alsf2,
}

/// What a scene may cost; absent: the loader's own limits.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct SceneLimits {
    /// Triangles over all nodes.
    pub triangles: Option<u64>,
    /// Pixels of all textures together.
    pub texture_px: Option<u64>,
    /// Bytes of all files together.
    pub file_bytes: Option<u64>,
    /// Nodes.
    pub nodes: Option<u64>,
}

impl WorldSpec {
    /// The formula's name in configurations.
    #[must_use]
    pub fn name(&self) -> &'static str {
        match self {
            Self::Street => "street",
            Self::Urban { .. } => "urban",
            Self::Highway { .. } => "highway",
            Self::Runway { .. } => "runway",
            Self::Targets { .. } => "targets",
        }
    }

    /// What decides that the options leave open; 1 where they leave nothing.
    #[must_use]
    pub fn seed(&self) -> u64 {
        match self {
            Self::Street | Self::Targets { .. } => 1,
            Self::Urban { seed, .. } | Self::Highway { seed, .. } | Self::Runway { seed, .. } => *seed,
        }
    }
}

impl fmt::Display for SceneSource {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::File { file } => write!(f, "{}", file.display()),
            Self::Made(world) => write!(f, "generated {} (seed {})", world.name(), world.seed()),
        }
    }
}
