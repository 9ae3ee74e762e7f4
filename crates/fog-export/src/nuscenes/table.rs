//! A table: a list of records, written one by one.

use serde_json::Value;

use crate::Result;
use crate::folder::{Folder, Sink};

/// A table that is being written.
pub(super) struct Table {
    sink: Sink,
    rows: u64,
}

impl Table {
    pub(super) fn create(folder: &Folder, name: &str) -> Result<Self> {
        let mut sink = folder.create(name)?;
        sink.write("[")?;
        Ok(Self { sink, rows: 0 })
    }

    /// Adds a record.
    pub(super) fn push(&mut self, row: &Value) -> Result<()> {
        self.sink.write(format!("{}\n{row}", if self.rows == 0 { "" } else { "," }))?;
        self.rows += 1;
        Ok(())
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
