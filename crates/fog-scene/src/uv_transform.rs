//! Moving texture coordinates (`KHR_texture_transform`).

use fog_core::math;

/// An affine map of texture coordinates: scale, then rotation, then offset (`KHR_texture_transform`).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct UvTransform {
    /// Rows for u and v: factors of u and v, and what is added.
    rows: [[f32; 3]; 2],
}

impl UvTransform {
    /// `rotation` in radians turns the coordinates counter-clockwise as one looks at the image (v runs down), which turns
    /// the image clockwise.
    #[must_use]
    pub fn new(offset: [f32; 2], rotation: f32, scale: [f32; 2]) -> Self {
        let (s, c) = (math::f32::sin(rotation), math::f32::cos(rotation));
        Self { rows: [[c * scale[0], s * scale[1], offset[0]], [-s * scale[0], c * scale[1], offset[1]]] }
    }

    /// Its numbers' bits, to tell transforms apart.
    pub(crate) fn bits(&self) -> [u32; 6] {
        let [[a, b, c], [d, e, f]] = self.rows;
        [a, b, c, d, e, f].map(f32::to_bits)
    }

    /// The moved coordinates.
    #[inline]
    #[must_use]
    pub fn apply(&self, [u, v]: [f32; 2]) -> [f32; 2] {
        self.rows.map(|[a, b, c]| a * u + b * v + c)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn transforms_follow_the_extension() {
        // The example of the extension's text: the lower left quarter of the image, rotated by 90°.
        let quarter = UvTransform::new([0.0, 1.0], math::PI_F32 / 2.0, [0.5, 0.5]);
        for (uv, want) in [([0.0, 0.0], [0.0, 1.0]), ([1.0, 0.0], [0.0, 0.5]), ([0.0, 1.0], [0.5, 1.0])] {
            let got = quarter.apply(uv);
            assert!((got[0] - want[0]).abs() < 1e-6 && (got[1] - want[1]).abs() < 1e-6, "{uv:?}: {got:?}");
        }
        // And its other one: v counted from below.
        assert_eq!(UvTransform::new([0.0, 1.0], 0.0, [1.0, -1.0]).apply([0.25, 0.25]), [0.25, 0.75]);
    }
}
