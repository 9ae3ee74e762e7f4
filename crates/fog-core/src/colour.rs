//! From radiance by wavelength to linear sRGB, and from sRGB colours to spectra.
//!
//! Inside the renderer radiance is *relative to D65*: L̃(λ) = L(λ) / (k S(λ)), with S the standard illuminant D65 and k one
//! constant. A light of scalar radiance x is then L̃ = x at every wavelength, a grey surface is a constant, and the film's
//! three responses each integrate to 1, so that x is recorded as R = G = B = x. Emission and reflectance colours become
//! spectra by the same three basis functions (`tables/cie/srgb_basis_5nm.csv`), whose mixtures give back their weights.
//!
//! Sources: `tables/cie/README.md`.

use crate::bands::{BAND_STEP_NM, BANDS, BandSpectrum};
use crate::sensor_response::SensorResponse;
use crate::spectrum::{LANES, Spectrum, Wavelengths};

/// First wavelength of the visible range that is rendered, in nm.
pub const VISIBLE_MIN_NM: f32 = 380.0;
/// Last wavelength of the visible range that is rendered, in nm.
pub const VISIBLE_MAX_NM: f32 = 780.0;
/// Luminous efficacy in lm/W of radiation whose luminous efficiency is 1 (SI, with V(λ) of standard air).
const EFFICACY_LM_W: f64 = 683.002;
pub(crate) const STEP_NM: f32 = 5.0;
/// Rows of the tables over wavelength, 380 to 780 nm.
pub(crate) const ROWS: usize = 81;
/// Planck constant times speed of light in J m (SI).
const PLANCK_LIGHT_J_M: f64 = 6.626_070_15e-34 * 299_792_458.0;

const OBSERVER: &str = include_str!("../../../tables/cie/observer_d65_5nm.csv");
const BASIS: &str = include_str!("../../../tables/cie/srgb_basis_5nm.csv");

/// Linear sRGB triple.
pub type Rgb = [f32; 3];

/// Wavelength sampling, film response and colour upsampling; build once, share by reference.
#[derive(Clone, Debug)]
pub struct Observer {
    response: [[f32; 3]; ROWS],
    basis: [[f32; 3]; ROWS],
    d65: [f32; ROWS],
    /// Spectral radiance at 560 nm of D65 of 1 cd/m², in W m⁻² sr⁻¹ nm⁻¹.
    d65_of_one_cd_m2: f64,
    /// Photons per m² of D65 of 1 lx s, each weighed with the luminous efficiency V(λ).
    photopic_photons: f64,
    sensor: Option<SensorResponse>,
}

/// Parses a CSV of numbers with one header line that is part of this program.
fn rows<const N: usize>(csv: &str) -> [[f64; N]; ROWS] {
    let mut out = [[0.0; N]; ROWS];
    for (row, line) in out.iter_mut().zip(csv.lines().skip(1)) {
        for (cell, text) in row.iter_mut().zip(line.split(',')) {
            *cell = text.parse().expect("embedded table is numeric");
        }
    }
    out
}

/// Integral of a function that is linear between the 5 nm rows.
pub(crate) fn integrate(values: impl Fn(usize) -> f64) -> f64 {
    (0..ROWS - 1).map(|i| 0.5 * f64::from(STEP_NM) * (values(i) + values(i + 1))).sum()
}

/// Inverse of a 3×3 matrix (rows), by cofactors.
pub(crate) fn invert(m: [[f64; 3]; 3]) -> [[f64; 3]; 3] {
    let minor = |r: usize, c: usize| {
        let (r0, r1, c0, c1) = ((r + 1) % 3, (r + 2) % 3, (c + 1) % 3, (c + 2) % 3);
        m[r0][c0] * m[r1][c1] - m[r0][c1] * m[r1][c0]
    };
    let det: f64 = (0..3).map(|c| m[0][c] * minor(0, c)).sum();
    core::array::from_fn(|r| core::array::from_fn(|c| minor(c, r) / det))
}

impl Default for Observer {
    fn default() -> Self {
        Self::new()
    }
}

impl Observer {
    /// CIE 1931 2° observer, D65, sRGB primaries (IEC 61966-2-1) with the tabulated D65 as white.
    #[must_use]
    pub fn new() -> Self {
        let observer = rows::<5>(OBSERVER);
        let basis = rows::<4>(BASIS);
        let weighted = |i: usize, c: usize| observer[i][1 + c] * observer[i][4];

        // XYZ of the primaries, scaled so that D65 is (1, 1, 1).
        let xy = [[0.64, 0.33], [0.30, 0.60], [0.15, 0.06]];
        let primaries: [[f64; 3]; 3] = core::array::from_fn(|c| {
            core::array::from_fn(|p| [xy[p][0], xy[p][1], 1.0 - xy[p][0] - xy[p][1]][c] / xy[p][1])
        });
        let luminance = integrate(|i| weighted(i, 1));
        let white: [f64; 3] = core::array::from_fn(|c| integrate(|i| weighted(i, c)) / luminance);
        let inverse = invert(primaries);
        let scale: [f64; 3] =
            core::array::from_fn(|p| (0..3).map(|c| inverse[p][c] * white[c]).sum::<f64>() * luminance);

        let mut this = Self {
            response: [[0.0; 3]; ROWS],
            basis: [[0.0; 3]; ROWS],
            d65: [0.0; ROWS],
            d65_of_one_cd_m2: 100.0 / (EFFICACY_LM_W * luminance),
            photopic_photons: 0.0,
            sensor: None,
        };
        for i in 0..ROWS {
            for p in 0..3 {
                this.response[i][p] =
                    ((0..3).map(|c| inverse[p][c] * weighted(i, c)).sum::<f64>() / scale[p]) as f32;
                this.basis[i][p] = basis[i][1 + p] as f32;
            }
            this.d65[i] = (observer[i][4] / 100.0) as f32;
        }
        this.photopic_photons = this.photons(|i| observer[i][2]);
        this
    }

    /// The same observer with a sensor beside it, whose three channels are recorded too.
    #[must_use]
    pub fn with_sensor(self, sensor: SensorResponse) -> Self {
        Self { sensor: Some(sensor), ..self }
    }

    /// The sensor beside it.
    #[inline]
    #[must_use]
    pub fn sensor(&self) -> Option<&SensorResponse> {
        self.sensor.as_ref()
    }

    /// Photons per m² that D65 of 1 lx s brings, each weighed with the luminous efficiency V(λ).
    #[must_use]
    pub fn photopic_photons_per_lx_s(&self) -> f64 {
        self.photopic_photons
    }

    /// Photons per m² of D65 of 1 lx s, weighed with `weights` by row: ∫ w(λ) S(λ) λ/(hc) dλ.
    pub(crate) fn photons(&self, weights: impl Fn(usize) -> f64) -> f64 {
        let at = |i: usize| weights(i) * f64::from(self.d65[i]) * f64::from(row_nm(i)) * 1e-9;
        integrate(at) * self.d65_of_one_cd_m2 / PLANCK_LIGHT_J_M
    }

    /// A basis spectrum at a row.
    pub(crate) fn basis_row(&self, i: usize) -> [f32; 3] {
        self.basis[i]
    }

    #[inline]
    fn locate(nm: f32) -> (usize, f32) {
        let x = ((nm - VISIBLE_MIN_NM) / STEP_NM).clamp(0.0, (ROWS - 1) as f32);
        let i = (x as usize).min(ROWS - 2);
        (i, x - i as f32)
    }

    /// Hero and companions for a uniform number: evenly spaced over the visible range, the companions rotated from the hero.
    ///
    /// Even spacing integrates the smooth responses far better than spacing by their size does: with eight lanes a grey
    /// path is recorded with 4 % of colour noise instead of 13 %.
    #[must_use]
    pub fn sample_wavelengths(&self, u: f32) -> Wavelengths {
        let mut nm = [0.0; LANES];
        for (lane, nm) in nm.iter_mut().enumerate() {
            let x = u + lane as f32 / LANES as f32;
            let x = if x >= 1.0 { x - 1.0 } else { x };
            *nm = VISIBLE_MIN_NM + (VISIBLE_MAX_NM - VISIBLE_MIN_NM) * x;
        }
        Wavelengths { nm }
    }

    /// What one lane of relative radiance 1 adds to linear sRGB: response × range / LANES.
    #[must_use]
    pub fn lane_response(&self, wavelengths: &Wavelengths) -> [Rgb; LANES] {
        lanes(&self.response, wavelengths)
    }

    /// The three basis spectra at the wavelengths of a path; the spectrum of colour (r, g, b) is r·\[0\] + g·\[1\] + b·\[2\].
    #[must_use]
    pub fn lane_basis(&self, wavelengths: &Wavelengths) -> [Spectrum; 3] {
        let mut out = [Spectrum::ZERO; 3];
        for lane in 0..LANES {
            let (i, t) = Self::locate(wavelengths.nm[lane]);
            for c in 0..3 {
                out[c][lane] = self.basis[i][c] + (self.basis[i + 1][c] - self.basis[i][c]) * t;
            }
        }
        out
    }

    /// Relative spectral power of D65 (S(560 nm) = 1) at a wavelength: physical radiance = relative radiance × this × k.
    #[must_use]
    pub fn d65(&self, nm: f32) -> f32 {
        let (i, t) = Self::locate(nm);
        self.d65[i] + (self.d65[i + 1] - self.d65[i]) * t
    }

    /// Physical spectral radiance (W m⁻² sr⁻¹ nm⁻¹, means over the bands) relative to D65 of 1 cd/m²: what is recorded of it as
    /// luminance is in cd/m². Of irradiance (W m⁻² nm⁻¹) the same in lx.
    #[must_use]
    pub fn relative_to_d65(&self, physical: &[f64; BANDS]) -> BandSpectrum {
        // Rows on either side of a band's centre that its mean takes in, by the trapezoidal rule.
        let reach = (0.5 * BAND_STEP_NM / STEP_NM) as i64;
        let mean = |band: usize| {
            let centre = (BandSpectrum::centre_nm(band) - VISIBLE_MIN_NM) / STEP_NM;
            let rows = (-reach..=reach).filter_map(|d| {
                let row = usize::try_from(centre as i64 + d).ok().filter(|&row| row < ROWS)?;
                let ends = d.abs() == reach || (d == 0 && (band == 0 || band == BANDS - 1));
                Some((f64::from(self.d65[row]), if ends { 0.5 } else { 1.0 }))
            });
            let (sum, weights) =
                rows.fold((0.0, 0.0), |(s, w), (d65, weight)| (s + d65 * weight, w + weight));
            sum / weights
        };
        BandSpectrum(core::array::from_fn(|band| {
            (physical[band] / (mean(band) * self.d65_of_one_cd_m2)) as f32
        }))
    }

    /// Linear sRGB of a relative spectrum given as a function of wavelength (piecewise linear between the 5 nm rows).
    #[must_use]
    pub fn rgb_of(&self, spectrum: impl Fn(f32) -> f32) -> [f64; 3] {
        integral(&self.response, |i| f64::from(spectrum(row_nm(i))))
    }
}

/// Wavelength of a row in nm.
pub(crate) fn row_nm(i: usize) -> f32 {
    VISIBLE_MIN_NM + STEP_NM * i as f32
}

/// What one lane of relative radiance 1 adds to three channels with responses by row.
#[inline]
pub(crate) fn lanes(response: &[[f32; 3]; ROWS], wavelengths: &Wavelengths) -> [Rgb; LANES] {
    wavelengths.nm.map(|nm| {
        let (i, t) = Observer::locate(nm);
        let k = (VISIBLE_MAX_NM - VISIBLE_MIN_NM) / LANES as f32;
        core::array::from_fn(|c| (response[i][c] + (response[i + 1][c] - response[i][c]) * t) * k)
    })
}

/// Integrals over wavelength of three responses times a spectrum, both linear between the rows.
pub(crate) fn integral(response: &[[f32; 3]; ROWS], spectrum: impl Fn(usize) -> f64) -> [f64; 3] {
    core::array::from_fn(|c| {
        (0..ROWS - 1)
            .map(|i| {
                let (r0, r1) = (f64::from(response[i][c]), f64::from(response[i + 1][c]));
                let (s0, s1) = (spectrum(i), spectrum(i + 1));
                f64::from(STEP_NM) / 6.0 * (r0 * (2.0 * s0 + s1) + r1 * (s0 + 2.0 * s1))
            })
            .sum()
    })
}

/// Value of a colour's spectrum at the lanes of a path.
#[inline(always)]
#[must_use]
pub fn upsample(rgb: Rgb, basis: &[Spectrum; 3]) -> Spectrum {
    basis[0] * rgb[0] + basis[1] * rgb[1] + basis[2] * rgb[2]
}

/// Relative luminance of linear sRGB (IEC 61966-2-1).
#[inline]
#[must_use]
pub fn luminance(rgb: [f64; 3]) -> f64 {
    0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2]
}

/// sRGB transfer function: linear value to the encoded one, both in [0, 1] (clamped).
#[must_use]
pub fn srgb_encode(linear: f32) -> f32 {
    let x = linear.clamp(0.0, 1.0);
    if x <= 0.003_130_8 { 12.92 * x } else { 1.055 * crate::math::f32::pow(x, 1.0 / 2.4) - 0.055 }
}

/// Inverse of [`srgb_encode`].
#[must_use]
pub fn srgb_decode(encoded: f32) -> f32 {
    let x = encoded.clamp(0.0, 1.0);
    if x <= 0.040_45 { x / 12.92 } else { crate::math::f32::pow((x + 0.055) / 1.055, 2.4) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn d65_is_white_and_the_basis_round_trips() {
        let o = Observer::new();
        for c in o.rgb_of(|_| 1.0) {
            assert!((c - 1.0).abs() < 2e-6, "white gives {c}");
        }
        for p in 0..3 {
            let rgb = o.rgb_of(|nm| {
                let (i, t) = Observer::locate(nm);
                o.basis[i][p] + (o.basis[i + 1][p] - o.basis[i][p]) * t
            });
            for (c, got) in rgb.iter().enumerate() {
                let want = if c == p { 1.0 } else { 0.0 };
                assert!((got - want).abs() < 3e-6, "basis {p} channel {c}: {got}");
            }
        }
        assert!((o.d65(560.0) - 1.0).abs() < 1e-6);
    }

    #[test]
    fn sampled_wavelengths_integrate_the_response() {
        let o = Observer::new();
        let n = 4096;
        let mut mean = [0.0f64; 3];
        for s in 0..n {
            let w = o.sample_wavelengths((s as f32 + 0.5) / n as f32);
            assert!(w.nm.iter().all(|&nm| (VISIBLE_MIN_NM..=VISIBLE_MAX_NM).contains(&nm)));
            for c in 0..3 {
                let grey: f32 = o.lane_response(&w).iter().map(|rgb| rgb[c]).sum();
                assert!((grey - 1.0).abs() < 0.12, "colour noise of a grey path: {grey}");
                mean[c] += f64::from(grey) / n as f64;
            }
        }
        for c in mean {
            assert!((c - 1.0).abs() < 1e-4, "{mean:?}");
        }
    }

    #[test]
    fn srgb_transfer_inverts() {
        for i in 0..=255 {
            let x = i as f32 / 255.0;
            assert!((srgb_encode(srgb_decode(x)) - x).abs() < 1e-5);
        }
    }
}
