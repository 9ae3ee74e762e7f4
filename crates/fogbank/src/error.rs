//! What can go wrong on the main path, and whose fault it is.

use std::path::PathBuf;

/// An error of the main path; its `Display` is the message for the user.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// The configuration is wrong.
    #[error(transparent)]
    Plan(#[from] fog_plan::PlanError),
    /// A scene cannot be loaded.
    #[error("{0}")]
    Scene(String),
    /// A fog cannot be made.
    #[error("{0}")]
    Fog(String),
    /// A light cannot be made.
    #[error("{0}")]
    Lighting(String),
    /// The optics table cannot be built.
    #[error(transparent)]
    Optics(#[from] fog_optics::error::OpticsError),
    /// A file named by the configuration cannot be read.
    #[error("cannot read {}: {source}", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// The system's reason.
        source: std::io::Error,
    },
    /// The data set cannot be read or written.
    #[error(transparent)]
    DataSet(#[from] fog_dataset::Error),
    /// A sensor cannot be made.
    #[error("{0}")]
    Sensor(String),
    /// A picture cannot be denoised.
    #[error("{0}")]
    Denoise(String),
    /// Two pictures or data sets that cannot be compared.
    #[error("cannot compare {} with {}: {reason}", a.display(), b.display())]
    Incomparable {
        /// A, as it was named.
        a: PathBuf,
        /// B.
        b: PathBuf,
        /// Why not.
        reason: String,
    },
    /// A file that fogs or lights are read from is another than when the data set was begun.
    #[error(
        "{} holds frames made from another content of {file} (such as {frame}); use another folder or the old file",
        dir.display()
    )]
    FileChanged {
        /// Folder of the data set.
        dir: PathBuf,
        /// The file, as written in the configuration.
        file: String,
        /// A frame that was made from the old content.
        frame: String,
    },
    /// A pixel came out infinite or not a number.
    #[error(transparent)]
    Frame(#[from] fog_film::FrameError),
    /// The renderer gave up inside (a bug): the frame failed, the program goes on.
    #[error("internal error while rendering: {0}; please report it with the configuration")]
    Panic(String),
    /// `--frame` names none of the plan's frames.
    #[error(
        "the plan has no frame `{wanted}`; it has {count} frames, for example `{example}` (see `fogbank plan`)"
    )]
    UnknownFrame {
        /// What was asked for.
        wanted: String,
        /// Number of frames in the plan.
        count: usize,
        /// Id of the first frame.
        example: String,
    },
    /// No frame is left to be rendered by what was asked for.
    #[error("none of the {count} frames {}", if filter.is_empty() { "is selected".to_owned() } else { format!("has {filter}") })]
    NothingSelected {
        /// The condition on the frames' values, as it was written.
        filter: String,
        /// Number of frames in the plan.
        count: usize,
    },
    /// Worker processes cannot be had, or cannot go on.
    #[error("workers: {0}")]
    Workers(String),
    /// A sweep where one frame was expected.
    #[error(
        "{name} is a sweep of {count} frames: name one with --frame ID (see `fogbank plan`), or use `fogbank sweep`"
    )]
    NotOneFrame {
        /// Name of the configuration.
        name: String,
        /// Number of frames in the plan.
        count: usize,
    },
    /// A path that the frame does not have.
    #[error("{0}")]
    UnknownPath(String),
    /// The caller asked to stop.
    #[error("stopped on request; run the same command again to go on")]
    Cancelled,
}

impl Error {
    /// True if the user's input or choice of folder is at fault, rather than the rendering of a frame.
    #[must_use]
    pub fn is_user_mistake(&self) -> bool {
        !matches!(self, Self::Frame(_) | Self::Panic(_) | Self::Cancelled)
    }
}
