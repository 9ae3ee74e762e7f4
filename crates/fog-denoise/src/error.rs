//! What can go wrong with the library.

use std::path::PathBuf;

/// A picture could not be denoised.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// The library could not be loaded.
    #[error("cannot load Open Image Denoise from {}: {reason}", file.display())]
    NotFound {
        /// The file that was tried.
        file: PathBuf,
        /// The system's reason.
        reason: String,
    },
    /// The file is a library, but not version 2 of this one.
    #[error("{} is not Open Image Denoise 2: {reason}", file.display())]
    NotOidn {
        /// The file.
        file: PathBuf,
        /// What it lacks.
        reason: String,
    },
    /// The library refused or failed.
    #[error("Open Image Denoise: {0}")]
    Refused(String),
    /// The images do not fit together.
    #[error("every image to be denoised must have {width} × {height} pixels, at least one")]
    Shape {
        /// Columns.
        width: u32,
        /// Rows.
        height: u32,
    },
}
