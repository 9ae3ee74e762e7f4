//! The pinhole camera.

use crate::math;

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

impl Intrinsics {
    /// Square pixels of this focal length and the principal point in the middle of the image.
    #[must_use]
    pub fn centred(focal_px: f64, width: u32, height: u32) -> Self {
        let middle = |size: u32| 0.5 * f64::from(size) - 0.5;
        Self { fx_px: focal_px, fy_px: focal_px, cx_px: middle(width), cy_px: middle(height) }
    }
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

    /// The image point with the principal point as origin, over the focal lengths: X/Z and Y/Z where nothing is distorted.
    #[inline]
    pub(super) fn normalised(&self, x: f64, y: f64) -> [f64; 2] {
        [(x - self.centre[0]) / self.focal[0], (y - self.centre[1]) / self.focal[1]]
    }

    /// The inverse of [`Pinhole::normalised`].
    #[inline]
    pub(super) fn pixels(&self, [u, v]: [f64; 2]) -> [f64; 2] {
        [self.focal[0] * u + self.centre[0], self.focal[1] * v + self.centre[1]]
    }

    /// Square pixels in the unit area of normalised coordinates.
    #[inline]
    pub(super) fn pixels_per_area(&self) -> f64 {
        self.focal[0] * self.focal[1]
    }

    /// Distance in pixels from the principal point of a normalised point at distance `radius`, with the geometric mean of the
    /// focal lengths.
    pub(super) fn radius_px(&self, radius: f64) -> f64 {
        radius * self.pixels_per_area().sqrt()
    }

    /// The normalised point of the image, of this width and height, that is farthest from the principal point: a corner.
    pub(super) fn farthest(&self, width: u32, height: u32) -> f64 {
        let (w, h) = (f64::from(width), f64::from(height));
        let corners = [[0.0, 0.0], [w, 0.0], [0.0, h], [w, h]];
        let radius = |[x, y]: [f64; 2]| {
            let [u, v] = self.normalised(x, y);
            (u * u + v * v).sqrt()
        };
        corners.map(radius).into_iter().fold(0.0, f64::max)
    }

    #[inline]
    pub(super) fn direction(&self, x: f64, y: f64) -> [f64; 3] {
        let [u, v] = self.normalised(x, y);
        [u, v, 1.0]
    }

    pub(super) fn image_point(&self, [x, y, z]: [f64; 3]) -> Option<[f64; 2]> {
        (z > 0.0).then(|| self.pixels([x / z, y / z]))
    }

    pub(super) fn solid_angle(&self, x: f64, y: f64) -> f64 {
        of_plane(self.normalised(x, y)) / self.pixels_per_area()
    }
}

/// Solid angle per area of the plane at distance 1: the third power of the cosine from the axis.
#[inline]
pub(super) fn of_plane([u, v]: [f64; 2]) -> f64 {
    let squared = 1.0 + u * u + v * v;
    1.0 / (squared * squared.sqrt())
}
