//! Sections `path` and `cameras`, and key `sensor.shutter`.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize, de::IgnoredAny};

use super::camera::SensorFile;
use crate::ranges;

/// The poses of the camera, or of the rig, over time: each makes a frame. One of `poses`, `csv`, `waypoints`, `drive` and
/// `glide_slope`.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema, Serialize)]
#[serde(default, deny_unknown_fields)]
#[schemars(rename = "Path", extend("minProperties" = 1))]
pub(crate) struct PathFile {
    /// Poses one by one.
    #[schemars(length(min = 1, max = 1_000_000))]
    pub(crate) poses: Option<Vec<PathPoseFile>>,
    /// A CSV file, relative to the current folder: columns time_s, x_m, y_m, z_m, and heading_deg, pitch_deg, roll_deg or the
    /// quaternion qw, qx, qy, qz from camera axes (x right, y down, z forward) to the world.
    pub(crate) csv: Option<String>,
    /// World points x, y, z in metres; a smooth curve goes through them, or straight lines (`line`).
    #[schemars(length(min = 2, max = 10_000))]
    pub(crate) waypoints: Option<Vec<[f64; 3]>>,
    /// With `waypoints`: speed along the curve in m/s.
    #[schemars(extend("exclusiveMinimum" = 0), range(max = ranges::SPEED_M_S.max))]
    pub(crate) speed_m_s: Option<f64>,
    /// With `waypoints`: poses per second.
    #[schemars(extend("exclusiveMinimum" = 0), range(max = ranges::RATE_HZ.max))]
    pub(crate) rate_hz: Option<f64>,
    /// With `waypoints`: `along` pitches with the curve, `level` does not. Absent: along.
    pub(crate) look: Option<LookFile>,
    /// With `waypoints`: a smooth `curve` through them, or `straight` lines from each to the next. Absent: curve.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) line: Option<LineFile>,
    /// Along a road.
    pub(crate) drive: Option<DriveFile>,
    /// A landing approach.
    pub(crate) glide_slope: Option<GlideSlopeFile>,
}

/// A pose of a list.
#[derive(Clone, Copy, Debug, Default, Deserialize, JsonSchema, Serialize)]
#[serde(default, deny_unknown_fields)]
#[schemars(rename = "PathPose", extend("required" = ["position_m"]))]
pub(crate) struct PathPoseFile {
    /// Seconds, each later than the one before. Absent, in all of them: one second apart.
    #[schemars(range(min = ranges::TIME_S.min, max = ranges::TIME_S.max))]
    pub(crate) time_s: Option<f64>,
    /// World position x, y, z in metres.
    #[schemars(inner(range(min = ranges::POSITION_M.min, max = ranges::POSITION_M.max)))]
    pub(crate) position_m: Option<[f64; 3]>,
    /// Clockwise seen from above, in degrees. Absent: 0, as the other angles.
    #[schemars(range(min = ranges::HEADING_DEG.min, max = ranges::HEADING_DEG.max))]
    pub(crate) heading_deg: Option<f64>,
    /// Upwards, in degrees.
    #[schemars(range(min = ranges::PITCH_DEG.min, max = ranges::PITCH_DEG.max))]
    pub(crate) pitch_deg: Option<f64>,
    /// To the right, in degrees.
    #[schemars(range(min = ranges::ROLL_DEG.min, max = ranges::ROLL_DEG.max))]
    pub(crate) roll_deg: Option<f64>,
    /// Instead of angles: quaternion w, x, y, z from camera axes (x right, y down, z forward) to the world.
    pub(crate) quaternion_wxyz: Option<[f64; 4]>,
}

/// Where a path through points looks.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
#[schemars(rename = "Look")]
pub(crate) enum LookFile {
    /// Heading and pitch of the curve.
    Along,
    /// Its heading, without pitch.
    Level,
}

/// How points are joined.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
#[schemars(rename = "Line")]
pub(crate) enum LineFile {
    /// By a smooth curve: centripetal Catmull–Rom.
    Curve,
    /// By straight lines; the heading changes at once where two meet.
    Straight,
}

/// A drive along a line on the ground.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema, Serialize)]
#[serde(default, deny_unknown_fields)]
#[schemars(rename = "Drive", extend("required" = ["points", "speed_m_s", "rate_hz"]))]
pub(crate) struct DriveFile {
    /// World points x, z in metres; a smooth curve goes through them, or straight lines (`line`).
    #[schemars(length(min = 2, max = 10_000))]
    pub(crate) points: Option<Vec<[f64; 2]>>,
    /// A smooth `curve` through the points, or `straight` lines from each to the next. Absent: curve.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) line: Option<LineFile>,
    /// Speed along the line in m/s.
    #[schemars(extend("exclusiveMinimum" = 0), range(max = ranges::SPEED_M_S.max))]
    pub(crate) speed_m_s: Option<f64>,
    /// Poses per second.
    #[schemars(extend("exclusiveMinimum" = 0), range(max = ranges::RATE_HZ.max))]
    pub(crate) rate_hz: Option<f64>,
    /// Height above the ground in metres. Absent: 1.2.
    #[schemars(range(min = ranges::EYE_HEIGHT_M.min, max = ranges::EYE_HEIGHT_M.max))]
    pub(crate) eye_height_m: Option<f64>,
    /// World height of the ground in metres, the same everywhere. Absent: 0.
    #[schemars(range(min = ranges::DATUM_M.min, max = ranges::DATUM_M.max))]
    pub(crate) ground_m: Option<f64>,
    /// Distance to the right of the line in metres. Absent: 0.
    #[schemars(range(min = ranges::LANE_OFFSET_M.min, max = ranges::LANE_OFFSET_M.max))]
    pub(crate) lane_offset_m: Option<f64>,
    /// Upwards, in degrees. Absent: 0.
    #[schemars(range(min = ranges::PITCH_DEG.min, max = ranges::PITCH_DEG.max))]
    pub(crate) pitch_deg: Option<f64>,
}

/// A landing approach: from `from_m` to `to_m` in steps, or poses drawn from LARD's cone.
#[derive(Clone, Copy, Debug, Default, Deserialize, JsonSchema, Serialize)]
#[serde(default, deny_unknown_fields)]
#[schemars(rename = "GlideSlope")]
pub(crate) struct GlideSlopeFile {
    /// Angle of the glide path in degrees. Absent: 3.
    #[schemars(range(min = ranges::GLIDE_ANGLE_DEG.min, max = ranges::GLIDE_ANGLE_DEG.max))]
    pub(crate) angle_deg: Option<f64>,
    /// First horizontal distance from the aiming point along the centre line, in metres.
    #[schemars(extend("exclusiveMinimum" = 0), range(max = ranges::ALONG_TRACK_M.max))]
    pub(crate) from_m: Option<f64>,
    /// Last one, at most.
    #[schemars(extend("exclusiveMinimum" = 0), range(max = ranges::ALONG_TRACK_M.max))]
    pub(crate) to_m: Option<f64>,
    /// Distance from pose to pose in metres. Instead: `count` or `rate_hz`.
    #[schemars(extend("exclusiveMinimum" = 0), range(max = ranges::ALONG_TRACK_M.max))]
    pub(crate) step_m: Option<f64>,
    /// Number of poses, both ends included.
    #[schemars(range(min = 2, max = 1_000_000))]
    pub(crate) count: Option<i64>,
    /// Poses per second.
    #[schemars(extend("exclusiveMinimum" = 0), range(max = ranges::RATE_HZ.max))]
    pub(crate) rate_hz: Option<f64>,
    /// Speed along the path in m/s. Absent: 70.
    #[schemars(extend("exclusiveMinimum" = 0), range(max = ranges::SPEED_M_S.max))]
    pub(crate) speed_m_s: Option<f64>,
    /// Middle of the runway's threshold in the world. Absent: [0, 0, 0].
    #[schemars(inner(range(min = ranges::POSITION_M.min, max = ranges::POSITION_M.max)))]
    pub(crate) threshold_m: Option<[f64; 3]>,
    /// Direction of landing in degrees. Absent: 0, along −Z.
    #[schemars(range(min = ranges::HEADING_DEG.min, max = ranges::HEADING_DEG.max))]
    pub(crate) heading_deg: Option<f64>,
    /// Distance of the aiming point beyond the threshold in metres. Absent: 311, as the runway scene has it.
    #[schemars(range(min = ranges::AIMING_POINT_M.min, max = ranges::AIMING_POINT_M.max))]
    pub(crate) aiming_point_m: Option<f64>,
    /// Angle to the right of the extended centre line, seen from the aiming point, in degrees. Absent: 0.
    #[schemars(range(min = ranges::DEVIATION_DEG.min, max = ranges::DEVIATION_DEG.max))]
    pub(crate) lateral_deviation_deg: Option<f64>,
    /// Angle above the glide path, seen from the aiming point, in degrees. Absent: 0.
    #[schemars(range(min = ranges::DEVIATION_DEG.min, max = ranges::DEVIATION_DEG.max))]
    pub(crate) vertical_deviation_deg: Option<f64>,
    /// Pitch in degrees. Absent: minus the angle of the glide path, so that the view is along it.
    #[schemars(range(min = ranges::PITCH_DEG.min, max = ranges::PITCH_DEG.max))]
    pub(crate) pitch_deg: Option<f64>,
    /// Heading of the aircraft less that of the runway, in degrees. Absent: 0.
    #[schemars(range(min = ranges::CRAB_DEG.min, max = ranges::CRAB_DEG.max))]
    pub(crate) crab_deg: Option<f64>,
    /// Roll in degrees. Absent: 0.
    #[schemars(range(min = ranges::ROLL_DEG.min, max = ranges::ROLL_DEG.max))]
    pub(crate) roll_deg: Option<f64>,
    /// Scatter about all that.
    pub(crate) dispersion: Option<DispersionFile>,
    /// Poses drawn evenly from LARD's approach cone (Ducoffe et al. 2023), each for itself: 0.08 to 3 nautical miles, 2.2 to
    /// 3.8 degrees up, 4 to each side, yaw 10 to each side, pitch −8 to 0, roll 10 to each side.
    pub(crate) lard: Option<LardFile>,
}

/// Standard deviations of normal distributions, in degrees; absent ones are 0.
#[derive(Clone, Copy, Debug, Default, Deserialize, JsonSchema, Serialize)]
#[serde(default, deny_unknown_fields)]
#[schemars(rename = "Dispersion")]
pub(crate) struct DispersionFile {
    /// Of the lateral deviation.
    #[schemars(range(min = ranges::SPREAD_DEG.min, max = ranges::SPREAD_DEG.max))]
    pub(crate) lateral_deg: f64,
    /// Of the vertical deviation.
    #[schemars(range(min = ranges::SPREAD_DEG.min, max = ranges::SPREAD_DEG.max))]
    pub(crate) vertical_deg: f64,
    /// Of the heading.
    #[schemars(range(min = ranges::SPREAD_DEG.min, max = ranges::SPREAD_DEG.max))]
    pub(crate) heading_deg: f64,
    /// Of the pitch.
    #[schemars(range(min = ranges::SPREAD_DEG.min, max = ranges::SPREAD_DEG.max))]
    pub(crate) pitch_deg: f64,
    /// Of the roll.
    #[schemars(range(min = ranges::SPREAD_DEG.min, max = ranges::SPREAD_DEG.max))]
    pub(crate) roll_deg: f64,
    /// Seed of the draws. Absent: 1.
    pub(crate) seed: Option<u64>,
    /// `pose`: drawn anew for each pose; `path`: once for the path. Absent: pose.
    pub(crate) each: Option<EachFile>,
}

/// For what a dispersion is drawn.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
#[schemars(rename = "Each")]
pub(crate) enum EachFile {
    /// For each pose.
    Pose,
    /// Once.
    Path,
}

/// How many poses of LARD's cone, and which.
#[derive(Clone, Copy, Debug, Default, Deserialize, JsonSchema, Serialize)]
#[serde(default, deny_unknown_fields)]
#[schemars(rename = "Lard", extend("required" = ["count"]))]
pub(crate) struct LardFile {
    /// Number of poses.
    #[schemars(range(min = 1, max = 1_000_000))]
    pub(crate) count: Option<i64>,
    /// Seed of the draws. Absent: 1.
    pub(crate) seed: Option<u64>,
}

/// A camera of the rig.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema, Serialize)]
#[serde(default, deny_unknown_fields)]
#[schemars(rename = "RigCamera")]
pub(crate) struct RigCameraFile {
    /// Position in the rig in metres: x right, y down, z forward.
    #[schemars(inner(range(min = ranges::MOUNT_M.min, max = ranges::MOUNT_M.max)))]
    pub(crate) position_m: [f64; 3],
    /// To the right of the rig's heading, in degrees.
    #[schemars(range(min = ranges::HEADING_DEG.min, max = ranges::HEADING_DEG.max))]
    pub(crate) heading_deg: f64,
    /// Upwards, in degrees.
    #[schemars(range(min = ranges::PITCH_DEG.min, max = ranges::PITCH_DEG.max))]
    pub(crate) pitch_deg: f64,
    /// To the right, in degrees.
    #[schemars(range(min = ranges::ROLL_DEG.min, max = ranges::ROLL_DEG.max))]
    pub(crate) roll_deg: f64,
    /// Keys of `sensor` that are other for this camera.
    #[schemars(with = "Option<SensorFile>")]
    #[serde(skip_serializing)]
    pub(crate) sensor: Option<IgnoredAny>,
}

/// When the rows of an image are exposed.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(rename_all = "snake_case")]
#[schemars(rename = "Shutter")]
pub(crate) enum ShutterFile {
    /// All at once.
    Global,
    /// One after another, from the top.
    Rolling(RollingFile),
}

/// A rolling shutter.
#[derive(Clone, Copy, Debug, Default, Deserialize, JsonSchema, Serialize)]
#[serde(default, deny_unknown_fields)]
#[schemars(rename = "RollingShutter", extend("required" = ["readout_s"]))]
pub(crate) struct RollingFile {
    /// Seconds from the upper edge of the image to the lower.
    #[schemars(extend("exclusiveMinimum" = 0), range(max = ranges::READOUT_S.max))]
    pub(crate) readout_s: Option<f64>,
}
