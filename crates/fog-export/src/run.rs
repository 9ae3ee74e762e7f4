//! From a data set to an export.

use std::path::Path;

use fog_dataset::{FrameState, PlanFrame, Reader};
use serde_json::{Value, json};

use crate::folder::{self, Folder};
use crate::frame::Frame;
use crate::job::Job;
use crate::summary::Losses;
use crate::{Error, Format, Options, Result, Summary};

/// Hears how far an export is. Every method may ask it to stop by returning false.
pub trait Progress {
    /// Before the first frame: how many frames there are to export.
    fn begin(&self, frames: u64) -> bool;
    /// After each frame.
    fn frame(&self, id: &str) -> bool;
}

/// Exports every finished frame of the data set in `dir` to the folder `out`.
///
/// If `out` holds the same export already nothing is done.
///
/// # Errors
/// [`Error::DataSet`] when the data set cannot be read; [`Error::MissingOutput`] or [`Error::Unfit`] for frames that the format
/// cannot be made of, before anything is written where that can be known; [`Error::Nothing`] when no frame is done;
/// [`Error::NotEmpty`], [`Error::OtherExport`] and [`Error::Busy`] about `out`; [`Error::Cancelled`]; [`Error::Io`]. Then `out`
/// is as before.
pub fn export(
    dir: &Path,
    format: Format,
    out: &Path,
    options: &Options,
    progress: &dyn Progress,
) -> Result<Summary> {
    let reader = Reader::open(dir)?;
    let mut summary = Summary::default();
    let digest = survey(&reader, format, &mut summary)?;
    if summary.exported == 0 {
        return Err(Error::Nothing { dir: dir.to_path_buf() });
    }
    let header = reader.header();
    let mut manifest = json!({
        "format": "fogbank-export",
        "format_version": 1,
        "export": format.name(),
        "program": env!("CARGO_PKG_VERSION"),
        "options": options,
        "data_set": {
            "name": header.name,
            "config_digest": header.config_digest,
            "code_digest": header.code_digest,
            "frames_digest": digest,
        },
        "frames": summary.exported,
    });
    let found = folder::manifest(out)?;
    if let Some(found) = found.filter(|_| !options.force) {
        if !is_part_of(&manifest, &found) {
            return Err(Error::OtherExport { dir: out.to_path_buf(), found: describe(&found) });
        }
        summary.was_there = true;
        summary.losses = serde_json::from_value(found["losses"].clone()).unwrap_or_default();
        return Ok(summary);
    }
    let losses = Losses::default();
    let folder = Folder::begin(out)?;
    let job = Job { format, reader: &reader, folder: &folder, options, losses: &losses };
    if write(&job, summary.exported, progress)? != digest {
        return Err(Error::Changed { dir: dir.to_path_buf() });
    }
    summary.losses = losses.list();
    manifest["not_exported"] = json!({ "failed": summary.failed, "missing": summary.missing });
    manifest["losses"] = json!(summary.losses);
    folder.finish(&manifest)?;
    Ok(summary)
}

/// Counts the frames by state, sees to it that each has what the format needs, and digests the ids of those that are done.
fn survey(reader: &Reader, format: Format, summary: &mut Summary) -> Result<String> {
    let mut digest = blake3::Hasher::new();
    for frame in reader.frames()? {
        let frame = frame?;
        match reader.state(&frame) {
            FrameState::Failed => summary.failed += 1,
            FrameState::Missing => summary.missing += 1,
            FrameState::Done => {
                check_outputs(&frame, format)?;
                summary.exported += 1;
                digest.update(frame.id.as_bytes()).update(b"\n");
            }
        }
    }
    Ok(digest.finalize().to_hex().to_string())
}

fn check_outputs(frame: &PlanFrame, format: Format) -> Result<()> {
    let has = frame.outputs.names();
    let missing: Vec<&str> = format.needs().iter().copied().filter(|name| !has.contains(name)).collect();
    if missing.is_empty() {
        return Ok(());
    }
    let outputs = has.into_iter().chain(missing.iter().copied()).collect();
    Err(Error::MissingOutput { format: format.name(), frame: frame.id.clone(), missing, outputs })
}

/// Gives the frames to the format; returns the digest of their ids.
fn write(job: &Job<'_>, frames: u64, progress: &dyn Progress) -> Result<String> {
    let go_on = |yes: bool| if yes { Ok(()) } else { Err(Error::Cancelled) };
    go_on(progress.begin(frames))?;
    let mut writer = job.format.writer(job)?;
    let mut digest = blake3::Hasher::new();
    let mut number = 0;
    for plan in job.reader.frames()? {
        let plan = plan?;
        if job.reader.state(&plan) != FrameState::Done {
            continue;
        }
        writer.frame(&Frame::new(number, &plan, job.reader))?;
        digest.update(plan.id.as_bytes()).update(b"\n");
        number += 1;
        go_on(progress.frame(&plan.id))?;
    }
    writer.finish()?;
    Ok(digest.finalize().to_hex().to_string())
}

/// Whether all that the first says stands in the second.
fn is_part_of(part: &Value, whole: &Value) -> bool {
    part.as_object().is_some_and(|part| part.iter().all(|(key, value)| whole.get(key) == Some(value)))
}

fn describe(manifest: &Value) -> String {
    let text = |value: &Value| value.as_str().unwrap_or("?").to_owned();
    let (export, name) = (text(&manifest["export"]), text(&manifest["data_set"]["name"]));
    format!("{} frames of `{name}` as {export}, of other frames, options or version", manifest["frames"])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Loss;

    #[test]
    fn losses_add_up_and_manifests_compare_by_what_they_say() {
        let losses = Losses::default();
        losses.add("a", 2, "pixels");
        losses.add("b", 0, "none");
        losses.add("a", 3, "pixels");
        let a = Loss { name: "a".to_owned(), count: 5, what: "pixels".to_owned() };
        assert_eq!(losses.list(), [a]);
        let (part, whole) = (json!({"a": 1, "b": {"c": 2}}), json!({"a": 1, "b": {"c": 2}, "d": 3}));
        assert!(is_part_of(&part, &whole) && !is_part_of(&whole, &part));
    }
}
