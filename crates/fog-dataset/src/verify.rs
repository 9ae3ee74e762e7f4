//! Re-hashing a whole data set.

use std::path::Path;

use crate::marker::{Check, Marker};
use crate::names::Kind;
use crate::{Counts, Error, FrameState, Header, Result, read_header, read_plan};

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
    let header = read_header(dir)?;
    let mut report = Report::default();
    for entry in &header.files {
        if let Some(reason) = entry.fault(dir, Check::Hash) {
            report.problems.push(Problem { frame: None, file: entry.name.clone(), reason });
        }
    }
    let mut states = Vec::new();
    for frame in read_plan(dir)? {
        let faults = match Marker::read(dir, &frame.id) {
            Ok(Some(marker)) => {
                let mut faults = foreign(&marker, &header);
                faults.extend(marker.faults(dir, frame.outputs, Check::Hash));
                Some(faults)
            }
            Ok(None) => None,
            Err(e @ (Error::Damaged { .. } | Error::Io { .. })) => {
                Some(vec![(Kind::Done.file(&frame.id), e.to_string())])
            }
            Err(e) => return Err(e),
        };
        let is_done = faults.as_ref().is_some_and(Vec::is_empty);
        states.push(FrameState::of(is_done, dir, &frame.id));
        for (file, reason) in faults.into_iter().flatten() {
            report.problems.push(Problem { frame: Some(frame.id.clone()), file, reason });
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
