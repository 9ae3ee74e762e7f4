//! From radiance to what the brightest shown value is: the factor `exposure`, whose product with a radiance is 1 at white.

use core::f64::consts::FRAC_PI_4;

/// Focal-plane exposure in lx·s at which a camera of ISO 1 saturates: S = 78 / H (ISO 12232:2006, saturation-based speed).
pub const SATURATION_LX_S: f64 = 78.0;

/// A photographer's exposure.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Photographic {
    /// Saturation-based ISO speed, above 0.
    pub iso: f64,
    /// Time that the shutter is open, in s, above 0.
    pub shutter_s: f64,
    /// Focal length over the diameter of the entrance pupil, above 0.
    pub f_number: f64,
    /// Share of the light that the lens lets through, above 0 up to 1.
    pub lens_transmission: f64,
}

impl Photographic {
    /// Focal-plane exposure in lx·s that a luminance of 1 cd/m² gives on the axis of a lens focused far away:
    /// H / L = π/4 · T t / N² (ISO 12232:2006; its q = 0.65 is π/4 · T with T = 0.9 and the losses 10° off the axis, which
    /// here are vignetting's).
    #[must_use]
    pub fn lx_s_per_cd_m2(&self) -> f64 {
        FRAC_PI_4 * self.lens_transmission * self.shutter_s / (self.f_number * self.f_number)
    }

    /// Luminance in cd/m² on the axis that just saturates.
    #[must_use]
    pub fn saturation_cd_m2(&self) -> f64 {
        SATURATION_LX_S / self.iso / self.lx_s_per_cd_m2()
    }

    /// The factor that makes the saturating luminance 1; `luminance_of_one_cd_m2` is what radiance 1 stands for.
    #[must_use]
    pub fn factor(&self, luminance_of_one_cd_m2: f64) -> f64 {
        luminance_of_one_cd_m2 / self.saturation_cd_m2()
    }
}

/// The factor that makes a percentile of luminances `target`; none if that percentile is not above 0.
///
/// `percentile` is in [0, 1]; between two ranks it is linear (definition 7 of Hyndman & Fan 1996, "Sample quantiles in
/// statistical packages"). The order of the luminances does not matter; values that are not finite are left out.
#[must_use]
pub fn automatic(luminances: impl Iterator<Item = f64>, percentile: f64, target: f64) -> Option<f64> {
    let mut sorted: Vec<f64> = luminances.filter(|l| l.is_finite()).collect();
    sorted.sort_unstable_by(f64::total_cmp);
    let last = sorted.len().checked_sub(1)?;
    let rank = percentile.clamp(0.0, 1.0) * last as f64;
    let lower = (rank as usize).min(last);
    let upper = (lower + 1).min(last);
    let luminance = sorted[lower] + (sorted[upper] - sorted[lower]) * (rank - lower as f64);
    Some(target / luminance).filter(|factor| factor.is_finite() && *factor > 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_percentile_becomes_the_target() {
        let values = || (0..=100).rev().map(f64::from);
        assert_eq!(automatic(values(), 0.5, 0.18), Some(0.18 / 50.0));
        assert_eq!(automatic(values(), 1.0, 1.0), Some(0.01));
        // Between ranks 99 and 100 of 0 to 100.
        let factor = automatic(values(), 0.995, 0.8).expect("bright");
        assert!((factor - 0.8 / 99.5).abs() < 1e-15);
        assert_eq!(automatic([3.0, f64::NAN, 5.0].into_iter(), 0.0, 6.0), Some(2.0));
    }

    #[test]
    fn darkness_has_no_exposure() {
        assert_eq!(automatic([0.0; 4].into_iter(), 0.99, 0.8), None);
        assert_eq!(automatic([-1.0, -2.0].into_iter(), 0.5, 0.8), None);
        assert_eq!(automatic(core::iter::empty(), 0.5, 0.8), None);
    }

    #[test]
    fn photographic_exposure_is_that_of_the_standard() {
        // ISO 12232's meter: f/8, 1/250 s, ISO 400 (EV100 11.97), q = 0.65: factor 2.083e-4 per cd/m².
        let standard = Photographic {
            iso: 400.0,
            shutter_s: 1.0 / 250.0,
            f_number: 8.0,
            lens_transmission: 0.65 / FRAC_PI_4,
        };
        assert!((standard.factor(1.0) / 2.083_333e-4 - 1.0).abs() < 1e-6, "{}", standard.factor(1.0));
        // A stop is a stop, whichever way.
        let p = Photographic { iso: 100.0, shutter_s: 0.01, f_number: 4.0, lens_transmission: 0.9 };
        let twice = [
            Photographic { iso: 200.0, ..p },
            Photographic { shutter_s: 0.02, ..p },
            Photographic { lens_transmission: 1.8, ..p },
            Photographic { f_number: 4.0 / 2.0f64.sqrt(), ..p },
        ];
        for q in twice {
            assert!((q.factor(7.0) / p.factor(7.0) - 2.0).abs() < 1e-12);
        }
        assert!((p.factor(p.saturation_cd_m2()) - 1.0).abs() < 1e-12);
    }
}
