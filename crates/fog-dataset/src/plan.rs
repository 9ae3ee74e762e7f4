//! The frames of a data set, as lines of `plan.jsonl`.

use std::io::{BufRead, Write};
use std::path::Path;

use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};

use crate::marker::FileEntry;
use crate::names::PLAN;
use crate::store::Store;
use crate::{Error, FrameList, Header, OutputSet, Result};

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

/// What a data set remembers of a line.
#[derive(Deserialize)]
struct Known<'a> {
    id: &'a str,
    outputs: OutputSet,
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

    /// The plan of a data set that is there and of this configuration and code, if its `plan.jsonl` is whole: it is what the same
    /// configuration would give again, read in a fraction of the time.
    ///
    /// # Errors
    /// [`Error::Io`] or [`Error::Damaged`] when the header cannot be read.
    pub fn stored(store: &Store, config_digest: &str, code_digest: &str) -> Result<Option<Self>> {
        let Some(header) = Header::read(store)? else { return Ok(None) };
        if header.config_digest != config_digest || header.code_digest != code_digest {
            return Ok(None);
        }
        let Some(entry) = header.files.iter().find(|entry| entry.name == PLAN) else { return Ok(None) };
        let Some(mut file) = store.open(PLAN)? else { return Ok(None) };
        let mut planned = Self::default();
        let mut line = Vec::new();
        while file.read_until(b'\n', &mut line).map_err(Error::io("read", &store.path(PLAN)))? > 0 {
            planned.hasher.update(&line);
            // The rest of the line is long, and of no use here.
            let known =
                line.windows(9).position(|w| w == b",\"spec\":{").map(|at| [&line[..at], b"}"].concat());
            let known = known.unwrap_or_else(|| line.clone());
            let Ok(Known { id, outputs }) = serde_json::from_slice(&known) else { return Ok(None) };
            if planned.frames.push(id, outputs).is_err() {
                return Ok(None);
            }
            line.clear();
        }
        Ok((planned.entry() == *entry).then_some(planned))
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

/// Reads the frames of a data set's `plan.jsonl` one by one; false from `each` ends that.
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
