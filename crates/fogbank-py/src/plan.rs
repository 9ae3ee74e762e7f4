//! A configuration and what its frames are made from.

use crate::errors::{ConfigError, exception, plan_exception};
use fogbank::plan as config;
use fogbank::{Resources, TableCache};
use pyo3::prelude::*;
use serde_json::json;
use std::path::PathBuf;
use std::sync::{Arc, RwLock};

/// A checked configuration.
#[pyclass(frozen, module = "fogbank._fogbank")]
pub(crate) struct Plan {
    pub(crate) plan: Arc<config::Plan>,
    /// Scenes and tables; they stay for the next frame.
    pub(crate) resources: Arc<RwLock<Resources>>,
}

#[pymethods]
impl Plan {
    /// From the text of a configuration, whose name is for messages (none: its places are not named), or from a file of that
    /// name if there is no text.
    #[new]
    #[pyo3(signature = (name, text, sets, cache_dir, oidn))]
    fn new(
        py: Python<'_>,
        name: PathBuf,
        text: Option<&str>,
        sets: Vec<String>,
        cache_dir: Option<PathBuf>,
        oidn: Option<PathBuf>,
    ) -> PyResult<Self> {
        let plan = py.detach(|| match text {
            Some(text) => config::parse(text, &name.to_string_lossy(), &sets),
            None => config::load(&name, &sets),
        });
        let plan = plan.map_err(|e| plan_exception(&e))?;
        let resources = Resources::new(table_cache(cache_dir)?).with_denoiser(oidn);
        Ok(Self { plan: Arc::new(plan), resources: Arc::new(RwLock::new(resources)) })
    }

    fn name(&self) -> &str {
        self.plan.name()
    }

    fn axes(&self) -> Vec<String> {
        self.plan.axes().iter().map(|axis| axis.path.clone()).collect()
    }

    fn resolved_yaml(&self) -> String {
        self.plan.resolved_yaml()
    }

    fn __len__(&self) -> usize {
        self.plan.len()
    }

    /// A frame as JSON.
    fn frame_json(&self, py: Python<'_>, index: usize) -> PyResult<String> {
        let frame = py.detach(|| self.plan.frame(index));
        Ok(json!(frame.map_err(|e| plan_exception(&e))?).to_string())
    }

    /// By frame, whether it meets a condition.
    fn matches(&self, py: Python<'_>, condition: &str) -> PyResult<Vec<bool>> {
        let matches = py.detach(|| {
            let frames = self.plan.frames().collect::<Result<Vec<_>, _>>()?;
            config::Filter::parse(condition)?.matches(&frames)
        });
        matches.map_err(|e| plan_exception(&e))
    }
}

/// The folder asked for, or the usual one.
pub(crate) fn table_cache(dir: Option<PathBuf>) -> PyResult<TableCache> {
    let dir = dir.or_else(fogbank::default_cache_dir);
    let missing =
        || ConfigError::new_err("no cache folder is known on this machine: name one with cache_dir");
    Ok(TableCache::new(dir.ok_or_else(missing)?))
}

/// For a single fog: its specification from the text of a configuration.
pub(crate) fn fog_spec(text: &str) -> PyResult<config::FogSpec> {
    let frame = config::parse(text, "", &[]).and_then(|plan| plan.frame(0));
    Ok(frame.map_err(|e| exception(e.into()))?.fog)
}
