//! Dotted paths: setting and removing parts of the tree.

use crate::{
    node::{Entry, Node, Value},
    origin::Origin,
    presets,
};

/// Puts `value` at the dotted `path` below `root`. Maps on the way are made when absent; a number steps into a list.
/// Below `sweep.axes` the rest of the path is one key, because the keys there are paths themselves.
///
/// # Errors
/// The message, when something on the way is neither map nor list, or an index is out of range.
pub(crate) fn set(root: &mut Node, path: &str, key_origin: &Origin, value: Node) -> Result<(), String> {
    if path.split('.').any(str::is_empty) {
        return Err(format!("`{path}` is not a dotted path"));
    }
    let keys: Vec<&str> = match path.strip_prefix("sweep.axes.") {
        Some(axis) => vec!["sweep", "axes", axis],
        None => path.split('.').collect(),
    };
    let Some((last, way)) = keys.split_last() else { return Ok(()) };
    presets::open(root, path);
    let mut node = root;
    let mut walked = String::new();
    for key in way {
        node = slot(node, key, &walked, key_origin)?;
        if !walked.is_empty() {
            walked.push('.');
        }
        walked.push_str(key);
        if node.value == Value::Null {
            *node = Node::new(Value::Map(Vec::new()), key_origin);
        }
    }
    *slot(node, last, &walked, key_origin)? = value;
    Ok(())
}

/// The place for `key` in `node`, made when it is a map without that key.
fn slot<'n>(
    node: &'n mut Node,
    key: &str,
    walked: &str,
    key_origin: &Origin,
) -> Result<&'n mut Node, String> {
    let found = node.describe();
    match &mut node.value {
        Value::Map(entries) => {
            let index = entries.iter().position(|e| e.key == key).unwrap_or_else(|| {
                let node = Node::new(Value::Null, key_origin);
                entries.push(Entry { key: key.to_owned(), key_origin: key_origin.clone(), node });
                entries.len() - 1
            });
            Ok(&mut entries[index].node)
        }
        Value::List(items) => {
            let len = items.len();
            key.parse::<usize>().ok().and_then(|index| items.get_mut(index)).ok_or_else(|| match len {
                0 => format!("`{walked}` is an empty list, so it has no item `{key}`"),
                _ => format!("`{walked}` is {found}; expected an index from 0 to {}, found `{key}`", len - 1),
            })
        }
        _ => Err(format!("`{walked}` is {found}, so `{key}` cannot be set inside it")),
    }
}

/// Removes the value at the path and its key. Returns whether there was one.
pub(crate) fn remove(root: &mut Node, path: &[String]) -> bool {
    let Some((last, way)) = path.split_last() else { return false };
    let mut node = root;
    for key in way {
        match node.child_mut(key) {
            Some(child) => node = child,
            None => return false,
        }
    }
    match &mut node.value {
        Value::Map(entries) => {
            let before = entries.len();
            entries.retain(|e| e.key != *last);
            entries.len() < before
        }
        _ => false,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::origin::Source;

    fn tree() -> Node {
        crate::yaml::parse("fog: none\ncamera: {position_m: [0, 1, 2]}\n", &Source::named("c.yaml")).unwrap()
    }

    fn put(path: &str) -> Result<serde_json::Value, String> {
        let mut root = tree();
        set(&mut root, path, &Origin::Default, Node::new(Value::Int(7), &Origin::Default))?;
        Ok(root.to_json())
    }

    #[test]
    fn sets_through_maps_lists_and_nothing() {
        assert_eq!(put("camera.position_m.2").unwrap()["camera"]["position_m"][2], 7);
        assert_eq!(put("render.samples").unwrap()["render"]["samples"], 7);
        assert_eq!(put("sweep.axes.camera.altitude_m").unwrap()["sweep"]["axes"]["camera.altitude_m"], 7);
    }

    #[test]
    fn scalars_and_bad_indices_are_refused() {
        assert_eq!(
            put("fog.height_m").unwrap_err(),
            "`fog` is text \"none\", so `height_m` cannot be set inside it"
        );
        assert_eq!(
            put("camera.position_m.z").unwrap_err(),
            "`camera.position_m` is a list of 3 items; expected an index from 0 to 2, found `z`"
        );
        assert_eq!(put("camera..x").unwrap_err(), "`camera..x` is not a dotted path");
    }

    #[test]
    fn removes_keys_only() {
        let mut root = tree();
        assert!(remove(&mut root, &["fog".into()]));
        assert!(!remove(&mut root, &["fog".into()]));
        assert!(!remove(&mut root, &["camera".into(), "position_m".into(), "0".into()]));
    }
}
