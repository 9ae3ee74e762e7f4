//! What surfaces and things are, and when a thing counts as detectable.

use serde::{Serialize, Serializer};

/// Labels of a frame. Left out of records where nothing is said about them.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct LabelsSpec {
    /// Classes by names of nodes, meshes and materials, in the order of the configuration. Left out where there are none.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub classes: Vec<ClassSpec>,
    /// Least absolute contrast of a thing with its surroundings, 0.001 to 1. Left out where it is 0.05.
    #[serde(skip_serializing_if = "is_default_contrast")]
    pub contrast_threshold: f64,
    /// Fewest visible pixels of a thing, 1 to 1 000 000. Left out where it is 10.
    #[serde(skip_serializing_if = "is_default_pixels")]
    pub min_pixels: u32,
}

/// Contrast of the meteorological optical range.
const CONTRAST_THRESHOLD: f64 = 0.05;
const MIN_PIXELS: u32 = 10;

impl Default for LabelsSpec {
    fn default() -> Self {
        Self { classes: Vec::new(), contrast_threshold: CONTRAST_THRESHOLD, min_pixels: MIN_PIXELS }
    }
}

impl LabelsSpec {
    pub(crate) fn is_default(&self) -> bool {
        *self == Self::default()
    }
}

/// Surfaces that are of a class.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct ClassSpec {
    /// Its name.
    pub class: String,
    /// What is of the class: any of these, at least one.
    pub patterns: Vec<ClassPatternSpec>,
}

/// Names of nodes and meshes, or of materials; `*` stands for any text. Serialises to `NAME` or `material:NAME`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ClassPatternSpec {
    /// Nodes and meshes.
    Node(String),
    /// Materials.
    Material(String),
}

impl Serialize for ClassPatternSpec {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Node(name) => serializer.serialize_str(name),
            Self::Material(name) => serializer.collect_str(&format_args!("material:{name}")),
        }
    }
}

fn is_default_contrast(value: &f64) -> bool {
    *value == CONTRAST_THRESHOLD
}

fn is_default_pixels(value: &u32) -> bool {
    *value == MIN_PIXELS
}
