//! Groups of lights of a frame.

use serde::{Serialize, Serializer};

/// A group of lights, whose light is told apart in the picture.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct LightGroupSpec {
    /// Its name: 1 to 32 letters, digits, `_` and `-`; unique, and not `rest`.
    pub name: String,
    /// Its lights, at least one pattern; a light that an earlier group has is not in this one.
    pub lights: Vec<LightsSpec>,
    /// Factor on the light of all of them, 0 to 1e6; left out of records where it is 1.
    #[serde(skip_serializing_if = "is_one")]
    pub intensity: f64,
}

/// Some of a frame's lights. Serialises to the word that it is written as.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum LightsSpec {
    /// `environment`.
    Environment,
    /// `sun`.
    Sun,
    /// `lamps`: all points and spots of the scene file.
    Lamps,
    /// `directional`: all directional lights of the scene file.
    Directional,
    /// `emitters`: all emitting surfaces of the scene file.
    Emitters,
    /// `node:NAME`: lights and emitting surfaces of the nodes with this name; `*` in it stands for any text.
    Node(String),
    /// `material:NAME`: emitting surfaces of the materials with this name; `*` in it stands for any text.
    Material(String),
}

impl LightsSpec {
    /// The words without a name.
    pub(crate) const WORDS: [(&'static str, Self); 5] = [
        ("environment", Self::Environment),
        ("sun", Self::Sun),
        ("lamps", Self::Lamps),
        ("directional", Self::Directional),
        ("emitters", Self::Emitters),
    ];

    /// What a word means, if anything.
    pub(crate) fn parse(word: &str) -> Option<Self> {
        if let Some((_, lights)) = Self::WORDS.into_iter().find(|(known, _)| *known == word) {
            return Some(lights);
        }
        match word.split_once(':')? {
            (_, "") => None,
            ("node", name) => Some(Self::Node(name.to_owned())),
            ("material", name) => Some(Self::Material(name.to_owned())),
            _ => None,
        }
    }
}

impl Serialize for LightsSpec {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Node(name) => serializer.collect_str(&format_args!("node:{name}")),
            Self::Material(name) => serializer.collect_str(&format_args!("material:{name}")),
            other => {
                let word = Self::WORDS.iter().find(|(_, lights)| lights == other);
                serializer.serialize_str(word.map_or("", |(word, _)| word))
            }
        }
    }
}

/// For values that records leave out where they are 1.
pub(crate) fn is_one(value: &f64) -> bool {
    *value == 1.0
}
