//! Cameras: where they stand, and which ray each point of their image sees.
//!
//! Poses are camera→world in OpenCV axes (x right, y down, z forward). Image coordinates are continuous with the origin
//! at the top left corner of the top left pixel, so a pixel's centre lies at + 0.5.

mod pose;

pub use pose::Pose;

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
}

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
        }
    }

    /// Ray through the image point (x, y) in pixels from the top left corner; `None` where the lens sees nothing.
    #[inline]
    #[must_use]
    pub fn ray(&self, x: f64, y: f64) -> Option<Ray> {
        let direction = self.lens.direction(x, y)?;
        Some(Ray { origin: self.pose.position, direction: self.pose.to_world(direction).normalize() })
    }

    /// Image point of a world point in pixels from the top left corner: the inverse of [`Camera::ray`]. `None` where the
    /// lens does not see the point, as behind a pinhole camera; points beside the image have image points
    /// ([`Camera::contains`] tells), and whether something stands in front of them is not asked.
    #[must_use]
    pub fn project(&self, point: Vec3A) -> Option<[f64; 2]> {
        self.lens.image_point(self.pose.to_camera(point))
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

    /// `depth` of a surface at `distance` metres along a ray of this camera: its planar depth along the camera's axis, below 0
    /// where a fisheye looks back; +inf where the distance is. Equirectangular images have no axis: there it is the distance.
    #[must_use]
    pub fn depth(&self, ray: &Ray, distance: f32) -> f32 {
        if distance == f32::INFINITY || matches!(self.lens, Lens::Equirectangular(_)) {
            return distance;
        }
        distance * ray.direction.dot(self.pose.forward)
    }
}

#[cfg(test)]
mod tests;
