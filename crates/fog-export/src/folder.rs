//! The folder of an export: filled beside its place and moved there when it is whole.
//!
//! `OUT.partial` is filled while a lock on a file in it is held, which the system releases however the process dies. What a dead
//! process left there is removed by the next. The finished folder has `export.json`, which says what it is.

use std::cell::RefCell;
use std::collections::HashSet;
use std::fs::{self, File, TryLockError};
use std::io::{BufWriter, ErrorKind, Write};
use std::path::{Component, Path, PathBuf};

use serde_json::Value;

use crate::{Error, Result};

/// What a finished export is.
const MANIFEST: &str = "export.json";
const LOCK: &str = ".fogbank-export.lock";

/// A folder that is being filled.
#[derive(Debug)]
pub(crate) struct Folder {
    out: PathBuf,
    dir: PathBuf,
    made: RefCell<HashSet<PathBuf>>,
    finished: bool,
    _lock: File,
}

/// `export.json` of a folder; `None` if the folder is not there or empty.
///
/// # Errors
/// [`Error::NotEmpty`] if it holds something else.
pub(crate) fn manifest(out: &Path) -> Result<Option<Value>> {
    let entries = match fs::read_dir(out) {
        Err(e) if e.kind() == ErrorKind::NotFound => return Ok(None),
        other => other.map_err(Error::io("list", out))?,
    };
    let path = out.join(MANIFEST);
    if let Ok(text) = fs::read(&path)
        && let Ok(manifest) = serde_json::from_slice::<Value>(&text)
        && manifest["format"] == "fogbank-export"
    {
        return Ok(Some(manifest));
    }
    match entries.into_iter().next() {
        None => Ok(None),
        Some(entry) => {
            let found = entry.map_err(Error::io("list", out))?.file_name().to_string_lossy().into_owned();
            Err(Error::NotEmpty { dir: out.to_path_buf(), found })
        }
    }
}

impl Folder {
    /// Begins an export that is to become `out`.
    ///
    /// # Errors
    /// [`Error::Busy`] if another process does the same; [`Error::NotEmpty`] if the folder beside is not ours; [`Error::Io`].
    pub(crate) fn begin(out: &Path) -> Result<Self> {
        let dir = beside(out, ".partial")?;
        let lock_path = dir.join(LOCK);
        if dir.exists()
            && !lock_path.exists()
            && let Some(entry) = fs::read_dir(&dir).map_err(Error::io("list", &dir))?.next()
        {
            let found = entry.map_err(Error::io("list", &dir))?.file_name().to_string_lossy().into_owned();
            return Err(Error::NotEmpty { dir, found });
        }
        fs::create_dir_all(&dir).map_err(Error::io("create", &dir))?;
        let lock = File::create(&lock_path).map_err(Error::io("create", &lock_path))?;
        match lock.try_lock() {
            Err(TryLockError::WouldBlock) => return Err(Error::Busy { dir: out.to_path_buf() }),
            // A file system without locks: then nobody guards against a second export to the same place.
            Ok(()) | Err(TryLockError::Error(_)) => {}
        }
        for entry in fs::read_dir(&dir).map_err(Error::io("list", &dir))? {
            let path = entry.map_err(Error::io("list", &dir))?.path();
            if path != lock_path {
                remove_all(&path)?;
            }
        }
        Ok(Self { out: out.to_path_buf(), dir, made: RefCell::default(), finished: false, _lock: lock })
    }

    /// The name that the folder will have.
    pub(crate) fn name(&self) -> String {
        self.out.file_name().unwrap_or_default().to_string_lossy().into_owned()
    }

    /// Where a file is while the folder is being filled; folders above it are made. `name` has `/` between its parts.
    ///
    /// # Errors
    /// [`Error::Io`].
    pub(crate) fn path(&self, name: &str) -> Result<PathBuf> {
        let path = self.dir.join(name);
        // Names of cameras are in it.
        if Path::new(name).components().any(|part| !matches!(part, Component::Normal(_))) {
            return Err(Error::io("create", &path)(ErrorKind::InvalidFilename.into()));
        }
        if let Some(parent) = path.parent()
            && !self.made.borrow().contains(parent)
        {
            fs::create_dir_all(parent).map_err(Error::io("create", parent))?;
            self.made.borrow_mut().insert(parent.to_path_buf());
        }
        Ok(path)
    }

    /// Writes a file.
    ///
    /// # Errors
    /// [`Error::Io`].
    pub(crate) fn write(&self, name: &str, bytes: impl AsRef<[u8]>) -> Result<()> {
        let path = self.path(name)?;
        fs::write(&path, bytes).map_err(Error::io("write", &path))
    }

    /// Copies a file.
    ///
    /// # Errors
    /// [`Error::Io`].
    pub(crate) fn copy(&self, from: &Path, name: &str) -> Result<()> {
        let path = self.path(name)?;
        fs::copy(from, &path).map(drop).map_err(Error::io("copy", from))
    }

    /// A file to be written bit by bit.
    ///
    /// # Errors
    /// [`Error::Io`].
    pub(crate) fn create(&self, name: &str) -> Result<Sink> {
        let path = self.path(name)?;
        let file = File::create(&path).map_err(Error::io("create", &path))?;
        Ok(Sink { file: BufWriter::new(file), path })
    }

    /// Writes `export.json` and moves the folder to its place; an older export there goes.
    ///
    /// # Errors
    /// [`Error::Io`].
    pub(crate) fn finish(mut self, manifest: &Value) -> Result<()> {
        self.write(MANIFEST, format!("{manifest:#}\n"))?;
        let lock = self.dir.join(LOCK);
        fs::remove_file(&lock).map_err(Error::io("remove", &lock))?;
        sync(&self.dir)?;
        let old = beside(&self.out, ".replaced")?;
        if old.join(MANIFEST).is_file() {
            remove_all(&old)?;
        }
        let replaces = self.out.join(MANIFEST).is_file();
        if replaces {
            fs::rename(&self.out, &old).map_err(Error::io("rename", &self.out))?;
        }
        fs::rename(&self.dir, &self.out).map_err(Error::io("make", &self.out))?;
        self.finished = true;
        if replaces { remove_all(&old) } else { Ok(()) }
    }
}

impl Drop for Folder {
    /// An export that fails leaves nothing.
    fn drop(&mut self) {
        if !self.finished {
            let _ = fs::remove_dir_all(&self.dir);
        }
    }
}

/// A file that is written bit by bit; its errors have its name.
#[derive(Debug)]
pub(crate) struct Sink {
    file: BufWriter<File>,
    path: PathBuf,
}

impl Sink {
    /// Adds bytes.
    ///
    /// # Errors
    /// [`Error::Io`].
    pub(crate) fn write(&mut self, bytes: impl AsRef<[u8]>) -> Result<()> {
        self.file.write_all(bytes.as_ref()).map_err(Error::io("write", &self.path))
    }

    /// Adds an item of a JSON list on a line of its own.
    ///
    /// # Errors
    /// [`Error::Io`].
    pub(crate) fn item(&mut self, is_first: bool, item: impl std::fmt::Display) -> Result<()> {
        self.write(format!("{}\n{item}", if is_first { "" } else { "," }))
    }

    /// Writes what is still in memory. To be called at the end: dropping hides errors.
    ///
    /// # Errors
    /// [`Error::Io`].
    pub(crate) fn close(&mut self) -> Result<()> {
        self.file.flush().map_err(Error::io("write", &self.path))
    }
}

/// The folder beside another with an ending after its name.
fn beside(out: &Path, ending: &str) -> Result<PathBuf> {
    let invalid = || Error::io("export to", out)(ErrorKind::InvalidFilename.into());
    let mut name = out.file_name().ok_or_else(invalid)?.to_owned();
    name.push(ending);
    Ok(out.with_file_name(name))
}

fn remove_all(path: &Path) -> Result<()> {
    let done = if path.is_dir() { fs::remove_dir_all(path) } else { fs::remove_file(path) };
    done.map_err(Error::io("remove", path))
}

/// Puts every file below a folder onto the disk, so that a power cut after the renaming finds them whole.
fn sync(dir: &Path) -> Result<()> {
    for entry in fs::read_dir(dir).map_err(Error::io("list", dir))? {
        let path = entry.map_err(Error::io("list", dir))?.path();
        if path.is_dir() {
            sync(&path)?;
        } else {
            File::open(&path).and_then(|file| file.sync_all()).map_err(Error::io("sync", &path))?;
        }
    }
    if cfg!(unix) {
        File::open(dir).and_then(|d| d.sync_all()).map_err(Error::io("sync", dir))?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_is_written_outside_and_a_given_up_folder_goes() {
        let base = tempfile::tempdir().expect("temporary folder");
        let out = base.path().join("x");
        let folder = Folder::begin(&out).expect("begin");
        folder.write("a/b.txt", "b").expect("write");
        for name in ["../c.txt", "/c.txt", "a/../../c.txt"] {
            assert!(matches!(folder.write(name, "c"), Err(Error::Io { .. })), "{name}");
        }
        assert!(matches!(Folder::begin(&out), Err(Error::Busy { .. })));
        drop(folder);
        assert_eq!(fs::read_dir(base.path()).expect("list").count(), 0);
    }
}
