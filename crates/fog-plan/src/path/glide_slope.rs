//! Landing approaches: along a glide path, or drawn from the cone of LARD.

use fog_core::math;

use super::{ApproachSpec, Path, PathPose, uniform};
use crate::rig::PoseSpec;

const NAUTICAL_MILE_M: f64 = 1852.0;

/// LARD's generic landing approach cone: distance in nautical miles, glide path angle, lateral deviation, yaw relative to the
/// runway, pitch and roll in degrees (Ducoffe et al. 2023, "LARD – Landing Approach Runway Detection", and the README of
/// github.com/deel-ai/LARD). There the values scatter about means; here they are uniform over these ranges. LARD does not say
/// which of its reference points each angle is seen from; here it is the aiming point.
const LARD: [[f64; 2]; 6] = [[0.08, 3.0], [2.2, 3.8], [-4.0, 4.0], [-10.0, 10.0], [-8.0, 0.0], [-10.0, 10.0]];

/// A runway and an approach to it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Approach {
    /// Middle of the threshold in the world.
    pub(crate) threshold_m: [f64; 3],
    /// Direction of landing.
    pub(crate) heading_deg: f64,
    /// Distance of the aiming point beyond the threshold.
    pub(crate) aiming_point_m: f64,
    /// Glide path angle.
    pub(crate) angle_deg: f64,
    pub(crate) lateral_deviation_deg: f64,
    pub(crate) vertical_deviation_deg: f64,
    /// Heading of the aircraft less that of the runway.
    pub(crate) crab_deg: f64,
    pub(crate) pitch_deg: f64,
    pub(crate) roll_deg: f64,
    pub(crate) dispersion: Option<Dispersion>,
}

/// Standard deviations of normal distributions.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Dispersion {
    pub(crate) lateral_deg: f64,
    pub(crate) vertical_deg: f64,
    pub(crate) heading_deg: f64,
    pub(crate) pitch_deg: f64,
    pub(crate) roll_deg: f64,
    pub(crate) seed: u64,
    /// Drawn anew for each pose; else once for the path.
    pub(crate) each_pose: bool,
}

/// Where the aircraft is relative to the runway, and how it is turned.
#[derive(Clone, Copy)]
struct State {
    along_m: f64,
    lateral_deg: f64,
    vertical_deg: f64,
    /// Relative to the runway.
    yaw_deg: f64,
    pitch_deg: f64,
    roll_deg: f64,
}

impl Approach {
    fn pose(&self, time_s: f64, state: &State) -> PathPose {
        let turn = |deg: f64| (math::f64::sin(deg.to_radians()), math::f64::cos(deg.to_radians()));
        let tan = |deg: f64| math::f64::tan(deg.to_radians());
        let (sin, cos) = turn(self.heading_deg);
        let (forward, right) = ([sin, -cos], [cos, sin]);
        let along = self.aiming_point_m - state.along_m;
        let across = state.along_m * tan(state.lateral_deg);
        let [x, y, z] = self.threshold_m;
        let position = [
            x + along * forward[0] + across * right[0],
            y + state.along_m * tan(state.vertical_deg),
            z + along * forward[1] + across * right[1],
        ];
        // Within what headings may be.
        let heading = self.heading_deg + state.yaw_deg;
        let heading = if heading.abs() > 360.0 { heading % 360.0 } else { heading };
        let pose = PoseSpec::new(position, [heading, state.pitch_deg, state.roll_deg]);
        let approach = ApproachSpec {
            along_track_m: state.along_m,
            lateral_deviation_deg: state.lateral_deg,
            vertical_angle_deg: state.vertical_deg,
        };
        PathPose { time_s, pose, approach: Some(approach) }
    }
}

/// Poses at these horizontal distances from the aiming point, flown at `speed_m_s` along the path.
pub(crate) fn glide(approach: &Approach, distances_m: &[f64], speed_m_s: f64) -> Path {
    let ground_speed = speed_m_s * math::f64::cos(approach.angle_deg.to_radians());
    let pose = |(i, &along_m): (usize, &f64)| {
        let sd = approach.dispersion;
        let draw = |dimension: usize, sd_of: fn(&Dispersion) -> f64| {
            sd.map_or(0.0, |d| sd_of(&d) * normal(d.seed, if d.each_pose { i } else { 0 }, dimension))
        };
        let state = State {
            along_m,
            lateral_deg: approach.lateral_deviation_deg + draw(0, |d| d.lateral_deg),
            vertical_deg: approach.angle_deg + approach.vertical_deviation_deg + draw(1, |d| d.vertical_deg),
            yaw_deg: approach.crab_deg + draw(2, |d| d.heading_deg),
            pitch_deg: approach.pitch_deg + draw(3, |d| d.pitch_deg),
            roll_deg: approach.roll_deg + draw(4, |d| d.roll_deg),
        };
        approach.pose((distances_m[0] - along_m) / ground_speed, &state)
    };
    Path { poses: distances_m.iter().enumerate().map(pose).collect(), moves: true }
}

/// Poses drawn evenly from LARD's cone, each for itself.
pub(crate) fn draw_lard(approach: &Approach, count: usize, seed: u64) -> Path {
    let pose = |i: usize| {
        let draw = |dimension: usize| {
            let [from, to] = LARD[dimension];
            from + (to - from) * uniform(seed, i, dimension)
        };
        let state = State {
            along_m: draw(0) * NAUTICAL_MILE_M,
            lateral_deg: draw(2),
            vertical_deg: draw(1),
            yaw_deg: draw(3),
            pitch_deg: draw(4),
            roll_deg: draw(5),
        };
        approach.pose(0.0, &state)
    };
    Path { poses: (0..count).map(pose).collect(), moves: false }
}

/// Standard normal number (Box & Muller 1958).
fn normal(seed: u64, index: usize, dimension: usize) -> f64 {
    let [u, v] = [0, 1].map(|k| uniform(seed, index, 2 * dimension + k + 64));
    let radius = (-2.0 * math::f64::ln(1.0 - u)).sqrt();
    radius * math::f64::cos(std::f64::consts::TAU * v)
}

#[cfg(test)]
mod tests {
    use super::*;

    const APPROACH: Approach = Approach {
        threshold_m: [10.0, 5.0, -20.0],
        heading_deg: 90.0,
        aiming_point_m: 300.0,
        angle_deg: 3.0,
        lateral_deviation_deg: 0.0,
        vertical_deviation_deg: 0.0,
        crab_deg: 0.0,
        pitch_deg: -3.0,
        roll_deg: 0.0,
        dispersion: None,
    };

    #[test]
    fn the_path_ends_at_the_aiming_point() {
        let path = glide(&APPROACH, &[3000.0, 60.0], 70.0);
        let [first, last] = [path.poses[0], path.poses[1]];
        // Landing eastwards: the threshold's x is 10, the aiming point's 310.
        let near = |a: f64, b: f64| (a - b).abs() < 1e-9;
        assert!(near(first.pose.position_m[0], 310.0 - 3000.0) && near(first.pose.position_m[2], -20.0));
        assert!(near(first.pose.position_m[1], 5.0 + 3000.0 * math::f64::tan(3.0f64.to_radians())));
        // 2940 m on the ground, along the path more.
        assert!(near(last.time_s, 2940.0 / math::f64::cos(3.0f64.to_radians()) / 70.0));
        let aside = glide(&Approach { lateral_deviation_deg: 2.0, ..APPROACH }, &[1000.0], 70.0);
        // Right of an eastward path is south, +Z.
        assert!(near(
            aside.poses[0].pose.position_m[2],
            -20.0 + 1000.0 * math::f64::tan(2.0f64.to_radians())
        ));
    }

    #[test]
    fn dispersion_has_its_standard_deviations() {
        let dispersion = Dispersion {
            lateral_deg: 0.5,
            vertical_deg: 0.2,
            heading_deg: 2.0,
            pitch_deg: 1.0,
            roll_deg: 3.0,
            seed: 4,
            each_pose: true,
        };
        let approach = Approach { dispersion: Some(dispersion), ..APPROACH };
        let distances: Vec<f64> = (0..10_000).map(|i| 3000.0 - 0.1 * f64::from(i)).collect();
        let path = glide(&approach, &distances, 70.0);
        let moments = |value: &dyn Fn(&PathPose) -> f64| {
            let n = path.poses.len() as f64;
            let mean = path.poses.iter().map(value).sum::<f64>() / n;
            (mean, (path.poses.iter().map(|p| (value(p) - mean).powi(2)).sum::<f64>() / n).sqrt())
        };
        let deviation = |p: &PathPose| p.approach.unwrap();
        for (value, mean, sd) in [
            (&(|p: &PathPose| deviation(p).lateral_deviation_deg) as &dyn Fn(&PathPose) -> f64, 0.0, 0.5),
            (&|p: &PathPose| deviation(p).vertical_angle_deg, 3.0, 0.2),
            (&|p: &PathPose| p.pose.heading_deg, 90.0, 2.0),
            (&|p: &PathPose| p.pose.pitch_deg, -3.0, 1.0),
            (&|p: &PathPose| p.pose.roll_deg, 0.0, 3.0),
        ] {
            let (found_mean, found_sd) = moments(value);
            // Five standard errors of 10 000 draws.
            assert!(
                (found_mean - mean).abs() < 0.05 * sd && (found_sd / sd - 1.0).abs() < 0.036,
                "{found_mean} {found_sd}"
            );
        }
        let once = Approach { dispersion: Some(Dispersion { each_pose: false, ..dispersion }), ..APPROACH };
        let path = glide(&once, &[3000.0, 2000.0], 70.0);
        assert_eq!(path.poses[0].pose.angles_deg(), path.poses[1].pose.angles_deg());
        assert_ne!(path.poses[0].pose.roll_deg, 0.0);
    }

    #[test]
    fn the_cone_of_lard() {
        let path = draw_lard(&APPROACH, 5000, 1);
        let range = |value: &dyn Fn(&PathPose) -> f64| {
            path.poses
                .iter()
                .map(value)
                .fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], v| [a.min(v), b.max(v)])
        };
        let spans = |[low, high]: [f64; 2], [from, to]: [f64; 2]| {
            let slack = 0.01 * (to - from);
            low >= from && low < from + slack && high <= to && high > to - slack
        };
        let approach = |p: &PathPose| p.approach.unwrap();
        assert!(spans(range(&|p| approach(p).along_track_m), [148.16, 5556.0]));
        assert!(spans(range(&|p| approach(p).vertical_angle_deg), [2.2, 3.8]));
        assert!(spans(range(&|p| approach(p).lateral_deviation_deg), [-4.0, 4.0]));
        assert!(spans(range(&|p| p.pose.heading_deg), [80.0, 100.0]));
        assert!(spans(range(&|p| p.pose.pitch_deg), [-8.0, 0.0]));
        assert!(spans(range(&|p| p.pose.roll_deg), [-10.0, 10.0]));
        assert!(!path.moves && path.after(0, 0.1).is_none());
    }
}
