//! Data sets as they are on disk.

use crate::arrays::to_array;
use crate::errors::{DataSetError, exception, plan_exception};
use fogbank::dataset::{
    self, Channel, FileKind, FrameState, PlanFrame, Raster, Reader, file_of_raster, raster_names,
};
use fogbank::plan::Filter;
use pyo3::exceptions::{PyIndexError, PyKeyError};
use pyo3::prelude::*;
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::{Arc, Mutex, PoisonError};

/// The finished frames of a data set.
#[pyclass(frozen, module = "fogbank._fogbank")]
pub(crate) struct DataSet {
    reader: Arc<Reader>,
    /// In the order of the plan.
    frames: Vec<Arc<PlanFrame>>,
    counts: (usize, usize, usize),
}

#[pymethods]
impl DataSet {
    /// Reads the plan, and looks which frames are done.
    #[new]
    fn new(py: Python<'_>, dir: PathBuf) -> PyResult<Self> {
        py.detach(|| {
            let reader = Reader::open(&dir)?;
            let (mut frames, mut counts) = (Vec::new(), (0, 0, 0));
            for frame in reader.frames()? {
                let frame = frame?;
                match reader.state(&frame) {
                    FrameState::Done => {
                        counts.0 += 1;
                        frames.push(Arc::new(frame));
                    }
                    FrameState::Failed => counts.1 += 1,
                    FrameState::Missing => counts.2 += 1,
                }
            }
            Ok(Self { reader: Arc::new(reader), frames, counts })
        })
        .map_err(wrong)
    }

    /// Numbers of frames that are done, failed and missing.
    fn counts(&self) -> (usize, usize, usize) {
        self.counts
    }

    /// `dataset.json`.
    fn header_json(&self) -> String {
        json!(self.reader.header()).to_string()
    }

    /// `classes.json`, if there is one.
    fn classes_json(&self) -> PyResult<Option<String>> {
        Ok(self.reader.classes().map_err(wrong)?.map(|classes| classes.to_string()))
    }

    fn ids(&self) -> Vec<&str> {
        self.frames.iter().map(|frame| frame.id.as_str()).collect()
    }

    /// By finished frame, whether it meets a condition.
    fn matches(&self, py: Python<'_>, condition: &str) -> PyResult<Vec<bool>> {
        let matches = py.detach(|| {
            let documents: Vec<&Value> = self.frames.iter().map(|frame| &frame.spec).collect();
            Filter::parse(condition)?.matches_json(&documents)
        });
        matches.map_err(|e| plan_exception(&e))
    }

    /// A finished frame.
    fn frame(&self, index: usize) -> PyResult<StoredFrame> {
        let frame = self.frames.get(index).ok_or_else(|| PyIndexError::new_err(index))?;
        let (reader, frame) = (Arc::clone(&self.reader), Arc::clone(frame));
        Ok(StoredFrame { reader, frame, files: Mutex::default() })
    }
}

/// A frame of a data set; its files are read when they are asked for.
#[pyclass(frozen, module = "fogbank._fogbank")]
pub(crate) struct StoredFrame {
    reader: Arc<Reader>,
    frame: Arc<PlanFrame>,
    /// Channels that were read along with others and that no array has taken over yet, by file name.
    files: Mutex<BTreeMap<String, BTreeMap<String, Channel>>>,
}

#[pymethods]
impl StoredFrame {
    /// Names of its pictures.
    fn names(&self) -> Vec<String> {
        raster_names(&self.frame)
    }

    /// A picture as an array. A file is read again only for a picture that was taken before.
    fn read<'py>(&self, py: Python<'py>, name: &str) -> PyResult<Bound<'py, PyAny>> {
        let kind = file_of_raster(name).filter(|_| self.names().iter().any(|known| known == name));
        let kind = kind.ok_or_else(|| PyKeyError::new_err(name.to_owned()))?;
        let raster = py.detach(|| self.raster(name, kind)).map_err(wrong)?;
        let lacks = || {
            let path = self.reader.path(&self.frame, kind);
            DataSetError::new_err(format!("{} does not hold {name}", path.display()))
        };
        to_array(py, raster.ok_or_else(lacks)?)
    }

    fn spec_json(&self) -> String {
        self.frame.spec.to_string()
    }

    fn record_json(&self, py: Python<'_>) -> PyResult<String> {
        py.detach(|| self.reader.text(&self.frame, FileKind::Record)).map_err(wrong)
    }

    fn objects_json(&self, py: Python<'_>) -> PyResult<Option<String>> {
        if !self.frame.outputs.objects {
            return Ok(None);
        }
        py.detach(|| self.reader.text(&self.frame, FileKind::Objects)).map(Some).map_err(wrong)
    }
}

impl StoredFrame {
    fn raster(&self, name: &str, kind: FileKind) -> dataset::Result<Option<Raster>> {
        let file = kind.file(&self.frame.id);
        if !file.ends_with(".exr") {
            return self.reader.raster(&self.frame, kind).map(Some);
        }
        let mut files = self.files.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(raster) = files.get_mut(&file).and_then(|channels| Raster::take(name, channels)) {
            return Ok(Some(raster));
        }
        let mut channels = self.reader.channels(&self.frame, kind)?;
        let raster = Raster::take(name, &mut channels);
        files.insert(file, channels);
        Ok(raster)
    }
}

fn wrong(error: dataset::Error) -> PyErr {
    exception(error.into())
}
