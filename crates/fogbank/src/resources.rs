//! What frames share: the observer, fog models, optics tables and loaded scenes, each made once.

use crate::denoise;
use crate::droplets::Spectrum;
use crate::error::Error;
use crate::progress::{Event, Progress};
use crate::scenes::Scenes;
use crate::sources::{DropletSource, Sources};
use crate::surroundings::Surroundings;
use crate::table_cache::TableCache;
use crate::tables::Tables;
use crate::text_files::TextFiles;
use fog_core::colour::Observer;
use fog_core::diameter_choice::DiameterChoice;
use fog_core::droplet_table::DropletTable;
use fog_core::optics_table::OpticsTable;
use fog_denoise::Denoiser;
use fog_optics::advection::AdvectionModel;
use fog_plan::{DropletsSpec, FogModel, FogSpec, FrameSpec, MeanCosine, Phase, Sampling, SceneSpec};
use fog_scene::LoadedScene;
use std::path::PathBuf;
use std::sync::Arc;

/// Fog models, tables and scenes by name. Fill it with [`Resources::prepare`] before frames are made from it.
#[derive(Debug)]
pub struct Resources {
    /// Colour matching and upsampling.
    pub observer: Observer,
    sources: Sources,
    surroundings: Surroundings,
    tables: Tables,
    scenes: Scenes,
    denoiser_path: Option<PathBuf>,
    denoiser: Option<Result<Denoiser, String>>,
}

impl Resources {
    /// Nothing loaded yet; tables will come from `cache`.
    #[must_use]
    pub fn new(cache: TableCache) -> Self {
        Self {
            observer: Observer::new(),
            sources: Sources::default(),
            surroundings: Surroundings::default(),
            tables: Tables::new(cache),
            scenes: Scenes::default(),
            denoiser_path: None,
            denoiser: None,
        }
    }

    /// Says where the library of Open Image Denoise is, its file or folder, for frames with the output `denoised`; else it
    /// is looked for where the system has its libraries.
    #[must_use]
    pub fn with_denoiser(mut self, path: Option<PathBuf>) -> Self {
        self.denoiser_path = path;
        self
    }

    /// Reads, loads or builds what a frame needs and is not there yet. What cannot be had is remembered with its reason and
    /// fails the frames that need it ([`crate::scene`]), so that others can go on.
    pub fn prepare(&mut self, spec: &FrameSpec, progress: &dyn Progress) {
        self.prepare_fog(&spec.fog, progress);
        if denoise::is_wanted(spec) && self.denoiser.is_none() {
            let denoiser = denoise::load(self.denoiser_path.as_deref());
            if let Ok(denoiser) = &denoiser {
                progress.event(Event::Denoiser { path: denoiser.file(), version: &denoiser.version() });
            }
            self.denoiser = Some(denoiser);
        }
        if let Some(file) = spec.sensor.model.as_ref().and_then(|model| model.response_file()) {
            self.sources.read_file(file);
        }
        self.surroundings.prepare(&spec.lighting, &self.observer);
        if let Some(scene) = &spec.scene {
            self.scenes.prepare(scene, progress);
        }
    }

    /// The part of [`Resources::prepare`] that a fog needs.
    pub(crate) fn prepare_fog(&mut self, fog: &FogSpec, progress: &dyn Progress) {
        self.sources.prepare(fog);
        // Why droplets could not be had is for the frame to say; some fogs need none.
        let Ok(droplets) = self.sources.droplets(fog) else { return };
        if needs_mixture(fog) {
            self.tables.prepare_mixture(droplets, progress);
        }
        if fog.phase == Phase::MieMeanDiameter {
            self.tables.prepare_mean_droplet(droplets);
        }
        if fog.phase == Phase::Mie && fog.sampling == Sampling::Diameter {
            self.tables.prepare_single(droplets, progress);
        }
    }

    /// A scene, or empty space.
    ///
    /// # Errors
    /// Why it could not be had.
    pub fn scene(&self, spec: Option<&SceneSpec>) -> Result<Arc<LoadedScene>, Error> {
        self.scenes.get(spec)
    }

    /// BLAKE3 of a scene by formula, in hexadecimal.
    pub(crate) fn scene_hash(&self, spec: &SceneSpec) -> Option<&str> {
        self.scenes.hash(spec)
    }

    /// The denoiser, if the frame asks for it.
    ///
    /// # Errors
    /// Why it could not be had.
    pub(crate) fn denoiser(&self, spec: &FrameSpec) -> Result<Option<&Denoiser>, Error> {
        match &self.denoiser {
            _ if !denoise::is_wanted(spec) => Ok(None),
            Some(Ok(denoiser)) => Ok(Some(denoiser)),
            Some(Err(reason)) => Err(Error::Denoise(reason.clone())),
            None => Err(Error::Denoise("the denoiser was not prepared".to_owned())),
        }
    }

    /// The advection model of a fog that takes something from it.
    ///
    /// # Errors
    /// Why it could not be had.
    pub fn model(&self, fog: &FogSpec) -> Result<&AdvectionModel, Error> {
        self.sources.model(fog)
    }

    /// Images and skies around scenes.
    pub(crate) fn surroundings(&self) -> &Surroundings {
        &self.surroundings
    }

    /// Text files that fogs and sensors are read from.
    pub(crate) fn files(&self) -> &TextFiles {
        self.sources.files()
    }

    pub(crate) fn spectrum(&self, droplets: &DropletsSpec) -> Result<&Spectrum, Error> {
        self.sources.spectrum(droplets)
    }

    /// The droplets of a fog: its own, or those of its advection model.
    pub(crate) fn droplets(&self, fog: &FogSpec) -> Result<&DropletSource, Error> {
        self.sources.droplets(fog)
    }

    /// The table of a fog's droplets all together.
    pub(crate) fn mixture(&self, fog: &FogSpec) -> Result<&OpticsTable, Error> {
        self.tables.mixture(self.droplets(fog)?)
    }

    /// The table of a droplet with the mean diameter of a fog's.
    pub(crate) fn mean_droplet(&self, fog: &FogSpec) -> Result<&OpticsTable, Error> {
        self.tables.mean_droplet(self.droplets(fog)?)
    }

    /// A fog's droplets one by one, and their odds.
    pub(crate) fn single(&self, fog: &FogSpec) -> Result<&(DropletTable, DiameterChoice), Error> {
        self.tables.single(self.droplets(fog)?)
    }
}

/// True if a fog's extinction or phase function comes from the table of all droplets together.
fn needs_mixture(fog: &FogSpec) -> bool {
    match &fog.model {
        FogModel::None => false,
        FogModel::Advection { .. } | FogModel::Droplets { .. } => true,
        model => {
            model.advection_height_m().is_some()
                || matches!(fog.phase, Phase::Mie | Phase::Hg(MeanCosine::Layer))
        }
    }
}
