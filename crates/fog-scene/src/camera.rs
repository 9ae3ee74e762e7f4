//! Pinhole cameras.
//!
//! Poses are camera→world in OpenCV axes (x right, y down, z forward). Image coordinates are continuous with the origin
//! at the top left corner of the top left pixel, so a pixel's centre lies at + 0.5.

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
}

/// A pinhole camera with square pixels and its principal point in the middle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// Where it stands and looks.
    pub pose: Pose,
    /// Image width in pixels.
    pub width: u32,
    /// Image height in pixels.
    pub height: u32,
    focal_px: f64,
}

/// A ray with a direction of unit length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// Start.
    pub origin: Vec3A,
    /// Unit direction of travel.
    pub direction: Vec3A,
}

impl Camera {
    /// Camera with `horizontal_fov_deg` in (0, 180) across the image's width.
    #[must_use]
    pub fn new(pose: Pose, width: u32, height: u32, horizontal_fov_deg: f64) -> Self {
        let half = math::f64::tan((0.5 * horizontal_fov_deg).to_radians());
        Self { pose, width, height, focal_px: 0.5 * f64::from(width) / half }
    }

    /// Focal length in pixels.
    #[must_use]
    pub fn focal_px(&self) -> f64 {
        self.focal_px
    }

    /// Ray through the image point (x, y) in pixels from the top left corner.
    #[inline]
    #[must_use]
    pub fn ray(&self, x: f64, y: f64) -> Ray {
        let u = ((x - 0.5 * f64::from(self.width)) / self.focal_px) as f32;
        let v = ((y - 0.5 * f64::from(self.height)) / self.focal_px) as f32;
        let p = &self.pose;
        Ray { origin: p.position, direction: (u * p.right + v * p.down + p.forward).normalize() }
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
    fn field_of_view_spans_the_width() {
        let c = Camera::new(Pose::new(Vec3A::ZERO, 0.0, 0.0, 0.0), 320, 180, 60.0);
        let left = c.ray(0.0, 90.0).direction;
        let right = c.ray(320.0, 90.0).direction;
        assert!((left.dot(right) - 0.5).abs() < 1e-6);
        assert!(left.x < 0.0 && c.ray(160.0, 0.0).direction.y > 0.0);
        close(c.ray(160.0, 90.0).direction, -Vec3A::Z);
    }
}
