//! Scenes of frames: read from files, or made by formula.

use crate::error::Error;
use crate::progress::{Event, Progress};
use fog_plan::{ApproachSystem, SceneLimits, SceneSource, SceneSpec, SignStyle, WorldSpec};
use fog_scene::{Limits, LoadedScene, SceneError, SceneErrorKind, SceneFile};
use fog_worlds::{ApproachLights, Highway, Runway, Style, Targets, Urban, World};
use serde_json::json;
use std::collections::HashMap;
use std::path::Path;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Instant;

/// Scenes by what they are made from, each made once. Why one cannot be had is remembered and fails the frames that need it.
#[derive(Debug, Default)]
pub(crate) struct Scenes {
    known: HashMap<(String, SceneLimits), Result<Known, String>>,
    empty: Arc<LoadedScene>,
}

#[derive(Debug)]
struct Known {
    /// As it is at the time that it was first asked for.
    scene: Arc<LoadedScene>,
    /// Where it comes from, if something in it moves.
    moving: Option<Moving>,
    /// BLAKE3 of the bytes of a scene by formula, in hexadecimal.
    blake3: Option<String>,
}

/// A scene that is another at each time.
#[derive(Debug)]
struct Moving {
    file: SceneFile,
    /// The last one made: frames of one time follow each other.
    last: Mutex<Arc<LoadedScene>>,
}

impl Known {
    fn new(file: SceneFile, time_s: f64, blake3: Option<String>) -> Result<Self, SceneError> {
        let scene = Arc::new(file.at(time_s)?);
        let moving = file.moves().then(|| Moving { file, last: Mutex::new(scene.clone()) });
        Ok(Self { scene, moving, blake3 })
    }

    fn at(&self, time_s: f64) -> Result<Arc<LoadedScene>, SceneError> {
        let Some(moving) = &self.moving else { return Ok(self.scene.clone()) };
        if self.scene.time_s == time_s {
            return Ok(self.scene.clone());
        }
        let mut last = moving.last.lock().unwrap_or_else(PoisonError::into_inner);
        if last.time_s != time_s {
            *last = Arc::new(moving.file.at(time_s)?);
        }
        Ok(last.clone())
    }
}

impl Scenes {
    /// Makes or loads the scene, if it is not there yet.
    pub(crate) fn prepare(&mut self, spec: &SceneSpec, progress: &dyn Progress) {
        if self.known.contains_key(&key(spec)) {
            return;
        }
        let started = Instant::now();
        let known = load(spec);
        if let Ok(Known { scene, .. }) = &known {
            progress.event(Event::Scene {
                name: &spec.source.to_string(),
                triangles: scene.geometry.triangles().len(),
                warnings: &scene.warnings,
                seconds: started.elapsed().as_secs_f64(),
            });
        }
        self.known.insert(key(spec), known);
    }

    /// The scene at its time, or empty space.
    ///
    /// # Errors
    /// Why it could not be had.
    pub(crate) fn get(&self, spec: Option<&SceneSpec>) -> Result<Arc<LoadedScene>, Error> {
        let Some(spec) = spec else { return Ok(self.empty.clone()) };
        match self.known.get(&key(spec)) {
            Some(Ok(known)) => known.at(spec.time_s).map_err(|e| Error::Scene(message(&e))),
            Some(Err(reason)) => Err(Error::Scene(reason.clone())),
            None => Err(Error::Scene(format!("{} was not prepared", spec.source))),
        }
    }

    /// BLAKE3 of a scene by formula, in hexadecimal.
    pub(crate) fn hash(&self, spec: &SceneSpec) -> Option<&str> {
        self.known.get(&key(spec))?.as_ref().ok()?.blake3.as_deref()
    }
}

/// All that a scene depends on but its time.
fn key(spec: &SceneSpec) -> (String, SceneLimits) {
    (json!(spec.source).to_string(), spec.limits)
}

fn load(spec: &SceneSpec) -> Result<Known, String> {
    let limits = limits(&spec.limits);
    match &spec.source {
        SceneSource::File { file } => {
            let scene = SceneFile::open(file, &limits).map_err(|e| message(&e))?;
            Known::new(scene, spec.time_s, None).map_err(|e| message(&e))
        }
        SceneSource::Made(made) => {
            let name = spec.source.to_string();
            let bytes = world(made).glb(made.seed()).map_err(|e| format!("scene: {name}: {e}"))?;
            let blake3 = Some(blake3::hash(&bytes).to_hex().to_string());
            let scene = SceneFile::from_bytes(Path::new(&name), &bytes, &limits).map_err(|e| message(&e))?;
            Known::new(scene, spec.time_s, blake3).map_err(|e| message(&e))
        }
    }
}

/// The limits of a specification; those of the loader where it has none.
fn limits(spec: &SceneLimits) -> Limits {
    let usual = Limits::default();
    let count = |limit: Option<u64>, usual: usize| {
        limit.map_or(usual, |limit| usize::try_from(limit).unwrap_or(usize::MAX))
    };
    Limits {
        max_file_bytes: spec.file_bytes.unwrap_or(usual.max_file_bytes),
        max_triangles: count(spec.triangles, usual.max_triangles),
        max_texture_pixels: spec.texture_px.unwrap_or(usual.max_texture_pixels),
        max_nodes: count(spec.nodes, usual.max_nodes),
    }
}

/// What is wrong with a scene, and for a limit the key that sets it.
fn message(error: &SceneError) -> String {
    let key = match error.kind {
        SceneErrorKind::TooLarge { .. } => "file_bytes",
        SceneErrorKind::TooManyTriangles { .. } => "triangles",
        SceneErrorKind::TooManyPixels { .. } => "texture_px",
        SceneErrorKind::TooManyNodes { .. } => "nodes",
        _ => return error.to_string(),
    };
    format!("{error} (scene.limits.{key})")
}

/// The formula with its options.
fn world(spec: &WorldSpec) -> World {
    let or = |value: Option<f64>, usual: f32| value.map_or(usual, |value| value as f32);
    let signs = |value: Option<SignStyle>, usual: Style| match value {
        None => usual,
        Some(SignStyle::Vienna) => Style::Vienna,
        Some(SignStyle::Mutcd) => Style::Mutcd,
    };
    let list = |value: &Option<Vec<f64>>, usual: Vec<f32>| {
        value.as_ref().map_or(usual, |values| values.iter().map(|&v| v as f32).collect())
    };
    match spec {
        WorldSpec::Street => World::Street,
        WorldSpec::Urban { length_m, style, traffic, people, limit, .. } => {
            let usual = Urban::default();
            let style = signs(*style, usual.style);
            World::Urban(Urban {
                length_m: or(*length_m, usual.length_m),
                style,
                traffic: or(*traffic, usual.traffic),
                people: or(*people, usual.people),
                limit: limit.unwrap_or(style.town_limit()),
            })
        }
        WorldSpec::Highway { length_m, style, traffic, gantries_m, .. } => {
            let usual = Highway::default();
            World::Highway(Highway {
                length_m: or(*length_m, usual.length_m),
                style: signs(*style, usual.style),
                traffic: or(*traffic, usual.traffic),
                gantries_m: or(*gantries_m, usual.gantries_m),
            })
        }
        WorldSpec::Runway {
            length_m,
            width_m,
            designator,
            approach,
            papi_deg,
            lights_percent,
            flashers,
            ..
        } => {
            let usual = Runway::default();
            let approach = approach.map_or(usual.approach, |approach| match approach {
                ApproachSystem::None => ApproachLights::None,
                ApproachSystem::Malsr => ApproachLights::Malsr,
                ApproachSystem::Alsf2 => ApproachLights::Alsf2,
            });
            World::Runway(Runway {
                length_m: or(*length_m, usual.length_m),
                width_m: or(*width_m, usual.width_m),
                designator: designator.clone().unwrap_or(usual.designator),
                approach,
                papi_deg: or(*papi_deg, usual.papi_deg),
                lights_percent: or(*lights_percent, usual.lights_percent),
                flashers: flashers.unwrap_or(usual.flashers),
            })
        }
        WorldSpec::Targets { boards_m, black_m, black_deg, eye_m } => {
            let usual = Targets::default();
            World::Targets(Targets {
                boards_m: list(boards_m, usual.boards_m),
                black_m: list(black_m, usual.black_m),
                black_deg: or(*black_deg, usual.black_deg),
                eye_m: or(*eye_m, usual.eye_m),
            })
        }
    }
}
