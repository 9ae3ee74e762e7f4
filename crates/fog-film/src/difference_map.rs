//! The map of a comparison as an 8-bit picture with a scale below it.

use crate::Comparison;
use crate::colour_map::magma;

/// An 8-bit sRGB picture, three bytes per pixel, row-major, row 0 at the top.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Srgb8Picture {
    /// Columns.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// width × height × 3 bytes.
    pub bytes: Vec<u8>,
}

/// Narrowest map that gets a scale: its numbers need the room.
const SCALE_MIN_WIDTH: u32 = 96;
const INK: [u8; 3] = [230; 3];
const PAPER: [u8; 3] = [24; 3];

impl Comparison {
    /// A round upper end for the colours of the map: the smallest of 0.1, 0.2, 0.5, 1, … 100 that 99 % of the pixels stay
    /// below; 1 for equal pictures.
    #[must_use]
    pub fn map_scale(&self) -> f64 {
        const ENDS: [f64; 10] = [0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0];
        if self.delta_e.max == 0.0 {
            return 1.0;
        }
        ENDS.into_iter().find(|end| self.delta_e.p99 <= *end).unwrap_or(100.0)
    }

    /// The ΔE of each pixel in the colours of [`magma`]: black is 0, pale yellow `scale` and more. The first `height` rows
    /// are the pixels of the pictures; below them, for maps of at least 96 columns, a scale with its numbers.
    #[must_use]
    pub fn map_picture(&self, scale: f64) -> Srgb8Picture {
        let mut bytes: Vec<u8> =
            self.map.iter().flat_map(|&v| magma((f64::from(v) / scale) as f32)).collect();
        let mut height = self.height;
        if self.width >= SCALE_MIN_WIDTH {
            let strip = legend(self.width, scale, self.delta_e.max > scale);
            height += strip.height;
            bytes.extend(strip.bytes);
        }
        Srgb8Picture { width: self.width, height, bytes }
    }
}

/// A bar of all colours, and under it 0, half of the scale, and its end with the quantity's name.
fn legend(width: u32, scale: f64, clipped: bool) -> Srgb8Picture {
    // Everything grows with the picture, in whole pixels.
    let unit = (width / 320).clamp(1, 8);
    let (margin, bar, digits) = (4 * unit, 8 * unit, GLYPH_ROWS * 2 * unit);
    let height = 3 * margin + bar + digits;
    let mut strip = Srgb8Picture { width, height, bytes: PAPER.repeat((width * height) as usize) };
    let length = width - 2 * margin;
    for x in 0..length {
        let colour = magma(x as f32 / (length - 1) as f32);
        strip.fill([margin + x, margin], [1, bar], colour);
    }
    let number = |v: f64| {
        let text = format!("{v:.2}");
        text.trim_end_matches('0').trim_end_matches('.').to_owned()
    };
    let end = format!("{}{} ΔE", number(scale), if clipped { "+" } else { "" });
    let (top, glyph) = (2 * margin + bar, 2 * unit);
    let half = number(0.5 * scale);
    strip.write("0", margin, top, glyph);
    strip.write(&half, (width - text_width(&half, glyph)) / 2, top, glyph);
    strip.write(&end, width - margin - text_width(&end, glyph), top, glyph);
    strip
}

impl Srgb8Picture {
    fn fill(&mut self, [x0, y0]: [u32; 2], [columns, rows]: [u32; 2], colour: [u8; 3]) {
        for y in y0..(y0 + rows).min(self.height) {
            for x in x0..(x0 + columns).min(self.width) {
                let at = 3 * (y * self.width + x) as usize;
                self.bytes[at..at + 3].copy_from_slice(&colour);
            }
        }
    }

    fn write(&mut self, text: &str, x: u32, y: u32, size: u32) {
        for (place, character) in text.chars().enumerate() {
            let left = x + place as u32 * (GLYPH_COLUMNS + 1) * size;
            for (row, dots) in glyph(character).into_iter().enumerate() {
                for column in (0..GLYPH_COLUMNS).filter(|c| dots >> (GLYPH_COLUMNS - 1 - c) & 1 == 1) {
                    self.fill([left + column * size, y + row as u32 * size], [size; 2], INK);
                }
            }
        }
    }
}

const GLYPH_COLUMNS: u32 = 3;
const GLYPH_ROWS: u32 = 5;

fn text_width(text: &str, size: u32) -> u32 {
    (text.chars().count() as u32 * (GLYPH_COLUMNS + 1) - 1) * size
}

/// Rows of a character, top to bottom, three dots each; blank for those that a scale has no use for.
fn glyph(character: char) -> [u8; GLYPH_ROWS as usize] {
    match character {
        '0' => [0b111, 0b101, 0b101, 0b101, 0b111],
        '1' => [0b010, 0b110, 0b010, 0b010, 0b111],
        '2' => [0b111, 0b001, 0b111, 0b100, 0b111],
        '3' => [0b111, 0b001, 0b111, 0b001, 0b111],
        '4' => [0b101, 0b101, 0b111, 0b001, 0b001],
        '5' => [0b111, 0b100, 0b111, 0b001, 0b111],
        '6' => [0b111, 0b100, 0b111, 0b101, 0b111],
        '7' => [0b111, 0b001, 0b010, 0b010, 0b010],
        '8' => [0b111, 0b101, 0b111, 0b101, 0b111],
        '9' => [0b111, 0b101, 0b111, 0b001, 0b111],
        '.' => [0b000, 0b000, 0b000, 0b000, 0b010],
        '+' => [0b000, 0b010, 0b111, 0b010, 0b000],
        'Δ' => [0b010, 0b010, 0b101, 0b101, 0b111],
        'E' => [0b111, 0b100, 0b110, 0b100, 0b111],
        _ => [0; GLYPH_ROWS as usize],
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Picture, Scale, compare};

    fn comparison(width: u32, height: u32) -> Comparison {
        let n = (width * height) as usize;
        let picture = |rgb| Picture { width, height, scale: Scale::Display, rgb, standard_error: None };
        let ramp = (0..n).map(|i| [(i % width as usize) as f32 / width as f32; 3]).collect();
        compare(&picture(ramp), &picture(vec![[0.0; 3]; n])).expect("comparable")
    }

    #[test]
    fn the_map_comes_first_and_the_scale_below() {
        let c = comparison(320, 4);
        let p = c.map_picture(100.0);
        assert_eq!((p.width, p.height), (320, 4 + 3 * 4 + 8 + 10));
        assert_eq!(p.bytes.len(), (p.width * p.height * 3) as usize);
        assert_eq!(p.bytes[..3], magma(0.0));
        assert_eq!(p.bytes[3 * 319..3 * 320], magma(c.map[319] / 100.0));
        // The bar from end to end.
        let at = |x: u32, y: u32| &p.bytes[3 * (y * 320 + x) as usize..][..3];
        assert_eq!((at(4, 8), at(315, 8)), (&magma(0.0)[..], &magma(1.0)[..]));
        assert_eq!((at(3, 8), at(316, 8)), (&PAPER[..], &PAPER[..]));
        // Numbers: the left edge of the zero.
        assert_eq!((at(4, 20), at(6, 23)), (&INK[..], &PAPER[..]));
        assert_eq!(comparison(95, 2).map_picture(5.0).height, 2, "no room for numbers");
        assert!(comparison(96, 2).map_picture(50.0).height > 2);
    }

    #[test]
    fn round_scales() {
        let mut c = comparison(8, 1);
        for (p99, want) in [(0.03, 0.1), (3.0, 5.0), (10.0, 10.0), (11.0, 20.0), (140.0, 100.0)] {
            c.delta_e.p99 = p99;
            assert_eq!(c.map_scale(), want);
        }
        c.delta_e = crate::DeltaE::default();
        assert_eq!(c.map_scale(), 1.0);
    }
}
