//! Where optics tables are kept if nobody says otherwise.

use std::path::{Path, PathBuf};

/// In a checkout of Fogbank its `tables/cache`; else `fogbank` in the user's cache folder. None on a machine that has none: the
/// variables `LOCALAPPDATA` (Windows), `HOME` (macOS), `XDG_CACHE_HOME` or `HOME` (elsewhere) say where it is.
#[must_use]
pub fn default_cache_dir() -> Option<PathBuf> {
    if Path::new("tables/advection/arcata.yaml").is_file() {
        return Some(PathBuf::from("tables/cache"));
    }
    let from = |key: &str, below: &str| {
        std::env::var_os(key).filter(|v| !v.is_empty()).map(|v| Path::new(&v).join(below))
    };
    let base = if cfg!(target_os = "windows") {
        from("LOCALAPPDATA", "")
    } else if cfg!(target_os = "macos") {
        from("HOME", "Library/Caches")
    } else {
        from("XDG_CACHE_HOME", "").or_else(|| from("HOME", ".cache"))
    };
    Some(base?.join("fogbank"))
}
