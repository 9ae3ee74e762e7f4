//! The frames of a data set, as lines of `plan.jsonl`.

use std::io::{BufRead, Write};
use std::path::Path;

use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};

use crate::marker::FileEntry;
use crate::names::PLAN;
use crate::store::Store;
use crate::{Error, FrameList, OutputSet, Result};

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

/// A plan that is given frame by frame: what its `plan.jsonl` holds, without its text.
#[derive(Debug, Default)]
pub struct Planned {
    frames: FrameList,
    hasher: blake3::Hasher,
}

impl Planned {
    /// The next frame.
    ///
    /// # Errors
    /// [`Error::BadId`] for an id that cannot name files, or that comes twice.
    pub fn push(&mut self, frame: &PlanFrame) -> Result<()> {
        self.hasher.update(&line(self.frames.len(), frame));
        self.frames.push(&frame.id, frame.outputs)
    }

    /// The frames so far.
    #[must_use]
    pub fn frames(&self) -> &FrameList {
        &self.frames
    }

    pub(crate) fn entry(&self) -> FileEntry {
        let (bytes, blake3) = (self.hasher.count(), self.hasher.finalize().to_hex().to_string());
        FileEntry { name: PLAN.to_owned(), bytes, blake3 }
    }

    pub(crate) fn into_frames(self) -> FrameList {
        self.frames
    }
}

/// Gives every frame of a plan in order to its argument.
pub type EachFrame<'a> = dyn Fn(&mut dyn FnMut(&PlanFrame) -> Result<()>) -> Result<()> + 'a;

/// Writes `plan.jsonl`.
pub(crate) fn write(store: &Store, frames: &EachFrame<'_>) -> Result<()> {
    let mut file = store.create(PLAN)?;
    let mut index = 0;
    frames(&mut |frame| {
        file.write_all(&line(index, frame)).map_err(Error::io("write", &store.path(PLAN)))?;
        index += 1;
        Ok(())
    })?;
    file.finish()
}

fn line(index: usize, frame: &PlanFrame) -> Vec<u8> {
    // A map of strings to values always has a text.
    let mut line = serde_json::to_vec(&Line { index, frame }).unwrap_or_default();
    line.push(b'\n');
    line
}

/// Reads the frames of a data set's `plan.jsonl` one by one.
///
/// # Errors
/// [`Error::Io`] when it cannot be read, [`Error::Damaged`] naming the line that is no frame.
pub(crate) fn read<T: for<'de> Deserialize<'de>>(
    store: &Store,
    each: &mut dyn FnMut(T) -> Result<()>,
) -> Result<()> {
    let path = store.path(PLAN);
    let file =
        store.open(PLAN)?.ok_or_else(|| Error::io("read", &path)(std::io::ErrorKind::NotFound.into()))?;
    for (i, line) in file.lines().enumerate() {
        let line = line.map_err(Error::io("read", &path))?;
        each(
            serde_json::from_str(&line).map_err(|e| Error::damaged(&path)(format!("line {}: {e}", i + 1)))?,
        )?;
    }
    Ok(())
}

/// Reads the frames of `plan.jsonl`, in order.
///
/// # Errors
/// [`Error::Io`] when it cannot be read, [`Error::Damaged`] naming the line that is no frame.
pub fn read_plan(dir: &Path) -> Result<Vec<PlanFrame>> {
    let mut frames = Vec::new();
    read(&Store::at(dir)?, &mut |frame| {
        frames.push(frame);
        Ok(())
    })?;
    Ok(frames)
}

/// Ids and outputs of the frames of `plan.jsonl`, in order.
///
/// # Errors
/// [`Error::Io`] when it cannot be read, [`Error::Damaged`] naming the line that is no frame, [`Error::BadId`].
pub(crate) fn read_list(store: &Store) -> Result<FrameList> {
    #[derive(Deserialize)]
    struct Owned {
        id: String,
        outputs: OutputSet,
    }
    let mut list = FrameList::default();
    read(store, &mut |Owned { id, outputs }| list.push(&id, outputs))?;
    Ok(list)
}
