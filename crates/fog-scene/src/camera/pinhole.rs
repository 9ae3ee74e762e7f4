//! Pinhole cameras.

use fog_core::math;

/// Focal lengths and principal point in OpenCV's convention: pixel centres at integer coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Intrinsics {
    /// Horizontal focal length in pixels, above 0.
    pub fx_px: f64,
    /// Vertical focal length in pixels, above 0.
    pub fy_px: f64,
    /// Column of the principal point.
    pub cx_px: f64,
    /// Row of the principal point.
    pub cy_px: f64,
}

/// The central projection x = fx·X/Z + cx, y = fy·Y/Z + cy.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pinhole {
    focal: [f64; 2],
    /// From the top left corner of the image.
    centre: [f64; 2],
}

impl Pinhole {
    /// Square pixels, the principal point in the middle and `horizontal_fov_deg` in (0, 180) across the image's width.
    #[must_use]
    pub fn from_fov(width: u32, height: u32, horizontal_fov_deg: f64) -> Self {
        let half = math::f64::tan((0.5 * horizontal_fov_deg).to_radians());
        let (width, height) = (f64::from(width), f64::from(height));
        Self { focal: [0.5 * width / half; 2], centre: [0.5 * width, 0.5 * height] }
    }

    /// With these focal lengths, above 0, and principal point.
    #[must_use]
    pub fn new(intrinsics: Intrinsics) -> Self {
        let Intrinsics { fx_px, fy_px, cx_px, cy_px } = intrinsics;
        Self { focal: [fx_px, fy_px], centre: [cx_px + 0.5, cy_px + 0.5] }
    }

    /// Focal lengths and principal point.
    #[must_use]
    pub fn intrinsics(&self) -> Intrinsics {
        let ([fx_px, fy_px], [cx, cy]) = (self.focal, self.centre);
        Intrinsics { fx_px, fy_px, cx_px: cx - 0.5, cy_px: cy - 0.5 }
    }

    /// X/Z and Y/Z of an image point.
    #[inline]
    pub(super) fn normalised(&self, x: f64, y: f64) -> [f64; 2] {
        [(x - self.centre[0]) / self.focal[0], (y - self.centre[1]) / self.focal[1]]
    }

    /// Image point of X/Z and Y/Z.
    #[inline]
    pub(super) fn image_point(&self, [u, v]: [f64; 2]) -> [f64; 2] {
        [self.focal[0] * u + self.centre[0], self.focal[1] * v + self.centre[1]]
    }

    #[inline]
    pub(super) fn direction(&self, x: f64, y: f64) -> [f64; 3] {
        let [u, v] = self.normalised(x, y);
        [u, v, 1.0]
    }

    pub(super) fn project(&self, [x, y, z]: [f64; 3]) -> Option<[f64; 2]> {
        (z > 0.0).then(|| self.image_point([x / z, y / z]))
    }

    pub(super) fn pixel_solid_angle(&self, x: f64, y: f64) -> f64 {
        let [u, v] = self.normalised(x, y);
        let squared = 1.0 + u * u + v * v;
        1.0 / (self.focal[0] * self.focal[1] * squared * squared.sqrt())
    }
}
