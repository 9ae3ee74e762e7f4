//! Frames of one data set must not come from different contents of one file.

use crate::error::Error;
use crate::resources::Resources;
use fog_dataset::DataSet;
use fog_plan::FrameSpec;
use std::path::Path;

/// Refuses a data set with a frame that was made from another content of a file than `resources` has read. A frame's record
/// has the hashes, in `fog_state.files` and `lighting.environment.blake3`.
///
/// # Errors
/// [`Error::FileChanged`], or if the record of a frame that is done cannot be read.
pub(crate) fn refuse(data_set: &DataSet, frames: &[FrameSpec], resources: &Resources) -> Result<(), Error> {
    let paths: Vec<&Path> = frames.iter().flat_map(|frame| frame.fog.files()).collect();
    let ours = resources.files().hashes(paths);
    let reads_files = |f: &&FrameSpec| !f.fog.files().is_empty() || f.lighting.image().is_some();
    for frame in frames.iter().filter(reads_files).filter(|f| data_set.is_done(&f.id)) {
        let record = fog_dataset::read_record(data_set.dir(), &frame.id)?;
        let theirs = &record["fog_state"]["files"];
        let changed = |(file, hash): &(&String, &String)| theirs[*file].as_str().is_some_and(|h| h != *hash);
        let fog = ours.iter().find(changed).map(|(file, _)| file.clone());
        let image = frame.lighting.image().filter(|_| {
            let theirs = record["lighting"]["environment"]["blake3"].as_str();
            let ours = resources.surroundings().hash(&frame.lighting);
            ours.zip(theirs).is_some_and(|(ours, theirs)| ours != theirs)
        });
        if let Some(file) = fog.or(image.map(|image| image.display().to_string())) {
            let (dir, frame) = (data_set.dir().to_owned(), frame.id.clone());
            return Err(Error::FileChanged { dir, file, frame });
        }
    }
    Ok(())
}
