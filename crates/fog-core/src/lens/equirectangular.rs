//! Images of longitude and latitude.

use crate::math;
use std::f64::consts::FRAC_PI_2;

/// Columns are longitudes, rows are latitudes, both evenly. The middle column looks forward, longitudes go to the right;
/// latitude 90° is up, the camera's −y.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Equirectangular {
    size: [f64; 2],
    /// Longitudes across the width, in radians.
    span: f64,
    /// Latitudes of the lower and the upper edge, in radians.
    latitudes: [f64; 2],
}

impl Equirectangular {
    /// An image of `width` × `height` pixels over `horizontal_fov_deg` of longitudes, above 0 up to 360, and over these
    /// latitudes, −90 to 90, lower first.
    #[must_use]
    pub fn new(width: u32, height: u32, horizontal_fov_deg: f64, latitudes_deg: [f64; 2]) -> Self {
        Self {
            size: [width, height].map(f64::from),
            span: horizontal_fov_deg.to_radians(),
            latitudes: latitudes_deg.map(f64::to_radians),
        }
    }

    /// Longitudes across the width in degrees.
    #[must_use]
    pub fn horizontal_fov_deg(&self) -> f64 {
        self.span.to_degrees()
    }

    /// Latitudes of the lower and the upper edge in degrees.
    #[must_use]
    pub fn latitudes_deg(&self) -> [f64; 2] {
        self.latitudes.map(f64::to_degrees)
    }

    /// Latitude of a row; `None` beyond the poles.
    fn latitude(&self, y: f64) -> Option<f64> {
        let [low, high] = self.latitudes;
        let latitude = high + (low - high) * (y / self.size[1]);
        (latitude.abs() <= FRAC_PI_2 * (1.0 + 1e-12)).then_some(latitude)
    }

    pub(super) fn direction(&self, x: f64, y: f64) -> Option<[f64; 3]> {
        let latitude = self.latitude(y)?;
        let longitude = (x / self.size[0] - 0.5) * self.span;
        let across = math::f64::cos(latitude);
        let (sin, cos) = (math::f64::sin(longitude), math::f64::cos(longitude));
        Some([across * sin, -math::f64::sin(latitude), across * cos])
    }

    pub(super) fn image_point(&self, [x, y, z]: [f64; 3]) -> Option<[f64; 2]> {
        let longitude = math::f64::atan2(x, z);
        let latitude = math::f64::atan2(-y, (x * x + z * z).sqrt());
        let [low, high] = self.latitudes;
        Some([(longitude / self.span + 0.5) * self.size[0], (high - latitude) / (high - low) * self.size[1]])
    }

    pub(super) fn solid_angle(&self, _: f64, y: f64) -> f64 {
        let Some(latitude) = self.latitude(y) else { return 0.0 };
        let [low, high] = self.latitudes;
        math::f64::cos(latitude).max(0.0) * self.span * (high - low) / (self.size[0] * self.size[1])
    }
}
