//! Rolling shutters: the camera moves on while the rows are exposed one after another.

use super::Pose;
use fog_core::{Vec3A, math};
use glam::{DMat3, DVec3};

/// Motion of a camera from the upper edge of its image to the lower: even, along a straight line and about one axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shutter {
    begin: Pose,
    shift: DVec3,
    /// Unit axis.
    axis: DVec3,
    /// In radians, −π to π.
    angle: f64,
}

impl Shutter {
    /// From `begin`, when the upper edge of the image is exposed, to `end`, when the lower is; less than half a turn apart.
    #[must_use]
    pub fn new(begin: Pose, end: Pose) -> Self {
        let turn = columns(&end) * columns(&begin).transpose();
        let twice = DVec3::new(
            turn.y_axis.z - turn.z_axis.y,
            turn.z_axis.x - turn.x_axis.z,
            turn.x_axis.y - turn.y_axis.x,
        );
        let trace = turn.x_axis.x + turn.y_axis.y + turn.z_axis.z;
        let angle = math::f64::atan2(0.5 * twice.length(), 0.5 * (trace - 1.0));
        let shift = end.position.as_dvec3() - begin.position.as_dvec3();
        Self { begin, shift, axis: twice.normalize_or(DVec3::Y), angle }
    }

    /// The pose when this share of the rows has been exposed, 0 to 1.
    #[must_use]
    pub fn pose(&self, share: f64) -> Pose {
        let angle = share * self.angle;
        let (sin, cos) = (math::f64::sin(angle), math::f64::cos(angle));
        // Rodrigues' rotation.
        let turn = |v: Vec3A| {
            let v = v.as_dvec3();
            let turned = v * cos + self.axis.cross(v) * sin + self.axis * (self.axis.dot(v) * (1.0 - cos));
            turned.as_vec3a()
        };
        Pose {
            position: (self.begin.position.as_dvec3() + share * self.shift).as_vec3a(),
            right: turn(self.begin.right),
            down: turn(self.begin.down),
            forward: turn(self.begin.forward),
        }
    }
}

fn columns(pose: &Pose) -> DMat3 {
    let [right, down, forward] = [pose.right, pose.down, pose.forward].map(|v| v.as_dvec3());
    DMat3::from_cols(right, down, forward)
}
