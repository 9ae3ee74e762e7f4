//! Exposure, and the model of the sensor.

use std::path::{Path, PathBuf};

use serde::Serialize;

/// What the values of a picture are multiplied with before its white is 1.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(untagged)]
pub enum ExposureSpec {
    /// This factor, above 0.
    Factor(f64),
    /// The factor that makes a percentile of the frame's luminances the target.
    Automatic {
        /// Share of the pixels that are darker, 0 to 1.
        percentile: f64,
        /// What their upper end becomes, above 0; 1 is white.
        target: f64,
    },
    /// A photographer's: white is what saturates at this ISO speed.
    Photographic {
        /// Saturation-based ISO speed (ISO 12232), 1 to 10 000 000.
        iso: f64,
        /// Time that the shutter is open, in s, 1e-6 to 3600.
        shutter_s: f64,
        /// Focal length over the diameter of the entrance pupil, 0.5 to 128.
        f_number: f64,
        /// Share of the light that the lens lets through, above 0 up to 1.
        lens_transmission: f64,
    },
}

/// A sensor behind a lens, with all its values.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SensorModelSpec {
    /// Colour filters of the four pixels of a cell.
    pub bayer: BayerSpec,
    /// Bits of the converter, 6 to 16.
    pub adc_bits: u32,
    /// Number for no light, below half of the converter's largest.
    pub black_level: u32,
    /// Most electrons of a pixel, 100 to 10 000 000.
    pub full_well_e: f64,
    /// Standard deviation of the noise of reading in electrons, 0 to 10 000.
    pub read_noise_e: f64,
    /// Mean dark electrons of a pixel per second, 0 to 1 000 000.
    pub dark_current_e_s: f64,
    /// Time that dark electrons gather in, in s, where the exposure is no photographer's; else absent.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub shutter_s: Option<f64>,
    /// A full well is so many times what saturates the converter, where the exposure is no photographer's; else absent.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub gain: Option<f64>,
    /// Side of a pixel in µm, 0.5 to 50.
    pub pixel_um: f64,
    /// Greatest quantum efficiency of green pixels, above 0 up to 1; not used by curves that are quantum efficiencies.
    pub quantum_efficiency: f64,
    /// Photo response nonuniformity: standard deviation of the pixels' responses over their mean, 0 to 0.5. Left out where it is 0.
    #[serde(skip_serializing_if = "is_zero")]
    pub prnu_1288: f64,
    /// Dark signal nonuniformity: standard deviation of the pixels' dark signals in electrons, 0 to 10 000. Left out where it is 0.
    #[serde(skip_serializing_if = "is_zero")]
    pub dsnu_1288_e: f64,
    /// Seed of the fixed pattern; absent where there is none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub pattern_seed: Option<u64>,
    /// Whether electrons are counted at random.
    pub photon_noise: bool,
    /// What the pixels see of each wavelength.
    pub response: ResponseSpec,
    /// How the lens spreads light.
    pub psf: PsfSpec,
    /// How the lens darkens corners.
    pub vignetting: VignettingSpec,
    /// Seed of the noise; absent: it follows from the frame's.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub noise_seed: Option<u64>,
}

/// Colour filters: upper row, lower row.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum BayerSpec {
    /// Red, green / green, blue.
    Rggb,
    /// Blue, green / green, red.
    Bggr,
    /// Green, red / blue, green.
    Grbg,
    /// Green, blue / red, green.
    Gbrg,
}

/// Spectral response of the pixels.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum ResponseSpec {
    /// Linear sRGB by the CIE observer, as `hdr`.
    Cie,
    /// The curves of a Nikon D5100 (`tables/sensor`).
    NikonD5100,
    /// A CSV file of curves, as written in the configuration.
    File(PathBuf),
}

/// Point-spread function.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum PsfSpec {
    /// None.
    None,
    /// Gaussian with this standard deviation in pixels, 0.05 to 16.
    GaussianPx(f64),
    /// Airy's disc at this f-number, 0.5 to 128.
    AiryFNumber(f64),
}

/// Vignetting.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum VignettingSpec {
    /// None.
    None,
    /// Fourth power of the cosine from the axis.
    Cos4,
    /// Coefficients of r², r⁴ and r⁶, r in half diagonals; each −10 to 10.
    Polynomial([f64; 3]),
}

impl SensorModelSpec {
    /// File of the curves, as written in the configuration.
    #[must_use]
    pub fn response_file(&self) -> Option<&Path> {
        match &self.response {
            ResponseSpec::File(file) => Some(file),
            _ => None,
        }
    }
}

fn is_zero(value: &f64) -> bool {
    *value == 0.0
}
