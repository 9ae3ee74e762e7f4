//! Where a camera stands and how it is turned.

use fog_core::math;
use fog_core::{Mat4, Vec3A};

/// Where a camera stands and looks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose {
    /// World position in metres.
    pub position: Vec3A,
    /// Image x axis (right) in the world.
    pub right: Vec3A,
    /// Image y axis (down) in the world.
    pub down: Vec3A,
    /// Viewing direction in the world.
    pub forward: Vec3A,
}

impl Pose {
    /// Pose from aviation angles in degrees: heading clockwise seen from above (0 = −Z, 90 = +X), pitch up, roll to the
    /// right (right wing down).
    #[must_use]
    pub fn new(position: Vec3A, heading_deg: f64, pitch_deg: f64, roll_deg: f64) -> Self {
        let sin_cos = |deg: f64| {
            let r = deg.to_radians();
            (math::f64::sin(r) as f32, math::f64::cos(r) as f32)
        };
        let ((sh, ch), (sp, cp), (sr, cr)) = (sin_cos(heading_deg), sin_cos(pitch_deg), sin_cos(roll_deg));
        let level = Vec3A::new(sh, 0.0, -ch);
        let forward = cp * level + sp * Vec3A::Y;
        let right = Vec3A::new(ch, 0.0, sh);
        let up = cp * Vec3A::Y - sp * level;
        Self { position, right: cr * right - sr * up, down: -(cr * up + sr * right), forward }
    }

    /// 4×4 camera→world.
    #[must_use]
    pub fn world_from_camera(&self) -> Mat4 {
        Mat4::from_cols(
            self.right.extend(0.0),
            self.down.extend(0.0),
            self.forward.extend(0.0),
            self.position.extend(1.0),
        )
    }

    /// A direction in camera axes (x right, y down, z forward) as one of the world, of the same length.
    #[inline]
    #[must_use]
    pub fn to_world(&self, [x, y, z]: [f64; 3]) -> Vec3A {
        x as f32 * self.right + y as f32 * self.down + z as f32 * self.forward
    }

    /// A world point in camera axes, in metres from the camera.
    #[must_use]
    pub fn to_camera(&self, point: Vec3A) -> [f64; 3] {
        let from_here = point.as_dvec3() - self.position.as_dvec3();
        [self.right, self.down, self.forward].map(|axis| from_here.dot(axis.as_dvec3()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn close(a: Vec3A, b: Vec3A) {
        assert!((a - b).length() < 1e-6, "{a} {b}");
    }

    #[test]
    fn angles_turn_the_right_way() {
        let at = |h, p, r| Pose::new(Vec3A::ZERO, h, p, r);
        close(at(0.0, 0.0, 0.0).forward, -Vec3A::Z);
        close(at(0.0, 0.0, 0.0).right, Vec3A::X);
        close(at(0.0, 0.0, 0.0).down, -Vec3A::Y);
        close(at(90.0, 0.0, 0.0).forward, Vec3A::X);
        close(at(0.0, 90.0, 0.0).forward, Vec3A::Y);
        // Rolled right, the right wing points down.
        close(at(0.0, 0.0, 90.0).right, -Vec3A::Y);
        for pose in [at(33.0, -20.0, 10.0), at(200.0, 50.0, -70.0)] {
            close(pose.right.cross(pose.down), pose.forward);
        }
    }

    #[test]
    fn camera_axes_and_the_world_are_inverse() {
        let pose = Pose::new(Vec3A::new(3.0, 2.0, -7.0), 33.0, -20.0, 10.0);
        let point = pose.position + pose.to_world([0.3, -0.2, 4.0]);
        let back = pose.to_camera(point);
        assert!(back.iter().zip([0.3, -0.2, 4.0]).all(|(a, b)| (a - b).abs() < 2e-6), "{back:?}");
    }
}
