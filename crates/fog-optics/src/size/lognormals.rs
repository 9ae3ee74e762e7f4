//! Sums of lognormals.

use crate::distribution::lognormal;
use crate::error::{OpticsError, check_range};
use fog_core::math::f64::ln;

/// Most lognormals of a sum.
const MAX_MODES: usize = 16;

/// One lognormal of a sum.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LognormalMode {
    /// Number of droplets in this mode relative to the others, above 0 up to 1e12.
    pub share: f64,
    /// Median diameter in µm, 0.02 to 500.
    pub median_diameter_um: f64,
    /// Geometric standard deviation, exp of the standard deviation of ln d, 1.02 to 4.
    pub geometric_sd: f64,
}

/// The modes with shares that add up to 1.
pub(super) fn normalised(modes: &[LognormalMode]) -> Result<Vec<LognormalMode>, OpticsError> {
    check_range("number of lognormals", modes.len() as f64, 1.0, MAX_MODES as f64)?;
    for mode in modes {
        check_range("lognormal's share", mode.share, f64::MIN_POSITIVE, 1e12)?;
        check_range("lognormal's median_diameter_um", mode.median_diameter_um, 0.02, 500.0)?;
        check_range("lognormal's geometric_sd", mode.geometric_sd, 1.02, 4.0)?;
    }
    let sum: f64 = modes.iter().map(|mode| mode.share).sum();
    Ok(modes.iter().map(|mode| LognormalMode { share: mode.share / sum, ..*mode }).collect())
}

pub(super) fn density_1_um(modes: &[LognormalMode], d_um: f64) -> f64 {
    (modes.iter())
        .map(|mode| mode.share * lognormal(d_um, ln(mode.median_diameter_um), ln(mode.geometric_sd)))
        .sum()
}
