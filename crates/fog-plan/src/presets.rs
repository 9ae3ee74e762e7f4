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

/// The short form of a clear sky, with what its keys stand for.
const CLEAR: &str = "clear";
const OF_SUN: [(&str, &str); 2] =
    [("sun_elevation_deg", "elevation_deg"), ("sun_azimuth_deg", "azimuth_deg")];

/// Turns `{clear: {sun_elevation_deg: 10}}` into `{preset: clear, sun: {elevation_deg: 10}}`. What is not of the short form stays,
/// to be found wrong where it stands.
fn lengthen(lighting: &mut Node) {
    let Value::Map(entries) = &mut lighting.value else { return };
    if entries.iter().any(|entry| entry.key == KEY) {
        return;
    }
    let Some(clear) = entries.iter_mut().find(|entry| entry.key == CLEAR) else { return };
    let Value::Map(short) = &mut clear.node.value else { return };
    let known = |entry: &Entry| OF_SUN.iter().find(|(short, _)| *short == entry.key);
    if short.iter().any(|entry| known(entry).is_none()) {
        return;
    }
    let origin = clear.node.origin.clone();
    let mut sun: Vec<Entry> = core::mem::take(short);
    for entry in &mut sun {
        if let Some((_, long)) = known(entry) {
            entry.key = (*long).to_owned();
        }
    }
    let name = Node::new(Value::Text(CLEAR.to_owned()), &clear.key_origin);
    let preset = Entry { key: KEY.to_owned(), key_origin: clear.key_origin.clone(), node: name };
    entries.retain(|entry| entry.key != CLEAR);
    entries.push(preset);
    let sun = Entry {
        key: "sun".to_owned(),
        key_origin: origin.clone(),
        node: Node::new(Value::Map(sun), &origin),
    };
    let under = Node::new(Value::Map(vec![sun]), &origin);
    let own = core::mem::replace(lighting, under);
    merge(lighting, own);
}

/// Before a key of `lighting` is set: a preset's name becomes a map with this name, which keys can be added to.
pub(crate) fn open(root: &mut Node, path: &str) {
    if !path.strip_prefix(SECTION).is_some_and(|rest| rest.starts_with('.')) {
        return;
    }
    let Some(node) = root.child_mut(SECTION) else { return };
    lengthen(node);
    if matches!(&node.value, Value::Text(name) if MAPS.contains_key(name.as_str())) {
        let origin = node.origin.clone();
        let name = core::mem::replace(node, Node::new(Value::Map(Vec::new()), &origin));
        node.value = Value::Map(vec![Entry { key: KEY.to_owned(), key_origin: origin, node: name }]);
    }
}

/// Whether a section `lighting` is laid over a preset: then it is not complete by itself.
pub(crate) fn is_over_preset(lighting: &Node) -> bool {
    let is_clear = |node: &Node| lighting.child(KEY).is_none() && matches!(node.value, Value::Map(_));
    lighting.child(KEY).is_some_and(|name| name.value != Value::Null)
        || lighting.child(CLEAR).is_some_and(is_clear)
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

    #[test]
    fn a_clear_sky_has_a_short_form() {
        let expanded = |text: &str| {
            let mut tree = yaml::parse(text, &Source::named("c.yaml")).expect("YAML");
            expand(&mut tree);
            tree
        };
        let short = expanded("lighting: {clear: {sun_elevation_deg: 10}, scene_emitters: true}");
        let long = expanded("lighting: {preset: clear, sun: {elevation_deg: 10}, scene_emitters: true}");
        assert_eq!(short.to_json(), long.to_json());
        assert_eq!(short.origin_of("lighting.sun.elevation_deg").to_string(), "c.yaml:1:39");
        // Keys of `sun` beside it win.
        let both =
            expanded("lighting: {clear: {sun_elevation_deg: 10}, sun: {azimuth_deg: 7, elevation_deg: 3}}");
        assert_eq!(both.to_json()["lighting"]["sun"]["elevation_deg"], 3);
        // What is no short form is left for the checks.
        let wrong = expanded("lighting: {clear: {elevation: 10}}").to_json();
        assert_eq!(wrong["lighting"]["clear"]["elevation"], 10);
    }
}
