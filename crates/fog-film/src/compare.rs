//! How much two pictures differ: to the eye, and in radiance.

mod statistics;

pub use statistics::{DeltaE, ZScores};

use fog_core::colour::luminance;
use fog_core::delta_e::{Lab, delta_e_2000};
use fog_core::math::f64::ln;

use crate::picture::srgb8;
use crate::{FrameError, Picture, Scale};

/// Share of the mean square radiance of the reference that is added to each denominator of the relative MSE, so that dark
/// pixels do not outweigh all others.
const FLOOR: f64 = 0.01;

/// Two pictures that cannot be compared.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum CompareError {
    /// They have different numbers of columns or rows.
    #[error(
        "the pictures differ in size: A has {} x {} pixels, B has {} x {}",
        .a[0], .a[1], .b[0], .b[1]
    )]
    Sizes {
        /// Columns and rows of A.
        a: [u32; 2],
        /// Columns and rows of B.
        b: [u32; 2],
    },
    /// One of them is no picture.
    #[error("{which}: {source}")]
    Picture {
        /// `A` or `B`.
        which: char,
        /// What is wrong with it.
        source: FrameError,
    },
}

/// What [`compare`] found.
#[derive(Clone, Debug, PartialEq)]
pub struct Comparison {
    /// Columns.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// CIEDE2000 of the shown colours.
    pub delta_e: DeltaE,
    /// CIEDE2000 of each pixel, row-major.
    pub map: Vec<f32>,
    /// Whether the next four are of radiance; else of the linear values that a display shows.
    pub of_radiance: bool,
    /// Mean over pixels of |a − b|² / (|b|² + 0.01 mean |b|²), |·| over R, G, B; infinite when B alone is black.
    pub relative_mse: f64,
    /// Mean luminance of A and of B.
    pub mean_luminance: [f64; 2],
    /// Mean |difference of luminance| over the mean luminance of B; infinite when B alone is black.
    pub mean_relative_difference: f64,
    /// Mean luminance of A over that of B, less 1: positive when A is brighter; infinite when B alone is black.
    pub relative_difference_of_means: f64,
    /// Mean square difference of the 8-bit sRGB values, over pixels and R, G, B.
    pub mse_srgb8: f64,
    /// Where at least one picture has standard errors; the other then counts as exact.
    pub z_scores: Option<ZScores>,
}

impl Comparison {
    /// Peak signal-to-noise ratio of the 8-bit sRGB values in dB, the peak being 255; infinite for equal values.
    #[must_use]
    pub fn psnr_db(&self) -> f64 {
        psnr_db(self.mse_srgb8)
    }
}

/// 10 log₁₀(255² / mse); infinite for 0.
#[must_use]
pub fn psnr_db(mse_srgb8: f64) -> f64 {
    if mse_srgb8 > 0.0 {
        10.0 / std::f64::consts::LN_10 * ln(255.0 * 255.0 / mse_srgb8)
    } else {
        f64::INFINITY
    }
}

/// Compares A with the reference B, pixel by pixel.
///
/// Colour difference and PSNR are of what a display shows: exposed and clipped to [0, 1], ΔE without rounding to 8 bits.
/// The other figures are of linear radiance, not exposed and not clipped; if one of the pictures holds display values only,
/// they are of the shown values of both.
///
/// # Errors
/// [`CompareError`] when the sizes differ or a picture is none.
pub fn compare(a: &Picture, b: &Picture) -> Result<Comparison, CompareError> {
    for (which, picture) in [('A', a), ('B', b)] {
        picture.check().map_err(|source| CompareError::Picture { which, source })?;
    }
    let sizes = [[a.width, a.height], [b.width, b.height]];
    if sizes[0] != sizes[1] {
        return Err(CompareError::Sizes { a: sizes[0], b: sizes[1] });
    }
    let is_radiance = |p: &Picture| matches!(p.scale, Scale::Radiance { .. });
    let of_radiance = is_radiance(a) && is_radiance(b);
    let values = |p: &Picture, i: usize| if of_radiance { p.rgb[i] } else { p.shown(i) }.map(f64::from);
    let radiance = radiance(a.rgb.len(), |i| values(a, i), |i| values(b, i));

    let map: Vec<f32> = (0..a.rgb.len()).map(|i| delta_e_of(a, b, i) as f32).collect();
    Ok(Comparison {
        width: a.width,
        height: a.height,
        delta_e: DeltaE::of(&map),
        map,
        of_radiance,
        relative_mse: radiance.relative_mse,
        mean_luminance: radiance.mean_luminance,
        mean_relative_difference: ratio(radiance.mean_difference, radiance.mean_luminance[1]),
        relative_difference_of_means: ratio(
            radiance.mean_luminance[0] - radiance.mean_luminance[1],
            radiance.mean_luminance[1],
        ),
        mse_srgb8: mse_srgb8(a, b),
        z_scores: of_radiance.then(|| ZScores::of(a, b)).flatten(),
    })
}

fn delta_e_of(a: &Picture, b: &Picture, i: usize) -> f64 {
    let lab = |p: &Picture| Lab::from_linear_srgb(p.shown(i).map(f64::from));
    delta_e_2000(lab(a), lab(b))
}

/// a / b, and 0 where both are 0.
fn ratio(a: f64, b: f64) -> f64 {
    if a == 0.0 { 0.0 } else { a / b }
}

fn mse_srgb8(a: &Picture, b: &Picture) -> f64 {
    let mut sum = 0u64;
    for i in 0..a.rgb.len() {
        let (a, b) = (a.shown(i), b.shown(i));
        for c in 0..3 {
            sum += u64::from(srgb8(a[c]).abs_diff(srgb8(b[c]))).pow(2);
        }
    }
    sum as f64 / (3 * a.rgb.len()) as f64
}

struct Radiance {
    relative_mse: f64,
    mean_luminance: [f64; 2],
    mean_difference: f64,
}

fn radiance(n: usize, a: impl Fn(usize) -> [f64; 3], b: impl Fn(usize) -> [f64; 3]) -> Radiance {
    let square = |v: [f64; 3]| v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
    let floor = FLOOR * (0..n).map(|i| square(b(i))).sum::<f64>() / n as f64;
    let (mut relative, mut means, mut differences) = (0.0, [0.0; 2], 0.0);
    for i in 0..n {
        let (a, b) = (a(i), b(i));
        relative += ratio(square([a[0] - b[0], a[1] - b[1], a[2] - b[2]]), square(b) + floor);
        let y = [luminance(a), luminance(b)];
        means[0] += y[0];
        means[1] += y[1];
        differences += (y[0] - y[1]).abs();
    }
    let n = n as f64;
    Radiance {
        relative_mse: relative / n,
        mean_luminance: means.map(|sum| sum / n),
        mean_difference: differences / n,
    }
}

#[cfg(test)]
mod tests;
