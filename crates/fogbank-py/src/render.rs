//! Frames and sweeps.

use crate::arrays::to_array;
use crate::errors::{ConfigError, DataSetError};
use crate::plan::Plan;
use crate::run::run;
use fogbank::dataset::{Opening, Raster};
use fogbank::plan::Filter;
use fogbank::{Error, Event, Selection, SweepOptions, Work};
use pyo3::exceptions::PyKeyError;
use pyo3::prelude::*;
use serde_json::json;
use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

/// A frame that was rendered and not stored.
#[pyclass(frozen, module = "fogbank._fogbank")]
pub(crate) struct RenderedFrame {
    spec: String,
    record: String,
    objects: Option<String>,
    /// Those that no array has taken over yet.
    rasters: Mutex<BTreeMap<String, Raster>>,
}

#[pymethods]
impl RenderedFrame {
    /// Names of its pictures.
    fn names(&self) -> Vec<String> {
        self.rasters.lock().unwrap_or_else(PoisonError::into_inner).keys().cloned().collect()
    }

    /// A picture as an array; once.
    fn read<'py>(&self, py: Python<'py>, name: &str) -> PyResult<Bound<'py, PyAny>> {
        let raster = self.rasters.lock().unwrap_or_else(PoisonError::into_inner).remove(name);
        to_array(py, raster.ok_or_else(|| PyKeyError::new_err(name.to_owned()))?)
    }

    fn spec_json(&self) -> &str {
        &self.spec
    }

    fn record_json(&self) -> &str {
        &self.record
    }

    fn objects_json(&self) -> Option<&str> {
        self.objects.as_deref()
    }
}

/// Renders the frame of an id or a beginning of one, or the only one.
#[pyfunction]
#[pyo3(signature = (plan, frame, threads, progress))]
pub(crate) fn render(
    py: Python<'_>,
    plan: &Plan,
    frame: Option<&str>,
    threads: usize,
    progress: Option<Bound<'_, PyAny>>,
) -> PyResult<RenderedFrame> {
    let resources = Arc::clone(&plan.resources);
    run(py, threads, progress, move |progress| {
        let (mut frames, index) = fogbank::one_frame(&plan.plan, frame)?;
        let spec = frames.swap_remove(index);
        resources.write().unwrap_or_else(PoisonError::into_inner).prepare(&spec, progress);
        let resources = resources.read().unwrap_or_else(PoisonError::into_inner);
        let paths = fogbank::path_count(&spec);
        progress.event(Event::Ready { done: 0, failed: 0, paths, todo: 1 });
        let traced = AtomicU64::new(0);
        let hear = |work: Work| match work {
            Work::Traced(n) => {
                traced.fetch_add(n, Ordering::Relaxed);
                progress.event(Event::Paths(n))
            }
            Work::Left(n) => progress.event(Event::Expected(traced.load(Ordering::Relaxed) + n)),
        };
        let rendered = fogbank::render_frame(&spec, &resources, &plan.plan.config_digest(), &hear)?;
        Ok(RenderedFrame {
            record: rendered.record.to_string(),
            objects: rendered.objects.as_ref().map(ToString::to_string),
            rasters: Mutex::new(rendered.rasters(&spec)),
            spec: json!(spec).to_string(),
        })
    })
}

/// Renders what is missing of a data set: numbers of frames that are done, failed and missing.
#[pyfunction]
#[pyo3(signature = (plan, out, only, condition, mode, retry_failed, threads, progress))]
#[expect(clippy::too_many_arguments, reason = "Python's side has names for them")]
pub(crate) fn sweep(
    py: Python<'_>,
    plan: &Plan,
    out: PathBuf,
    only: Vec<String>,
    condition: Option<&str>,
    mode: &str,
    retry_failed: bool,
    threads: usize,
    progress: Option<Bound<'_, PyAny>>,
) -> PyResult<(u64, u64, u64)> {
    let opening = match mode {
        "resume" => Opening::Resume,
        "overwrite" => Opening::Overwrite,
        "extend" => Opening::Extend,
        other => {
            let text = format!("mode is \"{other}\"; valid: resume, overwrite, extend");
            return Err(ConfigError::new_err(text));
        }
    };
    if out.is_file() {
        return Err(DataSetError::new_err(format!("{} is a file, not a folder", out.display())));
    }
    let resources = Arc::clone(&plan.resources);
    run(py, threads, progress, move |progress| {
        let filter = condition.map(Filter::parse).transpose().map_err(Error::from)?;
        let selection = Selection { only, filter, ..Selection::default() };
        let options = SweepOptions { selection, opening, retry_failed, ..SweepOptions::default() };
        let mut resources = resources.write().unwrap_or_else(PoisonError::into_inner);
        let counts = fogbank::sweep(&plan.plan, &options, &out, &mut resources, progress)?;
        Ok((counts.done, counts.failed, counts.missing))
    })
}
