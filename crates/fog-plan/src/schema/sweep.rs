//! Section `sweep`.

use std::collections::BTreeMap;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize, de::IgnoredAny};

use crate::ranges;

/// Axes, and how they combine.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema, Serialize)]
#[serde(default, deny_unknown_fields)]
#[schemars(rename = "Sweep", extend("required" = ["axes"]))]
pub(crate) struct SweepFile {
    /// How the axes combine.
    pub(crate) mode: SweepMode,
    /// Number of frames (random, sobol).
    #[schemars(range(min = ranges::COUNT.min, max = ranges::COUNT.max))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) count: Option<i64>,
    /// Axis by dotted path (`fog`, `camera.altitude_m`, `camera.position_m.2`). Several paths, separated by commas,
    /// change together: the values are then lists with one item per path.
    #[schemars(required, with = "Option<BTreeMap<String, AxisFile>>", extend("minProperties" = 1))]
    #[serde(skip_serializing)]
    pub(crate) axes: Option<IgnoredAny>,
}

/// How axes combine.
#[derive(Clone, Copy, Debug, Default, Deserialize, JsonSchema, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub(crate) enum SweepMode {
    /// Every value of each with every value of all others; the first axis changes slowest.
    #[default]
    Grid,
    /// First values together, second values together, …: all axes have equally many.
    Zip,
    /// `count` independent random draws.
    Random,
    /// `count` points of an Owen-scrambled Sobol sequence: like random, but evenly spread.
    Sobol,
}

impl SweepMode {
    /// Whether values are drawn, `count` times.
    pub(crate) fn draws(self) -> bool {
        matches!(self, Self::Random | Self::Sobol)
    }
}

/// Values of an axis. Only the schema needs this type: values are read from the tree, with their positions.
#[derive(JsonSchema)]
#[schemars(untagged, rename = "Axis")]
#[expect(dead_code, reason = "describes the axes to schemars; never made")]
enum AxisFile {
    /// The values one by one; each replaces the whole subtree at the path.
    List(#[schemars(length(min = 1))] Vec<serde_json::Value>),
    /// Numbers from `from` to `to`.
    Range(AxisRange),
}

/// Numbers: `count` of them including both ends, or in steps of `step`; with neither, drawn uniformly (random, sobol).
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct AxisRange {
    /// First value.
    pub(crate) from: f64,
    /// Last value.
    pub(crate) to: f64,
    /// How many, both ends included.
    #[schemars(range(min = ranges::COUNT.min, max = ranges::COUNT.max))]
    pub(crate) count: Option<i64>,
    /// Distance from each to the next.
    pub(crate) step: Option<f64>,
}
