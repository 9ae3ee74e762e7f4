//! Text files that fogs and sensors are read from: each read once, so that all frames of a run see the same content, and known by its
//! hash.

use crate::error::Error;
use std::collections::{BTreeMap, HashMap};
use std::path::{Path, PathBuf};

/// Files by their path as written.
#[derive(Debug, Default)]
pub(crate) struct TextFiles {
    files: HashMap<PathBuf, Result<TextFile, String>>,
}

#[derive(Debug)]
struct TextFile {
    text: String,
    blake3: String,
}

impl TextFiles {
    /// Reads a file if it was not tried before. Why it cannot be read is for [`TextFiles::text`] to tell.
    pub(crate) fn read(&mut self, path: &Path) {
        if self.files.contains_key(path) {
            return;
        }
        let file = read(path)
            .map(|text| TextFile { blake3: blake3::hash(text.as_bytes()).to_hex().to_string(), text });
        self.files.insert(path.to_owned(), file.map_err(|error| error.to_string()));
    }

    /// The text of a file.
    ///
    /// # Errors
    /// Why it cannot be read.
    pub(crate) fn text(&self, path: &Path) -> Result<&str, Error> {
        match self.files.get(path) {
            Some(Ok(file)) => Ok(&file.text),
            Some(Err(reason)) => Err(Error::Fog(reason.clone())),
            None => Err(Error::Fog(format!("{} was not prepared", path.display()))),
        }
    }

    /// BLAKE3 of the contents of those of `paths` that could be read, in hexadecimal, by path.
    pub(crate) fn hashes<'p>(&self, paths: impl IntoIterator<Item = &'p Path>) -> BTreeMap<String, String> {
        let hash = |path: &Path| {
            let file = self.files.get(path)?.as_ref().ok()?;
            Some((path.display().to_string(), file.blake3.clone()))
        };
        paths.into_iter().filter_map(hash).collect()
    }
}

/// The text of a file, if it is not too large.
pub(crate) fn read(path: &Path) -> Result<String, Error> {
    fog_plan::read_table(path).map_err(|source| Error::Read { path: path.to_owned(), source })
}
