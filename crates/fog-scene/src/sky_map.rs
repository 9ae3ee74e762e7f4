//! Light from far away by direction: an image of the whole sphere, aimed at where it is bright.
//!
//! The image is equirectangular: columns are headings, rows polar angles. Its centre column shows the heading 0 (−Z), headings
//! grow to the right, the top row is the zenith. Between the centres of texels radiance is bilinear.

use fog_core::Vec3A;
use fog_core::bands::{BANDS, BandLanes};
use fog_core::colour::{Rgb, upsample};
use fog_core::distribution_2d::{CellSample, Distribution2d};
use fog_core::math;
use fog_core::spectrum::Spectrum;
use std::sync::Arc;

/// Most texels of an image: 8192 × 4096.
pub const MAX_TEXELS: usize = 1 << 25;
/// Largest value of a texel.
pub const MAX_VALUE: f32 = 1e12;
/// Most columns and rows of cells among which directions are drawn; larger images have several texels in a cell.
const MAX_CELLS: [usize; 2] = [2048, 1024];

/// What is wrong with an image of the surroundings.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SkyMapError {
    /// It is too small or too large, or has another number of texels than its size says.
    #[error(
        "{width} × {height} px is no size for an environment: from 2 × 2 px to {MAX_TEXELS} px in all, as many values as \
         pixels (here {texels})"
    )]
    Size {
        /// Columns.
        width: usize,
        /// Rows.
        height: usize,
        /// Number of texels given.
        texels: usize,
    },
    /// A value that radiance cannot have.
    #[error(
        "the pixel in column {x}, row {y} (counted from 0) has the value {value}; valid: finite, from 0 to {MAX_VALUE:e}"
    )]
    Value {
        /// Column.
        x: usize,
        /// Row.
        y: usize,
        /// The value.
        value: f32,
    },
    /// Nothing shines.
    #[error("it is black everywhere")]
    Black,
}

/// The surroundings of a scene. Copies are cheap: they share the image.
#[derive(Clone, Debug)]
pub struct SkyMap {
    image: Arc<Image>,
    /// Heading of the image's centre column, in turns.
    turn: f32,
    scale: f32,
}

#[derive(Debug)]
struct Image {
    width: usize,
    height: usize,
    texels: Texels,
    /// Whether upper and lower half are apart: no interpolation between sky and ground.
    split: bool,
    cells: Distribution2d,
    /// Texels along the side of a cell.
    block: usize,
    /// Cells per row.
    columns: usize,
    /// Density of directions in each cell, in 1/sr.
    density: Vec<f32>,
    /// Mean over the sphere of the mean over the wavelengths.
    mean: f32,
    evenness: f32,
}

#[derive(Debug)]
enum Texels {
    /// Colours, linear sRGB.
    Rgb(Vec<Rgb>),
    /// Relative radiance by band.
    Bands(Vec<[f32; BANDS]>),
}

/// What the wavelengths of a path need to be looked up.
#[derive(Clone, Copy, Debug)]
pub struct SkyLanes<'a> {
    /// Basis spectra of colours.
    pub basis: &'a [Spectrum; 3],
    /// Places between the bands.
    pub bands: &'a BandLanes,
}

/// A direction drawn by its light.
#[derive(Clone, Copy, Debug)]
pub struct SkySample {
    /// Unit vector away from the viewer.
    pub direction: Vec3A,
    /// Density in 1/sr.
    pub pdf: f32,
    /// Relative radiance from there.
    pub radiance: Spectrum,
}

impl SkyMap {
    /// An image of colours: linear sRGB relative to D65, row by row from the top.
    ///
    /// # Errors
    /// [`SkyMapError`] for sizes and values that cannot be, and for an image without light.
    pub fn from_rgb(width: usize, height: usize, texels: Vec<Rgb>) -> Result<Self, SkyMapError> {
        check(width, height, &texels)?;
        let strength = texels.iter().map(|t| t.iter().sum::<f32>() / 3.0).collect::<Vec<_>>();
        Self::new(width, height, Texels::Rgb(texels), &strength, false)
    }

    /// An image of spectra: radiance relative to D65 by band, row by row from the top. Sky and ground, the upper and the lower
    /// half of an even number of rows, are apart: at the horizon one ends and the other begins.
    ///
    /// # Errors
    /// [`SkyMapError`] for sizes and values that cannot be, and for an image without light.
    pub fn from_bands(width: usize, height: usize, texels: Vec<[f32; BANDS]>) -> Result<Self, SkyMapError> {
        check(width, height, &texels)?;
        let strength = texels.iter().map(|t| t.iter().sum::<f32>() / BANDS as f32).collect::<Vec<_>>();
        Self::new(width, height, Texels::Bands(texels), &strength, height.is_multiple_of(2))
    }

    fn new(
        width: usize,
        height: usize,
        texels: Texels,
        strength: &[f32],
        split: bool,
    ) -> Result<Self, SkyMapError> {
        let block = width.div_ceil(MAX_CELLS[0]).max(height.div_ceil(MAX_CELLS[1]));
        let (columns, rows) = (width.div_ceil(block), height.div_ceil(block));
        // Power of each cell: bilinear radiance over its texels times their solid angles.
        let mut weights = vec![0.0; columns * rows];
        let mut solid_angles = vec![0.0; rows * columns];
        for y in 0..height {
            let omega = solid_angle(width, height, y, y + 1);
            let rows_around = neighbours(y, height, split);
            for x in 0..width {
                let around = [(x + width - 1) % width, x, (x + 1) % width];
                let mut sum = 0.0;
                for (row, a) in rows_around.iter().zip(TEXEL_MEAN) {
                    for (column, b) in around.iter().zip(TEXEL_MEAN) {
                        sum += a * b * f64::from(strength[row * width + column]);
                    }
                }
                let cell = (y / block) * columns + x / block;
                weights[cell] += sum * omega;
                solid_angles[cell] += omega;
            }
        }
        let mean = weights.iter().sum::<f64>() / (2.0 * math::TAU);
        let cells = Distribution2d::new(columns, &weights).ok_or(SkyMapError::Black)?;
        let density = (0..weights.len())
            .map(|i| (cells.probability([i / columns, i % columns]) / solid_angles[i]) as f32)
            .collect();
        // 1 / (4π ∫ p² dω) of the density p.
        let squares: f64 = (0..weights.len())
            .map(|i| cells.probability([i / columns, i % columns]).powi(2) / solid_angles[i])
            .sum();
        let evenness = (1.0 / (2.0 * math::TAU * squares)) as f32;
        let image = Image {
            width,
            height,
            texels,
            split,
            cells,
            block,
            columns,
            density,
            mean: mean as f32,
            evenness,
        };
        Ok(Self { image: Arc::new(image), turn: 0.0, scale: 1.0 })
    }

    /// The same surroundings turned so that the image's centre column shows `heading_deg` (clockwise from north, −Z).
    #[must_use]
    pub fn turned(&self, heading_deg: f64) -> Self {
        Self { turn: self.turn + (heading_deg / 360.0) as f32, ..self.clone() }
    }

    /// The same surroundings with `factor` (above 0) times the radiance.
    #[must_use]
    pub fn scaled(&self, factor: f64) -> Self {
        Self { scale: self.scale * factor as f32, ..self.clone() }
    }

    /// Mean relative radiance over the sphere (of colours, over red, green and blue; of spectra, over the bands).
    #[must_use]
    pub fn mean(&self) -> f32 {
        self.image.mean * self.scale
    }

    /// Share of the sphere that the light comes from, as it were: the square of the mean radiance over the mean of its square.
    /// 1 if it is the same everywhere, near 0 if most comes from a sun.
    #[must_use]
    pub fn evenness(&self) -> f32 {
        self.image.evenness
    }

    /// Size of the image in texels: columns and rows.
    #[must_use]
    pub fn size(&self) -> [usize; 2] {
        [self.image.width, self.image.height]
    }

    /// Relative radiance from `direction` (unit, away from the viewer).
    #[inline]
    #[must_use]
    pub fn radiance(&self, direction: Vec3A, lanes: SkyLanes<'_>) -> Spectrum {
        let [u, v] = self.place(direction);
        self.at(u, v, lanes)
    }

    /// Relative radiance and [`SkyMap::pdf`] of a direction.
    #[inline]
    #[must_use]
    pub fn radiance_and_pdf(&self, direction: Vec3A, lanes: SkyLanes<'_>) -> (Spectrum, f32) {
        let [u, v] = self.place(direction);
        (self.at(u, v, lanes), self.density(u, v))
    }

    /// Density in 1/sr with which [`SkyMap::sample`] finds a direction; above 0 wherever there is light.
    #[inline]
    #[must_use]
    pub fn pdf(&self, direction: Vec3A) -> f32 {
        let [u, v] = self.place(direction);
        self.density(u, v)
    }

    /// Draws a direction in proportion to the light from it, cell by cell.
    #[inline]
    #[must_use]
    pub fn sample(&self, u: [f64; 2], lanes: SkyLanes<'_>) -> SkySample {
        let Image { width, height, block, columns, .. } = *self.image;
        let CellSample { cell: [row, column], inside } = self.image.cells.sample(u);
        let edge = |i: usize, n: usize| (i * block).min(n) as f64 / n as f64;
        // Uniform in the cosine of the polar angle and in the heading.
        let cosine = |i: usize| math::f64::cos(math::PI * edge(i, height));
        let (c0, c1) = (cosine(row), cosine(row + 1));
        let cos = (c0 + (c1 - c0) * inside[0]) as f32;
        let (x0, x1) = (edge(column, width), edge(column + 1, width));
        let across = (x0 + (x1 - x0) * inside[1]) as f32;
        let (sin_heading, cos_heading) = math::sin_cos_turns(fraction(across - 0.5 + self.turn));
        let sin = (1.0 - cos * cos).max(0.0).sqrt();
        let direction = Vec3A::new(sin * sin_heading, cos, -sin * cos_heading);
        let down = math::f32::acos(cos.clamp(-1.0, 1.0)) * math::INV_PI_F32;
        SkySample {
            direction,
            pdf: self.image.density[row * columns + column],
            radiance: self.at(across, down, lanes),
        }
    }

    /// Position in the image, both coordinates in [0, 1].
    #[inline]
    fn place(&self, direction: Vec3A) -> [f32; 2] {
        let heading = math::f32::atan2(direction.x, -direction.z) * (1.0 / math::TAU_F32);
        let down = math::f32::acos(direction.y.clamp(-1.0, 1.0)) * math::INV_PI_F32;
        [fraction(heading - self.turn + 0.5), down]
    }

    #[inline]
    fn density(&self, u: f32, v: f32) -> f32 {
        let Image { width, height, block, columns, .. } = *self.image;
        let x = ((u * width as f32) as usize).min(width - 1) / block;
        let y = ((v * height as f32) as usize).min(height - 1) / block;
        self.image.density[y * columns + x]
    }

    /// Bilinear radiance at a place of the image.
    #[inline]
    fn at(&self, u: f32, v: f32, lanes: SkyLanes<'_>) -> Spectrum {
        let Image { width, height, split, .. } = *self.image;
        let x = u * width as f32 + (width as f32 - 0.5);
        let (left, a) = (x as usize, x - (x as usize) as f32);
        let columns = [left % width, (left + 1) % width];
        // The nearer row, and the one beside it on that side.
        let y = v * height as f32;
        let row = (y as usize).min(height - 1);
        let offset = y - row as f32 - 0.5;
        let [above, _, below] = neighbours(row, height, split);
        let (other, b) = if offset < 0.0 { (above, -offset) } else { (below, offset) };
        let corners = [(row, 1.0 - b), (other, b)];
        let weighted = corners.into_iter().flat_map(|(row, b)| {
            [(row * width + columns[0], b * (1.0 - a)), (row * width + columns[1], b * a)]
        });
        match &self.image.texels {
            Texels::Rgb(texels) => {
                let mut rgb = [0.0; 3];
                for (i, weight) in weighted {
                    for c in 0..3 {
                        rgb[c] += texels[i][c] * weight;
                    }
                }
                upsample(rgb, lanes.basis) * self.scale
            }
            Texels::Bands(texels) => {
                let mut sum = Spectrum::ZERO;
                for (i, weight) in weighted {
                    sum += lanes.bands.gather(&texels[i]) * weight;
                }
                sum * self.scale
            }
        }
    }
}

/// Weights of a texel and its neighbours in the mean of a piecewise linear function over the texel.
const TEXEL_MEAN: [f64; 3] = [0.125, 0.75, 0.125];

/// The row above, the row, and the row below, as interpolation takes them.
#[inline]
fn neighbours(y: usize, height: usize, split: bool) -> [usize; 3] {
    let (first, last) = match split {
        true if y < height / 2 => (0, height / 2 - 1),
        true => (height / 2, height - 1),
        false => (0, height - 1),
    };
    [y.saturating_sub(1).max(first), y, (y + 1).min(last)]
}

/// Solid angle in sr of a texel between the edges of two rows.
fn solid_angle(width: usize, height: usize, top: usize, bottom: usize) -> f64 {
    let cosine = |row: usize| math::f64::cos(math::PI * row as f64 / height as f64);
    math::TAU / width as f64 * (cosine(top) - cosine(bottom))
}

/// Fractional part in [0, 1).
#[inline]
fn fraction(x: f32) -> f32 {
    let f = x - x.floor();
    if f < 1.0 { f } else { 0.0 }
}

fn check<const N: usize>(width: usize, height: usize, texels: &[[f32; N]]) -> Result<(), SkyMapError> {
    let count = width.checked_mul(height).filter(|&n| n <= MAX_TEXELS && width >= 2 && height >= 2);
    if count != Some(texels.len()) {
        return Err(SkyMapError::Size { width, height, texels: texels.len() });
    }
    let bad = |value: &f32| !(0.0..=MAX_VALUE).contains(value);
    for (i, texel) in texels.iter().enumerate() {
        if let Some(&value) = texel.iter().find(|v| bad(v)) {
            return Err(SkyMapError::Value { x: i % width, y: i / width, value });
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use fog_core::spectrum::Wavelengths;

    #[test]
    fn what_is_no_radiance_is_refused_with_its_place() {
        for bad in [f32::NAN, f32::INFINITY, -1e-6, 2e12] {
            let mut texels = vec![[1.0; 3]; 8];
            texels[6][2] = bad;
            match SkyMap::from_rgb(4, 2, texels) {
                Err(SkyMapError::Value { x: 2, y: 1, value }) => {
                    assert_eq!(value.to_bits(), bad.to_bits());
                }
                other => panic!("{bad}: {other:?}"),
            }
        }
        assert_eq!(SkyMap::from_rgb(4, 2, vec![[0.0; 3]; 8]).err(), Some(SkyMapError::Black));
        assert!(matches!(
            SkyMap::from_rgb(4, 2, vec![[1.0; 3]; 7]),
            Err(SkyMapError::Size { texels: 7, .. })
        ));
        assert!(matches!(SkyMap::from_rgb(1 << 40, 1 << 40, Vec::new()), Err(SkyMapError::Size { .. })));
    }

    #[test]
    fn sky_and_ground_do_not_mix_at_the_horizon() {
        let texels = (0..8 * 4).map(|i| [if i < 16 { 1.0 } else { 0.25 }; BANDS]).collect();
        let map = SkyMap::from_bands(8, 4, texels).unwrap();
        let bands = BandLanes::new(&Wavelengths::monochromatic(550.0));
        let lanes = SkyLanes { basis: &[Spectrum::ONE; 3], bands: &bands };
        for (y, want) in [(0.9, 1.0), (0.01, 1.0), (-0.01, 0.25), (-0.9, 0.25)] {
            let d = Vec3A::new(f32::sqrt(1.0 - y * y), y, 0.0);
            assert!((map.radiance(d, lanes)[0] - want).abs() < 1e-6, "{y}");
        }
        assert!((map.mean() - 0.625).abs() < 1e-6);
        // (5/8)² over the mean of 1 and 1/16.
        assert!((map.evenness() - 0.625 * 0.625 / (0.5 * 1.0625)).abs() < 1e-4, "{}", map.evenness());
    }
}
