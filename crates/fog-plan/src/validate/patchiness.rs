//! Checks of `fog.patchiness`.

use fog_core::patchiness::{Patchiness, PatchinessError, PatchyField};

use super::Check;
use crate::{
    patchiness::PatchinessSpec,
    ranges,
    schema::{OrNone, PatchinessFile},
};

/// Shortest wavelength of patches in metres: fog is walked through by steps of a fraction of it.
const SHORTEST_M: f64 = 0.5;

impl Check<'_> {
    /// The patchiness of a layer of this thickness, where it is known. The outer option is the check's success.
    pub(super) fn patchiness(
        &mut self,
        file: Option<&OrNone<PatchinessFile>>,
        height_m: Option<f64>,
    ) -> Option<Option<PatchinessSpec>> {
        let Some(OrNone::Some(file)) = file else { return Some(None) };
        let density_sd = self.range("fog.patchiness.density_sd", file.density_sd, ranges::DENSITY_SD);
        let top_sd_m = self.range("fog.patchiness.top_sd_m", file.top_sd_m, ranges::TOP_SD_M);
        let why = "the distance between the largest patches, 1 to 100000 m";
        let length = self.required("fog.patchiness.length_m", file.length_m, why);
        let length = length.and_then(|l| self.range("fog.patchiness.length_m", l, ranges::PATCH_LENGTH_M));
        let octaves = self.whole("fog.patchiness.octaves", file.octaves, ranges::OCTAVES);
        let (density_sd, top_sd_m, length_m, octaves) = (density_sd?, top_sd_m?, length?, octaves?);
        if density_sd == 0.0 && top_sd_m == 0.0 {
            let message = "density_sd and top_sd_m are both 0; give one of them, or `none` for even fog";
            self.problem("fog.patchiness", message);
            return None;
        }
        let shortest_m = length_m / f64::from(1u32 << octaves);
        if shortest_m < SHORTEST_M {
            let message = format!(
                "{octaves} octaves below {length_m} m reach down to {shortest_m:.3} m; valid: {SHORTEST_M} m and more"
            );
            self.problem("fog.patchiness.octaves", message);
            return None;
        }
        let spec = PatchinessSpec { density_sd, top_sd_m, length_m, octaves, seed: file.seed };
        if let Some(Err(error)) = height_m.map(|height| fits(&spec, height)) {
            self.problem("fog.patchiness.top_sd_m", error.to_string());
            return None;
        }
        Some(Some(spec))
    }
}

/// Whether a layer of this thickness is left everywhere.
fn fits(spec: &PatchinessSpec, height_m: f64) -> Result<(), PatchinessError> {
    let PatchinessSpec { density_sd, top_sd_m, length_m, octaves, seed } = *spec;
    let field = PatchyField::new(Patchiness { density_sd, top_sd_m, length_m, octaves, seed })?;
    field.layer(0.0, height_m).map(|_| ())
}
