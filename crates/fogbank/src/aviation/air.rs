//! How far one sees on a runway and towards it.

use super::ThresholdUsed;
use super::position::Position;
use super::site::RunwaySite;
use crate::error::Error;
use fog_core::DVec3;
use fog_core::math::f64::exp;
use fog_optics::visibility::category::Edition;
use fog_optics::visibility::koschmieder::{MOR_OPTICAL_DEPTH, mor_m};
use fog_optics::visibility::rvr::{RunwayLights, Rvr};
use fog_optics::visibility::threshold::Threshold;
use serde::Serialize;

/// Least decision heights of CAT I and CAT II in m (ICAO Annex 6, Part I: 60 m or 200 ft, 30 m or 100 ft).
const DECISION_HEIGHTS_M: [(&str, f64); 2] = [("CAT I", 60.0), ("CAT II", 30.0)];

/// Where the threshold's markings are looked for, in m beyond it: they begin at 6 m, and lights stand before them.
const MARKINGS_M: f64 = 20.0;

/// What lies between the eye and what it looks at.
#[derive(Clone, Copy)]
pub struct Air<'a> {
    /// Optical depth at 550 nm between two points of the world in m.
    pub tau: &'a dyn Fn(DVec3, DVec3) -> f64,
    /// Extinction at 550 nm in 1/m 2.5 m over the threshold, where it is assessed for the runway visual range.
    pub sigma_t_1_m: f64,
    /// Whether something solid stands between the eye (first) and a point.
    pub hidden: &'a dyn Fn(DVec3, DVec3) -> bool,
}

/// A decision height.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct DecisionHeight {
    /// Category of the operation.
    pub category: &'static str,
    /// Its least decision height above the threshold in m.
    pub height_m: f64,
    /// Whether the eye has come down to it.
    pub reached: bool,
}

/// How far one sees.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct VisualRange {
    /// Extinction at 550 nm in 1/m at the height where it is assessed.
    pub sigma_t_1_m: f64,
    /// Meteorological optical range there in m, at a contrast of 5 %.
    pub mor_m: f64,
    /// Luminance in cd/m² that lights are seen against.
    pub background_luminance_cd_m2: f64,
    /// From which illuminance a light is seen.
    pub threshold: ThresholdUsed,
    /// Range of the runway's markings in m (Koschmieder).
    pub rvr_koschmieder_m: f64,
    /// Range of its edge and centre-line lights in m (Allard); 0 where they are dark.
    pub rvr_allard_m: f64,
    /// Runway visual range in m: the greater of both.
    pub rvr_m: f64,
    /// As it is reported: `M0050`, `0325`, …, `P2000`.
    pub rvr_reported: String,
    /// Category of operations that this RVR is enough for.
    pub category: &'static str,
    /// Whether the decision heights are reached.
    pub decision_heights: Vec<DecisionHeight>,
    /// Optical depth at 550 nm from the eye to the middle of the threshold.
    pub tau_to_threshold: f64,
    /// Transmittance on this way.
    pub transmittance_to_threshold: f64,
    /// Whether the threshold's markings are seen: at 5 % of their contrast, with nothing between.
    pub threshold_markings_in_sight: bool,
    /// How far ahead of the eye, along the runway's axis, the ground is seen in m (5 % contrast).
    pub ground_seen_ahead_m: f64,
}

/// `lights_cd`: intensities of the edge and the centre-line lights.
pub(super) fn visual_range(
    (site, position, eye): (&RunwaySite, &Position, DVec3),
    air: &Air<'_>,
    (background_luminance_cd_m2, threshold): (f64, &Threshold),
    [edge_cd, centre_line_cd]: [f64; 2],
) -> Result<VisualRange, Error> {
    let lights = RunwayLights { edge_cd, centre_line_cd, setting_percent: 100.0 };
    let rvr = Rvr::new(air.sigma_t_1_m, &lights, threshold.illuminance_lx)?;
    let category = Edition::Split.category(rvr.rvr_m);
    let height = position.height_above_threshold_m;
    let tau = (air.tau)(eye, site.threshold());
    let reached = |(category, height_m)| DecisionHeight { category, height_m, reached: height <= height_m };
    Ok(VisualRange {
        sigma_t_1_m: air.sigma_t_1_m,
        mor_m: mor_m(air.sigma_t_1_m),
        background_luminance_cd_m2,
        threshold: threshold.into(),
        rvr_koschmieder_m: rvr.markings_m,
        rvr_allard_m: rvr.lights_m,
        rvr_m: rvr.rvr_m,
        rvr_reported: rvr.reported().to_string(),
        category: category.name,
        decision_heights: DECISION_HEIGHTS_M.into_iter().map(reached).collect(),
        tau_to_threshold: tau,
        transmittance_to_threshold: exp(-tau),
        threshold_markings_in_sight: position.along_track_m > 0.0
            && tau <= MOR_OPTICAL_DEPTH
            && !(air.hidden)(eye, site.threshold() + site.forward() * MARKINGS_M),
        ground_seen_ahead_m: ground_seen_ahead_m(site, eye, air),
    })
}

/// Farthest distance that is looked at, in m.
const FARTHEST_M: f64 = 1e5;

/// Distance along the runway's axis at which the optical depth to the plane of the runway reaches that of 5 %. The way gets longer
/// with the distance and its mean extinction stays, so that there is one such place; 0 if not even the ground below is seen.
fn ground_seen_ahead_m(site: &RunwaySite, eye: DVec3, air: &Air<'_>) -> f64 {
    let below = DVec3::new(eye.x, site.threshold_m[1], eye.z);
    let seen = |ahead: f64| (air.tau)(eye, below + site.forward() * ahead) <= MOR_OPTICAL_DEPTH;
    if seen(FARTHEST_M) {
        return f64::INFINITY;
    }
    let (mut near, mut far) = (0.0, FARTHEST_M);
    for _ in 0..60 {
        let middle = 0.5 * (near + far);
        if seen(middle) { near = middle } else { far = middle }
    }
    near
}
