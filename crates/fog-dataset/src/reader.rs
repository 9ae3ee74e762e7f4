//! A finished or half-filled data set frame by frame, for those who turn it into something else. Holds no frame longer than it
//! is asked for, and not the plan: a data set may have millions of them.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use serde_json::Value;

use crate::header::Header;
use crate::marker::{Check, FileEntry, Marker};
use crate::names::{CLASSES, check_id};
use crate::{
    Channel, Error, FileKind, FrameState, PlanFrame, Result, Values, plan, read_exr_channels, read_header,
};

/// An open data set that is only read.
#[derive(Clone, Debug)]
pub struct Reader {
    dir: PathBuf,
    header: Header,
}

/// A picture of whole numbers: classes, instances, a sensor's raw picture.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Mask {
    /// Columns.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Row-major values, row 0 at the top.
    pub values: Vec<u16>,
}

impl Reader {
    /// Opens the data set that a folder holds.
    ///
    /// # Errors
    /// [`Error::Io`] or [`Error::Damaged`] when its `dataset.json` cannot be read.
    pub fn open(dir: &Path) -> Result<Self> {
        Ok(Self { dir: dir.to_path_buf(), header: read_header(dir)? })
    }

    /// The folder.
    #[must_use]
    pub fn dir(&self) -> &Path {
        &self.dir
    }

    /// `dataset.json`.
    #[must_use]
    pub fn header(&self) -> &Header {
        &self.header
    }

    /// The frames of the plan in order, read line by line.
    ///
    /// # Errors
    /// [`Error::Io`] when `plan.jsonl` cannot be read; the items are [`Error::Damaged`] naming a line that is no frame, and
    /// [`Error::BadId`].
    pub fn frames(&self) -> Result<impl Iterator<Item = Result<PlanFrame>> + use<>> {
        Ok(plan::lines(&self.dir)?.map(|frame| {
            let frame = frame?;
            check_id(&frame.id)?;
            Ok(frame)
        }))
    }

    /// Whether the frame is done (its marker is of this data set, and its files are there with their recorded sizes), failed
    /// or neither.
    #[must_use]
    pub fn state(&self, frame: &PlanFrame) -> FrameState {
        let is_done = self.header.is_complete(&self.dir, frame, Check::Size);
        FrameState::of(is_done, &self.dir, &frame.id)
    }

    /// Names, sizes and hashes of a finished frame's files, but for timings and a denoised picture.
    ///
    /// # Errors
    /// [`Error::Damaged`] or [`Error::Io`] when its marker cannot be read.
    pub fn files(&self, frame: &PlanFrame) -> Result<Vec<FileEntry>> {
        Ok(Marker::read(&self.dir, &frame.id)?.map_or_else(Vec::new, |marker| marker.files))
    }

    /// Where a file of the frame is, if its outputs ask for it.
    #[must_use]
    pub fn path(&self, frame: &PlanFrame, kind: FileKind) -> PathBuf {
        self.dir.join(kind.file(&frame.id))
    }

    /// A file of JSON: the record or the objects.
    ///
    /// # Errors
    /// [`Error::Io`] when it cannot be read, [`Error::Damaged`] when it does not parse.
    pub fn json(&self, frame: &PlanFrame, kind: FileKind) -> Result<Value> {
        read_json(&self.path(frame, kind))
    }

    /// The text of a file of JSON: its numbers are those that were written, to the last digit.
    ///
    /// # Errors
    /// [`Error::Io`] when it cannot be read, or is no text.
    pub fn text(&self, frame: &PlanFrame, kind: FileKind) -> Result<String> {
        let path = self.path(frame, kind);
        fs::read_to_string(&path).map_err(Error::io("read", &path))
    }

    /// A picture of whole numbers: classes, instances, the raw picture.
    ///
    /// # Errors
    /// [`Error::Io`] when it cannot be read, [`Error::Picture`] when it is no grey PNG of 8 or 16 bits.
    pub fn mask(&self, frame: &PlanFrame, kind: FileKind) -> Result<Mask> {
        let raster = self.raster(frame, kind)?;
        let (width, height) = (raster.width, raster.height);
        let values = match raster.values {
            Values::U8(values) if raster.components == 1 => values.into_iter().map(u16::from).collect(),
            Values::U16(values) => values,
            _ => return Err(Error::picture("decode", &self.path(frame, kind))("its pixels are not grey")),
        };
        Ok(Mask { width, height, values })
    }

    /// All channels of an OpenEXR file by their names there, as `depth.Z`.
    ///
    /// # Errors
    /// [`Error::Io`] when it cannot be opened, [`Error::Picture`] when it cannot be decoded.
    pub fn channels(&self, frame: &PlanFrame, kind: FileKind) -> Result<BTreeMap<String, Channel>> {
        read_exr_channels(&self.path(frame, kind))
    }

    /// `classes.json`; `None` if no frame has classes.
    ///
    /// # Errors
    /// [`Error::Io`] when it cannot be read, [`Error::Damaged`] when it does not parse.
    pub fn classes(&self) -> Result<Option<Value>> {
        let path = self.dir.join(CLASSES);
        if path.is_file() { read_json(&path).map(Some) } else { Ok(None) }
    }
}

fn read_json(path: &Path) -> Result<Value> {
    let text = fs::read(path).map_err(Error::io("read", path))?;
    serde_json::from_slice(&text).map_err(Error::damaged(path))
}
