//! Optics tables on disk: built once, shared by every process of a machine.
//!
//! A table's file is named by a hash of everything that it depends on and mapped read-only. One process builds it while
//! the others wait on a lock that the system releases even if the builder is killed. The content's hash is checked at
//! each opening; a damaged file is rebuilt.

use crate::error::Error;
use fog_core::droplet_table::DropletTable;
use fog_core::optics_table::{OpticsTable, OpticsTableError, SharedBytes};
use std::fs::{self, File, OpenOptions};
use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::Arc;

const MAGIC: &[u8; 8] = b"fogtable";
/// Magic, payload length, hash of the payload, padding: keeps the payload aligned.
const HEADER_BYTES: usize = 64;

/// A table that can be stored and mapped back.
pub trait Stored: Sized {
    /// The whole table.
    fn as_bytes(&self) -> &[u8];

    /// The table in bytes that start at `offset`.
    ///
    /// # Errors
    /// If the bytes are none of this version.
    fn from_bytes(bytes: SharedBytes, offset: usize) -> Result<Self, OpticsTableError>;
}

macro_rules! stored {
    ($($table:ty),*) => {
        $(impl Stored for $table {
            fn as_bytes(&self) -> &[u8] {
                self.as_bytes()
            }

            fn from_bytes(bytes: SharedBytes, offset: usize) -> Result<Self, OpticsTableError> {
                Self::from_bytes(bytes, offset)
            }
        })*
    };
}
stored!(OpticsTable, DropletTable);

/// A folder of optics tables.
#[derive(Clone, Debug)]
pub struct TableCache {
    dir: PathBuf,
}

/// How a table came to be.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum TableOrigin {
    /// Found in this file.
    Found(PathBuf),
    /// Built and stored in this file; the reason is given if an older file had to be replaced.
    Built {
        /// The file.
        path: PathBuf,
        /// What was wrong with the file that was there.
        replaced: Option<String>,
    },
    /// Built, but kept in memory because the cache cannot be written.
    Unstored {
        /// Why.
        reason: String,
    },
}

impl TableCache {
    /// Cache in `dir`, which need not exist yet.
    #[must_use]
    pub fn new(dir: impl Into<PathBuf>) -> Self {
        Self { dir: dir.into() }
    }

    /// Opens the table `name` whose inputs are `fingerprint`, building it with `build` if it is not there or damaged.
    ///
    /// # Errors
    /// Those of `build`. A cache that cannot be written only costs its sharing ([`TableOrigin::Unstored`]).
    pub fn open<T: Stored>(
        &self,
        name: &str,
        fingerprint: &[u8],
        build: impl FnOnce() -> Result<T, Error>,
    ) -> Result<(T, TableOrigin), Error> {
        let endian = if cfg!(target_endian = "big") { "-be" } else { "" };
        let hash = blake3::hash(fingerprint).to_hex();
        let path = self.dir.join(format!("{name}-{}{endian}.fogtable", &hash[..16]));
        if let Ok(table) = read(&path) {
            return Ok((table, TableOrigin::Found(path)));
        }
        // Hold the lock while building; whoever waited for it finds the file done.
        let lock = match self.lock(&path) {
            Ok(lock) => lock,
            Err(e) => return Ok((build()?, TableOrigin::Unstored { reason: e.to_string() })),
        };
        let replaced = match read(&path) {
            Ok(table) => return Ok((table, TableOrigin::Found(path))),
            Err(why) => path.exists().then_some(why),
        };
        let table = build()?;
        let stored = store(&path, table.as_bytes());
        drop(lock);
        match stored {
            Ok(()) => match read(&path) {
                Ok(mapped) => Ok((mapped, TableOrigin::Built { path, replaced })),
                Err(reason) => Ok((table, TableOrigin::Unstored { reason })),
            },
            Err(e) => Ok((table, TableOrigin::Unstored { reason: format!("{}: {e}", path.display()) })),
        }
    }

    fn lock(&self, path: &Path) -> std::io::Result<File> {
        let context =
            |e: std::io::Error| std::io::Error::new(e.kind(), format!("cannot lock {}: {e}", path.display()));
        fs::create_dir_all(&self.dir).map_err(context)?;
        let lock_path = path.with_extension("lock");
        let lock =
            OpenOptions::new().create(true).truncate(false).write(true).open(lock_path).map_err(context)?;
        lock.lock().map_err(context)?;
        Ok(lock)
    }
}

/// Writes aside, syncs and renames, so that the file is whole whenever it is there.
fn store(path: &Path, payload: &[u8]) -> std::io::Result<()> {
    let dir = path.parent().unwrap_or(Path::new("."));
    let mut file = tempfile::NamedTempFile::new_in(dir)?;
    let mut header = [0; HEADER_BYTES];
    header[..8].copy_from_slice(MAGIC);
    header[8..16].copy_from_slice(&(payload.len() as u64).to_le_bytes());
    header[16..48].copy_from_slice(blake3::hash(payload).as_bytes());
    file.write_all(&header)?;
    file.write_all(payload)?;
    file.as_file().sync_all()?;
    file.persist(path).map_err(|e| e.error)?;
    File::open(dir)?.sync_all()
}

/// A memory map as bytes that a table can borrow.
struct Mapped(memmap2::Mmap);

impl AsRef<[u8]> for Mapped {
    fn as_ref(&self) -> &[u8] {
        &self.0
    }
}

/// Maps a table and checks its hash; the error says what is wrong with the file.
fn read<T: Stored>(path: &Path) -> Result<T, String> {
    let file = File::open(path).map_err(|e| e.to_string())?;
    // SAFETY: table files are never changed in place, only replaced by rename (`store`), so the mapped bytes stay as they
    // are for as long as the map lives; a file that somebody else truncates under us is outside the cache's contract.
    #[allow(unsafe_code)]
    let map = unsafe { memmap2::Mmap::map(&file) }.map_err(|e| e.to_string())?;
    let header = map.get(..HEADER_BYTES).ok_or("file is too short")?;
    let payload = &map[HEADER_BYTES..];
    if &header[..8] != MAGIC || header[8..16] != (payload.len() as u64).to_le_bytes() {
        return Err("file is truncated or no table".to_owned());
    }
    if header[16..48] != blake3::hash(payload).as_bytes()[..] {
        return Err("checksum does not match".to_owned());
    }
    T::from_bytes(Arc::new(Mapped(map)), HEADER_BYTES).map_err(|e| e.to_string())
}

#[cfg(test)]
mod tests {
    use super::*;
    use fog_core::optics_table::OpticsTableParts;
    use fog_core::phase_grid::NODES;
    use std::sync::atomic::{AtomicU32, Ordering};

    fn table() -> Result<OpticsTable, Error> {
        let one = vec![1.0];
        Ok(OpticsTable::new(&OpticsTableParts {
            zeta: one.clone(),
            wavelengths_nm: one.clone(),
            c_ext_m2: one.clone(),
            c_sca_m2: one.clone(),
            g: vec![0.0],
            phase: vec![1.0; NODES],
        })
        .expect("valid"))
    }

    #[test]
    fn found_again_and_rebuilt_when_damaged() {
        let dir = tempfile::tempdir().unwrap();
        let cache = TableCache::new(dir.path().join("deep/er"));
        let (_, origin) = cache.open("t", b"a", table).unwrap();
        let TableOrigin::Built { path, replaced: None } = origin else { panic!("{origin:?}") };
        let never = || -> Result<OpticsTable, Error> { panic!("must be found") };
        assert_eq!(cache.open("t", b"a", never).unwrap().1, TableOrigin::Found(path.clone()));

        let mut bytes = fs::read(&path).unwrap();
        let middle = bytes.len() / 2;
        bytes[middle] ^= 1;
        fs::write(&path, &bytes).unwrap();
        let (mended, origin) = cache.open("t", b"a", table).unwrap();
        assert!(
            matches!(&origin, TableOrigin::Built { replaced: Some(why), .. } if why.contains("checksum")),
            "{origin:?}"
        );
        assert_eq!(mended.as_bytes(), table().unwrap().as_bytes());

        for cut in [0, 10, 64, 1000] {
            fs::write(&path, &bytes[..cut]).unwrap();
            assert!(matches!(cache.open("t", b"a", table).unwrap().1, TableOrigin::Built { .. }));
        }
    }

    #[test]
    fn one_builds_while_others_wait() {
        let dir = tempfile::tempdir().unwrap();
        let built = AtomicU32::new(0);
        std::thread::scope(|scope| {
            for _ in 0..8 {
                scope.spawn(|| {
                    let build = || {
                        built.fetch_add(1, Ordering::SeqCst);
                        std::thread::sleep(std::time::Duration::from_millis(50));
                        table()
                    };
                    TableCache::new(dir.path()).open("t", b"b", build).unwrap();
                });
            }
        });
        assert_eq!(built.load(Ordering::SeqCst), 1);
    }

    #[test]
    fn unwritable_cache_costs_only_the_sharing() {
        let dir = tempfile::tempdir().unwrap();
        let file = dir.path().join("file");
        fs::write(&file, "in the way").unwrap();
        let (_, origin) = TableCache::new(&file).open("t", b"c", table).unwrap();
        assert!(matches!(origin, TableOrigin::Unstored { .. }));
    }
}
