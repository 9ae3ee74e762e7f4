//! `dataset.json`: what the folder holds. Written first and never replaced, it claims the folder.

use std::fs;
use std::path::Path;

use serde::{Deserialize, Serialize};
use serde_json::Value;

use crate::names::HEADER;
use crate::{Error, FileEntry, Result};

/// Value of [`Header::format`].
pub const FORMAT: &str = "fogbank-dataset";
/// Value of [`Header::format_version`] that this crate reads and writes.
pub const FORMAT_VERSION: u32 = 1;

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
    /// Digest of the code.
    pub code_digest: String,
    /// `config.resolved.yaml`, `plan.jsonl` and, where frames have classes, `classes.json`, with their hashes.
    pub files: Vec<FileEntry>,
    /// What the caller tells about the data set.
    pub details: Value,
}

impl Header {
    /// Reads `dataset.json`; `None` when there is none.
    pub(crate) fn read(dir: &Path) -> Result<Option<Self>> {
        let path = dir.join(HEADER);
        let text = match fs::read(&path) {
            Ok(text) => text,
            Err(e) if e.kind() == std::io::ErrorKind::NotFound => return Ok(None),
            Err(e) => return Err(Error::io("read", &path)(e)),
        };
        let header: Self = serde_json::from_slice(&text).map_err(Error::damaged(&path))?;
        if header.format != FORMAT || header.format_version != FORMAT_VERSION {
            let found = format!("format `{}` version {}", header.format, header.format_version);
            let reason =
                format!("it says {found}, but this program knows `{FORMAT}` version {FORMAT_VERSION}");
            return Err(Error::damaged(&path)(reason));
        }
        Ok(Some(header))
    }
}
