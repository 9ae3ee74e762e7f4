//! Rolling shutters: the camera moves on while the rows are exposed one after another.

use super::Pose;
use fog_core::Vec3A;
use fog_core::attitude::{Attitude, Turn};
use glam::DVec3;

/// Motion of a camera from the upper edge of its image to the lower: even, along a straight line and about one axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shutter {
    begin: Pose,
    shift: DVec3,
    turn: Turn,
}

impl Shutter {
    /// From `begin`, when the upper edge of the image is exposed, to `end`, when the lower is; less than half a turn apart.
    #[must_use]
    pub fn new(begin: Pose, end: Pose) -> Self {
        let shift = end.position.as_dvec3() - begin.position.as_dvec3();
        Self { begin, shift, turn: Turn::between(&attitude(&begin), &attitude(&end)) }
    }

    /// The pose when this share of the rows has been exposed, 0 to 1.
    #[must_use]
    pub fn pose(&self, share: f64) -> Pose {
        let matrix = self.turn.matrix(share);
        let turn = |v: Vec3A| (matrix * v.as_dvec3()).as_vec3a();
        Pose {
            position: (self.begin.position.as_dvec3() + share * self.shift).as_vec3a(),
            right: turn(self.begin.right),
            down: turn(self.begin.down),
            forward: turn(self.begin.forward),
        }
    }
}

fn attitude(pose: &Pose) -> Attitude {
    Attitude::from_columns([pose.right, pose.down, pose.forward].map(|v| v.as_dvec3().to_array()))
}
