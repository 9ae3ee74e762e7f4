//! What frames share: the observer, the fog model, optics tables and loaded scenes, each made once.

use crate::error::Error;
use crate::progress::{Event, Progress};
use crate::table_cache::TableCache;
use fog_core::colour::Observer;
use fog_core::diameter_choice::DiameterChoice;
use fog_core::droplet_table::DropletTable;
use fog_core::optics_table::OpticsTable;
use fog_optics::advection::AdvectionModel;
use fog_optics::droplet_table;
use fog_optics::mean_diameter::mean_diameter_table;
use fog_optics::table::{self, TableSettings};
use fog_plan::{FogModel, FrameSpec, MeanCosine, Phase, Sampling};
use fog_scene::{Limits, LoadedScene};
use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Instant;

/// Wavelength of the single-droplet table (`phase: mie_mean_diameter`), in nm.
pub(crate) const MEAN_DIAMETER_NM: f64 = 550.0;

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
    droplets: Option<(DropletTable, DiameterChoice)>,
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
            droplets: None,
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
            let settings = TableSettings::visible(&self.model);
            let fingerprint = settings.fingerprint_bytes(&self.model);
            let started = Instant::now();
            let (built, origin) = self.cache.open("polydisperse", &fingerprint, || {
                let report = |fraction| {
                    progress.event(Event::TableProgress(fraction));
                };
                Ok(table::build_table(&self.model, &settings, &report)?)
            })?;
            let seconds = started.elapsed().as_secs_f64();
            progress.event(Event::Table { name: "polydisperse Mie", origin: &origin, seconds });
            self.polydisperse = Some(built);
        }
        if spec.fog.phase == Phase::MieMeanDiameter && self.mean_diameter.is_none() {
            self.mean_diameter = Some(mean_diameter_table(&self.model, MEAN_DIAMETER_NM)?);
        }
        if needs_droplets(spec) && self.droplets.is_none() {
            self.droplets = Some(self.prepare_droplets(progress)?);
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

    /// Single droplets at the renderer's wavelengths, and their odds at its altitudes.
    fn prepare_droplets(&self, progress: &dyn Progress) -> Result<(DropletTable, DiameterChoice), Error> {
        let TableSettings { zeta, wavelengths_nm, diameters } = TableSettings::visible(&self.model);
        let fingerprint = droplet_table::fingerprint_bytes(&diameters, &wavelengths_nm);
        let started = Instant::now();
        let (table, origin) = self.cache.open("droplets", &fingerprint, || {
            let report = |fraction| {
                progress.event(Event::TableProgress(fraction));
            };
            Ok(droplet_table::build(&diameters, &wavelengths_nm, &report)?)
        })?;
        let density = |zeta: f64, d_um: f64| self.model.shape(zeta).density_1_um(d_um);
        let choice = droplet_table::choice(&table, &diameters, &zeta, density)?;
        let seconds = started.elapsed().as_secs_f64();
        progress.event(Event::Table { name: "single droplets", origin: &origin, seconds });
        Ok((table, choice))
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

    pub(crate) fn droplets(&self) -> Result<&(DropletTable, DiameterChoice), Error> {
        self.droplets.as_ref().ok_or_else(|| Error::Fog("droplet table was not prepared".to_owned()))
    }

    pub(crate) fn mean_diameter(&self) -> Result<&OpticsTable, Error> {
        self.mean_diameter.as_ref().ok_or_else(|| Error::Fog("phase table was not prepared".to_owned()))
    }
}

/// True if the frame draws single droplets.
fn needs_droplets(spec: &FrameSpec) -> bool {
    spec.fog.model != FogModel::None
        && spec.fog.phase == Phase::Mie
        && spec.fog.sampling == Sampling::Diameter
}

/// True if the frame's extinction or phase function comes from the polydisperse table.
fn needs_polydisperse(spec: &FrameSpec) -> bool {
    let by_altitude = matches!(spec.fog.phase, Phase::Mie | Phase::Hg(MeanCosine::Layer));
    match &spec.fog.model {
        FogModel::None => false,
        FogModel::Advection { .. } => true,
        FogModel::Homogeneous { sigma_t_1_m, .. } => sigma_t_1_m.is_none() || by_altitude,
        FogModel::LinearGradient { sigma_t_base_1_m, sigma_t_top_1_m, .. } => {
            sigma_t_base_1_m.is_none() || sigma_t_top_1_m.is_none() || by_altitude
        }
        FogModel::Layered { .. } => by_altitude,
    }
}
