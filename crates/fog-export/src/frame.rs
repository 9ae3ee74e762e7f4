//! A frame as formats see it.

use std::cell::OnceCell;
use std::path::PathBuf;

use fog_dataset::{Channel, FileEntry, FileKind, Mask, OutputSet, PlanFrame, Reader};
use serde_json::{Value, json};

use crate::{Error, Result};

/// A finished frame; its files are read when they are asked for.
pub(crate) struct Frame<'a> {
    /// Counts the exported frames from 0.
    pub(crate) number: u64,
    /// Its line of the plan.
    pub(crate) plan: &'a PlanFrame,
    reader: &'a Reader,
    record: OnceCell<Value>,
}

impl<'a> Frame<'a> {
    pub(crate) fn new(number: u64, plan: &'a PlanFrame, reader: &'a Reader) -> Self {
        Self { number, plan, reader, record: OnceCell::new() }
    }

    pub(crate) fn id(&self) -> &str {
        &self.plan.id
    }

    pub(crate) fn outputs(&self) -> OutputSet {
        self.plan.outputs
    }

    /// Columns and rows.
    pub(crate) fn size(&self) -> Result<[u32; 2]> {
        let sensor = &self.record()?["sensor"];
        let side = |key: &str| sensor[key].as_u64().and_then(|n| u32::try_from(n).ok());
        match (side("width_px"), side("height_px")) {
            (Some(width), Some(height)) => Ok([width, height]),
            _ => Err(self.damaged("json", "it has no sensor.width_px and height_px")),
        }
    }

    /// What formats without a place for fog and light keep beside a picture: id, pair, axes, fog, state of the fog at the camera,
    /// lighting, camera.
    pub(crate) fn details(&self) -> Result<Value> {
        let record = self.record()?;
        let mut details = json!({ "id": self.id(), "pair_id": self.plan.pair_id, "axes": self.plan.axes });
        for key in ["fog", "lighting", "camera", "rig", "path"] {
            if !record[key].is_null() {
                details[key] = record[key].clone();
            }
        }
        details["intrinsics"] = record["sensor"]["intrinsics"].clone();
        details["fog_at_camera"] = record["fog_state"]["at_camera"].clone();
        Ok(details)
    }

    /// Names and sizes of its files, but for timings and a denoised picture.
    pub(crate) fn files(&self) -> Result<Vec<FileEntry>> {
        Ok(self.reader.files(self.plan)?)
    }

    /// Where a file of it is.
    pub(crate) fn path(&self, kind: FileKind) -> PathBuf {
        self.reader.path(self.plan, kind)
    }

    /// `<id>.json`.
    pub(crate) fn record(&self) -> Result<&Value> {
        if let Some(record) = self.record.get() {
            return Ok(record);
        }
        let record = self.reader.json(self.plan, FileKind::Record)?;
        Ok(self.record.get_or_init(|| record))
    }

    /// The things of `<id>.objects.json`, hidden ones too.
    pub(crate) fn objects(&self) -> Result<Vec<Value>> {
        match self.reader.json(self.plan, FileKind::Objects)?["objects"].take() {
            Value::Array(objects) => Ok(objects),
            _ => Err(self.damaged("objects.json", "it has no list `objects`")),
        }
    }

    /// Classes, instances or the raw picture.
    pub(crate) fn mask(&self, kind: FileKind) -> Result<Mask> {
        Ok(self.reader.mask(self.plan, kind)?)
    }

    /// A channel of an OpenEXR file of the frame.
    pub(crate) fn channel(&self, kind: FileKind, name: &str) -> Result<Channel> {
        let found = self.reader.channels(self.plan, kind)?.remove(name);
        found.ok_or_else(|| self.damaged("gt.exr", format!("it has no channel {name}")))
    }

    /// An error about the content of one of the frame's files.
    pub(crate) fn damaged(&self, what: &'static str, reason: impl Into<String>) -> Error {
        Error::Damaged { frame: self.id().to_owned(), what, reason: reason.into() }
    }
}
