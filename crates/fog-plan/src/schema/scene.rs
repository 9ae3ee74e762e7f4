//! Section `scene`.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::or_none::Example;
use crate::ranges;

/// A scene: `file`, or `generate` with the options of the formula (those of `fogbank scene NAME`). An option that is absent is the
/// formula's own.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema, Serialize)]
#[serde(default, deny_unknown_fields)]
#[schemars(rename = "Scene")]
pub(crate) struct SceneFile {
    /// Path of a glTF scene (`.glb` or `.gltf`), relative to the current folder.
    pub(crate) file: Option<String>,
    /// Time in seconds at which what moves in it (glTF animations, which all play from 0) is shown; a path's times are added.
    /// Absent: 0.
    #[schemars(range(min = ranges::TIME_S.min, max = ranges::TIME_S.max))]
    pub(crate) time_s: Option<f64>,
    /// In place of `file`: a scene by formula, made when it is needed. The same options and seed are the same scene.
    pub(crate) generate: Option<WorldName>,
    /// Number that decides what the options leave open (urban, highway, runway). Absent: 1.
    pub(crate) seed: Option<u64>,
    /// Length in metres: urban 80 to 600, highway 200 to 5000, runway 1200 to 5000.
    #[schemars(range(min = ranges::URBAN_LENGTH_M.min, max = ranges::RUNWAY_LENGTH_M.max))]
    pub(crate) length_m: Option<f64>,
    /// Whose signs, plates and markings (urban, highway).
    pub(crate) style: Option<StyleFile>,
    /// How full the lanes are, 0 to 1 (urban, highway).
    #[schemars(range(min = ranges::FULLNESS.min, max = ranges::FULLNESS.max))]
    pub(crate) traffic: Option<f64>,
    /// How full the pavements are, 0 to 1 (urban).
    #[schemars(range(min = ranges::FULLNESS.min, max = ranges::FULLNESS.max))]
    pub(crate) people: Option<f64>,
    /// Speed limit on the signs, km/h with vienna and mph with mutcd (urban).
    #[schemars(range(min = ranges::SPEED_LIMIT.min, max = ranges::SPEED_LIMIT.max))]
    pub(crate) limit: Option<i64>,
    /// Distance between gantries in metres (highway).
    #[schemars(range(min = ranges::GANTRIES_M.min, max = ranges::GANTRIES_M.max))]
    pub(crate) gantries_m: Option<f64>,
    /// Width in metres: 30, 45 or 60 (runway).
    pub(crate) width_m: Option<f64>,
    /// Number and letter at the near end, as 09L (runway).
    #[schemars(regex(pattern = "^[0-9]{1,2}[LCR]?$"))]
    pub(crate) designator: Option<String>,
    /// Approach lights (runway).
    pub(crate) approach: Option<ApproachFile>,
    /// Glide path of the PAPI in degrees (runway).
    #[schemars(range(min = ranges::PAPI_DEG.min, max = ranges::PAPI_DEG.max))]
    pub(crate) papi_deg: Option<f64>,
    /// Intensity of all lights in percent of the full one (runway).
    #[schemars(range(min = ranges::LIGHTS_PERCENT.min, max = ranges::LIGHTS_PERCENT.max))]
    pub(crate) lights_percent: Option<f64>,
    /// Light the sequenced flashers, all at once (runway).
    pub(crate) flashers: Option<bool>,
    /// Distances of the boards in metres, 1 to 5 of them (targets).
    #[schemars(length(min = 1, max = 5), inner(range(min = ranges::BOARD_M.min, max = ranges::BOARD_M.max)))]
    pub(crate) boards_m: Option<Vec<f64>>,
    /// Distances of the black targets in metres, 1 to 8 of them (targets).
    #[schemars(length(min = 1, max = 8), inner(range(min = ranges::BLACK_M.min, max = ranges::BLACK_M.max)))]
    pub(crate) black_m: Option<Vec<f64>>,
    /// Width that each black target subtends, in degrees (targets).
    #[schemars(range(min = ranges::BLACK_DEG.min, max = ranges::BLACK_DEG.max))]
    pub(crate) black_deg: Option<f64>,
    /// Altitude of the eye in metres (targets).
    #[schemars(range(min = ranges::EYE_M.min, max = ranges::EYE_M.max))]
    pub(crate) eye_m: Option<f64>,
    /// What the scene may cost: more is refused with a message before memory is taken.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) limits: Option<LimitsFile>,
}

/// Limits of a scene.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema, Serialize)]
#[serde(default, deny_unknown_fields)]
#[schemars(rename = "SceneLimits")]
pub(crate) struct LimitsFile {
    /// Triangles over all nodes. Absent: 20 million.
    #[schemars(range(min = 1, max = 2_147_483_647))]
    pub(crate) triangles: Option<u64>,
    /// Pixels of all textures together; each takes 4 bytes. Absent: 268 million.
    #[schemars(range(min = 1))]
    pub(crate) texture_px: Option<u64>,
    /// Bytes of the scene file and the files that it names, together. Absent: 2 GiB.
    #[schemars(range(min = 1))]
    pub(crate) file_bytes: Option<u64>,
    /// Nodes of the scene file. Absent: 4 million.
    #[schemars(range(min = 1))]
    pub(crate) nodes: Option<u64>,
}

/// Scenes by formula.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub(crate) enum WorldName {
    /// The street of Kolářová, Lachiver & Wilkie 2024.
    Street,
    /// A street in a town.
    Urban,
    /// A motorway.
    Highway,
    /// A runway with its lights.
    Runway,
    /// Checkerboards, markers and black targets at known places.
    Targets,
}

impl WorldName {
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Street => "street",
            Self::Urban => "urban",
            Self::Highway => "highway",
            Self::Runway => "runway",
            Self::Targets => "targets",
        }
    }
}

/// Whose signs.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(rename_all = "snake_case")]
#[schemars(rename = "SignStyle")]
pub(crate) enum StyleFile {
    /// Vienna Convention.
    Vienna,
    /// Manual on Uniform Traffic Control Devices (USA).
    Mutcd,
}

/// Approach lights.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(rename_all = "snake_case")]
#[schemars(rename = "ApproachLights")]
pub(crate) enum ApproachFile {
    /// No approach lights.
    None,
    /// Medium intensity with alignment lights.
    Malsr,
    /// High intensity, categories II and III.
    Alsf2,
}

impl Example for SceneFile {
    const EXAMPLE: &'static str = "{file: scenes/street.glb}";
}
