//! Reading files: only of the scene's folder, only so many bytes.

use super::uri::{self, Target};
use crate::error::SceneErrorKind;
use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};

/// The scene file and its folder, with the bytes that may still be read.
pub(super) struct Files {
    scene: PathBuf,
    limit: u64,
    left: u64,
}

impl Files {
    pub(super) fn new(scene: &Path, limit: u64) -> Self {
        Self { scene: scene.to_owned(), limit, left: limit }
    }

    /// The scene file's bytes.
    pub(super) fn read_scene(&mut self) -> Result<Vec<u8>, SceneErrorKind> {
        let file = File::open(&self.scene).map_err(SceneErrorKind::Read)?;
        self.read(file)?.map_err(SceneErrorKind::Read)
    }

    /// The bytes that a URI of the scene stands for.
    pub(super) fn fetch(&mut self, uri: &str) -> Result<Vec<u8>, SceneErrorKind> {
        let refused = |reason: String| SceneErrorKind::Uri { uri: shortened(uri), reason };
        let relative = match uri::parse(uri).map_err(|reason| refused(reason.into()))? {
            Target::Data(bytes) => return Ok(bytes),
            Target::Relative(path) => path,
        };
        let unreadable = |e: std::io::Error| refused(format!("cannot be read: {e}"));
        // An empty parent is the current folder.
        let parent = self.scene.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
        let folder = parent.canonicalize().map_err(unreadable)?;
        let path = folder.join(relative).canonicalize().map_err(unreadable)?;
        if !path.starts_with(&folder) {
            return Err(refused("leaves the scene's folder through a link".into()));
        }
        if !path.is_file() {
            return Err(refused("is not a file".into()));
        }
        let file = File::open(path).map_err(unreadable)?;
        self.read(file)?.map_err(unreadable)
    }

    /// Reads to the end or the limit, whatever the file's metadata says.
    fn read(&mut self, file: File) -> Result<std::io::Result<Vec<u8>>, SceneErrorKind> {
        let mut bytes = Vec::new();
        if let Err(error) = file.take(self.left.saturating_add(1)).read_to_end(&mut bytes) {
            return Ok(Err(error));
        }
        match self.left.checked_sub(bytes.len() as u64) {
            Some(left) => self.left = left,
            None => return Err(SceneErrorKind::TooLarge { limit: self.limit }),
        }
        Ok(Ok(bytes))
    }
}

/// A URI for a message: without control characters, at most 80 characters.
fn shortened(uri: &str) -> String {
    let mut text: String = uri.chars().take(80).flat_map(char::escape_debug).collect();
    if uri.chars().nth(80).is_some() {
        text.push('…');
    }
    text
}
