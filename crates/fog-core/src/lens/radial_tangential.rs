//! OpenCV's rational radial and tangential distortion.
//!
//! x' = x R + 2 p1 x y + p2 (r² + 2x²), y' = y R + p1 (r² + 2y²) + 2 p2 x y with x = X/Z, y = Y/Z, r² = x² + y² and
//! R = (1 + k1 r² + k2 r⁴ + k3 r⁶) / (1 + k4 r² + k5 r⁴ + k6 r⁶) (OpenCV 4 documentation, module calib3d, "Detailed
//! description"). Without a thin prism and a tilted sensor.

use super::error::LensError;
use super::monotone::{end_of_positive, invert};
use super::pinhole::{Intrinsics, Pinhole, of_plane};

/// Tangent of the widest angle from the axis that is looked at: 89.94 degrees.
const FARTHEST: f64 = 1e3;
/// Points of an edge of the grid on which the inverse is tried.
const GRID: u32 = 33;

/// The coefficients; all 0 is a pinhole camera.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Distortion {
    /// Radial, numerator first: k1, k2, k3, k4, k5, k6.
    pub k: [f64; 6],
    /// Tangential: p1, p2.
    pub p: [f64; 2],
}

/// A camera whose lens bends straight lines.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RadialTangential {
    pinhole: Pinhole,
    distortion: Distortion,
    /// Undistorted radius up to which the radial distortion grows.
    limit: f64,
}

impl Distortion {
    /// r R and its derivative after r.
    fn radial(&self, r: f64) -> [f64; 2] {
        let [n, dn, d, dd] = self.fraction(r * r);
        let s = r * r;
        [r * n / d, (n + 2.0 * s * (dn - n * dd / d)) / d]
    }

    /// Numerator and its derivative after s = r², denominator and its derivative.
    fn fraction(&self, s: f64) -> [f64; 4] {
        let [k1, k2, k3, k4, k5, k6] = self.k;
        let value = |a: f64, b: f64, c: f64| 1.0 + s * (a + s * (b + s * c));
        let slope = |a: f64, b: f64, c: f64| a + s * (2.0 * b + s * 3.0 * c);
        [value(k1, k2, k3), slope(k1, k2, k3), value(k4, k5, k6), slope(k4, k5, k6)]
    }

    /// The distorted point.
    fn apply(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let (s, [p1, p2]) = (x * x + y * y, self.p);
        let [n, _, d, _] = self.fraction(s);
        let radial = n / d;
        [
            x * radial + 2.0 * p1 * x * y + p2 * (s + 2.0 * x * x),
            y * radial + p1 * (s + 2.0 * y * y) + 2.0 * p2 * x * y,
        ]
    }

    /// Derivatives of the distorted point: ∂x'/∂x, ∂x'/∂y, ∂y'/∂x, ∂y'/∂y.
    fn derivatives(&self, [x, y]: [f64; 2]) -> [f64; 4] {
        let (s, [p1, p2]) = (x * x + y * y, self.p);
        let [n, dn, d, dd] = self.fraction(s);
        // dR/dx = 2x dR/ds.
        let (radial, slope) = (n / d, 2.0 * (dn - n * dd / d) / d);
        let mixed = slope * x * y + 2.0 * (p1 * x + p2 * y);
        [
            radial + slope * x * x + 2.0 * p1 * y + 6.0 * p2 * x,
            mixed,
            mixed,
            radial + slope * y * y + 6.0 * p1 * y + 2.0 * p2 * x,
        ]
    }

    /// Area of the distorted image over the area before.
    fn area(&self, point: [f64; 2]) -> f64 {
        let [a, b, c, d] = self.derivatives(point);
        a * d - b * c
    }
}

impl RadialTangential {
    /// A camera of `width` × `height` pixels.
    ///
    /// # Errors
    /// If the distortion folds inside the image: its radius stops growing, or it has no inverse somewhere.
    pub fn new(
        intrinsics: Intrinsics,
        distortion: Distortion,
        width: u32,
        height: u32,
    ) -> Result<Self, LensError> {
        let pinhole = Pinhole::new(intrinsics);
        // The sign of the derivative of r R, and the denominator.
        let grows = |r: f64| distortion.fraction(r * r)[2].min(distortion.radial(r)[1]);
        let fold = end_of_positive(FARTHEST, grows);
        let lens = Self { pinhole, distortion, limit: fold.unwrap_or(FARTHEST) };
        let corner = pinhole.farthest(width, height);
        if let Some(radius) = fold {
            let image = distortion.radial(radius)[0];
            if image < corner {
                return Err(LensError::Folds {
                    radius,
                    unit: "(tangent of the angle)",
                    image_radius_px: pinhole.radius_px(image),
                    corner_px: pinhole.radius_px(corner),
                });
            }
        }
        lens.try_inverse(width, height)?;
        Ok(lens)
    }

    /// Inverts on a grid over the image.
    fn try_inverse(&self, width: u32, height: u32) -> Result<(), LensError> {
        let at = |i: u32, size: u32| f64::from(i) / f64::from(GRID - 1) * f64::from(size);
        for (i, j) in (0..GRID).flat_map(|j| (0..GRID).map(move |i| (i, j))) {
            let (x, y) = (at(i, width), at(j, height));
            if self.direction(x, y).is_none() {
                let [u, v] = self.pinhole.normalised(x, y);
                let radius_px = self.pinhole.radius_px((u * u + v * v).sqrt());
                return Err(LensError::NoInverse { x, y, radius_px });
            }
        }
        Ok(())
    }

    /// Focal lengths and principal point.
    #[must_use]
    pub fn intrinsics(&self) -> Intrinsics {
        self.pinhole.intrinsics()
    }

    /// The coefficients.
    #[must_use]
    pub fn distortion(&self) -> Distortion {
        self.distortion
    }

    pub(super) fn direction(&self, x: f64, y: f64) -> Option<[f64; 3]> {
        let [u, v] = self.undistorted(self.pinhole.normalised(x, y))?;
        Some([u, v, 1.0])
    }

    /// The inverse of [`Distortion::apply`]: the radial part alone is inverted exactly, from there Newton's steps, halved where
    /// they lead away.
    fn undistorted(&self, wanted: [f64; 2]) -> Option<[f64; 2]> {
        let radius = (wanted[0] * wanted[0] + wanted[1] * wanted[1]).sqrt();
        let tangential = self.distortion.p != [0.0; 2];
        // Tangential distortion may move a point out of the radial part's reach: begin at its edge then.
        let reach = if tangential { radius.min(self.distortion.radial(self.limit)[0]) } else { radius };
        let r = invert(reach, self.limit, |r| self.distortion.radial(r))?;
        let scale = if radius > 0.0 { r / radius } else { 0.0 };
        let mut point = wanted.map(|c| c * scale);
        if !tangential {
            return Some(point);
        }
        let miss = |point: [f64; 2]| {
            let [x, y] = self.distortion.apply(point);
            [wanted[0] - x, wanted[1] - y]
        };
        let size = |[a, b]: [f64; 2]| a * a + b * b;
        let mut left = miss(point);
        for _ in 0..60 {
            if size(left) <= 1e-30 * (1.0 + radius * radius) {
                break;
            }
            let [a, b, c, d] = self.distortion.derivatives(point);
            let area = a * d - b * c;
            let step = [(d * left[0] - b * left[1]) / area, (a * left[1] - c * left[0]) / area];
            // The greatest share of the step that comes nearer.
            let nearer = (0..30).map(|half| 0.5f64.powi(half)).find_map(|share| {
                let next = [point[0] + share * step[0], point[1] + share * step[1]];
                let rest = miss(next);
                (size(rest) < size(left)).then_some((next, rest))
            });
            let Some((next, rest)) = nearer else { break };
            (point, left) = (next, rest);
        }
        let found = size(left) <= 1e-26 * (1.0 + radius * radius);
        let inside = size(point) <= self.limit * self.limit && self.distortion.area(point) > 0.0;
        (found && inside).then_some(point)
    }

    pub(super) fn image_point(&self, [x, y, z]: [f64; 3]) -> Option<[f64; 2]> {
        let point = [x / z, y / z];
        let seen = z > 0.0
            && point[0] * point[0] + point[1] * point[1] <= self.limit * self.limit
            && self.distortion.area(point) > 0.0;
        seen.then(|| self.pinhole.pixels(self.distortion.apply(point)))
    }

    pub(super) fn solid_angle(&self, x: f64, y: f64) -> f64 {
        let Some(point) = self.undistorted(self.pinhole.normalised(x, y)) else { return 0.0 };
        of_plane(point) / (self.pinhole.pixels_per_area() * self.distortion.area(point))
    }
}
