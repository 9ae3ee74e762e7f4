//! A picture to look at or to compare, whatever file it came from.

use fog_core::colour::{Rgb, srgb_encode};

use crate::FrameError;

/// What the values of a picture are.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Scale {
    /// Linear radiance without an upper end.
    Radiance {
        /// Factor from radiance to the display, whose white is 1.
        exposure: f32,
    },
    /// Linear values of a display, decoded from sRGB: [0, 1], exposed and clipped when the file was made.
    Display,
}

/// Linear sRGB pixels, row-major, row 0 at the top; grey pictures have R = G = B.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    /// Columns.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// What the values are.
    pub scale: Scale,
    /// The pixels.
    pub rgb: Vec<Rgb>,
    /// Standard error of each pixel's luminance, where it is known.
    pub standard_error: Option<Vec<f32>>,
}

impl Picture {
    /// Checks that there are pixels, that all channels have one value per pixel, and that every value is finite.
    ///
    /// # Errors
    /// The first thing found wrong.
    pub fn check(&self) -> Result<(), FrameError> {
        let (width, height) = (self.width, self.height);
        let expected = width as usize * height as usize;
        if expected == 0 {
            return Err(FrameError::Empty { width, height });
        }
        let errors = self.standard_error.as_deref();
        for (channel, found) in
            [("rgb", self.rgb.len()), ("standard_error", errors.map_or(expected, <[f32]>::len))]
        {
            if found != expected {
                return Err(FrameError::Shape { channel, width, height, expected, found });
            }
        }
        let finite =
            |&i: &usize| self.rgb[i].iter().all(|v| v.is_finite()) && errors.is_none_or(|e| e[i].is_finite());
        match (0..expected).find(|i| !finite(i)) {
            Some(i) => Err(FrameError::NotFinite { x: (i as u32) % width, y: (i / width as usize) as u32 }),
            None => Ok(()),
        }
    }

    /// Linear values of pixel `i` (row-major) as a display shows them: exposed and clipped to [0, 1].
    ///
    /// # Panics
    /// When `i` is not a pixel of the picture.
    #[inline]
    #[must_use]
    pub fn shown(&self, i: usize) -> Rgb {
        let exposure = match self.scale {
            Scale::Radiance { exposure } => exposure,
            Scale::Display => 1.0,
        };
        self.rgb[i].map(|v| (v * exposure).clamp(0.0, 1.0))
    }
}

impl Picture {
    /// The picture of means over blocks of `size` × `size` pixels, smaller ones at the right and the lower edge: noise that
    /// differs from pixel to pixel falls to 1/`size`. Standard errors are those of the means. A size of 0 counts as 1.
    #[must_use]
    pub fn blocks(&self, size: u32) -> Self {
        let size = size.max(1);
        let (width, height) = (self.width.div_ceil(size), self.height.div_ceil(size));
        let count = width as usize * height as usize;
        let mut sums = vec![([0.0f64; 3], 0.0f64, 0u32); count];
        for (i, rgb) in self.rgb.iter().enumerate() {
            let [x, y] = [i as u32 % self.width, i as u32 / self.width].map(|v| v / size);
            let (sum, squared_error, pixels) = &mut sums[y as usize * width as usize + x as usize];
            for c in 0..3 {
                sum[c] += f64::from(rgb[c]);
            }
            *squared_error += self.standard_error.as_ref().map_or(0.0, |e| f64::from(e[i]).powi(2));
            *pixels += 1;
        }
        let mean = |(sum, _, n): &([f64; 3], f64, u32)| sum.map(|s| (s / f64::from(*n)) as f32);
        let error = |(_, squared, n): &([f64; 3], f64, u32)| (squared.sqrt() / f64::from(*n)) as f32;
        Self {
            width,
            height,
            scale: self.scale,
            rgb: sums.iter().map(mean).collect(),
            standard_error: self.standard_error.as_ref().map(|_| sums.iter().map(error).collect()),
        }
    }
}

/// The 8-bit sRGB value of a linear one, clamped to [0, 1] and rounded to the nearest.
#[inline]
#[must_use]
pub fn srgb8(linear: f32) -> u8 {
    (srgb_encode(linear) * 255.0 + 0.5) as u8
}

#[cfg(test)]
mod tests {
    use super::*;
    use fog_core::colour::srgb_decode;

    #[test]
    fn bytes_survive_decoding() {
        for byte in 0..=255u8 {
            assert_eq!(srgb8(srgb_decode(f32::from(byte) / 255.0)), byte);
        }
    }

    #[test]
    fn exposed_and_clipped() {
        let mut p = Picture {
            width: 1,
            height: 1,
            scale: Scale::Radiance { exposure: 2.0 },
            rgb: vec![[-1.0, 0.25, 9.0]],
            standard_error: None,
        };
        assert_eq!(p.shown(0), [0.0, 0.5, 1.0]);
        p.scale = Scale::Display;
        assert_eq!(p.shown(0), [0.0, 0.25, 1.0]);
    }

    #[test]
    fn means_over_blocks() {
        let values = [1.0, 2.0, 5.0, 3.0, 6.0, 7.0, 4.0, 0.0, 8.0f32];
        let picture = Picture {
            width: 3,
            height: 3,
            scale: Scale::Radiance { exposure: 2.0 },
            rgb: values.iter().map(|&v| [v, 0.5, -v]).collect(),
            standard_error: Some(vec![0.3, 0.0, 0.1, 0.4, 0.0, 0.1, 0.5, 1.2, 0.7]),
        };
        let blocks = picture.blocks(2);
        assert_eq!((blocks.width, blocks.height, blocks.scale), (2, 2, picture.scale));
        let want = [3.0, 6.0, 2.0, 8.0];
        assert_eq!(blocks.rgb, want.map(|v| [v, 0.5, -v]));
        let errors = blocks.standard_error.expect("as there were");
        let want = [0.5 / 4.0, 0.02f32.sqrt() / 2.0, 1.3 / 2.0, 0.7];
        assert!(errors.iter().zip(want).all(|(e, w)| (e / w - 1.0).abs() < 1e-6), "{errors:?}");
        assert_eq!(picture.blocks(1), picture);
        assert_eq!(picture.blocks(99).rgb, [[4.0, 0.5, -4.0]]);
    }

    #[test]
    fn bad_pictures_are_refused() {
        let good = Picture {
            width: 2,
            height: 1,
            scale: Scale::Display,
            rgb: vec![[0.5; 3]; 2],
            standard_error: None,
        };
        assert_eq!(good.check(), Ok(()));
        let p = Picture { rgb: vec![[0.5; 3]; 3], ..good.clone() };
        assert!(matches!(p.check(), Err(FrameError::Shape { channel: "rgb", found: 3, .. })));
        let p = Picture { standard_error: Some(vec![]), ..good.clone() };
        assert!(matches!(p.check(), Err(FrameError::Shape { channel: "standard_error", .. })));
        let p = Picture { rgb: vec![[0.5; 3], [0.0, f32::INFINITY, 0.0]], ..good.clone() };
        assert_eq!(p.check(), Err(FrameError::NotFinite { x: 1, y: 0 }));
        let p = Picture { width: 0, rgb: vec![], ..good };
        assert!(matches!(p.check(), Err(FrameError::Empty { .. })));
    }
}
