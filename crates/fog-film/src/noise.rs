//! The noise of single pixels, relative to what they show.

use crate::Frame;

/// Share of a frame's mean luminance below which the error of a pixel counts as if the pixel were that bright: relative
/// errors of what is black beside the rest of the picture say nothing, and could never be met.
const FLOOR_SHARE: f64 = 0.01;

/// Least luminance that errors are relative to, in a frame of this mean luminance: 1 % of it.
#[must_use]
pub fn noise_floor(mean_luminance: f64) -> f64 {
    FLOOR_SHARE * mean_luminance.max(0.0)
}

/// `error` over `luminance`, or over the floor where that is more; 0 where there is no error.
#[must_use]
pub fn relative_error(error: f64, luminance: f64, floor: f64) -> f64 {
    let over = luminance.max(floor);
    if error > 0.0 && over > 0.0 { error / over } else { 0.0 }
}

/// How noisy the pixels of a frame are: standard errors of their luminance over their luminance or the floor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PixelNoise {
    /// [`noise_floor`] of the frame.
    pub floor: f64,
    /// Share of the pixels that are no noisier than asked for, 0 to 1.
    pub within: f64,
    /// Root mean square over the pixels.
    pub rms: f64,
    /// Of the noisiest pixel.
    pub largest: f64,
}

impl Frame {
    /// The noise of this frame's pixels against a target (relative standard error, e.g. 0.02).
    #[must_use]
    pub fn pixel_noise(&self, target: f64) -> PixelNoise {
        let count = self.pixel_count();
        let n = count.max(1) as f64;
        let mean = (0..count).map(|i| self.luminance(i)).sum::<f64>() / n;
        let floor = noise_floor(mean);
        let (mut within, mut squares, mut largest) = (0u64, 0.0, 0.0f64);
        for i in 0..count {
            let noise = relative_error(f64::from(self.standard_error[i]), self.luminance(i), floor);
            // The frame's f32 may have rounded a pixel over the target that it was stopped at.
            within += u64::from(noise <= target * (1.0 + 1e-6));
            squares += noise * noise;
            largest = largest.max(noise);
        }
        PixelNoise { floor, within: within as f64 / n, rms: (squares / n).sqrt(), largest }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Channels, PixelFilm, Truth};

    #[test]
    fn errors_are_relative_to_the_pixel_or_the_floor() {
        let pixel = |values: [f32; 2]| {
            let mut film = PixelFilm::default();
            values.iter().for_each(|&v| film.add_mono(v, 0.0));
            film
        };
        // Standard errors 0, 1 and 0.001; mean luminance 4.
        let pixels = [pixel([2.0; 2]), pixel([9.0, 11.0]), pixel([0.0, 0.002])];
        let truth = Truth {
            depth_m: vec![1.0; 3],
            distance_m: vec![1.0; 3],
            transmittance: vec![[1.0; 3]; 3],
            tau: vec![0.0; 3],
            ..Truth::default()
        };
        let mono = Channels::Mono { wavelength_nm: 550.0 };
        let frame = Frame::from_pixels(3, 1, mono, &pixels, truth).expect("valid frame");
        let noise = frame.pixel_noise(0.05);
        assert!((noise.floor / 0.040_003_333 - 1.0).abs() < 1e-6, "{noise:?}");
        assert!((noise.largest - 0.1).abs() < 1e-6, "{noise:?}");
        // The dark pixel's error of 100 % is 2.5 % of the floor.
        assert!((noise.within - 2.0 / 3.0).abs() < 1e-12, "{noise:?}");
        let dark = 0.001 / noise.floor;
        assert!((noise.rms - ((0.01 + dark * dark) / 3.0f64).sqrt()).abs() < 1e-6, "{noise:?}");
        assert_eq!(relative_error(0.0, 0.0, 0.0), 0.0);
    }
}
