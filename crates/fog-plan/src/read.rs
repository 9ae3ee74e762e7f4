//! Reads a type of the schema and reports every structural problem, not only serde's first.

use serde::de::DeserializeOwned;

use crate::{
    de::NodeReader,
    error::{Problem, Problems},
    node::Node,
    set::remove,
};

/// What was read: the value without the wrong parts (if enough remains), the problems, and the paths that were left out.
pub(crate) struct Reading<T> {
    pub(crate) value: Option<T>,
    pub(crate) problems: Vec<Problem>,
    pub(crate) dropped: Vec<Vec<String>>,
}

/// Reads `T` from the tree. After an error the offending part is dropped and reading starts again.
pub(crate) fn read<T: DeserializeOwned>(root: &Node) -> Reading<T> {
    let mut reading = Reading { value: None, problems: Vec::new(), dropped: Vec::new() };
    let mut error = match T::deserialize(NodeReader::new(root)) {
        Ok(value) => {
            reading.value = Some(value);
            return reading;
        }
        Err(error) => error,
    };
    let mut tree = root.clone();
    let mut problems = Problems::default();
    loop {
        let path = error.path();
        let missing = error.is_missing();
        // Dropping a part can make the part around it wrong: that is no news.
        let consequence = reading.dropped.iter().any(|d| d.starts_with(&path));
        let mut target = path.clone();
        if missing {
            target.pop();
        }
        if !consequence {
            problems.add(error.into_problem(root));
        }
        // Items of a list cannot go alone: take the list.
        while !target.is_empty() && !remove(&mut tree, &target) {
            target.pop();
        }
        if target.is_empty() || problems.is_full() {
            break;
        }
        reading.dropped.push(target);
        match T::deserialize(NodeReader::new(&tree)) {
            Ok(value) => {
                reading.value = Some(value);
                break;
            }
            Err(next) => error = next,
        }
    }
    reading.problems = problems.into_vec();
    reading
}
