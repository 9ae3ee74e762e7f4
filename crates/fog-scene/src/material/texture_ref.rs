//! Which texture a material reads, and where.

use crate::texture::Texture;
use fog_core::math;

/// A texture of the scene and the coordinates that it is read with.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TextureRef {
    /// Index into the scene's textures.
    pub texture: u32,
    /// 0 or 1: `TEXCOORD_0` or `TEXCOORD_1`.
    pub set: u8,
    /// Moves the coordinates first (`KHR_texture_transform`).
    pub transform: Option<UvTransform>,
}

impl TextureRef {
    /// The texture read at the coordinates of set 0 or 1 as they are.
    #[must_use]
    pub fn new(texture: u32, set: u8) -> Self {
        Self { texture, set, transform: None }
    }

    /// Coordinates at which the texture is read, of a point that has these in its two sets.
    #[inline]
    #[must_use]
    pub fn coordinates(&self, uv: &[[f32; 2]; 2]) -> [f32; 2] {
        let uv = uv[usize::from(self.set & 1)];
        self.transform.map_or(uv, |transform| transform.apply(uv))
    }

    /// Linear RGBA; `None` if `textures` has no such texture.
    #[must_use]
    pub fn sample(&self, textures: &[Texture], uv: &[[f32; 2]; 2]) -> Option<[f32; 4]> {
        Some(textures.get(self.texture as usize)?.sample(self.coordinates(uv)))
    }
}

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

    #[test]
    fn the_set_is_chosen_before_the_transform() {
        let uv = [[0.1, 0.2], [0.5, 0.25]];
        assert_eq!(TextureRef::new(0, 1).coordinates(&uv), uv[1]);
        let moved = TextureRef {
            transform: Some(UvTransform::new([1.0, 0.0], 0.0, [2.0, 2.0])),
            ..TextureRef::new(0, 1)
        };
        assert_eq!(moved.coordinates(&uv), [2.0, 0.5]);
        assert_eq!(moved.sample(&[], &uv), None);
    }
}
