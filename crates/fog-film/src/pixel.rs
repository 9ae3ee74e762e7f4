//! Sums of one pixel.

use fog_core::colour::{Rgb, luminance};
use fog_core::moments::Moments;

/// Accumulator of one pixel: f64 sums of direct light and airlight, and moments of the luminance of their total.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PixelFilm {
    direct: [f64; 3],
    airlight: [f64; 3],
    luminance: Moments,
}

impl PixelFilm {
    /// Adds one sample in linear sRGB: light that came straight through, and light scattered in the fog.
    #[inline]
    pub fn add(&mut self, direct: Rgb, airlight: Rgb) {
        let mut total = [0.0; 3];
        for c in 0..3 {
            let (d, a) = (f64::from(direct[c]), f64::from(airlight[c]));
            self.direct[c] += d;
            self.airlight[c] += a;
            total[c] = d + a;
        }
        self.luminance.add(luminance(total));
    }

    /// Adds one sample of a single-wavelength frame: channel 0 holds it, and it is its own luminance.
    #[inline]
    pub fn add_mono(&mut self, direct: f32, airlight: f32) {
        let (d, a) = (f64::from(direct), f64::from(airlight));
        self.direct[0] += d;
        self.airlight[0] += a;
        self.luminance.add(d + a);
    }

    /// Number of samples so far.
    #[must_use]
    pub fn samples(&self) -> u64 {
        self.luminance.n
    }

    /// Mean direct light; 0 without samples.
    #[must_use]
    pub fn direct(&self) -> Rgb {
        self.mean(self.direct)
    }

    /// Mean airlight; 0 without samples.
    #[must_use]
    pub fn airlight(&self) -> Rgb {
        self.mean(self.airlight)
    }

    /// Moments of the luminance of direct light plus airlight.
    #[must_use]
    pub fn luminance(&self) -> &Moments {
        &self.luminance
    }

    fn mean(&self, sums: [f64; 3]) -> Rgb {
        let n = self.luminance.n.max(1) as f64;
        sums.map(|s| (s / n) as f32)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn means_and_luminance() {
        let mut p = PixelFilm::default();
        assert_eq!(p.direct(), [0.0; 3]);
        p.add([1.0, 2.0, 3.0], [0.5, 0.0, 0.0]);
        p.add([3.0, 2.0, 1.0], [0.0, 0.5, 0.0]);
        assert_eq!(p.samples(), 2);
        assert_eq!(p.direct(), [2.0, 2.0, 2.0]);
        assert_eq!(p.airlight(), [0.25, 0.25, 0.0]);
        let want = luminance([2.25, 2.25, 2.0]);
        assert!((p.luminance().mean() - want).abs() < 1e-12);
        assert!(p.luminance().standard_error() > 0.0);
    }

    #[test]
    fn sums_do_not_drown_small_samples() {
        let mut p = PixelFilm::default();
        p.add_mono(1.0e8, 0.0);
        for _ in 0..1000 {
            p.add_mono(1.0, 0.0); // each would vanish in an f32 sum
        }
        assert!((f64::from(p.direct()[0]) / (100_001_000.0 / 1001.0) - 1.0).abs() < 1e-7);
    }
}
