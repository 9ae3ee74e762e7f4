//! What frames share: the observer, the fog model, optics tables and loaded scenes, each made once.

use crate::droplets::Spectrum;
use crate::error::Error;
use crate::progress::{Event, Progress};
use crate::table_cache::TableCache;
use fog_core::colour::Observer;
use fog_core::diameter_choice::DiameterChoice;
use fog_core::droplet_table::DropletTable;
use fog_core::optics_table::OpticsTable;
use fog_optics::advection::AdvectionModel;
use fog_optics::droplet_table;
use fog_optics::droplets::Spectra;
use fog_optics::mean_diameter::{self, mean_diameter_table};
use fog_optics::table::{self, TableSettings};
use fog_plan::{DropletsSpec, FogModel, FogSpec, FrameSpec, MeanCosine, Phase, Sampling};
use fog_scene::{Limits, LoadedScene};
use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Instant;

/// Key of the advection model's droplets among the configured ones, which are names or JSON.
const ADVECTION: &str = "advection";

/// Tables and scenes by name. Fill it with [`Resources::prepare`] before frames are made from it.
#[derive(Debug)]
pub struct Resources {
    cache: TableCache,
    /// Colour matching and upsampling.
    pub observer: Observer,
    /// The droplet model.
    pub model: AdvectionModel,
    polydisperse: Option<OpticsTable>,
    mean_diameter: Option<OpticsTable>,
    spectra: HashMap<String, Result<Spectrum, String>>,
    single: HashMap<String, (DropletTable, DiameterChoice)>,
    scenes: HashMap<PathBuf, Result<Arc<LoadedScene>, String>>,
    empty: Arc<LoadedScene>,
}

impl Resources {
    /// Nothing loaded yet; tables will come from `cache`.
    ///
    /// # Errors
    /// If the embedded fog model is invalid.
    pub fn new(cache: TableCache) -> Result<Self, Error> {
        Ok(Self {
            cache,
            observer: Observer::new(),
            model: AdvectionModel::arcata()?,
            polydisperse: None,
            mean_diameter: None,
            spectra: HashMap::new(),
            single: HashMap::new(),
            scenes: HashMap::new(),
            empty: Arc::new(LoadedScene::default()),
        })
    }

    /// Loads or builds what a frame needs and is not there yet. A scene that cannot be loaded is remembered and reported
    /// by [`Resources::scene`], so that other frames can go on.
    ///
    /// # Errors
    /// If a table cannot be built.
    pub fn prepare(&mut self, spec: &FrameSpec, progress: &dyn Progress) -> Result<(), Error> {
        if needs_polydisperse(spec) && self.polydisperse.is_none() {
            let spectra = Spectra::Advection(self.model.clone());
            self.polydisperse = Some(self.table("polydisperse", "polydisperse Mie", &spectra, progress)?);
        }
        if spec.fog.phase == Phase::MieMeanDiameter && self.mean_diameter.is_none() {
            self.mean_diameter = Some(mean_diameter_table(&self.model, mean_diameter::WAVELENGTH_NM)?);
        }
        if let FogModel::Droplets { droplets, .. } = &spec.fog.model
            && !self.spectra.contains_key(&key(droplets))
        {
            // A spectrum that cannot be had is remembered as a scene is.
            let spectrum = Spectrum::new(droplets, |spectra| {
                self.table("droplets", &format!("Mie, {}", key(droplets)), spectra, progress)
            });
            self.spectra.insert(key(droplets), spectrum.map_err(|e| e.to_string()));
        }
        if needs_single_droplets(&spec.fog) && !self.single.contains_key(&single_key(&spec.fog.model)) {
            let spectra = match &spec.fog.model {
                // Why the spectrum could not be had is reported by `Resources::spectrum`.
                FogModel::Droplets { droplets, .. } => {
                    self.spectrum(droplets).ok().map(|s| Spectra::Same(s.distribution.clone()))
                }
                _ => Some(Spectra::Advection(self.model.clone())),
            };
            if let Some(spectra) = spectra {
                let single = self.single_droplets(&spectra, progress)?;
                self.single.insert(single_key(&spec.fog.model), single);
            }
        }
        if let Some(scene) = &spec.scene
            && !self.scenes.contains_key(&scene.file)
        {
            let started = Instant::now();
            let loaded = fog_scene::load(&scene.file, &Limits::default());
            if let Ok(loaded) = &loaded {
                progress.event(Event::Scene {
                    path: &scene.file,
                    triangles: loaded.geometry.triangles().len(),
                    warnings: &loaded.warnings,
                    seconds: started.elapsed().as_secs_f64(),
                });
            }
            self.scenes.insert(scene.file.clone(), loaded.map(Arc::new).map_err(|e| e.to_string()));
        }
        Ok(())
    }

    /// The table of droplet spectra for the renderer, from the cache; `file` begins the name of its file, `name` is for the
    /// user.
    fn table(
        &self,
        file: &str,
        name: &str,
        spectra: &Spectra,
        progress: &dyn Progress,
    ) -> Result<OpticsTable, Error> {
        let settings = TableSettings::visible_of(spectra);
        let started = Instant::now();
        let (table, origin) = self.cache.open(file, &settings.fingerprint_bytes_of(spectra), || {
            let report = |fraction| {
                progress.event(Event::TableProgress(fraction));
            };
            Ok(table::build(spectra, &settings, &report)?)
        })?;
        let seconds = started.elapsed().as_secs_f64();
        progress.event(Event::Table { name, origin: &origin, seconds });
        Ok(table)
    }

    /// Single droplets of `spectra` at the renderer's wavelengths, and their odds at its altitudes.
    fn single_droplets(
        &self,
        spectra: &Spectra,
        progress: &dyn Progress,
    ) -> Result<(DropletTable, DiameterChoice), Error> {
        let TableSettings { zeta, wavelengths_nm, diameters } = TableSettings::visible_of(spectra);
        let fingerprint = droplet_table::fingerprint_bytes(&diameters, &wavelengths_nm);
        let started = Instant::now();
        let (table, origin) = self.cache.open("single", &fingerprint, || {
            let report = |fraction| {
                progress.event(Event::TableProgress(fraction));
            };
            Ok(droplet_table::build(&diameters, &wavelengths_nm, &report)?)
        })?;
        let choice = droplet_table::choice(&table, &diameters, &zeta, spectra)?;
        let seconds = started.elapsed().as_secs_f64();
        progress.event(Event::Table { name: "single droplets", origin: &origin, seconds });
        Ok((table, choice))
    }

    /// The spectrum of a specification.
    ///
    /// # Errors
    /// Why it could not be had.
    pub(crate) fn spectrum(&self, droplets: &DropletsSpec) -> Result<&Spectrum, Error> {
        match self.spectra.get(&key(droplets)) {
            Some(spectrum) => spectrum.as_ref().map_err(|reason| Error::Fog(reason.clone())),
            None => Err(Error::Fog(format!("{} was not prepared", key(droplets)))),
        }
    }

    /// The scene in `file`, or empty space.
    ///
    /// # Errors
    /// Why it could not be loaded.
    pub fn scene(&self, file: Option<&Path>) -> Result<Arc<LoadedScene>, Error> {
        match file {
            None => Ok(self.empty.clone()),
            Some(file) => match self.scenes.get(file) {
                Some(Ok(scene)) => Ok(scene.clone()),
                Some(Err(reason)) => Err(Error::Scene(reason.clone())),
                None => Err(Error::Scene(format!("{} was not prepared", file.display()))),
            },
        }
    }

    pub(crate) fn polydisperse(&self) -> Result<&OpticsTable, Error> {
        self.polydisperse.as_ref().ok_or_else(|| Error::Fog("optics table was not prepared".to_owned()))
    }

    /// Single droplets of a model, and their odds.
    pub(crate) fn single(&self, model: &FogModel) -> Result<&(DropletTable, DiameterChoice), Error> {
        let single = self.single.get(&single_key(model));
        single.ok_or_else(|| Error::Fog("droplet table was not prepared".to_owned()))
    }

    pub(crate) fn mean_diameter(&self) -> Result<&OpticsTable, Error> {
        self.mean_diameter.as_ref().ok_or_else(|| Error::Fog("phase table was not prepared".to_owned()))
    }
}

/// Key of the single droplets of a model.
fn single_key(model: &FogModel) -> String {
    match model {
        FogModel::Droplets { droplets, .. } => key(droplets),
        _ => ADVECTION.to_owned(),
    }
}

/// True if the fog draws single droplets.
fn needs_single_droplets(fog: &FogSpec) -> bool {
    fog.model != FogModel::None && fog.phase == Phase::Mie && fog.sampling == Sampling::Diameter
}

/// A spectrum's specification as text: its name, or JSON.
fn key(droplets: &DropletsSpec) -> String {
    match droplets {
        DropletsSpec::Named(name) => name.clone(),
        _ => serde_json::json!(droplets).to_string(),
    }
}

/// True if the frame's extinction or phase function comes from the polydisperse table.
fn needs_polydisperse(spec: &FrameSpec) -> bool {
    let by_altitude = matches!(spec.fog.phase, Phase::Mie | Phase::Hg(MeanCosine::Layer));
    match &spec.fog.model {
        FogModel::None | FogModel::Droplets { .. } => false,
        FogModel::Advection { .. } => true,
        FogModel::Homogeneous { sigma_t_1_m, .. } => sigma_t_1_m.is_none() || by_altitude,
        FogModel::LinearGradient { sigma_t_base_1_m, sigma_t_top_1_m, .. } => {
            sigma_t_base_1_m.is_none() || sigma_t_top_1_m.is_none() || by_altitude
        }
        FogModel::Layered { .. } => by_altitude,
    }
}
