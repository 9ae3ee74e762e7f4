//! Reading files: only of the scene's folder, only so many bytes.

use super::uri::{self, Target};
use crate::error::SceneErrorKind;
use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};

/// The scene's folder, with the bytes that may still be read.
pub(super) struct Files {
    /// `None`: the scene is in memory.
    folder: Option<PathBuf>,
    limit: u64,
    left: u64,
}

impl Files {
    /// For the scene in a file.
    pub(super) fn beside(scene: &Path, limit: u64) -> Self {
        // An empty parent is the current folder.
        let parent = scene.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
        Self { folder: Some(parent.to_owned()), limit, left: limit }
    }

    /// For a scene that has no folder.
    pub(super) fn nowhere(limit: u64) -> Self {
        Self { folder: None, limit, left: limit }
    }

    /// Counts bytes that are there already.
    pub(super) fn count(&mut self, bytes: &[u8]) -> Result<(), SceneErrorKind> {
        match self.left.checked_sub(bytes.len() as u64) {
            Some(left) => self.left = left,
            None => return Err(SceneErrorKind::TooLarge { limit: self.limit }),
        }
        Ok(())
    }

    /// The scene file's bytes.
    pub(super) fn read_scene(&mut self, scene: &Path) -> Result<Vec<u8>, SceneErrorKind> {
        let file = File::open(scene).map_err(SceneErrorKind::Read)?;
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
        let folder = self.folder.as_deref();
        let folder = folder
            .ok_or_else(|| refused("is beside the scene, which is in memory and has no folder".into()))?;
        let folder = folder.canonicalize().map_err(unreadable)?;
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
        self.count(&bytes)?;
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
