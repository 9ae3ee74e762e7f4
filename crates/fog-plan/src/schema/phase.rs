//! Key `fog.phase`.

use std::fmt;

use schemars::{JsonSchema, Schema};
use serde::{
    Deserialize, Deserializer, Serialize,
    de::{Error, Unexpected, Visitor},
};

use crate::ranges;

/// The phase functions.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(rename_all = "snake_case")]
#[schemars(rename = "Phase", transform = also_without_value)]
pub(crate) enum PhaseFile {
    /// Mie scattering of the advection model's droplets, by altitude relative to the layer and by wavelength.
    Mie,
    /// Henyey–Greenstein with this mean cosine.
    Hg(MeanCosineFile),
    /// Mie scattering of the mean droplet (the paper's table).
    MieMeanDiameter,
    /// The closed form of Jendersie & d'Eon 2023 (Henyey–Greenstein and Draine) for one diameter of droplets. Without a
    /// value: the mean diameter of the advection model's.
    JendersieDeon(Option<JendersieDeonFile>),
}

/// The JSON Schema of a variant whose value may be left out: its name alone will do.
fn also_without_value(schema: &mut Schema) {
    if let Some(serde_json::Value::Array(variants)) = schema.get_mut("oneOf") {
        variants.push(serde_json::json!({
            "const": "jendersie_deon",
            "description": "Jendersie & d'Eon 2023 for the mean diameter of the advection model's droplets."
        }));
    }
}

/// Mean cosine of Henyey–Greenstein.
#[derive(Clone, Copy, Debug, JsonSchema, Serialize)]
#[serde(untagged)]
#[schemars(rename = "MeanCosine")]
pub(crate) enum MeanCosineFile {
    /// This one.
    Value(#[schemars(range(min = ranges::HG_G.min, max = ranges::HG_G.max))] f64),
    /// The layer's own.
    Word(MeanCosineWord),
}

/// A mean cosine by name.
#[derive(Clone, Copy, Debug, JsonSchema, Serialize)]
#[serde(rename_all = "snake_case")]
pub(crate) enum MeanCosineWord {
    /// The mean over altitude of the droplets' g at 550 nm, weighted by what the layer scatters.
    Layer,
}

/// What the closed form is made for.
#[derive(Clone, Copy, Debug, Default, Deserialize, JsonSchema, Serialize)]
#[serde(default, deny_unknown_fields)]
#[schemars(rename = "JendersieDeon")]
pub(crate) struct JendersieDeonFile {
    /// Diameter of the droplets in micrometres. Absent: the mean diameter of the advection model's.
    #[schemars(extend("exclusiveMinimum" = 0), range(max = ranges::FIT_DIAMETER_UM.max))]
    pub(crate) diameter_um: Option<f64>,
}

impl<'de> Deserialize<'de> for MeanCosineFile {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(MeanCosineVisitor)
    }
}

struct MeanCosineVisitor;

impl Visitor<'_> for MeanCosineVisitor {
    type Value = MeanCosineFile;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a number or `layer`")
    }

    fn visit_f64<E: Error>(self, g: f64) -> Result<Self::Value, E> {
        Ok(MeanCosineFile::Value(g))
    }

    fn visit_i64<E: Error>(self, g: i64) -> Result<Self::Value, E> {
        Ok(MeanCosineFile::Value(g as f64))
    }

    fn visit_str<E: Error>(self, text: &str) -> Result<Self::Value, E> {
        match text {
            "layer" => Ok(MeanCosineFile::Word(MeanCosineWord::Layer)),
            _ => Err(E::invalid_type(Unexpected::Str(text), &self)),
        }
    }
}
