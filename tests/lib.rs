//! Helpers shared by the slow suites: statistics, reference tables and small scenes.

pub mod chi_square;
pub mod csv;
pub mod npy;
pub mod scenes;

use std::path::{Path, PathBuf};

/// A file of `tests/data`.
#[must_use]
pub fn data(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("data").join(name)
}
