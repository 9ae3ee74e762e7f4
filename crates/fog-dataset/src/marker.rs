//! The marker that makes a frame count as done.

use std::fs;
use std::path::Path;

use serde::{Deserialize, Serialize};

use crate::names::Kind;
use crate::{Error, OutputSet, Result, denoised};

/// Size and hash of a file of the data set.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FileEntry {
    /// File name in the data set's folder.
    pub name: String,
    /// Size in bytes.
    pub bytes: u64,
    /// BLAKE3 hash in hexadecimal.
    pub blake3: String,
}

/// Content of `<id>.done`.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Marker {
    /// The frame.
    pub id: String,
    /// Digest of the configuration that it was rendered from.
    pub config_digest: String,
    /// Digest of the code that rendered it.
    pub code_digest: String,
    /// The frame's files, but for the timings and a denoised picture.
    pub files: Vec<FileEntry>,
}

/// How closely files are compared with their entries.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Check {
    Size,
    Hash,
}

impl FileEntry {
    /// Entry of a file with the given content.
    pub(crate) fn of(name: String, content: &[u8]) -> Self {
        Self { name, bytes: content.len() as u64, blake3: blake3::hash(content).to_hex().to_string() }
    }

    /// What is wrong with the file in `dir`, if anything.
    pub(crate) fn fault(&self, dir: &Path, check: Check) -> Option<String> {
        let path = dir.join(&self.name);
        let found = match fs::metadata(&path) {
            Ok(m) if m.is_file() => m.len(),
            Ok(_) => return Some("is no file".to_owned()),
            Err(e) => return Some(format!("cannot be read: {e}")),
        };
        if found != self.bytes {
            return Some(format!("has {found} bytes instead of {}", self.bytes));
        }
        if check == Check::Size {
            return None;
        }
        let mut hasher = blake3::Hasher::new();
        match fs::File::open(&path).and_then(|file| hasher.update_reader(file).map(drop)) {
            Err(e) => Some(format!("cannot be read: {e}")),
            Ok(()) if hasher.finalize().to_hex().as_str() != self.blake3 => {
                Some("has another content than its recorded hash".to_owned())
            }
            Ok(()) => None,
        }
    }
}

impl Marker {
    /// Reads `<id>.done`; `None` when there is none.
    ///
    /// # Errors
    /// [`Error::Damaged`] when it is no marker of this frame, [`Error::Io`] when it cannot be read.
    pub(crate) fn read(dir: &Path, id: &str) -> Result<Option<Self>> {
        let path = dir.join(Kind::Done.file(id));
        let text = match fs::read(&path) {
            Ok(text) => text,
            Err(e) if e.kind() == std::io::ErrorKind::NotFound => return Ok(None),
            Err(e) => return Err(Error::io("read", &path)(e)),
        };
        let marker: Self = serde_json::from_slice(&text).map_err(Error::damaged(&path))?;
        if marker.id != id {
            return Err(Error::damaged(&path)(format!("it is the marker of frame `{}`", marker.id)));
        }
        Ok(Some(marker))
    }

    /// What is wrong with the frame's files, by file name: files that the outputs ask for and the marker lacks, and files
    /// that differ from their entries.
    pub(crate) fn faults(&self, dir: &Path, outputs: OutputSet, check: Check) -> Vec<(String, String)> {
        let mut faults = Vec::new();
        for kind in Kind::HASHED.into_iter().filter(|k| k.wanted(outputs)) {
            let name = kind.file(&self.id);
            match self.files.iter().find(|f| f.name == name) {
                Some(entry) => faults.extend(entry.fault(dir, check).map(|fault| (name, fault))),
                None => faults.push((name, "is not in the frame's marker".to_owned())),
            }
        }
        if outputs.denoised {
            faults.extend(denoised::faults(dir, &self.id, check));
        }
        faults
    }
}
