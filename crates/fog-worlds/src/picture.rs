//! Pictures for textures, drawn by covering pixels with shapes.

use crate::error::WorldError;
use fog_core::colour::{Rgb, srgb_encode};
use image::codecs::png::{CompressionType, FilterType, PngEncoder};
use image::{ExtendedColorType, ImageEncoder};

/// A picture in linear colours, over a drawing of `size` units; y points up from the lower left corner.
#[derive(Clone, Debug)]
pub(crate) struct Picture {
    width: usize,
    height: usize,
    units_per_px: f32,
    pixels: Vec<Rgb>,
}

/// What a drawing is made of.
#[derive(Clone, Debug)]
pub(crate) enum Area {
    /// Inside of a closed polygon (even-odd).
    Polygon(Vec<[f32; 2]>),
    /// Inside of a circle.
    Disc([f32; 2], f32),
    /// Closer than a distance to any of some lines.
    Lines(Vec<Vec<[f32; 2]>>, f32),
}

/// Subsamples along a pixel's edge.
const SUBSAMPLES: usize = 4;

impl Picture {
    /// A picture of one colour, `width` × `height` units, with `px` pixels to a unit.
    pub(crate) fn new(width: f32, height: f32, px_per_unit: f32, colour: Rgb) -> Self {
        let (w, h) = ((width * px_per_unit).round() as usize, (height * px_per_unit).round() as usize);
        Self { width: w, height: h, units_per_px: 1.0 / px_per_unit, pixels: vec![colour; w * h] }
    }

    /// A picture of given pixels, rows from the top.
    pub(crate) fn from_pixels(width: usize, pixels: Vec<Rgb>) -> Self {
        Self { width, height: pixels.len() / width, units_per_px: 1.0, pixels }
    }

    /// Covers an area with a colour.
    pub(crate) fn fill(&mut self, area: &Area, colour: Rgb) {
        let [min, max] = area.bounds();
        let column = |x: f32| (x / self.units_per_px).clamp(0.0, self.width as f32);
        let row = |y: f32| (self.height as f32 - y / self.units_per_px).clamp(0.0, self.height as f32);
        let (x0, x1) = (column(min[0]) as usize, column(max[0]).ceil() as usize);
        let (y0, y1) = (row(max[1]) as usize, row(min[1]).ceil() as usize);
        let step = self.units_per_px / SUBSAMPLES as f32;
        for py in y0..y1 {
            for px in x0..x1 {
                let mut inside = 0;
                for k in 0..SUBSAMPLES * SUBSAMPLES {
                    let x = px as f32 * self.units_per_px + (0.5 + (k % SUBSAMPLES) as f32) * step;
                    let below = (self.height - py) as f32 * self.units_per_px;
                    let y = below - (0.5 + (k / SUBSAMPLES) as f32) * step;
                    inside += usize::from(area.contains([x, y]));
                }
                let share = inside as f32 / (SUBSAMPLES * SUBSAMPLES) as f32;
                let pixel = &mut self.pixels[py * self.width + px];
                *pixel = core::array::from_fn(|c| pixel[c] + (colour[c] - pixel[c]) * share);
            }
        }
    }

    /// The file's bytes: 8-bit sRGB.
    pub(crate) fn png(&self) -> Result<Vec<u8>, WorldError> {
        let byte = |c: &f32| (srgb_encode(c.clamp(0.0, 1.0)) * 255.0 + 0.5) as u8;
        let bytes: Vec<u8> = self.pixels.iter().flatten().map(byte).collect();
        let mut out = Vec::new();
        let encoder = PngEncoder::new_with_quality(&mut out, CompressionType::Best, FilterType::Adaptive);
        encoder.write_image(&bytes, self.width as u32, self.height as u32, ExtendedColorType::Rgb8)?;
        Ok(out)
    }
}

impl Area {
    /// The rectangle of two corners.
    pub(crate) fn rectangle([x0, y0]: [f32; 2], [x1, y1]: [f32; 2]) -> Self {
        Self::Polygon(vec![[x0, y0], [x1, y0], [x1, y1], [x0, y1]])
    }

    fn bounds(&self) -> [[f32; 2]; 2] {
        let of = |points: &mut dyn Iterator<Item = [f32; 2]>, margin: f32| {
            let start = [[f32::MAX; 2], [f32::MIN; 2]];
            points.fold(start, |[a, b], p| {
                [
                    core::array::from_fn(|i| a[i].min(p[i] - margin)),
                    core::array::from_fn(|i| b[i].max(p[i] + margin)),
                ]
            })
        };
        match self {
            Self::Polygon(points) => of(&mut points.iter().copied(), 0.0),
            Self::Disc(centre, radius) => of(&mut [*centre].into_iter(), *radius),
            Self::Lines(lines, radius) => of(&mut lines.iter().flatten().copied(), *radius),
        }
    }

    fn contains(&self, p: [f32; 2]) -> bool {
        match self {
            Self::Polygon(points) => {
                let mut inside = false;
                let mut a = points[points.len() - 1];
                for &b in points {
                    if (a[1] > p[1]) != (b[1] > p[1])
                        && p[0] < a[0] + (p[1] - a[1]) / (b[1] - a[1]) * (b[0] - a[0])
                    {
                        inside = !inside;
                    }
                    a = b;
                }
                inside
            }
            Self::Disc(centre, radius) => {
                let [x, y] = [p[0] - centre[0], p[1] - centre[1]];
                x * x + y * y <= radius * radius
            }
            Self::Lines(lines, radius) => {
                let near = |pair: &[[f32; 2]]| squared_distance(p, pair[0], pair[1]) <= radius * radius;
                lines.iter().any(|line| line.windows(2).any(near))
            }
        }
    }
}

/// Squared distance of a point from a segment.
fn squared_distance(p: [f32; 2], a: [f32; 2], b: [f32; 2]) -> f32 {
    let (d, e) = ([b[0] - a[0], b[1] - a[1]], [p[0] - a[0], p[1] - a[1]]);
    let length2 = d[0] * d[0] + d[1] * d[1];
    let t = if length2 > 0.0 { ((d[0] * e[0] + d[1] * e[1]) / length2).clamp(0.0, 1.0) } else { 0.0 };
    let [x, y] = [e[0] - t * d[0], e[1] - t * d[1]];
    x * x + y * y
}
