//! OpenCV's fisheye (Kannala & Brandt 2006).
//!
//! A direction at the angle θ from the axis is shown at the distance θd = θ (1 + k1 θ² + k2 θ⁴ + k3 θ⁶ + k4 θ⁸) from the
//! principal point, in focal lengths (OpenCV 4 documentation, module calib3d, "Fisheye camera model"). OpenCV goes up to 90
//! degrees, here θ goes on to 180.

use super::error::LensError;
use super::monotone::{end_of_positive, invert};
use super::pinhole::{Intrinsics, Pinhole};
use crate::math;
use std::f64::consts::PI;

/// A fisheye camera. All coefficients 0: equidistant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fisheye {
    pinhole: Pinhole,
    k: [f64; 4],
    /// Greatest angle from the axis in radians, up to which θd grows.
    limit: f64,
}

/// θd and its derivative.
fn distorted(k: [f64; 4], theta: f64) -> [f64; 2] {
    let s = theta * theta;
    let [k1, k2, k3, k4] = k;
    [
        theta * (1.0 + s * (k1 + s * (k2 + s * (k3 + s * k4)))),
        1.0 + s * (3.0 * k1 + s * (5.0 * k2 + s * (7.0 * k3 + s * 9.0 * k4))),
    ]
}

impl Fisheye {
    /// A camera of `width` × `height` pixels with coefficients k1 to k4 that sees `field_of_view_deg`, above 0 up to 360: half
    /// of it on each side of the axis. The image is black beyond.
    ///
    /// # Errors
    /// If the distortion folds within the field of view and inside the image.
    pub fn new(
        intrinsics: Intrinsics,
        k: [f64; 4],
        field_of_view_deg: f64,
        width: u32,
        height: u32,
    ) -> Result<Self, LensError> {
        let pinhole = Pinhole::new(intrinsics);
        let edge = (0.5 * field_of_view_deg).to_radians().min(PI);
        let fold = end_of_positive(edge, |theta| distorted(k, theta)[1]);
        if let Some(theta) = fold {
            let (image, corner) = (distorted(k, theta)[0], pinhole.farthest(width, height));
            if image < corner {
                return Err(LensError::Folds {
                    radius: theta.to_degrees(),
                    unit: "degrees",
                    image_radius_px: pinhole.radius_px(image),
                    corner_px: pinhole.radius_px(corner),
                });
            }
        }
        Ok(Self { pinhole, k, limit: fold.unwrap_or(edge) })
    }

    /// Focal lengths and principal point.
    #[must_use]
    pub fn intrinsics(&self) -> Intrinsics {
        self.pinhole.intrinsics()
    }

    /// Coefficients k1 to k4.
    #[must_use]
    pub fn coefficients(&self) -> [f64; 4] {
        self.k
    }

    /// Angle in degrees from the axis up to which the lens sees.
    #[must_use]
    pub fn limit_deg(&self) -> f64 {
        self.limit.to_degrees()
    }

    /// Angle from the axis of a normalised image point at distance `radius`.
    fn angle(&self, radius: f64) -> Option<f64> {
        invert(radius, self.limit, |theta| distorted(self.k, theta))
    }

    pub(super) fn direction(&self, x: f64, y: f64) -> Option<[f64; 3]> {
        let [u, v] = self.pinhole.normalised(x, y);
        let radius = (u * u + v * v).sqrt();
        let theta = self.angle(radius)?;
        let across = if radius > 0.0 { math::f64::sin(theta) / radius } else { 1.0 };
        Some([u * across, v * across, math::f64::cos(theta)])
    }

    pub(super) fn image_point(&self, [x, y, z]: [f64; 3]) -> Option<[f64; 2]> {
        let across = (x * x + y * y).sqrt();
        let theta = math::f64::atan2(across, z);
        if theta > self.limit {
            return None;
        }
        // Near the axis θd/across is 1/z.
        let scale = if across > 0.0 { distorted(self.k, theta)[0] / across } else { 0.0 };
        Some(self.pinhole.pixels([x * scale, y * scale]))
    }

    pub(super) fn solid_angle(&self, x: f64, y: f64) -> f64 {
        let [u, v] = self.pinhole.normalised(x, y);
        let radius = (u * u + v * v).sqrt();
        let Some(theta) = self.angle(radius) else { return 0.0 };
        // sin θ dθ dφ over ρ dρ dφ.
        let ring = if radius > 0.0 { math::f64::sin(theta) / radius } else { 1.0 };
        ring / (distorted(self.k, theta)[1] * self.pinhole.pixels_per_area())
    }
}
