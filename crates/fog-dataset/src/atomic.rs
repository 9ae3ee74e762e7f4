//! Files that appear only when whole, and removal of what killed writers left.
//!
//! A file is written under a temporary name in its own folder (`.fogbank-<random>.tmp`), synced, and renamed. While it
//! lives its writer holds an exclusive lock on it, which the system releases when the process dies however it dies. So a
//! temporary that can be locked has no writer and may go, whatever its age; a writer that loses its file in the instant
//! between creating and locking it notices and starts again. Where the file system has no locks, only temporaries
//! untouched for a day are removed.

use std::fs::{self, File, TryLockError};
use std::io::{ErrorKind, Write};
use std::path::Path;
use std::time::Duration;

use tempfile::NamedTempFile;

use crate::{Error, Result};

const PREFIX: &str = ".fogbank-";
const SUFFIX: &str = ".tmp";
const ABANDONED_AFTER: Duration = Duration::from_secs(24 * 3600);

/// Writes `dir/name` whole, replacing what is there. The rename is durable after [`sync_dir`].
pub(crate) fn write(dir: &Path, name: &str, bytes: &[u8]) -> Result<()> {
    let path = dir.join(name);
    let temp = filled(dir, bytes).map_err(Error::io("write", &path))?;
    temp.persist(&path).map(drop).map_err(|e| e.error).map_err(Error::io("write", &path))
}

/// Writes `dir/name` whole unless it exists; returns whether it was written.
pub(crate) fn write_new(dir: &Path, name: &str, bytes: &[u8]) -> Result<bool> {
    let path = dir.join(name);
    let temp = filled(dir, bytes).map_err(Error::io("write", &path))?;
    match temp.persist_noclobber(&path) {
        Ok(_) => Ok(true),
        Err(e) if e.error.kind() == ErrorKind::AlreadyExists => Ok(false),
        Err(e) => Err(Error::io("write", &path)(e.error)),
    }
}

/// A synced temporary with the given content, removed again when dropped or when writing fails.
fn filled(dir: &Path, bytes: &[u8]) -> std::io::Result<NamedTempFile> {
    loop {
        let mut builder = tempfile::Builder::new();
        builder.prefix(PREFIX).suffix(SUFFIX);
        // As any new file: what the umask leaves, not the owner-only mode of temporaries.
        #[cfg(unix)]
        builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
        let mut temp = builder.tempfile_in(dir)?;
        // A file system without locks fails here; see `remove_if_abandoned`.
        let locked = temp.as_file().lock().is_ok();
        if locked && !temp.path().exists() {
            continue;
        }
        temp.write_all(bytes)?;
        temp.as_file().sync_all()?;
        return Ok(temp);
    }
}

/// Makes the renames in a folder durable.
pub(crate) fn sync_dir(dir: &Path) -> Result<()> {
    if cfg!(unix) {
        File::open(dir).and_then(|d| d.sync_all()).map_err(Error::io("sync", dir))?;
    }
    Ok(())
}

/// Removes a file; it is no error if there is none.
pub(crate) fn remove(path: &Path) -> Result<()> {
    match fs::remove_file(path) {
        Err(e) if e.kind() != ErrorKind::NotFound => Err(Error::io("remove", path)(e)),
        _ => Ok(()),
    }
}

/// Whether a file name is that of a temporary of ours.
pub(crate) fn is_temporary(name: &str) -> bool {
    name.len() > PREFIX.len() + SUFFIX.len() && name.starts_with(PREFIX) && name.ends_with(SUFFIX)
}

/// Removes the temporaries that dead writers left in a folder.
pub(crate) fn remove_abandoned(dir: &Path) -> Result<()> {
    for entry in fs::read_dir(dir).map_err(Error::io("list", dir))? {
        let entry = entry.map_err(Error::io("list", dir))?;
        if entry.file_name().to_str().is_some_and(is_temporary) {
            remove_if_abandoned(&entry.path())?;
        }
    }
    Ok(())
}

/// Removes one temporary if no process writes it any more; its lock is held until it is gone.
fn remove_if_abandoned(path: &Path) -> Result<()> {
    let Ok(file) = File::options().read(true).write(true).open(path) else { return Ok(()) };
    let abandoned = match file.try_lock() {
        Ok(()) => true,
        Err(TryLockError::WouldBlock) => false,
        Err(TryLockError::Error(_)) => file
            .metadata()
            .and_then(|m| m.modified())
            .is_ok_and(|t| t.elapsed().is_ok_and(|age| age > ABANDONED_AFTER)),
    };
    if abandoned { remove(path) } else { Ok(()) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn replaces_whole_and_keeps_the_first_when_asked() {
        let dir = tempfile::tempdir().expect("temporary folder");
        write(dir.path(), "a", b"one").expect("write");
        write(dir.path(), "a", b"two").expect("write");
        assert_eq!(fs::read(dir.path().join("a")).expect("read"), b"two");
        assert!(!write_new(dir.path(), "a", b"three").expect("write"));
        assert!(write_new(dir.path(), "b", b"three").expect("write"));
        assert_eq!(fs::read(dir.path().join("a")).expect("read"), b"two");
        assert_eq!(fs::read_dir(dir.path()).expect("list").count(), 2, "no temporaries left");
    }

    #[test]
    fn only_unlocked_temporaries_of_ours_are_removed() {
        let dir = tempfile::tempdir().expect("temporary folder");
        let live = filled(dir.path(), b"being written").expect("write");
        fs::write(dir.path().join(".fogbank-dead.tmp"), b"half").expect("write");
        fs::write(dir.path().join("other.tmp"), b"theirs").expect("write");
        remove_abandoned(dir.path()).expect("clean");
        assert!(live.path().exists() && dir.path().join("other.tmp").exists());
        assert!(!dir.path().join(".fogbank-dead.tmp").exists());
    }
}
