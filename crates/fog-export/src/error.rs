//! What can go wrong with an export; every message names the path or the frame.

use std::path::{Path, PathBuf};

/// Result of this crate.
pub type Result<T> = std::result::Result<T, Error>;

/// An export could not be made.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// The data set cannot be read.
    #[error(transparent)]
    DataSet(#[from] fog_dataset::Error),
    /// The operating system refused.
    #[error("cannot {action} {}: {source}", path.display())]
    Io {
        /// What was tried, as "write".
        action: &'static str,
        /// The file or folder.
        path: PathBuf,
        /// The system's reason.
        source: std::io::Error,
    },
    /// A frame was rendered without something that the format is made of.
    #[error("format {format} needs output{} {}, which frame {frame} does not have; render the data set again with outputs: [{}]",
        if missing.len() == 1 { "" } else { "s" }, quoted(missing), outputs.join(", "))]
    MissingOutput {
        /// The format's name.
        format: &'static str,
        /// The first such frame.
        frame: String,
        /// What it lacks.
        missing: Vec<&'static str>,
        /// The outputs that it has and those that it lacks.
        outputs: Vec<&'static str>,
    },
    /// A frame is of a kind that the format has no place for.
    #[error("frame {frame} cannot be exported as {format}: {reason}")]
    Unfit {
        /// The format's name.
        format: &'static str,
        /// The frame.
        frame: String,
        /// Why, and what would do.
        reason: String,
    },
    /// A file of the data set does not hold what it should.
    #[error("frame {frame}: {what} is damaged: {reason}; `fogbank verify` tells which files are")]
    Damaged {
        /// The frame.
        frame: String,
        /// The file, as "objects.json".
        what: &'static str,
        /// What is wrong with it.
        reason: String,
    },
    /// An option that the data set or the format does not fit.
    #[error("{0}")]
    Option(String),
    /// No frame of the data set is done.
    #[error("{} has no finished frame to export", dir.display())]
    Nothing {
        /// The data set.
        dir: PathBuf,
    },
    /// The folder holds something else.
    #[error("{} is not empty and no export of ours (it has `{found}`); use an empty or a new folder", dir.display())]
    NotEmpty {
        /// The folder.
        dir: PathBuf,
        /// One of its entries.
        found: String,
    },
    /// The folder holds another export, or one of other frames.
    #[error("{} holds an export already: {found}; use another folder, or --force to replace it", dir.display())]
    OtherExport {
        /// The folder.
        dir: PathBuf,
        /// What is there.
        found: String,
    },
    /// Frames were finished or removed while they were exported.
    #[error("the frames of {} changed while they were exported; export again", dir.display())]
    Changed {
        /// The data set.
        dir: PathBuf,
    },
    /// Another process is exporting there.
    #[error("another export to {} is under way", dir.display())]
    Busy {
        /// The folder.
        dir: PathBuf,
    },
    /// Stopped on request; what was exported so far is gone.
    #[error("stopped")]
    Cancelled,
}

impl Error {
    /// For `map_err`: an I/O error with what was tried where.
    pub(crate) fn io(action: &'static str, path: &Path) -> impl FnOnce(std::io::Error) -> Self {
        move |source| Self::Io { action, path: path.to_path_buf(), source }
    }
}

fn quoted(names: &[&str]) -> String {
    names.iter().map(|name| format!("`{name}`")).collect::<Vec<_>>().join(", ")
}
