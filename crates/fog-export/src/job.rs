//! What a format gets, and what it has to do.

use fog_dataset::Reader;

use crate::folder::Folder;
use crate::frame::Frame;
use crate::summary::Losses;
use crate::{Format, Result};

/// Size up to which a file of a format with shards is filled where nobody says otherwise, in MiB.
pub const SHARD_SIZE_MIB: u32 = 1024;

/// What the user may choose.
#[derive(Clone, Debug, Default, PartialEq, Eq, serde::Serialize)]
pub struct Options {
    /// Only things of these classes, by name; all if empty. Formats of label masks keep every class.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub classes: Vec<String>,
    /// Size up to which a tar or Parquet file is filled, in MiB ([`SHARD_SIZE_MIB`] by default); one frame always fits.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub shard_size_mib: Option<u32>,
    /// Export again, whatever export is in the folder.
    #[serde(skip)]
    pub force: bool,
}

impl Options {
    /// Size up to which a file is filled, in bytes.
    pub(crate) fn shard_bytes(&self) -> u64 {
        u64::from(self.shard_size_mib.unwrap_or(SHARD_SIZE_MIB)) << 20
    }
}

/// An export at work.
pub(crate) struct Job<'a> {
    pub(crate) format: Format,
    /// The data set.
    pub(crate) reader: &'a Reader,
    /// The folder to fill. It becomes the export when all is done.
    pub(crate) folder: &'a Folder,
    pub(crate) options: &'a Options,
    /// Where a format tells what it cannot hold.
    pub(crate) losses: &'a Losses,
}

impl Job<'_> {
    /// The data set's name as the beginning of file names: anything but letters, digits, `-` and `_` becomes `_`.
    pub(crate) fn file_stem(&self) -> String {
        let kept = |c: char| if c.is_ascii_alphanumeric() || c == '-' { c } else { '_' };
        self.reader.header().name.chars().map(kept).collect()
    }
}

/// Writes the frames of a data set in one format.
pub(crate) trait Writer {
    /// Takes the next frame of the plan that is done. It has the outputs that the format needs.
    fn frame(&mut self, frame: &Frame<'_>) -> Result<()>;

    /// After the last frame: writes what is still to be written.
    fn finish(&mut self) -> Result<()>;
}
