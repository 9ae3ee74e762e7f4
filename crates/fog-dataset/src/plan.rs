//! The frames of a data set, as lines of `plan.jsonl`.

use std::collections::HashSet;
use std::fs::File;
use std::io::{BufRead, BufReader};
use std::path::Path;

use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};

use crate::names::{PLAN, check_id};
use crate::{Error, OutputSet, Result};

/// One frame of the plan; its index is its place in the list.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PlanFrame {
    /// Stable id: letters, digits, `.`, `_`, `-`; names the frame's files.
    pub id: String,
    /// What frames that differ in fog alone have in common.
    #[serde(default)]
    pub pair_id: Option<String>,
    /// The sweep's axes by dotted path, with their values for this frame; they become columns of `index.csv`.
    #[serde(default)]
    pub axes: Map<String, Value>,
    /// The channels that the frame has.
    pub outputs: OutputSet,
    /// Everything else about the frame.
    #[serde(default)]
    pub spec: Value,
}

/// A line of `plan.jsonl`.
#[derive(Serialize)]
struct Line<'a> {
    index: usize,
    #[serde(flatten)]
    frame: &'a PlanFrame,
}

/// Checks every id and that none comes twice.
pub(crate) fn check(plan: &[PlanFrame]) -> Result<()> {
    let mut seen = HashSet::new();
    for frame in plan {
        check_id(&frame.id)?;
        if !seen.insert(frame.id.as_str()) {
            return Err(Error::BadId { id: frame.id.clone(), reason: "the plan has it twice" });
        }
    }
    Ok(())
}

/// The text of `plan.jsonl`.
pub(crate) fn to_lines(plan: &[PlanFrame], dir: &Path) -> Result<String> {
    let mut text = String::new();
    for (index, frame) in plan.iter().enumerate() {
        let line = serde_json::to_string(&Line { index, frame });
        text.push_str(&line.map_err(|e| Error::io("write", &dir.join(PLAN))(e.into()))?);
        text.push('\n');
    }
    Ok(text)
}

/// The frames of a data set, from its `plan.jsonl`.
///
/// # Errors
/// As [`lines`].
pub(crate) fn read(dir: &Path) -> Result<Vec<PlanFrame>> {
    lines(dir)?.collect()
}

/// The same line by line.
///
/// # Errors
/// [`Error::Io`] when it cannot be read; the items are [`Error::Damaged`] naming a line that is no frame.
pub(crate) fn lines(dir: &Path) -> Result<impl Iterator<Item = Result<PlanFrame>> + use<>> {
    let path = dir.join(PLAN);
    let lines = BufReader::new(File::open(&path).map_err(Error::io("read", &path))?).lines();
    Ok(lines.enumerate().map(move |(i, line)| {
        let line = line.map_err(Error::io("read", &path))?;
        serde_json::from_str(&line).map_err(|e| Error::damaged(&path)(format!("line {}: {e}", i + 1)))
    }))
}
