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
