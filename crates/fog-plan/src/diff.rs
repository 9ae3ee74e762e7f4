//! Which keys of two configurations differ.

use crate::{
    canonical::canonical,
    node::{Node, Value},
};

/// Leaves by dotted path, in order: canonical text and text for people.
pub(crate) fn flatten(node: &Node) -> Vec<(String, Leaf)> {
    let mut leaves = Vec::new();
    collect(node, String::new(), &mut leaves);
    leaves
}

/// A scalar, or an empty list or map.
#[derive(Clone, Debug)]
pub(crate) struct Leaf {
    canonical: String,
    shown: String,
}

fn collect(node: &Node, path: String, leaves: &mut Vec<(String, Leaf)>) {
    let below = |key: &str| if path.is_empty() { key.to_owned() } else { format!("{path}.{key}") };
    match &node.value {
        Value::Map(entries) if !entries.is_empty() => {
            entries.iter().for_each(|entry| collect(&entry.node, below(&entry.key), leaves));
        }
        Value::List(items) if !items.is_empty() => {
            items
                .iter()
                .enumerate()
                .for_each(|(index, item)| collect(item, below(&index.to_string()), leaves));
        }
        _ => {
            let json = node.to_json();
            let shown = match &json {
                serde_json::Value::String(text) => text.clone(),
                other => canonical(other),
            };
            leaves.push((path, Leaf { canonical: canonical(&json), shown }));
        }
    }
}

/// `path: was x, is now y` for each leaf that is not the same in both.
pub(crate) fn differing(old: &[(String, Leaf)], new: &[(String, Leaf)]) -> Vec<String> {
    let find = |leaves: &[(String, Leaf)], path: &str| {
        leaves.iter().find(|(p, _)| p == path).map(|(_, l)| l.clone())
    };
    let mut lines = Vec::new();
    for (path, leaf) in old {
        match find(new, path) {
            Some(now) if now.canonical == leaf.canonical => {}
            Some(now) => lines.push(format!("{path}: was {}, is now {}", leaf.shown, now.shown)),
            None => lines.push(format!("{path}: was {}, is now absent", leaf.shown)),
        }
    }
    for (path, leaf) in new {
        if find(old, path).is_none() {
            lines.push(format!("{path}: was absent, is now {}", leaf.shown));
        }
    }
    let axes = |leaves: &[(String, Leaf)]| -> Vec<String> {
        leaves
            .iter()
            .filter(|(path, _)| path.starts_with("sweep.axes."))
            .map(|(path, _)| path.clone())
            .collect()
    };
    if lines.is_empty() && axes(old) != axes(new) {
        lines.push("sweep.axes: the axes are in another order".to_owned());
    }
    lines
}
