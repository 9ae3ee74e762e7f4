//! Poses, and cameras mounted on a rig.

use fog_core::attitude::Attitude;
use serde::Serialize;

/// Where something is and how it is turned.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct PoseSpec {
    /// World position in metres.
    pub position_m: [f64; 3],
    /// Clockwise seen from above, in degrees: 0 looks along −Z, 90 along +X.
    pub heading_deg: f64,
    /// Upwards, in degrees.
    pub pitch_deg: f64,
    /// To the right, in degrees.
    pub roll_deg: f64,
}

/// A camera of a rig, of one frame.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct RigSpec {
    /// Name of the camera.
    pub camera: String,
    /// Pose of the camera in the rig: position in the rig's axes (x right, y down, z forward), angles relative to the rig's.
    pub mount: PoseSpec,
    /// Pose of the rig in the world.
    pub pose: PoseSpec,
}

impl PoseSpec {
    pub(crate) fn new(position_m: [f64; 3], [heading_deg, pitch_deg, roll_deg]: [f64; 3]) -> Self {
        Self { position_m, heading_deg, pitch_deg, roll_deg }
    }

    pub(crate) fn angles_deg(&self) -> [f64; 3] {
        [self.heading_deg, self.pitch_deg, self.roll_deg]
    }

    pub(crate) fn attitude(&self) -> Attitude {
        Attitude::from_angles_deg(self.angles_deg())
    }

    /// The pose in the world of something that has pose `mount` in this body.
    #[must_use]
    pub fn mounted(&self, mount: &Self) -> Self {
        let attitude = self.attitude();
        let offset = attitude.to_world(mount.position_m);
        let position = [0, 1, 2].map(|i| self.position_m[i] + offset[i]);
        // Angles as written stay as written.
        let angles = match mount.angles_deg() {
            [0.0, 0.0, 0.0] => self.angles_deg(),
            angles => attitude.mounted(angles).angles_deg(),
        };
        Self::new(position, angles)
    }

    /// The pose after `share` of the motion from `from` to `to`, begun here.
    #[must_use]
    pub fn moved(&self, from: &Self, to: &Self, share: f64) -> Self {
        let position =
            [0, 1, 2].map(|i| self.position_m[i] + share * (to.position_m[i] - from.position_m[i]));
        let angles = if from.angles_deg() == to.angles_deg() {
            self.angles_deg()
        } else {
            self.attitude().turned(&from.attitude(), &to.attitude(), share).angles_deg()
        };
        Self::new(position, angles)
    }
}
