//! What can go wrong with a data set; every message names the path and the action.

use std::path::{Path, PathBuf};

/// Result of this crate.
pub type Result<T> = std::result::Result<T, Error>;

/// A data set could not be read or written.
#[derive(Debug, thiserror::Error)]
pub enum Error {
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
    /// A picture could not be encoded or decoded.
    #[error("cannot {action} {}: {reason}", path.display())]
    Picture {
        /// What was tried, as "encode".
        action: &'static str,
        /// The file.
        path: PathBuf,
        /// The codec's reason.
        reason: String,
    },
    /// A file that is no picture, or none of the kinds that are read.
    #[error("{} is no picture that can be compared: {reason}", path.display())]
    NotAPicture {
        /// The file.
        path: PathBuf,
        /// What it is or lacks.
        reason: String,
    },
    /// A file of the data set does not hold what it should.
    #[error("{} is damaged: {reason}", path.display())]
    Damaged {
        /// The file.
        path: PathBuf,
        /// What is wrong with it.
        reason: String,
    },
    /// The folder holds the data set of another configuration.
    #[error("{} holds a data set of another configuration{}; use another folder or the old configuration",
        dir.display(), changed(keys))]
    ConfigDiffers {
        /// The folder.
        dir: PathBuf,
        /// The keys that changed; empty when the old configuration could not be compared.
        keys: Vec<String>,
    },
    /// The folder holds frames of another version of the program; mixing them would not be reproducible.
    #[error("{} was begun by another version of the program (code {found}, this is {expected}); \
        use another folder or that version", dir.display())]
    CodeDiffers {
        /// The folder.
        dir: PathBuf,
        /// Code digest of the folder.
        found: String,
        /// Code digest of this program.
        expected: String,
    },
    /// Same configuration and program, other frames: the caller's plan is not a function of them.
    #[error("{} was planned with other frames than this plan has; use another folder", dir.display())]
    PlanDiffers {
        /// The folder.
        dir: PathBuf,
    },
    /// The plan lacks a frame that the folder has.
    #[error("{} has a frame {frame} that is not in this plan: a data set is extended by adding values to its axes; use \
        another folder, or replace this data set", dir.display())]
    NotAnExtension {
        /// The folder.
        dir: PathBuf,
        /// The frame.
        frame: String,
    },
    /// Folders whose frames are not of one plan and program.
    #[error("{} and {} are not parts of one data set: their configurations or programs differ", a.display(), b.display())]
    NotOneDataSet {
        /// One folder.
        a: PathBuf,
        /// The other.
        b: PathBuf,
    },
    /// The folder is in use by something else.
    #[error("{} is not empty and holds no Fogbank data set (it has `{found}`); use an empty or a new folder",
        dir.display())]
    NotADataSet {
        /// The folder.
        dir: PathBuf,
        /// One of the entries in it.
        found: String,
    },
    /// A frame id that cannot name files.
    #[error("frame id `{id}` cannot name files: {reason}")]
    BadId {
        /// The id.
        id: String,
        /// The rule it breaks.
        reason: &'static str,
    },
    /// A frame that the plan does not have.
    #[error("the plan of {} has no frame `{id}`", dir.display())]
    UnknownFrame {
        /// The folder.
        dir: PathBuf,
        /// The id.
        id: String,
    },
    /// A frame whose channels do not fit together or are not finite.
    #[error("frame `{id}` cannot be stored: {source}")]
    Frame {
        /// The id.
        id: String,
        /// What is wrong with it.
        source: fog_film::FrameError,
    },
    /// An output name that does not exist.
    #[error("unknown output `{name}`, expected one of {}", crate::OutputSet::NAMES.join(", "))]
    UnknownOutput {
        /// The name.
        name: String,
    },
}

/// The changed keys as a part of a message.
fn changed(keys: &[String]) -> String {
    if keys.is_empty() { String::new() } else { format!(" (changed: {})", keys.join(", ")) }
}

impl Error {
    /// For `map_err`: an I/O error with what was tried where.
    pub(crate) fn io(action: &'static str, path: &Path) -> impl FnOnce(std::io::Error) -> Self {
        move |source| Self::Io { action, path: path.to_path_buf(), source }
    }

    /// For `map_err`: a codec's error with what was tried where.
    pub(crate) fn picture<E: std::fmt::Display>(action: &'static str, path: &Path) -> impl FnOnce(E) -> Self {
        move |e| Self::Picture { action, path: path.to_path_buf(), reason: e.to_string() }
    }

    /// For `map_err`: a file that does not parse.
    pub(crate) fn damaged<E: std::fmt::Display>(path: &Path) -> impl FnOnce(E) -> Self {
        move |e| Self::Damaged { path: path.to_path_buf(), reason: e.to_string() }
    }
}
