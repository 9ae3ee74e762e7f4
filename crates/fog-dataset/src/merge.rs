//! Parts of a data set, made apart, into one folder.

use std::io::ErrorKind;
use std::path::{Path, PathBuf};

use crate::marker::{Check, Marker};
use crate::names::{HEADER, Kind};
use crate::read::read_header_of;
use crate::side_by_side::side_by_side;
use crate::store::Store;
use crate::survey::Survey;
use crate::verify::foreign;
use crate::{Counts, DataSet, Error, Header, Problem, Result};

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
    let parts = parts.iter().map(|part| Store::at(part)).collect::<Result<Vec<_>>>()?;
    let Some(first) = parts.first() else { return Ok(merged) };
    let header = read_header_of(first)?;
    for part in &parts[1..] {
        if !read_header_of(part)?.is_of_one_data_set(&header) {
            let [a, b] = [first, part].map(|store| store.place().to_path_buf());
            return Err(Error::NotOneDataSet { a, b });
        }
    }
    let data_set = begin(Store::at(out)?, &header, &parts)?;
    let frames = data_set.frames();
    let surveys = parts.iter().map(|part| Survey::of(part, frames)).collect::<Result<Vec<_>>>()?;
    let here = Survey::of(data_set.store(), frames)?;
    let one = |place: usize| {
        let mut problems = Vec::new();
        if here.has(place, Kind::Done) && data_set.is_intact(frames.id(place)) {
            return Ok((None, problems));
        }
        for (i, part) in parts.iter().enumerate().filter(|(i, _)| surveys[*i].has(place, Kind::Done)) {
            if take(&data_set, part, &surveys[i], place, &header, &mut problems)? {
                return Ok((Some(i), problems));
            }
        }
        // Nobody has it: why, if it failed somewhere.
        if !here.has(place, Kind::Failed)
            && let Some((part, _)) = parts.iter().zip(&surveys).find(|(_, s)| s.has(place, Kind::Failed))
        {
            copy(part, data_set.store(), &Kind::Failed.file(frames.id(place)))?;
        }
        Ok((None, problems))
    };
    let remote = parts.iter().chain([data_set.store()]).find(|store| store.waits());
    for result in side_by_side(remote.unwrap_or(first), frames.len(), &one) {
        let (from, problems) = result?;
        from.into_iter().for_each(|i: usize| merged.taken[i] += 1);
        merged.problems.extend(problems);
    }
    merged.counts = data_set.finish()?;
    Ok(merged)
}

/// The folder with the header, configuration and plan of the parts.
fn begin(out: Store, header: &Header, parts: &[Store]) -> Result<DataSet> {
    out.make()?;
    match Header::read(&out)? {
        Some(found) if found.is_of_one_data_set(header) => {}
        Some(_) => {
            let [a, b] = [&out, &parts[0]].map(|store| store.place().to_path_buf());
            return Err(Error::NotOneDataSet { a, b });
        }
        None => {
            if let Some(found) = out.other_than(HEADER)? {
                return Err(Error::NotADataSet { dir: out.place().to_path_buf(), found });
            }
            copy(&parts[0], &out, HEADER)?;
        }
    }
    for entry in &header.files {
        if entry.fault(&out, Check::Hash).is_some() {
            let whole = |part: &&Store| entry.fault(part, Check::Hash).is_none();
            let part = parts.iter().find(whole).ok_or_else(|| {
                Error::damaged(&parts[0].path(&entry.name))("no part has it with its recorded hash")
            })?;
            copy(part, &out, &entry.name)?;
        }
    }
    DataSet::open(out)
}

/// Copies a frame if the part has it whole; notes what is damaged.
fn take(
    data_set: &DataSet,
    part: &Store,
    survey: &Survey,
    place: usize,
    header: &Header,
    problems: &mut Vec<Problem>,
) -> Result<bool> {
    let (out, frames) = (data_set.store(), data_set.frames());
    let (id, outputs) = (frames.id(place), frames.outputs(place));
    let problem = |file: String, reason| Problem { frame: Some(id.to_owned()), file, reason };
    let marker = match Marker::read(part, id) {
        Ok(Some(marker)) => marker,
        Ok(None) => return Ok(false),
        Err(e) => {
            problems.push(problem(Kind::Done.file(id), e.to_string()));
            return Ok(false);
        }
    };
    let mut faults = foreign(&marker, header);
    faults.extend(marker.faults(part, outputs, Check::Hash));
    if !faults.is_empty() {
        let named = |(file, reason): (String, String)| (part.path(&file).display().to_string(), reason);
        problems.extend(faults.into_iter().map(named).map(|(file, reason)| problem(file, reason)));
        return Ok(false);
    }
    for kind in Kind::all().filter(|kind| !matches!(kind, Kind::Done | Kind::Failed)) {
        if survey.has(place, kind) {
            copy(part, out, &kind.file(id))?;
        }
    }
    if !marker.faults(out, outputs, Check::Hash).is_empty() {
        return Ok(false);
    }
    out.sync()?;
    copy(part, out, &Kind::Done.file(id))?;
    out.remove(&Kind::Failed.file(id))?;
    Ok(true)
}

fn copy(from: &Store, to: &Store, name: &str) -> Result<()> {
    let content = from.read(name)?;
    let content = content.ok_or_else(|| Error::io("read", &from.path(name))(ErrorKind::NotFound.into()))?;
    to.write(name, content)
}
