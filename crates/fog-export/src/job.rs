//! What a format gets, and what it has to do.

use fog_dataset::Reader;

use crate::folder::Folder;
use crate::frame::Frame;
use crate::summary::Losses;
use crate::{Format, Result};

/// What the user may choose.
#[derive(Clone, Debug, Default, PartialEq, Eq, serde::Serialize)]
pub struct Options {
    /// Only things of these classes, by name; all if empty. Formats of label masks keep every class.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub classes: Vec<String>,
    /// Export again, whatever export is in the folder.
    #[serde(skip)]
    pub force: bool,
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

/// Writes the frames of a data set in one format.
pub(crate) trait Writer {
    /// Takes the next frame of the plan that is done. It has the outputs that the format needs.
    fn frame(&mut self, frame: &Frame<'_>) -> Result<()>;

    /// After the last frame: writes what is still to be written.
    fn finish(&mut self) -> Result<()>;
}
