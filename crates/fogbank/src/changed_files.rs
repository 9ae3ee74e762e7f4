//! Frames of one data set must not come from different contents of one file.

use crate::error::Error;
use crate::resources::Resources;
use fog_dataset::DataSet;
use fog_plan::FrameSpec;
use std::path::Path;

/// Refuses a data set with a frame that was made from another content of a file than `resources` has read. A frame's record
/// has the hashes, in `fog_state.files`, `sensor.raw.response_blake3` and `lighting.environment.blake3`.
///
/// # Errors
/// [`Error::FileChanged`], or if the record of a frame that is done cannot be read.
pub(crate) fn refuse(data_set: &DataSet, frames: &[FrameSpec], resources: &Resources) -> Result<(), Error> {
    let paths: Vec<&Path> = frames.iter().flat_map(|frame| frame.fog.files()).collect();
    let ours = resources.files().hashes(paths);
    let curves = |f: &FrameSpec| f.sensor.model.as_ref().and_then(|m| m.response_file()).map(Path::to_owned);
    let reads_files =
        |f: &&FrameSpec| !f.fog.files().is_empty() || f.lighting.image().is_some() || curves(f).is_some();
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
        let curves = curves(frame).filter(|file| {
            let theirs = record["sensor"]["raw"]["response_blake3"].as_str();
            let ours = resources.files().hashes([file.as_path()]).into_values().next();
            ours.zip(theirs).is_some_and(|(ours, theirs)| ours != theirs)
        });
        let other = image.map(Path::to_owned).or(curves).map(|file| file.display().to_string());
        if let Some(file) = fog.or(other) {
            let (dir, frame) = (data_set.dir().to_owned(), frame.id.clone());
            return Err(Error::FileChanged { dir, file, frame });
        }
    }
    Ok(())
}
