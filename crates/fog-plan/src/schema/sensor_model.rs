//! Key `sensor.model`.

use std::fmt;

use schemars::JsonSchema;
use serde::{
    Deserialize, Deserializer, Serialize,
    de::{Error, IntoDeserializer, MapAccess, Visitor, value::MapAccessDeserializer},
};

use crate::ranges;

/// The sensor that the raw picture is of: a preset by name, or a map of what differs from one; `none`: the picture is ideal.
#[derive(Clone, Debug, JsonSchema, Serialize)]
#[serde(untagged)]
#[schemars(rename = "SensorModel")]
pub(crate) enum SensorModelFile {
    /// By name.
    Word(SensorModelWord),
    /// A preset, and what differs from it.
    Map(Box<SensorModelMap>),
}

/// Sensors by name, and none.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
#[schemars(rename = "SensorModelWord")]
pub(crate) enum SensorModelWord {
    /// No sensor: the picture is ideal.
    None,
    /// As in a map.
    Generic,
    /// As in a map.
    Imx174,
    /// As in a map.
    Icx625,
}

/// Sensors by name.
#[derive(Clone, Copy, Debug, Default, Deserialize, JsonSchema, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
#[schemars(rename = "SensorPreset")]
pub(crate) enum SensorPreset {
    /// Round numbers of a small machine-vision or automotive sensor: 3 µm, 10 000 e, read noise 3 e, 10 e/s, 50 %.
    #[default]
    Generic,
    /// Sony IMX174 by EMVA 1288 figures: 5.86 µm, 32 691 e, read noise 6.83 e, 77 %.
    Imx174,
    /// Sony ICX625 by EMVA 1288 figures: 3.45 µm, 5903 e, read noise 8.28 e, 57 %.
    Icx625,
}

/// A sensor behind a lens. What is absent is as in the preset.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema, Serialize)]
#[serde(default, deny_unknown_fields)]
#[schemars(rename = "SensorModelMap")]
pub(crate) struct SensorModelMap {
    /// The sensor that this one is like. Absent: generic.
    pub(crate) preset: SensorPreset,
    /// Colour filters of the four pixels of a cell: upper row, lower row. Absent: rggb.
    pub(crate) bayer: Option<BayerFile>,
    /// Bits of the converter. Absent: 12.
    #[schemars(range(min = ranges::ADC_BITS.min, max = ranges::ADC_BITS.max))]
    pub(crate) adc_bits: Option<i64>,
    /// Number for no light, below half of the converter's largest. Absent: 1/64 of the converter's range.
    #[schemars(range(min = ranges::BLACK_LEVEL.min, max = ranges::BLACK_LEVEL.max))]
    pub(crate) black_level: Option<i64>,
    /// Most electrons of a pixel.
    #[schemars(range(min = ranges::FULL_WELL_E.min, max = ranges::FULL_WELL_E.max))]
    pub(crate) full_well_e: Option<f64>,
    /// Standard deviation of the noise of reading, in electrons.
    #[schemars(range(min = ranges::READ_NOISE_E.min, max = ranges::READ_NOISE_E.max))]
    pub(crate) read_noise_e: Option<f64>,
    /// Mean dark electrons of a pixel per second.
    #[schemars(range(min = ranges::DARK_CURRENT_E_S.min, max = ranges::DARK_CURRENT_E_S.max))]
    pub(crate) dark_current_e_s: Option<f64>,
    /// Time that dark electrons gather in, in seconds; a photographer's exposure has its own. Absent: 0.01.
    #[schemars(range(min = ranges::SHUTTER_S.min, max = ranges::SHUTTER_S.max))]
    pub(crate) shutter_s: Option<f64>,
    /// A full well is so many times what saturates the converter; with a photographer's exposure the ISO speed says it.
    /// Absent: 1.
    #[schemars(range(min = ranges::GAIN.min, max = ranges::GAIN.max))]
    pub(crate) gain: Option<f64>,
    /// Side of a pixel in micrometres.
    #[schemars(range(min = ranges::PIXEL_UM.min, max = ranges::PIXEL_UM.max))]
    pub(crate) pixel_um: Option<f64>,
    /// Greatest quantum efficiency of green pixels: electrons per photon.
    #[schemars(extend("exclusiveMinimum" = 0), range(max = ranges::QUANTUM_EFFICIENCY.max))]
    pub(crate) quantum_efficiency: Option<f64>,
    /// Photo response nonuniformity, PRNU₁₂₈₈ as a share: standard deviation of the pixels' responses over their mean. Absent: 0.
    #[schemars(range(min = ranges::PRNU.min, max = ranges::PRNU.max))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) prnu_1288: Option<f64>,
    /// Dark signal nonuniformity, DSNU₁₂₈₈: standard deviation of the pixels' dark signals in electrons. Absent: 0.
    #[schemars(range(min = ranges::DSNU_E.min, max = ranges::DSNU_E.max))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) dsnu_1288_e: Option<f64>,
    /// Which sensor it is: seed of the fixed pattern of `prnu_1288` and `dsnu_1288_e`, the same for all frames. Absent: 1.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) pattern_seed: Option<u64>,
    /// Whether electrons are counted at random. Absent: true.
    pub(crate) photon_noise: Option<bool>,
    /// What the pixels see of each wavelength. Absent: cie.
    pub(crate) response: Option<ResponseFile>,
    /// How the lens spreads light. Absent: none.
    pub(crate) psf: Option<PsfFile>,
    /// How the lens darkens corners. Absent: none.
    pub(crate) vignetting: Option<VignettingFile>,
    /// Seed of the noise. Absent: it follows from the frame's.
    pub(crate) noise_seed: Option<u64>,
}

/// Patterns of filters.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(rename_all = "snake_case")]
#[schemars(rename = "Bayer")]
pub(crate) enum BayerFile {
    /// Red, green / green, blue.
    Rggb,
    /// Blue, green / green, red.
    Bggr,
    /// Green, red / blue, green.
    Grbg,
    /// Green, blue / red, green.
    Gbrg,
}

/// Spectral responses.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(rename_all = "snake_case")]
#[schemars(rename = "Response")]
pub(crate) enum ResponseFile {
    /// Linear sRGB by the CIE observer, like `hdr`.
    Cie,
    /// The curves of a Nikon D5100 (Darrodi et al. 2015).
    NikonD5100,
    /// Path of a CSV file: `wavelength_nm,qe_red,qe_green,qe_blue` (electrons per photon) or `wavelength_nm,red,green,blue`
    /// (response to energy in any unit).
    File(String),
}

/// Point-spread functions.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(rename_all = "snake_case")]
#[schemars(rename = "Psf")]
pub(crate) enum PsfFile {
    /// None: a point stays in its pixel.
    None,
    /// Gaussian with this standard deviation in pixels.
    GaussianPx(#[schemars(range(min = ranges::GAUSSIAN_PX.min, max = ranges::GAUSSIAN_PX.max))] f64),
    /// Airy's disc of a perfect lens at this f-number.
    AiryFNumber(#[schemars(range(min = ranges::F_NUMBER.min, max = ranges::F_NUMBER.max))] f64),
}

/// Laws of vignetting.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(rename_all = "snake_case")]
#[schemars(rename = "Vignetting")]
pub(crate) enum VignettingFile {
    /// None.
    None,
    /// Fourth power of the cosine of the angle from the axis.
    Cos4,
    /// 1 + a r² + b r⁴ + c r⁶ with these a, b, c; r from the middle in half diagonals.
    Polynomial([f64; 3]),
}

impl<'de> Deserialize<'de> for SensorModelFile {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(SensorModelVisitor)
    }
}

struct SensorModelVisitor;

impl<'de> Visitor<'de> for SensorModelVisitor {
    type Value = SensorModelFile;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(
            "`none`, a sensor (generic, imx174, icx625) or a map such as {preset: generic, read_noise_e: 2}",
        )
    }

    fn visit_str<E: Error>(self, text: &str) -> Result<Self::Value, E> {
        SensorModelWord::deserialize(text.into_deserializer()).map(SensorModelFile::Word)
    }

    fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<Self::Value, A::Error> {
        SensorModelMap::deserialize(MapAccessDeserializer::new(map))
            .map(|map| SensorModelFile::Map(Box::new(map)))
    }
}
