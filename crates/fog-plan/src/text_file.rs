//! Files of text, none of them read without end.

use std::{
    fs::File,
    io::{Error, ErrorKind, Read as _, Result},
    path::Path,
};

/// Largest table in MiB: a million lines of 200 characters take less.
const MAX_MIB: u64 = 256;

/// The text of a table: poses, spectra, curves, fog models.
///
/// # Errors
/// If it cannot be read, is larger than 256 MiB or no UTF-8.
pub fn read_table(path: &Path) -> Result<String> {
    read_up_to(path, MAX_MIB, "")
}

/// The text of a file of at most so many MiB; `why` goes on what is said of a larger one.
pub(crate) fn read_up_to(path: &Path, max_mib: u64, why: &str) -> Result<String> {
    let mut bytes = Vec::new();
    File::open(path)?.take((max_mib << 20) + 1).read_to_end(&mut bytes)?;
    let refuse = |text: String| Error::new(ErrorKind::InvalidData, text);
    if bytes.len() as u64 > max_mib << 20 {
        return Err(refuse(format!("larger than {max_mib} MiB{why}")));
    }
    String::from_utf8(bytes).map_err(|_| refuse("not UTF-8 text".to_owned()))
}
