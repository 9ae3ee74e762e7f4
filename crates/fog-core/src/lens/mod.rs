//! Lenses: which direction each image point shows, and where each direction is shown.
//!
//! Directions are in camera axes (x right, y down, z forward), of any length. Image points are in pixels, continuous, with
//! the origin at the top left corner of the top left pixel, so that a pixel's centre lies at + 0.5; [`Intrinsics`] are in
//! OpenCV's convention, where it lies at 0. All in f64; the inverses are exact to rounding.

mod equirectangular;
mod error;
mod fisheye;
mod monotone;
mod pinhole;
mod radial_tangential;

pub use equirectangular::Equirectangular;
pub use error::LensError;
pub use fisheye::Fisheye;
pub use pinhole::{Intrinsics, Pinhole};
pub use radial_tangential::{Distortion, RadialTangential};

/// How directions become image points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Lens {
    /// Straight lines stay straight.
    Pinhole(Pinhole),
    /// OpenCV's radial and tangential distortion.
    RadialTangential(RadialTangential),
    /// OpenCV's fisheye.
    Fisheye(Fisheye),
    /// Longitude and latitude.
    Equirectangular(Equirectangular),
}

impl Lens {
    /// Direction that the image point (x, y) shows, of any length; `None` where the lens shows nothing.
    #[inline]
    #[must_use]
    pub fn direction(&self, x: f64, y: f64) -> Option<[f64; 3]> {
        match self {
            Self::Pinhole(lens) => Some(lens.direction(x, y)),
            Self::RadialTangential(lens) => lens.direction(x, y),
            Self::Fisheye(lens) => lens.direction(x, y),
            Self::Equirectangular(lens) => lens.direction(x, y),
        }
    }

    /// Image point of a direction, of any length above 0: the inverse of [`Lens::direction`]. It may lie beside the image.
    /// `None` where the lens does not see the direction.
    #[must_use]
    pub fn image_point(&self, direction: [f64; 3]) -> Option<[f64; 2]> {
        match self {
            Self::Pinhole(lens) => lens.image_point(direction),
            Self::RadialTangential(lens) => lens.image_point(direction),
            Self::Fisheye(lens) => lens.image_point(direction),
            Self::Equirectangular(lens) => lens.image_point(direction),
        }
    }

    /// Solid angle in sr per square pixel at the image point (x, y); 0 where the lens shows nothing.
    #[must_use]
    pub fn solid_angle(&self, x: f64, y: f64) -> f64 {
        match self {
            Self::Pinhole(lens) => lens.solid_angle(x, y),
            Self::RadialTangential(lens) => lens.solid_angle(x, y),
            Self::Fisheye(lens) => lens.solid_angle(x, y),
            Self::Equirectangular(lens) => lens.solid_angle(x, y),
        }
    }

    /// Focal lengths and principal point; an equirectangular image has none.
    #[must_use]
    pub fn intrinsics(&self) -> Option<Intrinsics> {
        match self {
            Self::Pinhole(lens) => Some(lens.intrinsics()),
            Self::RadialTangential(lens) => Some(lens.intrinsics()),
            Self::Fisheye(lens) => Some(lens.intrinsics()),
            Self::Equirectangular(_) => None,
        }
    }
}

#[cfg(test)]
mod tests;
