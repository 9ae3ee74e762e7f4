//! Lenses that are none.

use thiserror::Error;

/// Coefficients whose distortion does not grow outwards over the whole image: two directions would share an image point.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
pub enum LensError {
    /// The distorted radius stops growing inside the image.
    #[error(
        "the distortion folds back at {radius:.4} {unit} from the axis, where the image radius is {image_radius_px:.1} px: \
         inside the image, whose farthest corner is {corner_px:.1} px from the principal point"
    )]
    Folds {
        /// Where, as `unit` says.
        radius: f64,
        /// `(tangent of the angle)` or `degrees`.
        unit: &'static str,
        /// Distance from the principal point in pixels, in the mean of both focal lengths.
        image_radius_px: f64,
        /// Distance of the farthest corner of the image in pixels.
        corner_px: f64,
    },
    /// Radial and tangential distortion together have no inverse at a place of the image.
    #[error(
        "the distortion has no inverse at image point ({x:.1}, {y:.1}) px, {radius_px:.1} px from the principal point"
    )]
    NoInverse {
        /// Column in pixels.
        x: f64,
        /// Row in pixels.
        y: f64,
        /// Distance from the principal point in pixels.
        radius_px: f64,
    },
}
