//! How much a thing stands out.

use super::LabelledView;
use fog_core::colour::luminance;
use fog_film::{Channels, Frame};

/// Weber's contrast: mean luminance of a thing over that of its surroundings, less 1. Of frames of one wavelength the radiance
/// stands for the luminance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contrast {
    /// The contrast, −1 and more; infinite where the surroundings are black.
    pub value: f64,
    /// Its standard error from those of the pixels, taken for independent.
    pub standard_error: f64,
}

/// Transmittance from which on the light that comes straight tells what a surface sends off.
const LEAST_TRANSMITTANCE: f64 = 1e-3;
/// Widths of surroundings in pixels: least and greatest.
const WIDTHS: [f64; 2] = [2.0, 32.0];

/// The visible pixels of a thing, and those around it.
pub(super) struct Surroundings {
    inside: Vec<usize>,
    around: Vec<usize>,
}

impl Surroundings {
    /// Pixels of the thing, and all others within a square around any of them: a quarter of the square root of their number
    /// wide, 2 to 32 pixels. `None` where nothing is around.
    pub(super) fn new(view: &LabelledView<'_>, id: u16, pixels: u64, bounds: [u32; 4]) -> Option<Self> {
        let reach = ((pixels as f64).sqrt() / 4.0).round().clamp(WIDTHS[0], WIDTHS[1]) as usize;
        let [width, height] = [view.camera.width, view.camera.height].map(|v| v as usize);
        let [left, top, right, bottom] = bounds.map(|v| v as usize);
        let (left, top) = (left.saturating_sub(reach), top.saturating_sub(reach));
        let (right, bottom) = ((right + reach).min(width), (bottom + reach).min(height));
        let mask = &view.frame.truth.surface.instance;
        // Number of the thing's pixels above and to the left.
        let row = right - left + 1;
        let mut sums = vec![0u32; row * (bottom - top + 1)];
        for y in top..bottom {
            for x in left..right {
                let at = (y - top + 1) * row + (x - left + 1);
                let here = u32::from(mask[y * width + x] == id);
                sums[at] = here + sums[at - 1] + sums[at - row] - sums[at - row - 1];
            }
        }
        let (mut inside, mut around) = (Vec::new(), Vec::new());
        for y in top..bottom {
            let rows =
                [(y.saturating_sub(reach)).max(top), (y + reach + 1).min(bottom)].map(|y| (y - top) * row);
            for x in left..right {
                let i = y * width + x;
                if mask[i] == id {
                    inside.push(i);
                    continue;
                }
                let columns =
                    [x.saturating_sub(reach).max(left), (x + reach + 1).min(right)].map(|x| x - left);
                let near = sums[rows[1] + columns[1]] + sums[rows[0] + columns[0]];
                if near > sums[rows[0] + columns[1]] + sums[rows[1] + columns[0]] {
                    around.push(i);
                }
            }
        }
        (!around.is_empty()).then_some(Self { inside, around })
    }

    /// Contrast in a picture.
    pub(super) fn contrast(&self, frame: &Frame) -> Option<Contrast> {
        let mean = |pixels: &[usize]| {
            let (mut sum, mut variance) = (0.0, 0.0);
            for &i in pixels {
                let error = f64::from(frame.standard_error[i]);
                sum += frame.luminance(i);
                variance += error * error;
            }
            let n = pixels.len() as f64;
            (sum / n, variance / (n * n))
        };
        let ((thing, of_thing), (ground, of_ground)) = (mean(&self.inside), mean(&self.around));
        if ground <= 0.0 {
            let value = if thing > 0.0 { f64::INFINITY } else { 0.0 };
            return Some(Contrast { value, standard_error: 0.0 });
        }
        let ratio = thing / ground;
        let standard_error = (of_thing + ratio * ratio * of_ground).sqrt() / ground;
        Some(Contrast { value: ratio - 1.0, standard_error })
    }

    /// Contrast of what the surfaces send off: each pixel's direct light over its transmittance. `None` where half of the
    /// thing's pixels or half of those around it are behind too much fog.
    pub(super) fn unveiled(&self, frame: &Frame) -> Option<f64> {
        let direct = |i: usize| match frame.channels {
            Channels::Rgb => luminance(frame.direct[i].map(f64::from)),
            Channels::Mono { .. } => f64::from(frame.direct[i][0]),
        };
        let through = |i: usize| match frame.channels {
            Channels::Rgb => f64::from(frame.truth.transmittance[i][1]),
            Channels::Mono { .. } => f64::from(frame.truth.transmittance[i][0]),
        };
        let mean = |pixels: &[usize]| {
            let (mut sum, mut count) = (0.0, 0);
            for &i in pixels {
                let t = through(i);
                if t >= LEAST_TRANSMITTANCE {
                    sum += direct(i) / t;
                    count += 1;
                }
            }
            (2 * count > pixels.len()).then(|| sum / f64::from(count as u32))
        };
        let (thing, ground) = (mean(&self.inside)?, mean(&self.around)?);
        (ground > 0.0).then(|| thing / ground - 1.0)
    }
}
