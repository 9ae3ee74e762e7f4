//! Reading a data set back.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use serde_json::Value;

use crate::header::Header;
use crate::names::{Kind, check_id};
use crate::{Channel, Error, PlanFrame, Result, plan, read_exr_channels};

/// A frame as it is stored.
#[derive(Clone, Debug, PartialEq)]
pub struct StoredFrame {
    /// All channels of `<id>.hdr.exr` and `<id>.gt.exr` by their names there, as `R`, `airlight.G`, `depth.Z`.
    pub channels: BTreeMap<String, Channel>,
    /// `<id>.json`.
    pub record: Value,
}

/// Reads one frame; files that its outputs did not ask for are simply not there.
///
/// # Errors
/// [`Error::BadId`], [`Error::Io`] when the record or a present file cannot be read, [`Error::Damaged`] or
/// [`Error::Picture`] when it does not parse.
pub fn read_frame(dir: &Path, id: &str) -> Result<StoredFrame> {
    let record = read_record(dir, id)?;
    let mut channels = BTreeMap::new();
    for kind in [Kind::Hdr, Kind::Truth] {
        match read_exr_channels(&dir.join(kind.file(id))) {
            Ok(found) => channels.extend(found),
            Err(Error::Io { source, .. }) if source.kind() == std::io::ErrorKind::NotFound => {}
            Err(e) => return Err(e),
        }
    }
    Ok(StoredFrame { channels, record })
}

/// Reads `<id>.json` of one frame.
///
/// # Errors
/// [`Error::BadId`], [`Error::Io`] when it cannot be read, [`Error::Damaged`] when it does not parse.
pub fn read_record(dir: &Path, id: &str) -> Result<Value> {
    check_id(id)?;
    let path = dir.join(Kind::Record.file(id));
    let text = fs::read(&path).map_err(Error::io("read", &path))?;
    serde_json::from_slice(&text).map_err(Error::damaged(&path))
}

/// Where the picture of a frame is: its linear radiance if that is an output, else its sRGB picture; `None` when it has
/// neither or is not rendered.
#[must_use]
pub fn picture_path(dir: &Path, frame: &PlanFrame) -> Option<PathBuf> {
    let outputs = frame.outputs;
    let kinds = [(outputs.hdr, Kind::Hdr), (outputs.image, Kind::Image)];
    let (_, kind) = kinds.into_iter().find(|(wanted, _)| *wanted)?;
    Some(dir.join(kind.file(&frame.id))).filter(|path| path.is_file())
}

/// Reads `dataset.json`.
///
/// # Errors
/// [`Error::Io`] when there is none or it cannot be read, [`Error::Damaged`] when it is not ours.
pub fn read_header(dir: &Path) -> Result<Header> {
    let missing = || Error::io("read", &dir.join(crate::names::HEADER))(std::io::ErrorKind::NotFound.into());
    Header::read(dir)?.ok_or_else(missing)
}

/// Reads the frames of `plan.jsonl`, in order.
///
/// # Errors
/// [`Error::Io`] when it cannot be read, [`Error::Damaged`] naming the line that is no frame.
pub fn read_plan(dir: &Path) -> Result<Vec<PlanFrame>> {
    plan::read(dir)
}
