//! Key `sensor.exposure`.

use std::fmt;

use schemars::JsonSchema;
use serde::{
    Deserialize, Deserializer, Serialize,
    de::{Error, MapAccess, Unexpected, Visitor, value::MapAccessDeserializer},
};

use crate::ranges;

/// Percentile of the luminances that automatic exposure looks at.
pub(crate) const PERCENTILE: f64 = 0.99;
/// What automatic exposure makes of it.
pub(crate) const TARGET: f64 = 0.8;
/// Share of the light that a lens lets through (ISO 12232:2006 takes 0.9).
pub(crate) const LENS_TRANSMISSION: f64 = 0.9;

/// Factor on linear values before sRGB encoding, or where it comes from.
#[derive(Clone, Copy, Debug, JsonSchema, Serialize)]
#[serde(untagged)]
#[schemars(rename = "Exposure")]
pub(crate) enum ExposureFile {
    /// The factor itself.
    Factor(#[schemars(extend("exclusiveMinimum" = 0), range(max = ranges::EXPOSURE.max))] f64),
    /// `auto`: {percentile: 0.99, target: 0.8}.
    Word(ExposureWord),
    /// By a percentile of the frame's luminances, or a photographer's by ISO speed, shutter and f-number.
    Map(ExposureMap),
}

/// An exposure by name.
#[derive(Clone, Copy, Debug, JsonSchema, Serialize)]
#[serde(rename_all = "snake_case")]
#[schemars(rename = "ExposureWord")]
pub(crate) enum ExposureWord {
    /// Automatic: the 99th percentile of the luminances becomes 0.8.
    Auto,
}

/// `percentile` and `target`, or `iso`, `shutter_s` and `f_number`.
#[derive(Clone, Copy, Debug, Default, Deserialize, JsonSchema, Serialize)]
#[serde(default, deny_unknown_fields)]
#[schemars(rename = "ExposureMap")]
pub(crate) struct ExposureMap {
    /// Automatic: share of the pixels that are darker than the luminance that becomes `target`. Absent: 0.99.
    #[schemars(range(min = ranges::PERCENTILE.min, max = ranges::PERCENTILE.max))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) percentile: Option<f64>,
    /// Automatic: what that luminance becomes; 1 is white. Absent: 0.8.
    #[schemars(extend("exclusiveMinimum" = 0), range(max = ranges::TARGET.max))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) target: Option<f64>,
    /// Photographic: saturation-based ISO speed (ISO 12232).
    #[schemars(range(min = ranges::ISO.min, max = ranges::ISO.max))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) iso: Option<f64>,
    /// Photographic: time that the shutter is open, in seconds.
    #[schemars(range(min = ranges::SHUTTER_S.min, max = ranges::SHUTTER_S.max))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) shutter_s: Option<f64>,
    /// Photographic: focal length over the diameter of the entrance pupil.
    #[schemars(range(min = ranges::F_NUMBER.min, max = ranges::F_NUMBER.max))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) f_number: Option<f64>,
    /// Photographic: share of the light that the lens lets through. Absent: 0.9.
    #[schemars(extend("exclusiveMinimum" = 0), range(max = ranges::LENS_TRANSMISSION.max))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) lens_transmission: Option<f64>,
}

impl<'de> Deserialize<'de> for ExposureFile {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(ExposureVisitor)
    }
}

struct ExposureVisitor;

impl<'de> Visitor<'de> for ExposureVisitor {
    type Value = ExposureFile;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(
            "a number, `auto`, a map such as {percentile: 0.99, target: 0.8} or \
             {iso: 400, shutter_s: 0.01, f_number: 2.8}",
        )
    }

    fn visit_f64<E: Error>(self, factor: f64) -> Result<Self::Value, E> {
        Ok(ExposureFile::Factor(factor))
    }

    fn visit_i64<E: Error>(self, factor: i64) -> Result<Self::Value, E> {
        Ok(ExposureFile::Factor(factor as f64))
    }

    fn visit_str<E: Error>(self, text: &str) -> Result<Self::Value, E> {
        match text {
            "auto" => Ok(ExposureFile::Word(ExposureWord::Auto)),
            _ => Err(E::invalid_type(Unexpected::Str(text), &self)),
        }
    }

    fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<Self::Value, A::Error> {
        ExposureMap::deserialize(MapAccessDeserializer::new(map)).map(ExposureFile::Map)
    }
}
