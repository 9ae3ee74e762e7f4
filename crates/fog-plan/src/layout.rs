//! How many frames each combination of axis values makes: one for each pose of its path and each camera of its rig.

use std::sync::Arc;

use crate::{
    error::{Problem, Problems},
    node::{Node, Value},
    plan::Plan,
    set::set,
    sweep::MAX_FRAMES,
    validate::{self, Place},
};

/// Frames by combination.
#[derive(Clone, Debug)]
pub(crate) enum Layout {
    /// The same number for each.
    Even(usize),
    /// Index of the frame after the last of each.
    Uneven(Arc<[usize]>),
}

impl Layout {
    /// Number of frames of this many combinations.
    pub(crate) fn len(&self, combinations: usize) -> usize {
        match self {
            Self::Even(each) => combinations * each,
            Self::Uneven(ends) => ends.last().copied().unwrap_or(0),
        }
    }

    /// The combination of a frame, and the frame's position among those of the combination.
    pub(crate) fn locate(&self, index: usize) -> (usize, usize) {
        match self {
            Self::Even(each) => (index / each, index % each),
            Self::Uneven(ends) => {
                let combination = ends.partition_point(|end| *end <= index);
                let first = combination.checked_sub(1).map_or(0, |before| ends[before]);
                (combination, index - first)
            }
        }
    }

    /// Index of the first frame of a combination.
    pub(crate) fn first(&self, combination: usize) -> usize {
        match self {
            Self::Even(each) => combination * each,
            Self::Uneven(ends) => combination.checked_sub(1).map_or(0, |before| ends[before]),
        }
    }
}

impl Plan {
    /// Reads a path that no axis changes once for all frames, and counts the frames.
    pub(crate) fn lay_out(&mut self, problems: &mut Problems) {
        let changes = |key: &str| {
            let mut axes = self.sweep.iter().flat_map(|sweep| &sweep.axes).flat_map(|axis| &axis.paths);
            axes.any(|path| path == key || path.strip_prefix(key).is_some_and(|rest| rest.starts_with('.')))
        };
        let (path, cameras) = (changes("path"), changes("cameras"));
        if !path && self.base.child("path").is_some() {
            match validate::path(&self.base, &self.files) {
                Ok(path) => self.path = Some(path),
                Err(found) => problems.extend(found),
            }
            // Frames need not carry it.
            crate::set::remove(&mut self.base, &["path".to_owned()]);
        }
        let combinations = self.combinations();
        let layout = if path || cameras {
            let mut end = 0usize;
            let count = |combination| {
                end = end.saturating_add(self.count(combination));
                end
            };
            Layout::Uneven((0..combinations).map(count).collect())
        } else {
            Layout::Even(self.count(0))
        };
        let all = match &layout {
            Layout::Even(each) => combinations.checked_mul(*each),
            Layout::Uneven(_) => Some(layout.len(combinations)),
        };
        if all.is_none_or(|all| all > MAX_FRAMES) {
            let message = format!("axes × poses × cameras make too many frames; at most {MAX_FRAMES}");
            problems.add(Problem::new(self.resolved.origin_of("path"), "path", message));
            return;
        }
        self.layout = layout;
    }

    /// Number of frames of a combination; of one that is wrong at least one, which will say so.
    fn count(&self, combination: usize) -> usize {
        let Ok((mut tree, _)) = self.tree(combination) else { return 1 };
        let names = camera_names(&tree);
        let poses = match (&self.path, tree.child("path")) {
            (Some(path), _) => path.poses.len(),
            (None, None) => 1,
            (None, Some(_)) => {
                crate::set::remove(&mut tree, &["cameras".to_owned()]);
                validate::path(&tree, &self.files).map_or(1, |path| path.poses.len())
            }
        };
        poses * names.len().max(1)
    }
}

/// Names of the rig's cameras in the order written.
pub(crate) fn camera_names(tree: &Node) -> Vec<String> {
    match tree.child("cameras").map(|node| &node.value) {
        Some(Value::Map(entries)) => entries.iter().map(|entry| entry.key.clone()).collect(),
        _ => Vec::new(),
    }
}

/// The place among the frames of a combination with these cameras: poses in order, of each all cameras.
pub(crate) fn place<'p>(within: usize, names: &'p [String], plan: &'p Plan) -> Place<'p> {
    let count = names.len().max(1);
    Place {
        camera: names.get(within % count).map(String::as_str),
        pose: within / count,
        path: plan.path.as_ref(),
        files: &plan.files,
    }
}

/// Puts a camera's own `sensor` keys over those of all cameras and removes them from the rig. Returns the keys.
///
/// # Errors
/// A problem of keys that cannot be put there.
pub(crate) fn override_sensor(tree: &mut Node, camera: &str) -> Result<Vec<String>, Problem> {
    let own = tree.child_mut("cameras").and_then(|cameras| cameras.child_mut(camera)).and_then(|camera| {
        let Value::Map(entries) = &mut camera.value else { return None };
        let at = entries.iter().position(|entry| entry.key == "sensor")?;
        Some(entries.remove(at).node)
    });
    let Some(own) = own.filter(|own| own.value != Value::Null) else { return Ok(Vec::new()) };
    let path = format!("cameras.{camera}.sensor");
    let Value::Map(entries) = own.value else {
        let message = format!("expected a map of keys of `sensor`, found {}", own.describe());
        return Err(Problem::new(&own.origin, path, message));
    };
    let has = |key: &str| entries.iter().any(|entry| entry.key == key);
    // A field of view and intrinsics take each other's place, and neither fits every lens.
    let (fov, intrinsics, lens) = (has("horizontal_fov_deg"), has("intrinsics"), has("lens"));
    let remove = |tree: &mut Node, key: &str| {
        crate::set::remove(tree, &["sensor".to_owned(), key.to_owned()]);
    };
    if intrinsics || (lens && !fov) {
        remove(tree, "horizontal_fov_deg");
    }
    if fov || (lens && !intrinsics) {
        remove(tree, "intrinsics");
    }
    let keys = entries.iter().map(|entry| entry.key.clone()).collect();
    for entry in entries {
        let key = format!("sensor.{}", entry.key);
        set(tree, &key, &entry.key_origin, entry.node)
            .map_err(|message| Problem::new(&entry.key_origin, format!("{path}.{}", entry.key), message))?;
    }
    Ok(keys)
}
