//! Columns of the table: what they are declared as, where their values come from, and how these are written.

use std::fs;
use std::io::Write;

use fog_dataset::{FileKind, Reader};
use parquet::data_type::{ByteArray, ByteArrayType, DoubleType, Int64Type};
use parquet::errors::Result as ParquetResult;
use parquet::file::writer::{SerializedFileWriter, SerializedRowGroupWriter};
use serde_json::{Value, json};

use crate::frame::Frame;
use crate::{Error, Result};

/// Pictures that a frame may have.
const PICTURES: [(FileKind, &str, &str); 5] = [
    (FileKind::Image, "image", "sRGB picture"),
    (FileKind::ClearImage, "clear_image", "the same view in clear air"),
    (FileKind::Semantic, "semantic", "class of each pixel, 8 bits"),
    (FileKind::Instance, "instance", "instance of each pixel, 16 bits"),
    (FileKind::Raw, "raw", "the sensor's raw picture, 16 bits"),
];
/// Other files that a frame may have.
const FILES: [(FileKind, &str, &str); 4] = [
    (FileKind::Truth, "gt_exr", "OpenEXR file of truth per pixel: depth, transmittance, …"),
    (FileKind::Hdr, "hdr_exr", "OpenEXR file of radiance"),
    (FileKind::Clear, "clear_exr", "OpenEXR file of radiance in clear air"),
    (FileKind::Objects, "objects", "records of the things in the picture, JSON"),
];

/// A column.
pub(super) struct Column {
    pub(super) name: String,
    pub(super) about: String,
    source: Source,
    values: Values,
}

enum Source {
    Number,
    Id,
    Pair,
    Axis(String),
    File(FileKind),
}

/// Values of the rows that are not written yet; `None` where a frame has none.
enum Values {
    Whole(Vec<Option<i64>>),
    Number(Vec<Option<f64>>),
    Text(Vec<Option<ByteArray>>),
    Bytes(Vec<Option<ByteArray>>),
    /// PNG bytes and file name.
    Picture(Vec<Option<(ByteArray, ByteArray)>>),
}

/// The columns of all frames of a plan; it is read once for its axes and outputs.
pub(super) fn of_plan(reader: &Reader) -> Result<Vec<Column>> {
    let mut axes: Vec<(String, bool)> = Vec::new();
    let mut kinds = Vec::new();
    for frame in reader.frames()? {
        let frame = frame?;
        for (name, value) in &frame.axes {
            let is_number = value.is_number() || value.is_null();
            match axes.iter_mut().find(|(known, _)| known == name) {
                Some((_, all)) => *all &= is_number,
                None => axes.push((name.clone(), is_number)),
            }
        }
        let all = PICTURES.iter().chain(&FILES).map(|(kind, ..)| *kind);
        kinds.extend(
            all.filter(|kind| !kinds.contains(kind) && kind.wanted(frame.outputs)).collect::<Vec<_>>(),
        );
    }
    let column = |name: &str, about: &str, source, values| Column {
        name: name.to_owned(),
        about: about.to_owned(),
        source,
        values,
    };
    let (text, bytes) = (|| Values::Text(Vec::new()), || Values::Bytes(Vec::new()));
    let mut columns = Vec::new();
    for (kind, name, about) in PICTURES.iter().filter(|(kind, ..)| kinds.contains(kind)) {
        columns.push(column(name, about, Source::File(*kind), Values::Picture(Vec::new())));
    }
    columns.push(column("number", "number of the frame, from 0", Source::Number, Values::Whole(Vec::new())));
    columns.push(column("id", "id of the frame", Source::Id, text()));
    columns.push(column("pair_id", "the same for frames that differ in fog alone", Source::Pair, text()));
    for (axis, is_number) in axes {
        let values = if is_number { Values::Number(Vec::new()) } else { text() };
        let about = format!("axis `{axis}`{}", if is_number { "" } else { ", as text or JSON" });
        // Points are for nested columns.
        columns.push(column(&format!("axis_{}", axis.replace('.', "_")), &about, Source::Axis(axis), values));
    }
    columns.push(column(
        "record",
        "everything about the frame, JSON",
        Source::File(FileKind::Record),
        text(),
    ));
    for (kind, name, about) in FILES.iter().filter(|(kind, ..)| kinds.contains(kind)) {
        let values = if *kind == FileKind::Objects { text() } else { bytes() };
        columns.push(column(name, about, Source::File(*kind), values));
    }
    Ok(columns)
}

impl Column {
    /// Its field in the language of Parquet's schemas.
    pub(super) fn declaration(&self) -> String {
        let name = &self.name;
        match self.values {
            Values::Whole(_) => format!("optional int64 {name}; "),
            Values::Number(_) => format!("optional double {name}; "),
            Values::Text(_) => format!("optional binary {name} (STRING); "),
            Values::Bytes(_) => format!("optional binary {name}; "),
            Values::Picture(_) => {
                format!("optional group {name} {{ optional binary bytes; optional binary path (STRING); }} ")
            }
        }
    }

    /// Its feature in the words of `datasets`.
    pub(super) fn feature(&self) -> Value {
        let kind = match self.values {
            Values::Picture(_) => return json!({ "_type": "Image" }),
            Values::Whole(_) => "int64",
            Values::Number(_) => "float64",
            Values::Text(_) => "string",
            Values::Bytes(_) => "binary",
        };
        json!({ "dtype": kind, "_type": "Value" })
    }

    /// Takes the value of one more frame.
    pub(super) fn push(&mut self, frame: &Frame<'_>) -> Result<()> {
        let value = match &self.source {
            Source::Number => json!(frame.number),
            Source::Id => json!(frame.id()),
            Source::Pair => json!(frame.plan.pair_id),
            Source::Axis(axis) => frame.plan.axes.get(axis).cloned().unwrap_or_default(),
            Source::File(kind) => return self.push_file(frame, *kind),
        };
        match &mut self.values {
            Values::Whole(all) => all.push(value.as_i64()),
            Values::Number(all) => all.push(value.as_f64()),
            Values::Text(all) => all.push(match value {
                Value::Null => None,
                Value::String(text) => Some(ByteArray::from(text.into_bytes())),
                other => Some(ByteArray::from(other.to_string().into_bytes())),
            }),
            Values::Bytes(_) | Values::Picture(_) => {}
        }
        Ok(())
    }

    fn push_file(&mut self, frame: &Frame<'_>, kind: FileKind) -> Result<()> {
        let content = if kind.wanted(frame.outputs()) {
            let path = frame.path(kind);
            Some(ByteArray::from(fs::read(&path).map_err(Error::io("read", &path))?))
        } else {
            None
        };
        match &mut self.values {
            Values::Picture(all) => {
                let name = ByteArray::from(kind.file(frame.id()).into_bytes());
                all.push(content.map(|content| (content, name)));
            }
            Values::Text(all) | Values::Bytes(all) => all.push(content),
            Values::Whole(_) | Values::Number(_) => {}
        }
        Ok(())
    }
}

/// Writes and forgets the values of all columns.
pub(super) fn write_group<W: Write + Send>(
    writer: &mut SerializedFileWriter<W>,
    columns: &mut [Column],
) -> ParquetResult<()> {
    let mut group = writer.next_row_group()?;
    for column in columns {
        match &mut column.values {
            Values::Whole(all) => leaf::<Int64Type, W>(&mut group, std::mem::take(all), 1)?,
            Values::Number(all) => leaf::<DoubleType, W>(&mut group, std::mem::take(all), 1)?,
            Values::Text(all) | Values::Bytes(all) => {
                leaf::<ByteArrayType, W>(&mut group, std::mem::take(all), 1)?;
            }
            Values::Picture(all) => {
                let all = std::mem::take(all);
                let names =
                    all.iter().map(|picture| picture.as_ref().map(|(_, name)| name.clone())).collect();
                let contents = all.into_iter().map(|picture| picture.map(|(content, _)| content)).collect();
                leaf::<ByteArrayType, W>(&mut group, contents, 2)?;
                leaf::<ByteArrayType, W>(&mut group, names, 2)?;
            }
        }
    }
    group.close()?;
    Ok(())
}

/// Writes one column of Parquet whose values are `depth` optional steps deep.
fn leaf<T: parquet::data_type::DataType, W: Write + Send>(
    group: &mut SerializedRowGroupWriter<'_, W>,
    values: Vec<Option<T::T>>,
    depth: i16,
) -> ParquetResult<()> {
    let levels: Vec<i16> = values.iter().map(|value| if value.is_some() { depth } else { 0 }).collect();
    let there: Vec<T::T> = values.into_iter().flatten().collect();
    if let Some(mut column) = group.next_column()? {
        column.typed::<T>().write_batch(&there, Some(&levels), None)?;
        column.close()?;
    }
    Ok(())
}
