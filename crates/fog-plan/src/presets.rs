//! Lighting by name: the files of `configs/lighting`, built in.

use std::{collections::HashMap, sync::LazyLock};

use crate::{
    merge::merge,
    node::{Entry, Node, Value},
    origin::Source,
    schema::Preset,
    yaml,
};

/// The section that presets are of, and the key in it that names one.
const SECTION: &str = "lighting";
const KEY: &str = "preset";

/// The sections `lighting` of the files, by name.
static MAPS: LazyLock<HashMap<&'static str, Node>> = LazyLock::new(|| {
    let read = |preset: Preset| {
        let (name, text) = (preset.name(), preset.yaml());
        let source = Source::named(&format!("configs/lighting/{name}.yaml (built in)"));
        let tree = yaml::parse(text, &source).ok()?;
        Some((name, tree.child(SECTION)?.clone()))
    };
    Preset::ALL.into_iter().filter_map(read).collect()
});

/// Before a key of `lighting` is set: a preset's name becomes a map with this name, which keys can be added to.
pub(crate) fn open(root: &mut Node, path: &str) {
    if !path.strip_prefix(SECTION).is_some_and(|rest| rest.starts_with('.')) {
        return;
    }
    let Some(node) = root.child_mut(SECTION) else { return };
    if matches!(&node.value, Value::Text(name) if MAPS.contains_key(name.as_str())) {
        let origin = node.origin.clone();
        let name = core::mem::replace(node, Node::new(Value::Map(Vec::new()), &origin));
        node.value = Value::Map(vec![Entry { key: KEY.to_owned(), key_origin: origin, node: name }]);
    }
}

/// Whether a section `lighting` is laid over a preset: then it is not complete by itself.
pub(crate) fn is_over_preset(lighting: &Node) -> bool {
    lighting.child(KEY).is_some_and(|name| name.value != Value::Null)
}

/// Replaces a preset's name by what it stands for, under the keys beside it. Names that are no preset's stay.
pub(crate) fn expand(root: &mut Node) {
    open(root, "lighting.preset");
    let Some(node) = root.child_mut(SECTION) else { return };
    let Some(Value::Text(name)) = node.child(KEY).map(|name| &name.value) else { return };
    let Some(preset) = MAPS.get(name.as_str()) else { return };
    let own = core::mem::replace(node, preset.clone());
    merge(node, own);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_file_is_lighting_and_nothing_else() {
        for preset in Preset::ALL {
            let tree = yaml::parse(preset.yaml(), &Source::named(preset.name())).expect("YAML");
            let Value::Map(entries) = &tree.value else { panic!("{}", preset.name()) };
            assert_eq!(entries.iter().map(|e| e.key.as_str()).collect::<Vec<_>>(), ["lighting"]);
            assert!(preset.yaml().starts_with("# "), "{} says what it is", preset.name());
            assert!(MAPS.contains_key(preset.name()));
        }
    }

    #[test]
    fn keys_beside_the_name_win() {
        let text = "lighting: {preset: sunny, sun: {elevation_deg: 5}, scene_emitters: true}";
        let mut tree = yaml::parse(text, &Source::named("c.yaml")).expect("YAML");
        expand(&mut tree);
        let lighting = tree.to_json()["lighting"].clone();
        assert_eq!((&lighting["preset"], &lighting["scene_emitters"]), (&"sunny".into(), &true.into()));
        assert_eq!(
            (&lighting["sun"]["elevation_deg"], &lighting["sun"]["irradiance"]),
            (&5.into(), &2.into())
        );
        assert_eq!(tree.origin_of("lighting.sun.elevation_deg").to_string(), "c.yaml:1:48");
        let origin = tree.origin_of("lighting.sun.irradiance").to_string();
        assert!(origin.starts_with("configs/lighting/sunny.yaml (built in):"), "{origin}");
    }
}
