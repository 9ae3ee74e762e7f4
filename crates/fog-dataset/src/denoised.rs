//! Files of a denoised picture: outside of the frame's marker, for their bytes are not the frame's alone.

use std::fs;
use std::path::Path;

use serde_json::{Value, json};

use crate::marker::{Check, FileEntry};
use crate::names::Kind;
use crate::{Error, FrameFiles, Result, atomic, encode, layers};

/// Writes the pictures, then the record with their hashes.
pub(crate) fn write(dir: &Path, files: &FrameFiles<'_>) -> Result<()> {
    let path = dir.join(Kind::Denoised.file(files.id));
    let refuse = |reason: &str| Error::picture("encode", &path)(reason);
    let denoised =
        files.denoised.ok_or_else(|| refuse("the frame's outputs ask for it, but it was not given"))?;
    if denoised.rgb.len() != files.frame.pixel_count() {
        return Err(refuse("it has not as many pixels as the frame"));
    }
    let mut entries = Vec::new();
    for kind in Kind::DENOISED {
        let name = kind.file(files.id);
        let path = dir.join(&name);
        let content = match kind {
            Kind::Denoised => encode::radiance(files, layers::denoised(files.frame, &denoised.rgb), &path)?,
            _ => {
                let bytes = denoised.to_srgb8(files.exposure);
                encode::png(files.frame.width, files.frame.height, &bytes, &path)?
            }
        };
        atomic::write(dir, &name, &content)?;
        entries.push(FileEntry::of(name, &content));
    }
    let mut record = denoised.details.clone();
    record["files"] = json!(entries);
    atomic::write(dir, &Kind::Denoising.file(files.id), &encode::pretty(&record))
}

/// What is wrong with the files of a frame that asks for them, by file name.
pub(crate) fn faults(dir: &Path, id: &str, check: Check) -> Vec<(String, String)> {
    let name = Kind::Denoising.file(id);
    let entries = fs::read(dir.join(&name)).map_err(|e| format!("cannot be read: {e}")).and_then(|text| {
        let record: Value = serde_json::from_slice(&text).map_err(|e| format!("is damaged: {e}"))?;
        let entries: Vec<FileEntry> =
            serde_json::from_value(record["files"].clone()).map_err(|e| format!("is damaged: {e}"))?;
        let complete = Kind::DENOISED.iter().all(|kind| entries.iter().any(|e| e.name == kind.file(id)));
        if complete { Ok(entries) } else { Err("does not name both pictures".to_owned()) }
    });
    match entries {
        Err(fault) => vec![(name, fault)],
        Ok(entries) => {
            let fault = |entry: FileEntry| entry.fault(dir, check).map(|fault| (entry.name, fault));
            entries.into_iter().filter_map(fault).collect()
        }
    }
}
