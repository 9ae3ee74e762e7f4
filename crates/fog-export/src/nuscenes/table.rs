//! A table: a list of records, written one by one.

use serde_json::Value;

use crate::Result;
use crate::folder::{Folder, Sink};

/// A table that is being written.
pub(super) struct Table {
    sink: Sink,
    is_empty: bool,
}

impl Table {
    pub(super) fn create(folder: &Folder, name: &str) -> Result<Self> {
        let mut sink = folder.create(name)?;
        sink.write("[")?;
        Ok(Self { sink, is_empty: true })
    }

    /// Adds a record.
    pub(super) fn push(&mut self, row: &Value) -> Result<()> {
        let is_first = std::mem::take(&mut self.is_empty);
        self.sink.item(is_first, row)
    }

    /// Ends the list.
    pub(super) fn close(&mut self) -> Result<()> {
        self.sink.write("\n]\n")?;
        self.sink.close()
    }
}

/// The 32 hexadecimal digits that stand for a thing of this name.
pub(super) fn token(parts: &[&str]) -> String {
    let mut digits = blake3::hash(parts.join("\n").as_bytes()).to_hex().to_string();
    digits.truncate(32);
    digits
}
