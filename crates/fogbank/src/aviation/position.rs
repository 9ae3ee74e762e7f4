//! Where an eye is on its approach.

use super::site::RunwaySite;
use fog_core::DVec3;
use fog_core::math::f64::atan2;
use serde::Serialize;

/// Share of the glide path's angle that an indicator's dot stands for: 0.0875 DDM at 0.12 θ, and two dots are the full scale of
/// 0.175 DDM (ICAO Annex 10, Vol. I, 3.1.5.6, for CAT II and III; as commonly quoted, the text was not at hand).
const SHARE_OF_A_DOT: f64 = 0.12;

/// Position by the runway.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Position {
    /// Height of the eye over the threshold in m.
    pub height_above_threshold_m: f64,
    /// Distance to the threshold along the runway's axis in m: negative beyond it.
    pub along_track_m: f64,
    /// Distance to the right of the extended centre line in m: negative to the left.
    pub cross_track_m: f64,
    /// Straight distance to the middle of the threshold in m.
    pub slant_range_to_threshold_m: f64,
    /// Straight distance to the aiming point in m.
    pub slant_range_to_aiming_point_m: f64,
    /// Elevation in degrees at which the eye is seen from the aiming point; absent beyond it.
    pub glide_path_angle_deg: Option<f64>,
    /// That less the runway's glide path in degrees: positive above it.
    pub glide_path_deviation_deg: Option<f64>,
    /// The same in dots of an indicator, 0.12 of the glide path's angle each.
    pub glide_path_deviation_dots: Option<f64>,
    /// Angle in degrees at the aiming point between the extended centre line and the eye, seen from above: positive if the eye
    /// is to the right of it; absent beyond the aiming point.
    pub lateral_angle_deg: Option<f64>,
}

impl Position {
    pub(super) fn new(site: &RunwaySite, eye: DVec3) -> Self {
        let from_threshold = eye - site.threshold();
        let from_aim = eye - site.aim();
        let (height, along) = (from_threshold.y, site.before(eye));
        let cross = from_threshold.dot(site.right());
        let level = from_aim.x.hypot(from_aim.z);
        let ahead = Some(along + site.touchdown_m).filter(|distance| *distance > 0.0);
        let angle = ahead.map(|_| atan2(height, level).to_degrees());
        let deviation = angle.map(|angle| angle - site.glide_slope_deg);
        Self {
            height_above_threshold_m: height,
            along_track_m: along,
            cross_track_m: cross,
            slant_range_to_threshold_m: from_threshold.length(),
            slant_range_to_aiming_point_m: from_aim.length(),
            glide_path_angle_deg: angle,
            glide_path_deviation_deg: deviation,
            glide_path_deviation_dots: deviation.map(|d| d / (SHARE_OF_A_DOT * site.glide_slope_deg)),
            lateral_angle_deg: ahead.map(|distance| atan2(cross, distance).to_degrees()),
        }
    }
}
