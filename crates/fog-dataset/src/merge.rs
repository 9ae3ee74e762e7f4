//! Parts of a data set, made apart, into one folder.

use std::fs;
use std::path::{Path, PathBuf};

use crate::marker::{Check, Marker};
use crate::names::{HEADER, Kind};
use crate::verify::foreign;
use crate::{Counts, DataSet, Error, FrameState, Header, PlanFrame, Problem, Result, atomic, read_header};

/// What [`merge`] did.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Merged {
    /// States of the plan's frames in the folder now.
    pub counts: Counts,
    /// Frames that were taken, by part, in the order given.
    pub taken: Vec<u64>,
    /// Damaged files that were found in parts on the way; another part may have had them whole.
    pub problems: Vec<Problem>,
}

/// Copies into `out` every frame that it lacks and one of the parts has whole. Every file is re-hashed on the way, so that a
/// frame counts as done only if its bytes are those that were rendered. `out` is made, or goes on; it may be one of the parts.
///
/// # Errors
/// [`Error::NotOneDataSet`] when the parts are not of one data set; [`Error::NotADataSet`] when `out` holds something else;
/// [`Error::Io`] or [`Error::Damaged`] when a header or plan cannot be read or the folder cannot be written.
pub fn merge(out: &Path, parts: &[PathBuf]) -> Result<Merged> {
    let mut merged = Merged { taken: vec![0; parts.len()], ..Merged::default() };
    let Some(first) = parts.first() else { return Ok(merged) };
    let header = read_header(first)?;
    for part in &parts[1..] {
        if !read_header(part)?.is_of_one_data_set(&header) {
            return Err(Error::NotOneDataSet { a: first.clone(), b: part.clone() });
        }
    }
    let data_set = begin(out, &header, parts)?;
    for frame in data_set.plan() {
        if data_set.is_intact(&frame.id) {
            continue;
        }
        for (i, part) in parts.iter().enumerate() {
            if take(out, part, frame, &header, &mut merged.problems)? {
                merged.taken[i] += 1;
                break;
            }
        }
        if data_set.state(&frame.id) == FrameState::Missing {
            take_failure(out, parts, &frame.id)?;
        }
    }
    merged.counts = data_set.finish()?;
    Ok(merged)
}

/// The folder with the header, configuration and plan of the parts.
fn begin(out: &Path, header: &Header, parts: &[PathBuf]) -> Result<DataSet> {
    fs::create_dir_all(out).map_err(Error::io("create", out))?;
    atomic::remove_abandoned(out)?;
    match Header::read(out)? {
        Some(found) if found.is_of_one_data_set(header) => {}
        Some(_) => return Err(Error::NotOneDataSet { a: out.to_path_buf(), b: parts[0].clone() }),
        None => {
            if let Some(entry) = fs::read_dir(out).map_err(Error::io("list", out))?.next() {
                let found = entry.map_err(Error::io("list", out))?.file_name();
                let found = found.to_string_lossy().into_owned();
                return Err(Error::NotADataSet { dir: out.to_path_buf(), found });
            }
            copy(&parts[0], out, HEADER)?;
        }
    }
    for entry in &header.files {
        if entry.fault(out, Check::Hash).is_some() {
            let whole = |part: &&PathBuf| entry.fault(part, Check::Hash).is_none();
            let part = parts.iter().find(whole).ok_or_else(|| {
                Error::damaged(&parts[0].join(&entry.name))("no part has it with its recorded hash")
            })?;
            copy(part, out, &entry.name)?;
        }
    }
    DataSet::open(out)
}

/// Copies a frame if the part has it whole; notes what is damaged.
fn take(
    out: &Path,
    part: &Path,
    frame: &PlanFrame,
    header: &Header,
    problems: &mut Vec<Problem>,
) -> Result<bool> {
    let problem = |file: String, reason| Problem { frame: Some(frame.id.clone()), file, reason };
    let marker = match Marker::read(part, &frame.id) {
        Ok(Some(marker)) => marker,
        Ok(None) => return Ok(false),
        Err(e) => {
            problems.push(problem(Kind::Done.file(&frame.id), e.to_string()));
            return Ok(false);
        }
    };
    let mut faults = foreign(&marker, header);
    faults.extend(marker.faults(part, frame.outputs, Check::Hash));
    if !faults.is_empty() {
        let named = |(file, reason): (String, String)| (part.join(file).display().to_string(), reason);
        problems.extend(faults.into_iter().map(named).map(|(file, reason)| problem(file, reason)));
        return Ok(false);
    }
    for kind in Kind::all().filter(|kind| !matches!(kind, Kind::Done | Kind::Failed)) {
        let name = kind.file(&frame.id);
        if part.join(&name).is_file() {
            copy(part, out, &name)?;
        }
    }
    if !marker.faults(out, frame.outputs, Check::Hash).is_empty() {
        return Ok(false);
    }
    atomic::sync_dir(out)?;
    copy(part, out, &Kind::Done.file(&frame.id))?;
    atomic::remove(&out.join(Kind::Failed.file(&frame.id)))?;
    Ok(true)
}

/// Copies the record of a failure, if a part has one.
fn take_failure(out: &Path, parts: &[PathBuf], id: &str) -> Result<()> {
    let name = Kind::Failed.file(id);
    match parts.iter().find(|part| part.join(&name).is_file()) {
        Some(part) => copy(part, out, &name),
        None => Ok(()),
    }
}

fn copy(from: &Path, to: &Path, name: &str) -> Result<()> {
    let path = from.join(name);
    let bytes = fs::read(&path).map_err(Error::io("read", &path))?;
    atomic::write(to, name, &bytes)
}
