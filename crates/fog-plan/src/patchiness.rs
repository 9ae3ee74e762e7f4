//! Patchy fog of a frame.

use serde::Serialize;

/// Random billows of a layer. See [`fog_core::patchiness::Patchiness`], whose fields these are.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct PatchinessSpec {
    /// Standard deviation of the number density over its mean at each altitude, 0 to 2.
    pub density_sd: f64,
    /// Standard deviation of the top's altitude in metres, 0 to 1000.
    pub top_sd_m: f64,
    /// Longest wavelength in metres, 1 to 100 000.
    pub length_m: f64,
    /// The shortest wavelength, at least 0.5 m, is `length_m` / 2^`octaves`; 1 to 8.
    pub octaves: u32,
    /// Selects the realisation.
    pub seed: u64,
}
