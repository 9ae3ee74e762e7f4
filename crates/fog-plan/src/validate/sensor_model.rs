//! Checks of `sensor.model`, and of what goes with it.

use super::Check;
use crate::{
    frame::SensorSpec,
    ranges::{self, Range},
    schema::{
        BayerFile, ConfigFile, OutputFile, PsfFile, ResponseFile, SensorModelFile, SensorModelMap,
        SensorModelWord, SensorPreset, VignettingFile,
    },
    sensor::{BayerSpec, ExposureSpec, PsfSpec, ResponseSpec, SensorModelSpec, VignettingSpec},
};

const ADC_BITS: i64 = 12;
/// Time that dark electrons gather in where nothing says it, in s.
const SHUTTER_S: f64 = 0.01;
/// The sensor that a pattern is of where nothing says it.
const PATTERN_SEED: u64 = 1;

/// What presets differ in.
struct Preset {
    full_well_e: f64,
    read_noise_e: f64,
    dark_current_e_s: f64,
    pixel_um: f64,
    quantum_efficiency: f64,
}

/// Values of a preset. Those of the two sensors are EMVA 1288 figures of their monochrome versions, with the quantum efficiency at
/// 525 nm, as quoted by others in 2016: IMX174 at fhotolab.fherb.de, ICX625 (Point Grey's of the GS3-PGE-50S5M) at
/// mengineer.hatenablog.com. Dark currents are not among them.
fn preset(preset: SensorPreset) -> Preset {
    match preset {
        SensorPreset::Generic => Preset {
            full_well_e: 10_000.0,
            read_noise_e: 3.0,
            dark_current_e_s: 10.0,
            pixel_um: 3.0,
            quantum_efficiency: 0.5,
        },
        SensorPreset::Imx174 => Preset {
            full_well_e: 32_691.0,
            read_noise_e: 6.83,
            dark_current_e_s: 0.0,
            pixel_um: 5.86,
            quantum_efficiency: 0.77,
        },
        SensorPreset::Icx625 => Preset {
            full_well_e: 5903.0,
            read_noise_e: 8.28,
            dark_current_e_s: 0.0,
            pixel_um: 3.45,
            quantum_efficiency: 0.57,
        },
    }
}

impl Check<'_> {
    /// The sensor; the outer option is the check's success.
    pub(super) fn sensor_model(
        &mut self,
        file: Option<&SensorModelFile>,
        exposure: Option<&ExposureSpec>,
    ) -> Option<Option<SensorModelSpec>> {
        let named = |preset| SensorModelMap { preset, ..SensorModelMap::default() };
        let map = match file {
            None | Some(SensorModelFile::Word(SensorModelWord::None)) => return Some(None),
            Some(SensorModelFile::Word(SensorModelWord::Generic)) => &named(SensorPreset::Generic),
            Some(SensorModelFile::Word(SensorModelWord::Imx174)) => &named(SensorPreset::Imx174),
            Some(SensorModelFile::Word(SensorModelWord::Icx625)) => &named(SensorPreset::Icx625),
            Some(SensorModelFile::Map(map)) => map,
        };
        let base = preset(map.preset);
        let bits = self.whole(&path("adc_bits"), map.adc_bits.unwrap_or(ADC_BITS), ranges::ADC_BITS);
        let black_level = self.black_level(map, bits);
        let full_well_e =
            self.part("full_well_e", map.full_well_e.unwrap_or(base.full_well_e), ranges::FULL_WELL_E);
        let read =
            self.part("read_noise_e", map.read_noise_e.unwrap_or(base.read_noise_e), ranges::READ_NOISE_E);
        let dark = map.dark_current_e_s.unwrap_or(base.dark_current_e_s);
        let dark = self.part("dark_current_e_s", dark, ranges::DARK_CURRENT_E_S);
        let pixel_um = self.part("pixel_um", map.pixel_um.unwrap_or(base.pixel_um), ranges::PIXEL_UM);
        let efficiency = map.quantum_efficiency.unwrap_or(base.quantum_efficiency);
        let efficiency = self.part("quantum_efficiency", efficiency, ranges::QUANTUM_EFFICIENCY);
        let prnu = self.part("prnu_1288", map.prnu_1288.unwrap_or(0.0), ranges::PRNU);
        let dsnu = self.part("dsnu_1288_e", map.dsnu_1288_e.unwrap_or(0.0), ranges::DSNU_E);
        let own = self.not_photographic(map, exposure);
        let (psf, vignetting, response) =
            (self.psf(map.psf), self.vignetting(map.vignetting), self.response(map));
        let (shutter_s, gain) = own?;
        let (prnu_1288, dsnu_1288_e) = (prnu?, dsnu?);
        let pattern_seed = self.pattern_seed(map, prnu_1288 > 0.0 || dsnu_1288_e > 0.0)?;
        Some(Some(SensorModelSpec {
            bayer: match map.bayer {
                None | Some(BayerFile::Rggb) => BayerSpec::Rggb,
                Some(BayerFile::Bggr) => BayerSpec::Bggr,
                Some(BayerFile::Grbg) => BayerSpec::Grbg,
                Some(BayerFile::Gbrg) => BayerSpec::Gbrg,
            },
            adc_bits: bits?,
            black_level: black_level?,
            full_well_e: full_well_e?,
            read_noise_e: read?,
            dark_current_e_s: dark?,
            shutter_s,
            gain,
            pixel_um: pixel_um?,
            quantum_efficiency: efficiency?,
            prnu_1288,
            dsnu_1288_e,
            pattern_seed,
            photon_noise: map.photon_noise.unwrap_or(true),
            response: response?,
            psf: psf?,
            vignetting: vignetting?,
            noise_seed: map.noise_seed,
        }))
    }

    /// Seed of the fixed pattern, if there is one; the outer option is the check's success.
    fn pattern_seed(&mut self, map: &SensorModelMap, has_pattern: bool) -> Option<Option<u64>> {
        match map.pattern_seed {
            Some(_) if !has_pattern => {
                self.problem(&path("pattern_seed"), "there is no pattern: give prnu_1288 or dsnu_1288_e");
                None
            }
            seed => Some(has_pattern.then_some(seed.unwrap_or(PATTERN_SEED))),
        }
    }

    fn part(&mut self, key: &str, value: f64, range: Range) -> Option<f64> {
        self.range(&path(key), value, range)
    }

    fn black_level(&mut self, map: &SensorModelMap, bits: Option<u32>) -> Option<u32> {
        let bits = bits?;
        let range = 1i64 << bits;
        let level = map.black_level.unwrap_or(range / 64);
        let level = self.whole(&path("black_level"), level, ranges::BLACK_LEVEL)?;
        if i64::from(level) >= range / 2 {
            let message =
                format!("{level} is half of the range of {bits} bits or more; valid: 0 to {}", range / 2 - 1);
            self.problem(&path("black_level"), message);
            return None;
        }
        Some(level)
    }

    /// Shutter and gain, which a photographer's exposure has itself; the outer option is the check's success.
    fn not_photographic(
        &mut self,
        map: &SensorModelMap,
        exposure: Option<&ExposureSpec>,
    ) -> Option<(Option<f64>, Option<f64>)> {
        if !matches!(exposure, Some(ExposureSpec::Photographic { .. })) {
            let shutter = self.part("shutter_s", map.shutter_s.unwrap_or(SHUTTER_S), ranges::SHUTTER_S);
            let gain = self.part("gain", map.gain.unwrap_or(1.0), ranges::GAIN);
            return Some((Some(shutter?), Some(gain?)));
        }
        let taken = [
            ("shutter_s", map.shutter_s, "sensor.exposure.shutter_s is the time"),
            ("gain", map.gain, "sensor.exposure.iso says the gain"),
        ];
        let mut fine = true;
        for (key, _, why) in taken.into_iter().filter(|(_, value, _)| value.is_some()) {
            self.problem(&path(key), format!("not with a photographer's exposure: {why}"));
            fine = false;
        }
        fine.then_some((None, None))
    }

    fn psf(&mut self, psf: Option<PsfFile>) -> Option<PsfSpec> {
        Some(match psf {
            None | Some(PsfFile::None) => PsfSpec::None,
            Some(PsfFile::GaussianPx(sigma)) => {
                PsfSpec::GaussianPx(self.part("psf.gaussian_px", sigma, ranges::GAUSSIAN_PX)?)
            }
            Some(PsfFile::AiryFNumber(n)) => {
                PsfSpec::AiryFNumber(self.part("psf.airy_f_number", n, ranges::F_NUMBER)?)
            }
        })
    }

    fn vignetting(&mut self, vignetting: Option<VignettingFile>) -> Option<VignettingSpec> {
        Some(match vignetting {
            None | Some(VignettingFile::None) => VignettingSpec::None,
            Some(VignettingFile::Cos4) => VignettingSpec::Cos4,
            Some(VignettingFile::Polynomial(coefficients)) => {
                let mut fine = true;
                for (i, value) in coefficients.into_iter().enumerate() {
                    let key = format!("vignetting.polynomial.{i}");
                    fine &= self.part(&key, value, ranges::VIGNETTING).is_some();
                }
                VignettingSpec::Polynomial(fine.then_some(coefficients)?)
            }
        })
    }

    fn response(&mut self, map: &SensorModelMap) -> Option<ResponseSpec> {
        Some(match &map.response {
            None | Some(ResponseFile::Cie) => ResponseSpec::Cie,
            Some(ResponseFile::NikonD5100) => ResponseSpec::NikonD5100,
            Some(ResponseFile::File(file)) if !file.is_empty() => ResponseSpec::File(file.into()),
            Some(ResponseFile::File(_)) => {
                self.problem(&path("response.file"), "empty; give the path of a CSV file");
                return None;
            }
        })
    }

    /// What the sensor, the wavelengths rendered and the outputs must agree on.
    pub(super) fn sensor_rules(&mut self, file: &ConfigFile, sensor: Option<&SensorSpec>) {
        let model = sensor.map(|sensor| sensor.model.is_some());
        if file.render.wavelength_nm.is_some() {
            if model == Some(true) {
                let message = "a colour sensor sees the visible spectrum, but render.wavelength_nm renders one wavelength";
                self.problem("sensor.model", message);
            }
            if matches!(sensor.map(|s| s.exposure), Some(ExposureSpec::Photographic { .. })) {
                let message = "ISO speeds are of visible light, but render.wavelength_nm renders one wavelength; give a \
                               factor or `auto`";
                self.problem("sensor.exposure", message);
            }
        }
        let index = file.outputs.0.iter().position(|output| *output == OutputFile::Raw);
        if let Some(index) = index.filter(|_| model == Some(false)) {
            let message = "raw is the picture of a sensor: give sensor.model, such as `generic`";
            self.problem(&format!("outputs.{index}"), message);
        }
    }
}

/// Dotted path of a key of the model.
fn path(key: &str) -> String {
    format!("sensor.model.{key}")
}
