//! Lens and shutter of a frame's sensor.

use serde::Serialize;

/// Focal lengths and principal point in OpenCV's convention: pixel centres at integer coordinates.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct IntrinsicsSpec {
    /// Horizontal focal length in pixels, above 0 up to 1 000 000.
    pub fx_px: f64,
    /// Vertical focal length in pixels, above 0 up to 1 000 000.
    pub fy_px: f64,
    /// Column of the principal point, −1 000 000 to 1 000 000.
    pub cx_px: f64,
    /// Row of the principal point, −1 000 000 to 1 000 000.
    pub cy_px: f64,
}

/// How directions become image points.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum LensSpec {
    /// Straight lines stay straight.
    #[default]
    Pinhole,
    /// OpenCV's radial (k1 to k6) and tangential (p1, p2) distortion.
    Opencv {
        /// Numerator, r².
        k1: f64,
        /// Numerator, r⁴.
        k2: f64,
        /// Tangential.
        p1: f64,
        /// Tangential.
        p2: f64,
        /// Numerator, r⁶.
        k3: f64,
        /// Denominator, r².
        k4: f64,
        /// Denominator, r⁴.
        k5: f64,
        /// Denominator, r⁶.
        k6: f64,
    },
    /// OpenCV's fisheye.
    Fisheye {
        /// θ³.
        k1: f64,
        /// θ⁵.
        k2: f64,
        /// θ⁷.
        k3: f64,
        /// θ⁹.
        k4: f64,
        /// Full angle in degrees that the lens sees, above 0 up to 360; black beyond.
        field_of_view_deg: f64,
    },
    /// Columns are longitudes, rows latitudes.
    Equirectangular {
        /// Latitudes in degrees of the lower and the upper edge, −90 to 90.
        latitude_deg: [f64; 2],
    },
}

impl LensSpec {
    pub(crate) fn is_pinhole(&self) -> bool {
        *self == Self::Pinhole
    }
}

/// When the rows of an image are exposed; all at once where nothing is said.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum ShutterSpec {
    /// One after another from the top, while the camera moves on.
    Rolling {
        /// Seconds from the upper edge of the image to the lower, above 0 up to 1.
        readout_s: f64,
    },
}
