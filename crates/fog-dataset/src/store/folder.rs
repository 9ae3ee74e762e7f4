//! A folder: files that appear only when whole, and removal of what killed writers left.
//!
//! A file is written under a temporary name in its own folder (`.fogbank-<random>.tmp`), synced, and renamed. While it
//! lives its writer holds an exclusive lock on it, which the system releases when the process dies however it dies. So a
//! temporary that can be locked has no writer and may go, whatever its age; a writer that loses its file in the instant
//! between creating and locking it notices and starts again. Where the file system has no locks, only temporaries
//! untouched for a day are removed.

use std::fs::{self, File, TryLockError};
use std::io::{self, ErrorKind, Write};
use std::path::Path;
use std::time::Duration;

use tempfile::NamedTempFile;

const PREFIX: &str = ".fogbank-";
const SUFFIX: &str = ".tmp";
const ABANDONED_AFTER: Duration = Duration::from_secs(24 * 3600);

/// Writes `dir/name` whole, replacing what is there. The rename is durable after [`sync_dir`].
pub(super) fn write(dir: &Path, name: &str, bytes: &[u8]) -> io::Result<()> {
    let mut temp = temporary(dir)?;
    temp.write_all(bytes)?;
    keep(temp, &dir.join(name))
}

/// Writes `dir/name` whole unless it exists; returns whether it was written.
pub(super) fn write_new(dir: &Path, name: &str, bytes: &[u8]) -> io::Result<bool> {
    let mut temp = temporary(dir)?;
    temp.write_all(bytes)?;
    temp.as_file().sync_all()?;
    match temp.persist_noclobber(dir.join(name)) {
        Ok(_) => Ok(true),
        Err(e) if e.error.kind() == ErrorKind::AlreadyExists => Ok(false),
        Err(e) => Err(e.error),
    }
}

/// Gives a temporary its name when its content is on the disk.
pub(super) fn keep(temp: NamedTempFile, path: &Path) -> io::Result<()> {
    temp.as_file().sync_all()?;
    temp.persist(path).map(drop).map_err(|e| e.error)
}

/// An empty temporary, locked; removed again when dropped.
pub(super) fn temporary(dir: &Path) -> io::Result<NamedTempFile> {
    loop {
        let mut builder = tempfile::Builder::new();
        builder.prefix(PREFIX).suffix(SUFFIX);
        // As any new file: what the umask leaves, not the owner-only mode of temporaries.
        #[cfg(unix)]
        builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
        let temp = builder.tempfile_in(dir)?;
        // A file system without locks fails here; see `remove_if_abandoned`.
        let locked = temp.as_file().lock().is_ok();
        if !locked || temp.path().exists() {
            return Ok(temp);
        }
    }
}

/// Makes the renames in a folder durable.
pub(super) fn sync_dir(dir: &Path) -> io::Result<()> {
    if cfg!(unix) { File::open(dir)?.sync_all() } else { Ok(()) }
}

/// Removes a file; it is no error if there is none.
pub(super) fn remove(path: &Path) -> io::Result<()> {
    match fs::remove_file(path) {
        Err(e) if e.kind() != ErrorKind::NotFound => Err(e),
        _ => Ok(()),
    }
}

/// Gives the names in a folder one by one, but for temporaries of ours.
pub(super) fn list(dir: &Path, each: &mut dyn FnMut(&str)) -> io::Result<()> {
    for entry in fs::read_dir(dir)? {
        let name = entry?.file_name();
        let name = name.to_string_lossy();
        if !is_temporary(&name) {
            each(&name);
        }
    }
    Ok(())
}

/// Whether a file name is that of a temporary of ours.
fn is_temporary(name: &str) -> bool {
    name.len() > PREFIX.len() + SUFFIX.len() && name.starts_with(PREFIX) && name.ends_with(SUFFIX)
}

/// Removes the temporaries that dead writers left in a folder.
pub(super) fn remove_abandoned(dir: &Path) -> io::Result<()> {
    for entry in fs::read_dir(dir)? {
        let entry = entry?;
        if entry.file_name().to_str().is_some_and(is_temporary) {
            remove_if_abandoned(&entry.path())?;
        }
    }
    Ok(())
}

/// Removes one temporary if no process writes it any more; its lock is held until it is gone.
fn remove_if_abandoned(path: &Path) -> io::Result<()> {
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
        let live = temporary(dir.path()).expect("a file");
        fs::write(dir.path().join(".fogbank-dead.tmp"), b"half").expect("write");
        fs::write(dir.path().join("other.tmp"), b"theirs").expect("write");
        remove_abandoned(dir.path()).expect("clean");
        assert!(live.path().exists() && dir.path().join("other.tmp").exists());
        assert!(!dir.path().join(".fogbank-dead.tmp").exists());
    }
}
