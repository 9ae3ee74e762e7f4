//! The numbers of a fog.

use crate::errors::{ConfigError, exception};
use crate::plan::{fog_spec, table_cache};
use crate::run::run;
use fogbank::optics::visibility::{Law, threshold};
use fogbank::{Error, FogNumbers};
use numpy::{PyArray1, PyReadonlyArray1};
use pyo3::prelude::*;
use serde_json::{Value, json};
use std::path::PathBuf;

/// Arguments of one length each, side by side in memory.
type Numbers<'py> = PyReadonlyArray1<'py, f64>;

/// A fog by itself.
#[pyclass(frozen, module = "fogbank._fogbank")]
pub(crate) struct Fog {
    numbers: FogNumbers,
    spec: Value,
}

#[pymethods]
impl Fog {
    /// From the text of a configuration with this fog.
    #[new]
    #[pyo3(signature = (text, cache_dir))]
    fn new(py: Python<'_>, text: &str, cache_dir: Option<PathBuf>) -> PyResult<Self> {
        let (spec, cache) = (fog_spec(text)?, table_cache(cache_dir)?);
        let numbers = run(py, 0, None, |_| FogNumbers::new(&spec, cache))?;
        Ok(Self { numbers, spec: json!(spec) })
    }

    fn spec_json(&self) -> String {
        self.spec.to_string()
    }

    /// Altitudes of base and top.
    fn extent_m(&self) -> Option<[f64; 2]> {
        self.numbers.extent_m()
    }

    fn sigma_t<'py>(&self, py: Python<'py>, z: Numbers<'py>, nm: Numbers<'py>) -> Answer<'py> {
        let (z, nm) = (z.as_slice()?, nm.as_slice()?);
        self.answer(py, nm, || self.numbers.sigma_t_1_m(z, nm))
    }

    fn albedo<'py>(&self, py: Python<'py>, z: Numbers<'py>, nm: Numbers<'py>) -> Answer<'py> {
        let (z, nm) = (z.as_slice()?, nm.as_slice()?);
        self.answer(py, nm, || self.numbers.albedo(z, nm))
    }

    fn phase<'py>(
        &self,
        py: Python<'py>,
        z: Numbers<'py>,
        nm: Numbers<'py>,
        cosine: Numbers<'py>,
    ) -> Answer<'py> {
        let (z, nm, cosine) = (z.as_slice()?, nm.as_slice()?, cosine.as_slice()?);
        self.answer(py, nm, || self.numbers.phase_1_sr(z, nm, cosine))
    }

    /// `law` is `mor`, `koschmieder` or `allard`, which alone takes `intensity_cd` and `threshold_lx`.
    #[expect(clippy::too_many_arguments, reason = "Python's side has names for them")]
    fn visibility<'py>(
        &self,
        py: Python<'py>,
        z: Numbers<'py>,
        nm: Numbers<'py>,
        law: &str,
        intensity_cd: Numbers<'py>,
        threshold_lx: Numbers<'py>,
        elevation_deg: Option<Numbers<'py>>,
    ) -> Answer<'py> {
        let (z, nm) = (z.as_slice()?, nm.as_slice()?);
        let lights = intensity_cd.as_slice()?.iter().zip(threshold_lx.as_slice()?);
        let laws = match law {
            "mor" => vec![Law::Mor; z.len()],
            "koschmieder" => vec![Law::Koschmieder; z.len()],
            "allard" => lights
                .map(|(&intensity_cd, &threshold_lx)| Law::Allard { intensity_cd, threshold_lx })
                .collect(),
            other => {
                let text = format!("law is \"{other}\"; valid: mor, koschmieder, allard");
                return Err(ConfigError::new_err(text));
            }
        };
        let elevation = elevation_deg.as_ref().map(|angles| angles.as_slice()).transpose()?;
        self.answer(py, nm, || self.numbers.visibility_m(z, nm, &laws, elevation))
    }

    /// The fog at 550 nm at each altitude: a row of values for each name of [`Fog::state_names`], NaN where there is none.
    fn state<'py>(&self, py: Python<'py>, z: Numbers<'py>) -> PyResult<Vec<Bound<'py, PyArray1<f64>>>> {
        let z = z.as_slice()?;
        let columns = py.detach(|| {
            let states = z.iter().map(|&z| self.numbers.state(z)).collect::<Result<Vec<_>, Error>>()?;
            let column = |get: fn(&State) -> Option<f64>| -> Vec<f64> {
                states.iter().map(|state| get(state).unwrap_or(f64::NAN)).collect()
            };
            Ok(STATE.map(|(_, get)| column(get)))
        });
        Ok(columns.map_err(exception)?.into_iter().map(|column| PyArray1::from_vec(py, column)).collect())
    }

    /// Names of what [`Fog::state`] gives.
    #[staticmethod]
    fn state_names() -> Vec<&'static str> {
        STATE.iter().map(|(name, _)| *name).collect()
    }

    /// Illuminance in lx of a threshold by its name; none for an unknown name.
    #[staticmethod]
    fn threshold_lx(name: &str) -> Option<f64> {
        threshold::named(name).map(|threshold| threshold.illuminance_lx)
    }

    /// Names of all thresholds.
    #[staticmethod]
    fn threshold_names() -> Vec<&'static str> {
        threshold::NAMES.to_vec()
    }
}

type State = fogbank::optics::state::FogState;
type Column = (&'static str, fn(&State) -> Option<f64>);

const STATE: [Column; 8] = [
    ("sigma_t_1_m", |s| Some(s.sigma_t_550_1_m)),
    ("albedo", |s| s.albedo),
    ("g", |s| s.g),
    ("mor_m", |s| s.mor_m.or(Some(f64::INFINITY))),
    ("liquid_water_content_g_m3", |s| s.liquid_water_content_g_m3),
    ("number_density_1_m3", |s| s.number_density_1_m3),
    ("effective_radius_um", |s| s.effective_radius_um),
    ("mean_diameter_um", |s| s.mean_diameter_um),
];

type Answer<'py> = PyResult<Bound<'py, PyArray1<f64>>>;

impl Fog {
    /// The values of `compute`, which runs without Python's lock.
    fn answer<'py>(
        &self,
        py: Python<'py>,
        nm: &[f64],
        compute: impl FnOnce() -> Result<Vec<f64>, Error> + Send,
    ) -> Answer<'py> {
        // On threads that end: a pool that stays would be lost to a fork of the process.
        if !self.numbers.is_ready(nm) {
            run(py, 0, None, |_| self.numbers.prepare(nm))?;
        }
        Ok(PyArray1::from_vec(py, py.detach(compute).map_err(exception)?))
    }
}
