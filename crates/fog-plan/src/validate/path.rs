//! Checks of `path`.

use std::sync::Arc;

use fog_core::attitude::Attitude;

use super::Check;
use crate::{
    path::{MAX_POSES, Path, PathPose, Travel, travel},
    ranges::{self, Range},
    rig::PoseSpec,
    schema::{DriveFile, LineFile, LookFile, PathFile, PathPoseFile},
};

/// Height of a driver's eyes, or of a camera behind the windscreen, where a drive does not say.
const EYE_HEIGHT_M: f64 = 1.2;

impl Check<'_> {
    /// The poses of a path.
    pub(super) fn path(&mut self, file: &PathFile) -> Option<Arc<Path>> {
        let kinds = [
            ("poses", file.poses.is_some()),
            ("csv", file.csv.is_some()),
            ("waypoints", file.waypoints.is_some()),
            ("drive", file.drive.is_some()),
            ("glide_slope", file.glide_slope.is_some()),
        ];
        let given: Vec<&str> = kinds.iter().filter(|(_, is)| *is).map(|(name, _)| *name).collect();
        if given.len() != 1 {
            let all = kinds.map(|(name, _)| name).join(", ");
            let found = if given.is_empty() { "none".to_owned() } else { given.join(" and ") };
            if !(given.is_empty() && self.dropped.iter().any(|path| path[0] == "path")) {
                self.problem("path", format!("expected one of {all}; found {found}"));
            }
            return None;
        }
        if given[0] != "waypoints" {
            let stray = [
                ("speed_m_s", file.speed_m_s.is_some()),
                ("rate_hz", file.rate_hz.is_some()),
                ("look", file.look.is_some()),
                ("line", file.line.is_some()),
            ];
            if let Some((key, _)) = stray.iter().find(|(_, is)| *is) {
                self.problem(&format!("path.{key}"), format!("belongs to waypoints, not to {}", given[0]));
                return None;
            }
        }
        let moving = |poses| Arc::new(Path { poses, moves: true });
        if let Some(poses) = &file.poses {
            return self.poses(poses).map(moving);
        }
        if let Some(csv) = &file.csv {
            let read = self.files.path(csv.as_ref());
            return read.map_err(|message| self.problem("path.csv", message)).ok();
        }
        if let Some(points) = &file.waypoints {
            return self.waypoints(file, points).map(moving);
        }
        if let Some(drive) = &file.drive {
            return self.drive(drive).map(moving);
        }
        self.glide_slope(file.glide_slope.as_ref()?).map(Arc::new)
    }

    fn poses(&mut self, files: &[PathPoseFile]) -> Option<Vec<PathPose>> {
        if files.is_empty() || files.len() > MAX_POSES {
            self.problem("path.poses", format!("{} poses; valid: 1 to {MAX_POSES}", files.len()));
            return None;
        }
        let timed = files.iter().filter(|pose| pose.time_s.is_some()).count();
        let mut poses: Vec<PathPose> = Vec::with_capacity(files.len());
        for (i, file) in files.iter().enumerate() {
            let path = format!("path.poses.{i}");
            if timed > 0 && file.time_s.is_none() {
                self.problem(&path, "time_s is missing; either all poses have it or none");
                return None;
            }
            let time =
                self.range(&format!("{path}.time_s"), file.time_s.unwrap_or(i as f64), ranges::TIME_S)?;
            let pose = self.pose(&path, file)?;
            if let Some(last) = poses.last().filter(|last| last.time_s >= time) {
                let message = format!("{time} s does not come after {} s of the pose before", last.time_s);
                self.problem(&format!("{path}.time_s"), message);
                return None;
            }
            poses.push(PathPose { time_s: time, pose, approach: None });
        }
        Some(poses)
    }

    fn pose(&mut self, path: &str, file: &PathPoseFile) -> Option<PoseSpec> {
        let position_path = format!("{path}.position_m");
        let position =
            self.required(&position_path, file.position_m, "world position [x, y, z] in metres")?;
        self.point(&position_path, &position)?;
        let angles = [file.heading_deg, file.pitch_deg, file.roll_deg];
        if let Some(quaternion) = file.quaternion_wxyz {
            let path = format!("{path}.quaternion_wxyz");
            if angles.iter().any(Option::is_some) {
                self.problem(&path, "give angles or a quaternion, not both");
                return None;
            }
            let Some(attitude) = Attitude::from_quaternion_wxyz(quaternion) else {
                self.problem(&path, "all 0 is no rotation");
                return None;
            };
            return Some(PoseSpec::new(position, attitude.angles_deg()));
        }
        let [heading, pitch, roll] = angles.map(|angle| angle.unwrap_or(0.0));
        let heading = self.range(&format!("{path}.heading_deg"), heading, ranges::HEADING_DEG);
        let pitch = self.range(&format!("{path}.pitch_deg"), pitch, ranges::PITCH_DEG);
        let roll = self.range(&format!("{path}.roll_deg"), roll, ranges::ROLL_DEG);
        Some(PoseSpec::new(position, [heading?, pitch?, roll?]))
    }

    /// Coordinates within the range of positions.
    pub(super) fn point<const N: usize>(&mut self, path: &str, point: &[f64; N]) -> Option<()> {
        for (i, c) in point.iter().enumerate() {
            self.range(&format!("{path}.{i}"), *c, ranges::POSITION_M)?;
        }
        Some(())
    }

    /// A line of points: at least two, none equal to the next.
    fn line<const N: usize>(&mut self, path: &str, points: &[[f64; N]]) -> Option<()> {
        if !(2..=10_000).contains(&points.len()) {
            let is = if points.len() == 1 { "point" } else { "points" };
            self.problem(path, format!("{} {is}; valid: 2 to 10000", points.len()));
            return None;
        }
        for (i, point) in points.iter().enumerate() {
            self.point(&format!("{path}.{i}"), point)?;
            if i > 0 && *point == points[i - 1] {
                self.problem(&format!("{path}.{i}"), "the same as the point before");
                return None;
            }
        }
        Some(())
    }

    fn waypoints(&mut self, file: &PathFile, points: &[[f64; 3]]) -> Option<Vec<PathPose>> {
        let line = self.line("path.waypoints", points);
        let speed = self.needed("path.speed_m_s", file.speed_m_s, ranges::SPEED_M_S, "speed along the curve");
        let rate = self.needed("path.rate_hz", file.rate_hz, ranges::RATE_HZ, "poses per second");
        line?;
        let along = file.look != Some(LookFile::Level);
        let straight = file.line == Some(LineFile::Straight);
        let how =
            Travel { straight, speed_m_s: speed?, rate_hz: rate?, offset_m: 0.0, along, pitch_deg: 0.0 };
        self.travelled("path.waypoints", points, &how)
    }

    fn drive(&mut self, file: &DriveFile) -> Option<Vec<PathPose>> {
        let points =
            self.required("path.drive.points", file.points.as_ref(), "world points [x, z] in metres");
        let line = points.and_then(|points| self.line("path.drive.points", points));
        let speed = self.needed("path.drive.speed_m_s", file.speed_m_s, ranges::SPEED_M_S, "speed");
        let rate = self.needed("path.drive.rate_hz", file.rate_hz, ranges::RATE_HZ, "poses per second");
        let mut or = |key: &str, value: Option<f64>, default: f64, range: Range| {
            self.range(&format!("path.drive.{key}"), value.unwrap_or(default), range)
        };
        let eye = or("eye_height_m", file.eye_height_m, EYE_HEIGHT_M, ranges::EYE_HEIGHT_M);
        let ground = or("ground_m", file.ground_m, 0.0, ranges::DATUM_M);
        let offset_m = or("lane_offset_m", file.lane_offset_m, 0.0, ranges::LANE_OFFSET_M);
        let pitch_deg = or("pitch_deg", file.pitch_deg, 0.0, ranges::PITCH_DEG);
        line?;
        let y = ground? + eye?;
        let points: Vec<[f64; 3]> = points?.iter().map(|[x, z]| [*x, y, *z]).collect();
        let how = Travel {
            straight: file.line == Some(LineFile::Straight),
            speed_m_s: speed?,
            rate_hz: rate?,
            offset_m: offset_m?,
            along: false,
            pitch_deg: pitch_deg?,
        };
        self.travelled("path.drive.points", &points, &how)
    }

    fn travelled(&mut self, path: &str, points: &[[f64; 3]], how: &Travel) -> Option<Vec<PathPose>> {
        let straight: f64 = points.windows(2).map(|p| length(p[0], p[1])).sum();
        // The curve is a little longer than the straight lines.
        let count = 2.0 * straight / how.speed_m_s * how.rate_hz;
        if count > MAX_POSES as f64 {
            self.problem(path, format!("more than {MAX_POSES} poses at this speed and rate"));
            return None;
        }
        Some(travel(points, how))
    }
}

fn length(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).map(|i| (a[i] - b[i]) * (a[i] - b[i])).sum::<f64>().sqrt()
}
