//! Exposure of the image plane.

use serde::Serialize;

/// What the values of a picture are multiplied with before its white is 1.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(untagged)]
pub enum ExposureSpec {
    /// This factor, above 0.
    Factor(f64),
    /// The factor that makes a percentile of the frame's luminances the target.
    Automatic {
        /// Share of the pixels that are darker, 0 to 1.
        percentile: f64,
        /// What their upper end becomes, above 0; 1 is white.
        target: f64,
    },
    /// A photographer's: white is what saturates at this ISO speed.
    Photographic {
        /// Saturation-based ISO speed (ISO 12232), 1 to 10 000 000.
        iso: f64,
        /// Time that the shutter is open, in s, 1e-6 to 3600.
        shutter_s: f64,
        /// Focal length over the diameter of the entrance pupil, 0.5 to 128.
        f_number: f64,
        /// Share of the light that the lens lets through, above 0 up to 1.
        lens_transmission: f64,
    },
}
