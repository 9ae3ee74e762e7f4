//! Travelling along a line through points at an even speed.

use fog_core::math;

use super::{PathPose, curve::Curve};
use crate::rig::PoseSpec;

/// How a line is travelled.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Travel {
    /// Whether straight lines join the points; else a smooth curve does.
    pub(crate) straight: bool,
    /// Along the line, in m/s, above 0.
    pub(crate) speed_m_s: f64,
    /// Poses per second, above 0.
    pub(crate) rate_hz: f64,
    /// To the right of the line, horizontally.
    pub(crate) offset_m: f64,
    /// Whether the pitch follows the line; else it is level.
    pub(crate) along: bool,
    /// Added to the pitch.
    pub(crate) pitch_deg: f64,
}

/// Poses from the first point to the last; at least two points, no two in a row equal. The heading is that of the line.
pub(crate) fn travel(points: &[[f64; 3]], travel: &Travel) -> Vec<PathPose> {
    let curve = if travel.straight { Curve::straight(points) } else { Curve::through(points) };
    let step = travel.speed_m_s / travel.rate_hz;
    // Rounding must not lose the end.
    let steps = (curve.length() / step * (1.0 + 1e-9)).floor() as usize;
    let mut heading_deg = 0.0;
    (0..=steps)
        .map(|i| {
            let [point, [x, y, z]] = curve.at((i as f64 * step).min(curve.length()));
            let level = (x * x + z * z).sqrt();
            // On a vertical line the heading stays what it was.
            if level > 1e-9 {
                heading_deg = math::f64::atan2(x, -z).to_degrees();
            }
            let heading = f64::to_radians(heading_deg);
            let (right_x, right_z) = (math::f64::cos(heading), math::f64::sin(heading));
            let slope = if travel.along { math::f64::atan2(y, level).to_degrees() } else { 0.0 };
            let position =
                [point[0] + travel.offset_m * right_x, point[1], point[2] + travel.offset_m * right_z];
            let pitch = (slope + travel.pitch_deg).clamp(-90.0, 90.0);
            let angles = [heading_deg, pitch, 0.0].map(|a| (a * 1e12).round() / 1e12 + 0.0);
            let pose = PoseSpec::new(position, angles);
            PathPose { time_s: i as f64 / travel.rate_hz, pose, approach: None }
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const TRAVEL: Travel =
        Travel { straight: false, speed_m_s: 5.0, rate_hz: 2.0, offset_m: 0.0, along: true, pitch_deg: 0.0 };

    #[test]
    fn time_speed_and_heading() {
        let poses = travel(&[[0.0, 1.0, 0.0], [10.0, 1.0, 0.0]], &TRAVEL);
        let times: Vec<f64> = poses.iter().map(|p| p.time_s).collect();
        assert_eq!(times, [0.0, 0.5, 1.0, 1.5, 2.0]);
        assert!((poses[3].pose.position_m[0] - 7.5).abs() < 1e-12);
        assert!(poses.iter().all(|p| p.pose.angles_deg() == [90.0, 0.0, 0.0]));
    }

    #[test]
    fn lanes_lie_to_the_right_and_slopes_pitch() {
        let north = [[0.0, 0.0, 0.0], [0.0, 0.0, -20.0]];
        let poses = travel(&north, &Travel { offset_m: 1.75, pitch_deg: -2.0, ..TRAVEL });
        assert_eq!(poses[0].pose, PoseSpec::new([1.75, 0.0, 0.0], [0.0, -2.0, 0.0]));
        let climb = [[0.0, 0.0, 0.0], [10.0, 10.0, 0.0]];
        assert!((travel(&climb, &TRAVEL)[2].pose.pitch_deg - 45.0).abs() < 1e-9);
        assert_eq!(travel(&climb, &Travel { along: false, ..TRAVEL })[2].pose.pitch_deg, 0.0);
    }

    #[test]
    fn straight_lines_turn_at_their_points() {
        let corner = [[0.0, 0.0, 0.0], [0.0, 0.0, -10.0], [10.0, 0.0, -10.0]];
        let poses = travel(&corner, &Travel { straight: true, ..TRAVEL });
        let places: Vec<_> =
            poses.iter().map(|p| p.pose.position_m.map(|c| (c * 1e9).round() / 1e9)).collect();
        assert_eq!(places.len(), 9);
        assert_eq!(
            (places[3], places[4], places[5]),
            ([0.0, 0.0, -7.5], [0.0, 0.0, -10.0], [2.5, 0.0, -10.0])
        );
        let headings: Vec<f64> = poses.iter().map(|p| p.pose.heading_deg).collect();
        assert_eq!(headings, [0.0, 0.0, 0.0, 0.0, 90.0, 90.0, 90.0, 90.0, 90.0]);
        // The curve through the same points leaves the lines.
        assert!(travel(&corner, &TRAVEL).iter().any(|p| p.pose.position_m[0] < -0.1));
    }
}
