//! `dataset.json`: what the folder holds. Written first, it claims the folder.

use std::fs;
use std::path::Path;

use serde::{Deserialize, Serialize};
use serde_json::Value;

use crate::marker::{Check, Marker};
use crate::names::HEADER;
use crate::verify::foreign;
use crate::{Error, FileEntry, PlanFrame, Result};

/// Value of [`Header::format`].
pub const FORMAT: &str = "fogbank-dataset";
/// Value of [`Header::format_version`] that this crate writes. 2: Cryptomatte layer of `instance`, `worldToCamera` and
/// `worldToNDC` in place of `fogbank.world_from_camera`, `whiteLuminance`. Version 1 is read, too.
pub const FORMAT_VERSION: u32 = 2;

/// Content of `dataset.json`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Header {
    /// [`FORMAT`].
    pub format: String,
    /// [`FORMAT_VERSION`].
    pub format_version: u32,
    /// The data set's name.
    pub name: String,
    /// Number of frames in the plan.
    pub frames: u64,
    /// Digest of the configuration.
    pub config_digest: String,
    /// Digests of the configurations that this one extends, from the first on; frames made from them count as this one's.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub extends: Vec<String>,
    /// Digest of the code.
    pub code_digest: String,
    /// `config.resolved.yaml`, `plan.jsonl` and, where frames have classes, `classes.json`, with their hashes.
    pub files: Vec<FileEntry>,
    /// What the caller tells about the data set.
    pub details: Value,
}

impl Header {
    /// Whether both are of the same frames, made by the same program.
    pub(crate) fn is_of_one_data_set(&self, other: &Self) -> bool {
        (&self.config_digest, &self.code_digest, &self.files)
            == (&other.config_digest, &other.code_digest, &other.files)
    }

    /// Whether a frame made from this configuration belongs to the data set.
    pub(crate) fn takes(&self, config_digest: &str) -> bool {
        self.config_digest == config_digest || self.extends.iter().any(|digest| digest == config_digest)
    }

    /// Whether a frame is done: its marker is of this data set, and its files are there as the marker says.
    pub(crate) fn is_complete(&self, dir: &Path, frame: &PlanFrame, check: Check) -> bool {
        Marker::read(dir, &frame.id).is_ok_and(|marker| {
            marker.is_some_and(|marker| {
                foreign(&marker, self).is_empty() && marker.faults(dir, frame.outputs, check).is_empty()
            })
        })
    }

    /// Reads `dataset.json`; `None` when there is none.
    pub(crate) fn read(dir: &Path) -> Result<Option<Self>> {
        let path = dir.join(HEADER);
        let text = match fs::read(&path) {
            Ok(text) => text,
            Err(e) if e.kind() == std::io::ErrorKind::NotFound => return Ok(None),
            Err(e) => return Err(Error::io("read", &path)(e)),
        };
        let header: Self = serde_json::from_slice(&text).map_err(Error::damaged(&path))?;
        if header.format != FORMAT || !(1..=FORMAT_VERSION).contains(&header.format_version) {
            let found = format!("format `{}` version {}", header.format, header.format_version);
            let reason =
                format!("it says {found}, but this program knows `{FORMAT}` up to version {FORMAT_VERSION}");
            return Err(Error::damaged(&path)(reason));
        }
        Ok(Some(header))
    }
}
