//! The passing beam of a head lamp for right-hand traffic: UN Regulation 112, class B.
//!
//! The regulation asks for intensities at points of a screen (Sec. 6.2: 75R, 50R, 50V and 25 at least, B50L, zone III, 75L and 50L
//! at most); between them it leaves the beam free. This one is a hot spot on the lane, a broad foreground and faint stray light over
//! a cut-off that is level at 0.57° under the lamp on the left and climbs at 15° on the right. The limits at the test points
//! are those of the regulation's table (Official Journal of the EU L 250, 2014); how far the cut-off climbs is a choice.

use crate::lamp::{Lamp, Table, colour};
use fog_core::math;

/// Elevation of the level part of the cut-off, and where the climbing part ends.
const LEVEL_DEG: f32 = -0.57;
const HIGHEST_DEG: f32 = 0.4;
/// Tangent of 15°.
const CLIMB: f32 = 0.267_949_2;
/// Thickness of the cut-off.
const SOFT_DEG: f32 = 0.2;
/// Where the beam ends aside, up and down.
const ASIDE_DEG: f32 = 40.0;
const UP_DEG: f32 = 10.0;
const DOWN_DEG: f32 = -20.0;

/// The head lamp. Its stated intensity is that of the hot spot.
pub(crate) fn low_beam() -> Lamp {
    Lamp {
        name: "low beam".to_owned(),
        color: colour::WHITE,
        candela: intensity(1.2, -0.9),
        cone_deg: Some([1.0, 16.0]),
        table: Some(table()),
        radius_m: 0.08,
        source: "passing beam within the limits of UN Regulation 112, class B",
    }
}

fn table() -> Table {
    let fine = (-12..=8).map(|k| 0.1 * k as f32);
    let below = [-20.0, -15.0, -10.0, -7.0, -5.0, -4.0, -3.0, -2.5, -2.0, -1.7, -1.4];
    let above = [1.0, 1.5, 2.0, 3.0, 5.0, 7.0, 10.0];
    let up = below.into_iter().chain(fine).chain(above).collect();
    let right: Vec<f32> =
        (0..=10).map(|k| 0.5 * k as f32).chain([6.0, 8.0, 10.0, 13.0, 16.0, 20.0, 25.0, 30.0]).collect();
    let left = right.iter().copied();
    let ends = [ASIDE_DEG, 360.0 - ASIDE_DEG];
    let back = right.iter().rev().map(|a| 360.0 - a);
    let aside = left.chain(ends).chain(back).collect();
    // Azimuths grow to the left.
    Table::new(up, aside, |aside, up| intensity(if aside > 180.0 { 360.0 - aside } else { -aside }, up))
}

/// Intensity in cd towards so many degrees to the right and up.
fn intensity(right: f32, up: f32) -> f32 {
    if right.abs() >= ASIDE_DEG || !(DOWN_DEG..UP_DEG).contains(&up) {
        return 0.0;
    }
    let bell = |[x, width]: [f32; 2], [y, height]: [f32; 2]| {
        math::f32::exp(-((x / width).powi(2) + (y / height).powi(2)))
    };
    let hot_spot = 14_000.0 * bell([right - 1.2, 4.5], [up + 0.9, 1.3]);
    let foreground = 3_000.0 * bell([right, 18.0], [up + 2.0, 4.0]);
    let stray = 250.0 * bell([right, 20.0], [up, 6.0]);
    let cut_off = (LEVEL_DEG + CLIMB * right.max(0.0)).min(HIGHEST_DEG);
    let lit = ((cut_off - up) / SOFT_DEG + 0.5).clamp(0.0, 1.0);
    lit * (hot_spot + foreground) + stray
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_regulations_test_points_are_kept() {
        // Right, up; least and greatest intensity in cd.
        for (point, right, up, least, greatest) in [
            ("B 50 L", -3.43, 0.57, 0.0, 350.0),
            ("BR", 2.5, 1.0, 0.0, 1_750.0),
            ("75 R", 1.15, -0.57, 10_100.0, f32::INFINITY),
            ("75 L", -3.43, -0.57, 0.0, 10_600.0),
            ("50 L", -3.43, -0.86, 0.0, 13_200.0),
            ("50 R", 1.72, -0.86, 10_100.0, f32::INFINITY),
            ("50 V", 0.0, -0.86, 5_100.0, f32::INFINITY),
            ("25 L", -9.0, -1.72, 1_700.0, f32::INFINITY),
            ("25 R", 9.0, -1.72, 1_700.0, f32::INFINITY),
            ("zone III", -6.0, 0.0, 0.0, 625.0),
            ("zone III", -1.0, 2.0, 0.0, 625.0),
        ] {
            let got = intensity(right, up);
            assert!((least..=greatest).contains(&got), "{point}: {got} cd, {least} to {greatest}");
        }
        assert_eq!(intensity(41.0, -1.0), 0.0);
    }
}
