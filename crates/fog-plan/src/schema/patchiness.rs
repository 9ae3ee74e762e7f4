//! Section `fog.patchiness`.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::or_none::Example;
use crate::ranges;

/// Random billows of density and top about the layer, whose means stay what they are.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(default, deny_unknown_fields)]
#[schemars(rename = "Patchiness")]
pub(crate) struct PatchinessFile {
    /// Standard deviation of the number density in shares of its mean at each altitude.
    #[schemars(range(min = ranges::DENSITY_SD.min, max = ranges::DENSITY_SD.max))]
    pub(crate) density_sd: f64,
    /// Standard deviation of the altitude of the layer's top in metres: the profile is stretched to it.
    #[schemars(range(min = ranges::TOP_SD_M.min, max = ranges::TOP_SD_M.max))]
    pub(crate) top_sd_m: f64,
    /// Distance between the largest patches in metres: the longest wavelength.
    #[schemars(range(min = ranges::PATCH_LENGTH_M.min, max = ranges::PATCH_LENGTH_M.max))]
    pub(crate) length_m: Option<f64>,
    /// Sizes of patches: the shortest wavelength is length_m / 2^octaves.
    #[schemars(range(min = ranges::OCTAVES.min, max = ranges::OCTAVES.max))]
    pub(crate) octaves: i64,
    /// Which of all such fogs; independent of the configuration's `seed`.
    pub(crate) seed: u64,
}

impl Default for PatchinessFile {
    fn default() -> Self {
        Self { density_sd: 0.0, top_sd_m: 0.0, length_m: None, octaves: 3, seed: 0 }
    }
}

impl Example for PatchinessFile {
    const EXAMPLE: &'static str = "{density_sd: 0.5, top_sd_m: 8, length_m: 120}";
}
