//! Checks of `classes` and `labels`.

use super::Check;
use crate::{
    labels::{ClassPatternSpec, ClassSpec, LabelsSpec},
    ranges,
    schema::{ClassesFile, LabelsFile, NameFile, NamesFile},
};

/// Most classes of a configuration: semantic pictures hold bytes, and the built-in classes come first.
const MAX_CLASSES: usize = 200;
/// Longest name of a class.
const MAX_NAME: usize = 64;

impl Check<'_> {
    pub(super) fn labels(
        &mut self,
        classes: Option<&ClassesFile>,
        labels: Option<&LabelsFile>,
    ) -> Option<LabelsSpec> {
        let classes = classes.map_or(&[][..], |classes| &classes.0);
        if classes.len() > MAX_CLASSES {
            let message = format!("{} classes are too many; at most {MAX_CLASSES}", classes.len());
            self.problem("classes", message);
            return None;
        }
        let classes: Vec<_> = classes.iter().map(|(class, names)| self.class(class, names)).collect();
        let classes: Option<Vec<ClassSpec>> = classes.into_iter().collect();
        let defaults = LabelsSpec::default();
        let contrast = labels.and_then(|l| l.contrast_threshold).unwrap_or(defaults.contrast_threshold);
        let pixels = labels.and_then(|l| l.min_pixels).unwrap_or(i64::from(defaults.min_pixels));
        let contrast = self.range("labels.contrast_threshold", contrast, ranges::CONTRAST);
        let pixels = self.whole("labels.min_pixels", pixels, ranges::MIN_PIXELS);
        Some(LabelsSpec { classes: classes?, contrast_threshold: contrast?, min_pixels: pixels? })
    }

    fn class(&mut self, class: &str, names: &NamesFile) -> Option<ClassSpec> {
        let path = format!("classes.{class}");
        if class.is_empty() || class.len() > MAX_NAME || class.chars().any(char::is_control) {
            self.problem(
                "classes",
                format!("{class:?} is not a name of a class: use 1 to {MAX_NAME} letters"),
            );
            return None;
        }
        let names = match names {
            NamesFile::One(name) => std::slice::from_ref(name),
            NamesFile::Several(names) => names,
        };
        let empty = |name: &NameFile| match name {
            NameFile::Node(name) => name.is_empty(),
            NameFile::Material(name) => name.material.is_empty(),
        };
        if names.is_empty() || names.iter().any(empty) {
            self.problem(
                &path,
                "empty; name nodes, meshes or materials, such as \"car_*\" or {material: \"paint*\"}",
            );
            return None;
        }
        let pattern = |name: &NameFile| match name {
            NameFile::Node(name) => ClassPatternSpec::Node(name.clone()),
            NameFile::Material(name) => ClassPatternSpec::Material(name.material.clone()),
        };
        Some(ClassSpec { class: class.to_owned(), patterns: names.iter().map(pattern).collect() })
    }
}
