//! Images of 8 bits a channel, looked up as glTF's samplers do at their finest level.

use crate::uv_transform::UvTransform;
use std::sync::Arc;

/// What the bytes of a texture's colour channels mean; alpha is always linear.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Encoding {
    /// sRGB transfer function: base colour and emission.
    Srgb,
    /// Byte / 255: roughness and metalness.
    Linear,
}

/// How coordinates outside [0, 1] are read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Wrap {
    /// The image again.
    Repeat,
    /// The image again, every other one mirrored.
    Mirror,
    /// The texel at the border.
    Clamp,
}

/// How texels are read between their centres.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Filter {
    /// The texel around the point.
    Nearest,
    /// The four texels around the point, mixed after decoding.
    Bilinear,
}

/// A decoded image.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Image {
    width: u32,
    height: u32,
    texels: Vec<[u8; 4]>,
}

impl Image {
    /// An image of `texels` in rows from the top; `None` if their number is not `width × height`, or 0.
    #[must_use]
    pub fn new(width: u32, height: u32, texels: Vec<[u8; 4]>) -> Option<Self> {
        let whole = (width as usize).checked_mul(height as usize) == Some(texels.len());
        (whole && !texels.is_empty()).then_some(Self { width, height, texels })
    }

    /// Width and height in texels.
    #[must_use]
    pub fn size(&self) -> [u32; 2] {
        [self.width, self.height]
    }

    /// Rows of RGBA texels from the top.
    #[must_use]
    pub fn texels(&self) -> &[[u8; 4]] {
        &self.texels
    }
}

/// An image with its sampler and the place of the texture in it.
#[derive(Clone, Debug)]
pub struct Texture {
    image: Arc<Image>,
    filter: Filter,
    wrap: [Wrap; 2],
    decode: Arc<[f32; 256]>,
    transform: Option<UvTransform>,
}

impl Texture {
    /// A texture that reads `image` with these settings; `wrap` for u and v.
    #[must_use]
    pub fn new(image: Arc<Image>, encoding: Encoding, filter: Filter, wrap: [Wrap; 2]) -> Self {
        let decode = core::array::from_fn(|byte| {
            let x = byte as f32 / 255.0;
            if encoding == Encoding::Srgb { fog_core::colour::srgb_decode(x) } else { x }
        });
        Self { image, filter, wrap, decode: Arc::new(decode), transform: None }
    }

    /// The same texture read at other coordinates.
    #[must_use]
    pub fn moved(self, transform: UvTransform) -> Self {
        Self { transform: Some(transform), ..self }
    }

    /// Coordinates in the image of texture coordinates.
    #[inline]
    #[must_use]
    pub fn image_coordinates(&self, uv: [f32; 2]) -> [f32; 2] {
        self.transform.map_or(uv, |transform| transform.apply(uv))
    }

    /// The image behind the sampler.
    #[must_use]
    pub fn image(&self) -> &Image {
        &self.image
    }

    /// How texels are read between their centres.
    #[must_use]
    pub fn filter(&self) -> Filter {
        self.filter
    }

    /// Linear RGBA in [0, 1] at texture coordinates; (0, 0) is the upper left corner of the image, v runs down.
    #[must_use]
    pub fn sample(&self, uv: [f32; 2]) -> [f32; 4] {
        let uv = self.image_coordinates(uv);
        let size = self.image.size();
        let inside: [f32; 2] = core::array::from_fn(|i| self.wrap[i].reduce(uv[i]) * size[i] as f32);
        match self.filter {
            Filter::Nearest => self.decoded(core::array::from_fn(|i| (inside[i] as u32).min(size[i] - 1))),
            Filter::Bilinear => {
                let lower: [f32; 2] = core::array::from_fn(|i| (inside[i] - 0.5).floor());
                let weight: [f32; 2] = core::array::from_fn(|i| inside[i] - 0.5 - lower[i]);
                let texel = |dx: i64, dy: i64| {
                    let offset = [dx, dy];
                    self.decoded(core::array::from_fn(|i| {
                        self.wrap[i].neighbour(lower[i] as i64 + offset[i], size[i])
                    }))
                };
                let mix =
                    |a: [f32; 4], b: [f32; 4], t: f32| core::array::from_fn(|c| a[c] + (b[c] - a[c]) * t);
                let upper = mix(texel(0, 0), texel(1, 0), weight[0]);
                let under = mix(texel(0, 1), texel(1, 1), weight[0]);
                mix(upper, under, weight[1])
            }
        }
    }

    fn decoded(&self, [x, y]: [u32; 2]) -> [f32; 4] {
        let index = y as usize * self.image.width as usize + x as usize;
        let [r, g, b, a] = self.image.texels[index];
        let colour = |byte: u8| self.decode[byte as usize];
        [colour(r), colour(g), colour(b), f32::from(a) / 255.0]
    }
}

impl Wrap {
    /// Brings a coordinate into [0, 1]; what is not finite becomes 0.
    fn reduce(self, x: f32) -> f32 {
        let x = if x.is_finite() { x } else { 0.0 };
        match self {
            Self::Repeat => x - x.floor(),
            Self::Mirror => {
                let pair = x - 2.0 * (x * 0.5).floor();
                if pair > 1.0 { 2.0 - pair } else { pair }
            }
            Self::Clamp => x.clamp(0.0, 1.0),
        }
    }

    /// The texel that stands for one at most one step outside of the image.
    fn neighbour(self, i: i64, size: u32) -> u32 {
        let size = i64::from(size);
        let inside = match self {
            Self::Repeat => i.rem_euclid(size),
            Self::Mirror | Self::Clamp => i.clamp(0, size - 1),
        };
        inside as u32
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ramp(filter: Filter, wrap: Wrap) -> Texture {
        let texels = vec![[0, 0, 0, 255], [255, 0, 0, 0], [0, 51, 0, 255], [0, 0, 188, 255]];
        let image = Image::new(2, 2, texels).unwrap();
        Texture::new(Arc::new(image), Encoding::Linear, filter, [wrap; 2])
    }

    #[test]
    fn nearest_reads_rows_from_the_top() {
        let t = ramp(Filter::Nearest, Wrap::Clamp);
        assert_eq!(t.sample([0.75, 0.25]), [1.0, 0.0, 0.0, 0.0]);
        assert_eq!(t.sample([0.25, 0.75]), [0.0, 0.2, 0.0, 1.0]);
        assert_eq!(t.sample([-7.0, 9.0]), [0.0, 0.2, 0.0, 1.0]);
        assert_eq!(t.sample([f32::NAN, f32::INFINITY]), [0.0, 0.0, 0.0, 1.0]);
    }

    #[test]
    fn wraps_repeat_and_mirror() {
        let repeat = ramp(Filter::Nearest, Wrap::Repeat);
        assert_eq!(repeat.sample([-0.25, 3.25])[0], 1.0);
        assert_eq!(repeat.sample([1.25, 0.25])[0], 0.0);
        let mirror = ramp(Filter::Nearest, Wrap::Mirror);
        assert_eq!(mirror.sample([1.25, 0.25])[0], 1.0);
        assert_eq!(mirror.sample([-0.25, 0.25])[0], 0.0);
        assert_eq!(mirror.sample([-1e-12, 1.0])[1], 0.2);
    }

    #[test]
    fn bilinear_mixes_decoded_texels() {
        let t = ramp(Filter::Bilinear, Wrap::Clamp);
        assert!((t.sample([0.5, 0.25])[0] - 0.5).abs() < 1e-6);
        assert!((t.sample([0.5, 0.5])[0] - 0.25).abs() < 1e-6);
        assert_eq!(t.sample([0.0, 0.25])[0], 0.0);
        let repeat = ramp(Filter::Bilinear, Wrap::Repeat);
        assert!((repeat.sample([0.0, 0.25])[0] - 0.5).abs() < 1e-6);
        assert!((repeat.sample([1.0, 0.25])[0] - 0.5).abs() < 1e-6);
    }

    #[test]
    fn srgb_is_decoded_and_alpha_is_not() {
        let image = Arc::new(Image::new(1, 1, vec![[188, 255, 0, 128]]).unwrap());
        let t = Texture::new(image, Encoding::Srgb, Filter::Nearest, [Wrap::Repeat; 2]);
        let [r, g, b, a] = t.sample([0.3, 0.3]);
        assert!((r - 0.502_886).abs() < 1e-4 && g == 1.0 && b == 0.0 && (a - 128.0 / 255.0).abs() < 1e-7);
        assert!(Image::new(2, 2, vec![[0; 4]]).is_none() && Image::new(0, 0, vec![]).is_none());
    }
}
