//! Laying one tree over another: includes under the file that names them, presets under what overrides them.

use crate::node::{Entry, Node, Value};

/// Maps that say one thing in one of several ways: the whole of one replaces the whole of the other.
const WHOLE: [&str; 5] = ["phase", "droplets", "vertical", "environment", "path"];

/// Puts `over` on top of `base`. Maps are merged key by key; anything else in `over` (lists too) takes the place of what
/// `base` has. A map also takes the whole place where it names another `model`, where it is a scene of its own, for the maps of
/// `WHOLE`, and for each axis of a sweep.
pub(crate) fn merge(base: &mut Node, over: Node) {
    merge_at("", base, over);
}

fn merge_at(key: &str, base: &mut Node, over: Node) {
    if WHOLE.contains(&key) || is_other(key, base, &over) {
        *base = over;
        return;
    }
    match (&mut base.value, over) {
        (Value::Map(entries), Node { value: Value::Map(news), origin }) => {
            base.origin = origin;
            for new in news {
                lay(key, entries, new);
            }
        }
        (_, over) => *base = over,
    }
}

/// Puts an entry of the map at `key` over the others.
fn lay(key: &str, entries: &mut Vec<Entry>, new: Entry) {
    match entries.iter_mut().find(|old| old.key == new.key) {
        // An axis says all about its values.
        Some(old) if key == "axes" => *old = new,
        Some(old) => {
            old.key_origin = new.key_origin;
            merge_at(&new.key, &mut old.node, new.node);
        }
        None => entries.push(new),
    }
}

/// Whether the map `over` is about something else than the map `base`.
fn is_other(key: &str, base: &Node, over: &Node) -> bool {
    let model = |node: &Node| node.child("model").map(|model| model.value.clone());
    let renamed = model(over).is_some_and(|new| model(base).is_some_and(|old| old != new));
    let scene = key == "scene" && ["file", "generate"].iter().any(|source| over.child(source).is_some());
    renamed || scene
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{origin::Source, yaml};

    fn merged(base: &str, over: &str) -> String {
        let read = |text: &str| yaml::parse(text, &Source::named("c.yaml")).expect("YAML");
        let mut tree = read(base);
        merge(&mut tree, read(over));
        tree.to_json().to_string()
    }

    #[test]
    fn maps_merge_and_all_else_is_replaced() {
        assert_eq!(
            merged("a: {x: 1, y: [1, 2]}\nb: 3", "a: {y: [7], z: 4}\nc: 5"),
            r#"{"a":{"x":1,"y":[7],"z":4},"b":3,"c":5}"#
        );
        assert_eq!(merged("lighting: day", "lighting: {sun: {x: 1}}"), r#"{"lighting":{"sun":{"x":1}}}"#);
        assert_eq!(merged("lighting: {sun: 1}", "lighting: night"), r#"{"lighting":"night"}"#);
        assert_eq!(merged("a: {x: 1}", "a: ~"), r#"{"a":null}"#);
    }

    #[test]
    fn another_thing_takes_the_whole_place() {
        assert_eq!(
            merged("fog: {model: advection, height_m: 9}", "fog: {model: layered, file: a.csv}"),
            r#"{"fog":{"model":"layered","file":"a.csv"}}"#
        );
        assert_eq!(
            merged("fog: {model: advection, height_m: 9}", "fog: {model: advection, datum_m: 1}"),
            r#"{"fog":{"model":"advection","height_m":9,"datum_m":1}}"#
        );
        assert_eq!(
            merged("fog: {phase: {hg: 0.8}}", "fog: {phase: {jendersie_deon: {}}}"),
            r#"{"fog":{"phase":{"jendersie_deon":{}}}}"#
        );
        assert_eq!(
            merged("scene: {file: a.glb}", "scene: {generate: urban}"),
            r#"{"scene":{"generate":"urban"}}"#
        );
        assert_eq!(
            merged(
                "sweep: {axes: {x: {from: 0, count: 3}, y: [1]}}",
                "sweep: {axes: {x: {from: 1, step: 2}}}"
            ),
            r#"{"sweep":{"axes":{"x":{"from":1,"step":2},"y":[1]}}}"#
        );
    }
}
