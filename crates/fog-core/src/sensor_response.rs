//! What the three kinds of pixel of a colour sensor see of each wavelength.

use crate::colour::{Observer, ROWS, Rgb, integral, invert, lanes, row_nm};
use crate::spectrum::{LANES, Wavelengths};

/// Responses of red, green and blue pixels to radiance relative to D65, over 380 to 780 nm, scaled so that green's to D65
/// white of radiance 1 is 1.
#[derive(Clone, Debug)]
pub struct SensorResponse {
    rows: [[f32; 3]; ROWS],
    electrons_per_lx_s_m2: f64,
}

impl SensorResponse {
    /// The sensor whose red, green and blue pixels turn photons into electrons with these probabilities, by wavelength in nm;
    /// they are taken at every 5 nm and linear between. None if green pixels see nothing of D65.
    #[must_use]
    pub fn new(observer: &Observer, quantum_efficiency: impl Fn(f64) -> [f64; 3]) -> Option<Self> {
        let at: Vec<[f64; 3]> = (0..ROWS).map(|i| quantum_efficiency(f64::from(row_nm(i)))).collect();
        // Photons of relative radiance 1 by row.
        let seen = |i: usize, c: usize| at[i][c] * f64::from(observer.d65(row_nm(i))) * f64::from(row_nm(i));
        let rows = core::array::from_fn(|i| core::array::from_fn(|c| seen(i, c) as f32));
        let [_, green, _] = integral(&rows, |_| 1.0);
        if !(green > 0.0 && green.is_finite()) {
            return None;
        }
        Some(Self {
            rows: core::array::from_fn(|i| core::array::from_fn(|c| (seen(i, c) / green) as f32)),
            electrons_per_lx_s_m2: observer.photons(|i| at[i][1]),
        })
    }

    /// What one lane of relative radiance 1 adds to the channels.
    #[inline]
    #[must_use]
    pub fn lane_response(&self, wavelengths: &Wavelengths) -> [Rgb; LANES] {
        lanes(&self.rows, wavelengths)
    }

    /// The channels' values of a relative spectrum given as a function of wavelength.
    #[must_use]
    pub fn channels_of(&self, spectrum: impl Fn(f32) -> f32) -> [f64; 3] {
        integral(&self.rows, |i| f64::from(spectrum(row_nm(i))))
    }

    /// Electrons per m² of a green pixel's area that D65 of 1 lx s gives.
    #[must_use]
    pub fn electrons_per_lx_s_m2(&self) -> f64 {
        self.electrons_per_lx_s_m2
    }

    /// Linear sRGB from the channels, row by row: the matrix that gives the colours of the three spectra that colours are made of
    /// ([`Observer::lane_basis`]) back, and so under D65 those of all surfaces and lights with such spectra. None if the
    /// channels do not tell the three apart.
    #[must_use]
    pub fn srgb_from_channels(&self, observer: &Observer) -> Option<[[f64; 3]; 3]> {
        let seen: [[f64; 3]; 3] =
            core::array::from_fn(|p| integral(&self.rows, |i| f64::from(observer.basis_row(i)[p])));
        let matrix = invert(core::array::from_fn(|c| core::array::from_fn(|p| seen[p][c])));
        matrix.as_flattened().iter().all(|v| v.is_finite() && v.abs() < 1e6).then_some(matrix)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::colour::upsample;

    /// The quantum efficiencies whose channels are linear sRGB (with negative parts).
    fn srgb(observer: &Observer) -> SensorResponse {
        let curve = |nm: f64| {
            let w = Wavelengths::monochromatic(nm as f32);
            observer.lane_response(&w)[0].map(|v| f64::from(v) / (f64::from(observer.d65(nm as f32)) * nm))
        };
        SensorResponse::new(observer, curve).expect("green sees")
    }

    #[test]
    fn the_observers_curves_give_the_observers_values() {
        let observer = Observer::new();
        let sensor = srgb(&observer);
        for k in 0..50 {
            let w = observer.sample_wavelengths(k as f32 / 50.0);
            let (a, b) = (observer.lane_response(&w), sensor.lane_response(&w));
            for (a, b) in a.as_flattened().iter().zip(b.as_flattened()) {
                assert!((a - b).abs() <= 3e-6 * a.abs().max(0.1), "{a} {b}");
            }
        }
        let identity = sensor.srgb_from_channels(&observer).expect("three colours");
        for (r, row) in identity.iter().enumerate() {
            for (c, v) in row.iter().enumerate() {
                assert!((v - f64::from(u8::from(r == c))).abs() < 2e-5, "{identity:?}");
            }
        }
    }

    #[test]
    fn colours_come_back_through_other_curves() {
        let observer = Observer::new();
        let bump = |nm: f64, centre: f64| (1.0 - ((nm - centre) / 90.0).powi(2)).max(0.0);
        let sensor = SensorResponse::new(&observer, |nm| [600.0, 540.0, 460.0].map(|c| 0.5 * bump(nm, c)))
            .expect("green sees");
        assert!((sensor.channels_of(|_| 1.0)[1] - 1.0).abs() < 1e-6);
        let matrix = sensor.srgb_from_channels(&observer).expect("three colours");
        for colour in [[1.0, 1.0, 1.0], [0.8, 0.1, 0.3], [0.0, 0.5, 0.9]] {
            let spectrum =
                |nm: f32| upsample(colour, &observer.lane_basis(&Wavelengths::monochromatic(nm)))[0];
            let seen = sensor.channels_of(spectrum);
            for c in 0..3 {
                let got: f64 = (0..3).map(|k| matrix[c][k] * seen[k]).sum();
                assert!((got - f64::from(colour[c])).abs() < 1e-5, "{colour:?}: {got}");
            }
        }
        assert!(SensorResponse::new(&observer, |_| [1.0, 0.0, 1.0]).is_none());
        let grey = SensorResponse::new(&observer, |_| [0.5; 3]).expect("green sees");
        assert!(grey.srgb_from_channels(&observer).is_none());
    }

    #[test]
    fn photons_are_counted() {
        let observer = Observer::new();
        // 1 lm at 555 nm is 1/683 W, or 4.09e15 photons a second; D65's photons weighed with V are about as many.
        let photopic = observer.photopic_photons_per_lx_s();
        assert!((photopic / 4.09e15 - 1.0).abs() < 0.02, "{photopic:e}");
        // Through a band around 555 nm alone the two definitions agree.
        let luminous = |nm: f64| {
            let w = Wavelengths::monochromatic(nm as f32);
            let [r, g, b] = observer.lane_response(&w)[0].map(f64::from);
            (0.2126 * r + 0.7152 * g + 0.0722 * b) / f64::from(observer.d65(nm as f32))
        };
        let peak = luminous(555.0);
        let sensor = SensorResponse::new(&observer, |nm| [luminous(nm) / peak; 3]).expect("green sees");
        assert!((sensor.electrons_per_lx_s_m2() / photopic - 1.0).abs() < 2e-3);
    }
}
