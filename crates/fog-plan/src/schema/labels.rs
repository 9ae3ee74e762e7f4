//! Sections `classes` and `labels`.

use std::{borrow::Cow, fmt};

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::{
    Deserialize, Deserializer, Serialize, Serializer,
    de::{MapAccess, Visitor},
    ser::SerializeMap,
};

use crate::ranges;

/// Names of surfaces by class, in the order in which they are written.
#[derive(Clone, Debug, Default)]
pub(crate) struct ClassesFile(pub(crate) Vec<(String, NamesFile)>);

/// One name or several.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(untagged, expecting = "a name, {material: NAME}, or a list of them")]
#[schemars(rename = "Names")]
pub(crate) enum NamesFile {
    /// One.
    One(NameFile),
    /// Any of these.
    Several(Vec<NameFile>),
}

/// A name, in which `*` stands for any text.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(untagged)]
#[schemars(rename = "Name")]
pub(crate) enum NameFile {
    /// Of nodes and meshes, with all that is below such nodes.
    Node(String),
    /// Of materials.
    Material(MaterialName),
}

/// The name of a material.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct MaterialName {
    /// The name.
    pub(crate) material: String,
}

/// When a thing counts as detectable.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema, Serialize)]
#[serde(default, deny_unknown_fields)]
#[schemars(rename = "Labels")]
pub(crate) struct LabelsFile {
    /// Least absolute contrast of a thing's mean luminance with that of its surroundings in the picture. Absent: 0.05, that of
    /// the meteorological optical range.
    #[schemars(range(min = ranges::CONTRAST.min, max = ranges::CONTRAST.max))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) contrast_threshold: Option<f64>,
    /// Fewest pixels of a thing that must be visible. Absent: 10.
    #[schemars(range(min = ranges::MIN_PIXELS.min, max = ranges::MIN_PIXELS.max))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) min_pixels: Option<i64>,
}

impl<'de> Deserialize<'de> for ClassesFile {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_map(ClassesVisitor)
    }
}

struct ClassesVisitor;

impl<'de> Visitor<'de> for ClassesVisitor {
    type Value = ClassesFile;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a map of classes, such as {car: \"car_*\", road: [\"road*\", {material: \"asphalt*\"}]}")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<ClassesFile, A::Error> {
        let mut classes = Vec::new();
        while let Some(entry) = map.next_entry()? {
            classes.push(entry);
        }
        Ok(ClassesFile(classes))
    }
}

impl Serialize for ClassesFile {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(Some(self.0.len()))?;
        for (class, names) in &self.0 {
            map.serialize_entry(class, names)?;
        }
        map.end()
    }
}

impl JsonSchema for ClassesFile {
    fn schema_name() -> Cow<'static, str> {
        "Classes".into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        json_schema!({ "type": "object", "additionalProperties": generator.subschema_for::<NamesFile>() })
    }
}
