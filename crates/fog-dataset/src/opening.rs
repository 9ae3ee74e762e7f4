//! What becomes of a data set that is there already.

use serde::Deserialize;
use serde_json::{Value, json};

use crate::header::Header;
use crate::names::{CLASSES, HEADER, INDEX, Kind};
use crate::plan::EachFrame;
use crate::store::Store;
use crate::survey::Survey;
use crate::{Error, FrameList, OutputSet, Result, encode, plan};

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
pub(crate) fn replace(store: &Store, ours: Header) -> Result<Header> {
    let old = plan::read_list(store)?;
    let survey = Survey::of(store, &old)?;
    for place in 0..old.len() {
        for kind in Kind::all().filter(|&kind| survey.has(place, kind)) {
            store.remove(&kind.file(old.id(place)))?;
        }
    }
    store.remove(INDEX)?;
    store.remove(CLASSES)?;
    // Until now it is the old data set with fewer frames, from now on the new one with none.
    write(store, ours)
}

/// What a longer plan must keep of a frame.
#[derive(Deserialize)]
struct Kept {
    id: String,
    outputs: OutputSet,
    #[serde(default)]
    spec: Spec,
}

#[derive(Default, Deserialize)]
struct Spec {
    #[serde(default)]
    digest: Value,
}

/// Makes the folder's data set that of a longer plan.
pub(crate) fn extend(
    store: &Store,
    found: &Header,
    ours: Header,
    list: &FrameList,
    frames: &EachFrame<'_>,
) -> Result<Header> {
    if found.code_digest != ours.code_digest {
        let (found, expected) = (found.code_digest.clone(), ours.code_digest);
        return Err(Error::CodeDiffers { dir: store.place().to_path_buf(), found, expected });
    }
    let mut digests = Vec::with_capacity(list.len());
    frames(&mut |frame| {
        digests.push(frame.spec.get("digest").cloned().unwrap_or_default());
        Ok(())
    })?;
    plan::read(store, &mut |Kept { id, outputs, spec }| {
        let same = |place| list.outputs(place) == outputs && digests[place] == spec.digest;
        if list.find(&id).is_some_and(same) {
            return Ok(());
        }
        Err(Error::NotAnExtension { dir: store.place().to_path_buf(), frame: id })
    })?;
    let mut extends = found.extends.clone();
    extends.push(found.config_digest.clone());
    write(store, Header { extends, ..ours })
}

/// Replaces the header, before the files that it names as in a new folder: whoever is killed after this leaves the rest to be
/// written by the next.
fn write(store: &Store, header: Header) -> Result<Header> {
    store.write(HEADER, encode::pretty(&json!(header)))?;
    store.sync()?;
    Ok(header)
}
