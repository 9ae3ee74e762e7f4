//! Where the droplets of fogs come from: advection models and spectra, each read once.

use crate::droplets::Spectrum;
use crate::error::Error;
use crate::text_files::{self, TextFiles};
use fog_optics::advection::AdvectionModel;
use fog_optics::droplets::Spectra;
use fog_optics::mean_diameter::layer_mean_diameter_um;
use fog_optics::table::TableSettings;
use fog_plan::{DropletsSpec, FogModel, FogSpec};
use std::collections::HashMap;
use std::path::{Path, PathBuf};

/// Reads the fog model in `file` (YAML of the form of `tables/advection/arcata.yaml`, as `fogbank fit` writes it), or the
/// shipped one.
///
/// # Errors
/// If the file cannot be read, or is no such model: with its name, and line and column or the key.
pub fn load_model(file: Option<&Path>) -> Result<AdvectionModel, Error> {
    match file {
        None => Ok(AdvectionModel::arcata()?),
        Some(file) => parse(&text_files::read(file)?, file),
    }
}

fn parse(text: &str, file: &Path) -> Result<AdvectionModel, Error> {
    AdvectionModel::from_yaml(text).map_err(|error| Error::Fog(format!("{}: {error}", file.display())))
}

/// Droplets by altitude, as tables are made from them.
#[derive(Clone, Debug)]
pub(crate) struct DropletSource {
    /// What the user calls them.
    pub(crate) name: String,
    pub(crate) spectra: Spectra,
    /// Number-mean diameter in µm; of an advection model its mean over altitude.
    pub(crate) mean_diameter_um: f64,
    /// Hash of all that the renderer's table of them depends on: equal droplets share their tables.
    pub(crate) fingerprint: blake3::Hash,
}

impl DropletSource {
    pub(crate) fn new(name: String, spectra: Spectra) -> Self {
        let fingerprint = TableSettings::visible_of(&spectra).fingerprint_bytes_of(&spectra);
        let mean_diameter_um = match &spectra {
            Spectra::Same(distribution) => distribution.mean_diameter_um(),
            Spectra::Advection(model) => layer_mean_diameter_um(model),
        };
        Self { name, spectra, mean_diameter_um, fingerprint: blake3::hash(&fingerprint) }
    }
}

/// An advection model and its droplets.
#[derive(Debug)]
struct Model {
    model: AdvectionModel,
    droplets: DropletSource,
}

impl Model {
    fn new(file: Option<&Path>, files: &TextFiles) -> Result<Self, Error> {
        let (model, name) = match file {
            None => (AdvectionModel::arcata()?, "polydisperse Mie".to_owned()),
            Some(file) => (parse(files.text(file)?, file)?, format!("polydisperse Mie, {}", file.display())),
        };
        let droplets = DropletSource::new(name, Spectra::Advection(model.clone()));
        Ok(Self { model, droplets })
    }
}

/// Files, models and spectra. What cannot be had is remembered with its reason, so that frames that do without go on.
#[derive(Debug, Default)]
pub(crate) struct Sources {
    files: TextFiles,
    /// By file; the shipped one has none.
    models: HashMap<Option<PathBuf>, Result<Model, String>>,
    /// By specification as text.
    spectra: HashMap<String, Result<Spectrum, String>>,
}

impl Sources {
    /// Reads what a fog is made from and is not there yet.
    pub(crate) fn prepare(&mut self, fog: &FogSpec) {
        for file in fog.files() {
            self.files.read(file);
        }
        if fog.takes_advection_model() && !self.models.contains_key(&fog.coefficients) {
            let model = Model::new(fog.coefficients.as_deref(), &self.files);
            self.models.insert(fog.coefficients.clone(), model.map_err(|e| e.to_string()));
        }
        if let FogModel::Droplets { droplets, .. } = &fog.model {
            let key = key(droplets);
            if !self.spectra.contains_key(&key) {
                let spectrum = Spectrum::new(droplets, format!("Mie, {key}"), &self.files);
                self.spectra.insert(key, spectrum.map_err(|e| e.to_string()));
            }
        }
    }

    /// Reads a file that is no fog's.
    pub(crate) fn read_file(&mut self, file: &Path) {
        self.files.read(file);
    }

    pub(crate) fn files(&self) -> &TextFiles {
        &self.files
    }

    /// The advection model of a fog that takes something from it.
    ///
    /// # Errors
    /// Why it could not be had.
    pub(crate) fn model(&self, fog: &FogSpec) -> Result<&AdvectionModel, Error> {
        Ok(&self.model_of(fog)?.model)
    }

    fn model_of(&self, fog: &FogSpec) -> Result<&Model, Error> {
        found(self.models.get(&fog.coefficients), "fog model")
    }

    /// The spectrum of a specification.
    ///
    /// # Errors
    /// Why it could not be had.
    pub(crate) fn spectrum(&self, droplets: &DropletsSpec) -> Result<&Spectrum, Error> {
        found(self.spectra.get(&key(droplets)), "droplet spectrum")
    }

    /// The droplets of a fog: its own, or those of its advection model.
    ///
    /// # Errors
    /// Why they could not be had; also if the fog has no droplets and takes none.
    pub(crate) fn droplets(&self, fog: &FogSpec) -> Result<&DropletSource, Error> {
        match &fog.model {
            FogModel::Droplets { droplets, .. } => Ok(&self.spectrum(droplets)?.droplets),
            _ => Ok(&self.model_of(fog)?.droplets),
        }
    }
}

/// What was prepared, or why it could not be.
pub(crate) fn found<'a, T>(prepared: Option<&'a Result<T, String>>, what: &str) -> Result<&'a T, Error> {
    match prepared {
        Some(Ok(found)) => Ok(found),
        Some(Err(reason)) => Err(Error::Fog(reason.clone())),
        None => Err(Error::Fog(format!("{what} was not prepared"))),
    }
}

/// A spectrum's specification as text: its name, or JSON.
fn key(droplets: &DropletsSpec) -> String {
    match droplets {
        DropletsSpec::Named(name) => name.clone(),
        _ => serde_json::json!(droplets).to_string(),
    }
}
