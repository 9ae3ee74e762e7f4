//! What becomes of a data set that is there already.

use std::collections::HashMap;
use std::path::Path;

use serde_json::json;

use crate::header::Header;
use crate::names::{CLASSES, HEADER, INDEX, Kind};
use crate::{Error, PlanFrame, Result, atomic, encode, plan};

/// How a folder is opened that may hold a data set.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Opening {
    /// Goes on with the same data set; another one is refused.
    #[default]
    Resume,
    /// Replaces a data set of another configuration or program: its files are removed, and nothing else.
    Overwrite,
    /// Takes a plan that has all frames of the folder's and more; those that are done are kept.
    Extend,
}

/// Removes the frames of the folder's data set and makes the folder that of another.
pub(crate) fn replace(dir: &Path, ours: Header) -> Result<Header> {
    for frame in plan::read(dir)? {
        for kind in Kind::all() {
            atomic::remove(&dir.join(kind.file(&frame.id)))?;
        }
    }
    atomic::remove(&dir.join(INDEX))?;
    atomic::remove(&dir.join(CLASSES))?;
    // Until now it is the old data set with fewer frames, from now on the new one with none.
    write(dir, ours)
}

/// Makes the folder's data set that of a longer plan.
pub(crate) fn extend(dir: &Path, found: &Header, ours: Header, frames: &[PlanFrame]) -> Result<Header> {
    if found.code_digest != ours.code_digest {
        let (found, expected) = (found.code_digest.clone(), ours.code_digest);
        return Err(Error::CodeDiffers { dir: dir.to_path_buf(), found, expected });
    }
    let new: HashMap<&str, &PlanFrame> = frames.iter().map(|frame| (frame.id.as_str(), frame)).collect();
    let same = |old: &PlanFrame, new: &PlanFrame| {
        old.outputs == new.outputs && old.spec.get("digest") == new.spec.get("digest")
    };
    for old in plan::read(dir)? {
        if !new.get(old.id.as_str()).is_some_and(|new| same(&old, new)) {
            return Err(Error::NotAnExtension { dir: dir.to_path_buf(), frame: old.id });
        }
    }
    let mut extends = found.extends.clone();
    extends.push(found.config_digest.clone());
    write(dir, Header { extends, ..ours })
}

/// Replaces the header, before the files that it names as in a new folder: whoever is killed after this leaves the rest to be
/// written by the next.
fn write(dir: &Path, header: Header) -> Result<Header> {
    atomic::write(dir, HEADER, &encode::pretty(&json!(header)))?;
    atomic::sync_dir(dir)?;
    Ok(header)
}
