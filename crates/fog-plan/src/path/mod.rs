//! Paths: the poses of a camera or a rig over time, of which each makes a frame.

mod csv;
mod curve;
mod glide_slope;
mod travel;

pub(crate) use csv::CsvFiles;
pub(crate) use glide_slope::{Approach, Dispersion, draw_lard, glide};
pub(crate) use travel::{Travel, travel};

use crate::{draws, frame::CameraSpec, rig::PoseSpec};
use serde::Serialize;

/// Most poses of a path.
pub(crate) const MAX_POSES: usize = 1_000_000;

/// A pose of a path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct PathPose {
    pub(crate) time_s: f64,
    pub(crate) pose: PoseSpec,
    pub(crate) approach: Option<ApproachSpec>,
}

/// Poses in the order of time; at least one.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Path {
    pub(crate) poses: Vec<PathPose>,
    /// Whether the poses are of one motion; else each stands for itself.
    pub(crate) moves: bool,
}

/// Where on its path a frame is.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct PathSpec {
    /// Position among the path's poses, from 0.
    pub index: usize,
    /// Time in seconds, of the upper edge of the image where rows are read one after another.
    pub time_s: f64,
    /// Position relative to the runway; only of a glide slope, and else not written.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub approach: Option<ApproachSpec>,
    /// The same camera at the path's next pose. Absent, and then not written, at the end and where poses are of no one motion.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub next: Option<NextSpec>,
}

/// A camera at the next pose of its path.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct NextSpec {
    /// Time in seconds.
    pub time_s: f64,
    /// Pose of the camera.
    pub camera: CameraSpec,
    /// As [`crate::FrameSpec::readout_end`].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub readout_end: Option<CameraSpec>,
}

/// Where an aircraft is on its approach.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct ApproachSpec {
    /// Horizontal distance before the aiming point along the runway's centre line, in metres.
    pub along_track_m: f64,
    /// Angle to the right of the extended centre line at the aiming point, in the horizontal plane, in degrees.
    pub lateral_deviation_deg: f64,
    /// Elevation above the aiming point in the vertical plane of the centre line, in degrees.
    pub vertical_angle_deg: f64,
}

impl Path {
    /// The pose after `seconds` of the motion at pose `index`: towards the next, at the end on from the one before. `None` if
    /// nothing moves.
    pub(crate) fn after(&self, index: usize, seconds: f64) -> Option<PoseSpec> {
        if !self.moves || self.poses.len() < 2 {
            return None;
        }
        let first = index.min(self.poses.len() - 2);
        let (from, to) = (&self.poses[first], &self.poses[first + 1]);
        let share = seconds / (to.time_s - from.time_s);
        Some(self.poses[index].pose.moved(&from.pose, &to.pose, share))
    }
}

/// Uniform number in [0, 1) of a seed, a pose and a dimension.
pub(crate) fn uniform(seed: u64, index: usize, dimension: usize) -> f64 {
    draws::uniform(seed ^ 0x7061_7468, index, dimension)
}
