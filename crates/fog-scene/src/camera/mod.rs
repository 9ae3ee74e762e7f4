//! Cameras: where they stand, and which ray each point of their image sees.
//!
//! Poses are camera→world in OpenCV axes (x right, y down, z forward). Image coordinates are continuous with the origin
//! at the top left corner of the top left pixel, so a pixel's centre lies at + 0.5.

mod pose;
mod shutter;

pub use pose::Pose;
pub use shutter::Shutter;

use fog_core::Vec3A;
use fog_core::lens::{Lens, Pinhole};

/// A ray with a direction of unit length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// Start.
    pub origin: Vec3A,
    /// Unit direction of travel.
    pub direction: Vec3A,
}

/// A camera: a pose, an image and a lens.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// Where it stands and looks.
    pub pose: Pose,
    /// Image width in pixels.
    pub width: u32,
    /// Image height in pixels.
    pub height: u32,
    /// Which direction each image point sees.
    pub lens: Lens,
    /// How it moves on while its rows are exposed one after another; none: all are exposed at once, from `pose`.
    pub shutter: Option<Shutter>,
}

/// Times that the row of a point seen by a rolling shutter is asked for anew.
const ROW_STEPS: usize = 50;

impl Camera {
    /// Pinhole camera with square pixels, the principal point in the middle and `horizontal_fov_deg` in (0, 180) across the
    /// image's width.
    #[must_use]
    pub fn new(pose: Pose, width: u32, height: u32, horizontal_fov_deg: f64) -> Self {
        Self {
            pose,
            width,
            height,
            lens: Lens::Pinhole(Pinhole::from_fov(width, height, horizontal_fov_deg)),
            shutter: None,
        }
    }

    /// The camera's pose when the rows at y pixels from the image's upper edge are exposed.
    #[inline]
    #[must_use]
    pub fn pose_at(&self, y: f64) -> Pose {
        let Some(shutter) = &self.shutter else { return self.pose };
        shutter.pose((y / f64::from(self.height)).clamp(0.0, 1.0))
    }

    /// Ray through the image point (x, y) in pixels from the top left corner; `None` where the lens sees nothing.
    #[inline]
    #[must_use]
    pub fn ray(&self, x: f64, y: f64) -> Option<Ray> {
        let direction = self.lens.direction(x, y)?;
        let pose = self.pose_at(y);
        Some(Ray { origin: pose.position, direction: pose.to_world(direction).normalize() })
    }

    /// Image point of a world point in pixels from the top left corner: the inverse of [`Camera::ray`]. `None` where the
    /// lens does not see the point, as behind a pinhole camera; points beside the image have image points
    /// ([`Camera::contains`] tells), and whether something stands in front of them is not asked. With a rolling shutter the
    /// row that sees the point is found step by step; a point that outruns the rows may be missed.
    #[must_use]
    pub fn project(&self, point: Vec3A) -> Option<[f64; 2]> {
        let seen_from = |pose: Pose| self.lens.image_point(pose.to_camera(point));
        if self.shutter.is_none() {
            return seen_from(self.pose);
        }
        let mut at = seen_from(self.pose_at(0.5 * f64::from(self.height)))?;
        for _ in 0..ROW_STEPS {
            let next = seen_from(self.pose_at(at[1]))?;
            let step = (next[1] - at[1]).abs();
            at = next;
            if step < 1e-9 {
                break;
            }
        }
        Some(at)
    }

    /// True if the image point lies in the image.
    #[must_use]
    pub fn contains(&self, [x, y]: [f64; 2]) -> bool {
        (0.0..f64::from(self.width)).contains(&x) && (0.0..f64::from(self.height)).contains(&y)
    }

    /// Solid angle in sr that a square of one pixel's size around the image point (x, y) sees, to first order in its size: the
    /// density of directions there. 0 where the lens sees nothing.
    #[must_use]
    pub fn pixel_solid_angle(&self, x: f64, y: f64) -> f64 {
        self.lens.solid_angle(x, y)
    }

    /// `depth` of a surface at `distance` metres along the ray of an image point: its planar depth along the camera's axis,
    /// below 0 where a fisheye looks back; +inf where the distance is, NaN where the lens sees nothing. Equirectangular images
    /// have no axis: there it is the distance.
    #[must_use]
    pub fn depth(&self, x: f64, y: f64, distance: f32) -> f32 {
        if distance == f32::INFINITY || matches!(self.lens, Lens::Equirectangular(_)) {
            return distance;
        }
        let Some([x, y, z]) = self.lens.direction(x, y) else { return f32::NAN };
        (f64::from(distance) * z / (x * x + y * y + z * z).sqrt()) as f32
    }
}

#[cfg(test)]
mod tests;
