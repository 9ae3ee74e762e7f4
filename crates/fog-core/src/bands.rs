//! Smooth spectra as values at a few even wavelengths: light of the sky and of the sun.

use crate::colour::{VISIBLE_MAX_NM, VISIBLE_MIN_NM};
use crate::spectrum::{LANES, Spectrum, Wavelengths};

/// Number of bands.
pub const BANDS: usize = 21;
/// Distance between the centres of two bands in nm; the first is at 380 nm, the last at 780 nm.
pub const BAND_STEP_NM: f32 = (VISIBLE_MAX_NM - VISIBLE_MIN_NM) / (BANDS - 1) as f32;

/// A spectrum that is linear between the centres of the bands.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BandSpectrum(pub [f32; BANDS]);

impl BandSpectrum {
    /// The same at every wavelength.
    pub const ONE: Self = Self([1.0; BANDS]);

    /// Centre of a band in nm.
    #[must_use]
    pub fn centre_nm(band: usize) -> f32 {
        VISIBLE_MIN_NM + BAND_STEP_NM * band as f32
    }

    /// A spectrum from its values at the centres, given as a function of nm.
    #[must_use]
    pub fn from_fn(mut f: impl FnMut(f32) -> f32) -> Self {
        Self(core::array::from_fn(|band| f(Self::centre_nm(band))))
    }

    /// Value at a wavelength in nm, clamped at both ends.
    #[must_use]
    pub fn at(&self, nm: f32) -> f32 {
        BandLanes::new(&Wavelengths::monochromatic(nm)).gather(&self.0)[0]
    }

    /// The spectrum times `k`.
    #[must_use]
    pub fn scaled(self, k: f32) -> Self {
        Self(self.0.map(|v| v * k))
    }
}

/// Where the wavelengths of a path fall between the bands.
#[derive(Clone, Copy, Debug)]
pub struct BandLanes {
    lower: [u8; LANES],
    weight: [f32; LANES],
}

impl BandLanes {
    /// Finds `wavelengths` among the bands, clamped at both ends.
    #[inline]
    #[must_use]
    pub fn new(wavelengths: &Wavelengths) -> Self {
        let (mut lower, mut weight) = ([0; LANES], [0.0; LANES]);
        for lane in 0..LANES {
            let x = (wavelengths.nm[lane] - VISIBLE_MIN_NM) / BAND_STEP_NM;
            let x = x.clamp(0.0, (BANDS - 1) as f32);
            let i = (x as usize).min(BANDS - 2);
            lower[lane] = i as u8;
            weight[lane] = x - i as f32;
        }
        Self { lower, weight }
    }

    /// Values of a spectrum at all lanes.
    #[inline(always)]
    #[must_use]
    pub fn gather(&self, bands: &[f32; BANDS]) -> Spectrum {
        let mut out = Spectrum::ZERO;
        for lane in 0..LANES {
            let i = (self.lower[lane] as usize).min(BANDS - 2);
            out[lane] = bands[i] + (bands[i + 1] - bands[i]) * self.weight[lane];
        }
        out
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn linear_spectra_are_kept() {
        let s = BandSpectrum::from_fn(|nm| 2.0 * nm - 300.0);
        for nm in [380.0, 391.0, 400.0, 555.5, 779.0, 780.0] {
            assert!((s.at(nm) - (2.0 * nm - 300.0)).abs() < 1e-3, "{nm}");
        }
        assert_eq!((s.at(300.0), s.at(900.0)), (s.0[0], s.0[BANDS - 1]));
    }
}
