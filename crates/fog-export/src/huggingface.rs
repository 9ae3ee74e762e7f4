//! Hugging Face `datasets`: Parquet files with the pictures in them, and a card.
//!
//! `data/train-00000.parquet`, … have a row per frame: id, pair, a column for each axis of the sweep, the record as JSON, pictures
//! as the `Image` feature (PNG bytes and their name) and OpenEXR files as bytes. `README.md` is the card.

mod card;
mod column;

use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::PathBuf;
use std::sync::Arc;

use parquet::basic::Compression;
use parquet::file::metadata::KeyValue;
use parquet::file::properties::{EnabledStatistics, WriterProperties};
use parquet::file::writer::SerializedFileWriter;
use parquet::schema::parser::parse_message_type;

use crate::frame::Frame;
use crate::job::{Job, Writer};
use crate::{Error, Result};
use column::Column;

/// The outputs that frames must have.
pub(crate) const NEEDS: &[&str] = &["image"];

/// Content of a row group, which is in memory until it is written.
const GROUP_BYTES: u64 = 32 << 20;
/// Most rows of one: what can be read by itself.
const GROUP_ROWS: usize = 100;

/// The writer.
pub(crate) struct HuggingFace<'a> {
    job: &'a Job<'a>,
    columns: Vec<Column>,
    rows: usize,
    /// Bytes of the rows that are not written yet, and of those in the open file.
    pending: u64,
    written: u64,
    files: u64,
    frames: u64,
    open: Option<(SerializedFileWriter<BufWriter<File>>, PathBuf)>,
}

impl<'a> HuggingFace<'a> {
    pub(crate) fn begin(job: &'a Job<'a>) -> Result<Self> {
        let columns = column::of_plan(job.reader)?;
        Ok(Self { job, columns, rows: 0, pending: 0, written: 0, files: 0, frames: 0, open: None })
    }

    fn create(&mut self) -> Result<(SerializedFileWriter<BufWriter<File>>, PathBuf)> {
        let path = self.job.folder.path(&format!("data/train-{:05}.parquet", self.files))?;
        self.files += 1;
        let fail = |e: parquet::errors::ParquetError| failed(e, &path);
        let fields: String = self.columns.iter().map(Column::declaration).collect();
        let schema = parse_message_type(&format!("message schema {{ {fields} }}")).map_err(fail)?;
        let features: serde_json::Map<_, _> =
            self.columns.iter().map(|column| (column.name.clone(), column.feature())).collect();
        let features = serde_json::json!({ "info": { "features": features } }).to_string();
        let properties = WriterProperties::builder()
            .set_created_by("Fogbank".to_owned())
            .set_compression(Compression::UNCOMPRESSED)
            .set_dictionary_enabled(false)
            .set_statistics_enabled(EnabledStatistics::None)
            .set_key_value_metadata(Some(vec![KeyValue::new("huggingface".to_owned(), features)]))
            .build();
        let file = BufWriter::new(File::create(&path).map_err(Error::io("create", &path))?);
        let writer = SerializedFileWriter::new(file, Arc::new(schema), Arc::new(properties)).map_err(fail)?;
        Ok((writer, path))
    }

    /// Writes the rows that wait as one group.
    fn write_group(&mut self) -> Result<()> {
        if self.rows == 0 {
            return Ok(());
        }
        if self.open.as_ref().is_some() && self.written + self.pending > self.job.options.shard_bytes() {
            self.close()?;
        }
        let (mut writer, path) = match self.open.take() {
            Some(open) => open,
            None => self.create()?,
        };
        column::write_group(&mut writer, &mut self.columns).map_err(|e| failed(e, &path))?;
        self.open = Some((writer, path));
        self.written += std::mem::take(&mut self.pending);
        self.rows = 0;
        Ok(())
    }

    fn close(&mut self) -> Result<()> {
        self.written = 0;
        if let Some((writer, path)) = self.open.take() {
            let mut file = writer.into_inner().map_err(|e| failed(e, &path))?;
            file.flush().map_err(Error::io("write", &path))?;
        }
        Ok(())
    }
}

impl Writer for HuggingFace<'_> {
    fn frame(&mut self, frame: &Frame<'_>) -> Result<()> {
        let bytes: u64 = frame.files()?.iter().map(|file| file.bytes).sum();
        let limit = GROUP_BYTES.min(self.job.options.shard_bytes());
        if self.pending + bytes > limit || self.rows >= GROUP_ROWS {
            self.write_group()?;
        }
        for column in &mut self.columns {
            column.push(frame)?;
        }
        self.pending += bytes;
        self.rows += 1;
        self.frames += 1;
        Ok(())
    }

    fn finish(&mut self) -> Result<()> {
        self.write_group()?;
        self.close()?;
        let card = card::text(self.job.reader.header(), &self.columns, self.frames);
        self.job.folder.write("README.md", card)
    }
}

fn failed(e: parquet::errors::ParquetError, path: &std::path::Path) -> Error {
    Error::io("write", path)(std::io::Error::other(e))
}
