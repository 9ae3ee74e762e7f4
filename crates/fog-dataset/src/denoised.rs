//! Files of a denoised picture: outside of the frame's marker, for their bytes are not the frame's alone.

use serde_json::{Value, json};

use crate::marker::{Check, FileEntry};
use crate::names::Kind;
use crate::store::Store;
use crate::{Error, FrameFiles, Result, encode, layers};

/// The pictures and the record with their hashes, by file name.
pub(crate) fn files(store: &Store, files: &FrameFiles<'_>) -> Result<Vec<(String, Vec<u8>)>> {
    let path = store.path(&Kind::Denoised.file(files.id));
    let refuse = |reason: &str| Error::picture("encode", &path)(reason);
    let denoised =
        files.denoised.ok_or_else(|| refuse("the frame's outputs ask for it, but it was not given"))?;
    if denoised.rgb.len() != files.frame.pixel_count() {
        return Err(refuse("it has not as many pixels as the frame"));
    }
    let (mut entries, mut contents) = (Vec::new(), Vec::new());
    for kind in Kind::DENOISED {
        let name = kind.file(files.id);
        let path = store.path(&name);
        let content = match kind {
            Kind::Denoised => encode::radiance(files, layers::denoised(files.frame, &denoised.rgb), &path)?,
            _ => {
                let bytes = denoised.to_srgb8(files.exposure);
                encode::png(files.frame.width, files.frame.height, &bytes, &path)?
            }
        };
        entries.push(FileEntry::of(name.clone(), &content));
        contents.push((name, content));
    }
    let mut record = denoised.details.clone();
    record["files"] = json!(entries);
    contents.push((Kind::Denoising.file(files.id), encode::pretty(&record)));
    Ok(contents)
}

/// What is wrong with the files of a frame that asks for them, by file name.
pub(crate) fn faults(store: &Store, id: &str, check: Check) -> Vec<(String, String)> {
    let name = Kind::Denoising.file(id);
    let text =
        store.read(&name).map_err(|e| e.to_string()).and_then(|text| text.ok_or("is missing".to_owned()));
    let entries = text.and_then(|text| {
        let record: Value = serde_json::from_slice(&text).map_err(|e| format!("is damaged: {e}"))?;
        let entries: Vec<FileEntry> =
            serde_json::from_value(record["files"].clone()).map_err(|e| format!("is damaged: {e}"))?;
        let complete = Kind::DENOISED.iter().all(|kind| entries.iter().any(|e| e.name == kind.file(id)));
        if complete { Ok(entries) } else { Err("does not name both pictures".to_owned()) }
    });
    match entries {
        Err(fault) => vec![(name, fault)],
        Ok(entries) => {
            let fault = |entry: FileEntry| entry.fault(store, check).map(|fault| (entry.name, fault));
            entries.into_iter().filter_map(fault).collect()
        }
    }
}
