//! Re-hashing a whole data set.

use std::path::Path;

use crate::marker::{Check, Marker};
use crate::names::Kind;
use crate::read::read_header_of;
use crate::side_by_side::side_by_side;
use crate::store::Store;
use crate::survey::Survey;
use crate::{Counts, Error, FrameState, Header, Result, plan};

/// A file that is not what the data set says.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Problem {
    /// The frame it belongs to; none for files of the whole data set.
    pub frame: Option<String>,
    /// File name in the folder.
    pub file: String,
    /// What is wrong, as "has 12 bytes instead of 34".
    pub reason: String,
}

/// What [`verify`] found.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Report {
    /// Frames whose every file has its recorded hash are `done`; frames with a damaged file are counted as missing.
    pub counts: Counts,
    /// Every fault, in plan order. A frame that was never finished is no fault.
    pub problems: Vec<Problem>,
}

impl Report {
    /// Whether no file is damaged and no frame lacks.
    #[must_use]
    pub fn is_complete(&self) -> bool {
        self.problems.is_empty() && self.counts.failed == 0 && self.counts.missing == 0
    }
}

/// Compares every file of the data set in `dir` with its recorded hash.
///
/// # Errors
/// [`Error::Io`] or [`Error::Damaged`] when `dataset.json` or `plan.jsonl` cannot be read at all: then there is nothing
/// to compare with.
pub fn verify(dir: &Path) -> Result<Report> {
    let store = Store::at(dir)?;
    let header = read_header_of(&store)?;
    let mut report = Report::default();
    for entry in &header.files {
        if let Some(reason) = entry.fault(&store, Check::Hash) {
            report.problems.push(Problem { frame: None, file: entry.name.clone(), reason });
        }
    }
    let frames = plan::read_list(&store)?;
    let survey = Survey::of(&store, &frames)?;
    let check = |place: usize| {
        if !survey.has(place, Kind::Done) {
            return Ok(None);
        }
        match Marker::read(&store, frames.id(place)) {
            Ok(Some(marker)) => {
                let mut faults = foreign(&marker, &header);
                faults.extend(marker.faults(&store, frames.outputs(place), Check::Hash));
                Ok(Some(faults))
            }
            Ok(None) => Ok(None),
            Err(e @ (Error::Damaged { .. } | Error::Io { .. })) => {
                Ok(Some(vec![(Kind::Done.file(frames.id(place)), e.to_string())]))
            }
            Err(e) => Err(e),
        }
    };
    let mut states = Vec::new();
    for (place, faults) in side_by_side(&store, frames.len(), &check).into_iter().enumerate() {
        let faults = faults?;
        states.push(match &faults {
            Some(faults) if faults.is_empty() => FrameState::Done,
            _ if survey.has(place, Kind::Failed) => FrameState::Failed,
            _ => FrameState::Missing,
        });
        for (file, reason) in faults.into_iter().flatten() {
            report.problems.push(Problem { frame: Some(frames.id(place).to_owned()), file, reason });
        }
    }
    report.counts = Counts::of(&states);
    Ok(report)
}

/// A marker of another configuration or program.
pub(crate) fn foreign(marker: &Marker, header: &Header) -> Vec<(String, String)> {
    let fault = |what, found: &str, expected: &str| {
        let reason = format!("is of {what} {found}, but the data set of {expected}");
        (Kind::Done.file(&marker.id), reason)
    };
    let mut faults = Vec::new();
    if !header.takes(&marker.config_digest) {
        faults.push(fault("configuration", &marker.config_digest, &header.config_digest));
    }
    if marker.code_digest != header.code_digest {
        faults.push(fault("code", &marker.code_digest, &header.code_digest));
    }
    faults
}
