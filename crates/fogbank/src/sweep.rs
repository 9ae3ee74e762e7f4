//! All frames of a plan, or some of them, into a data set.

use crate::error::Error;
use crate::frame::Rendered;
use crate::lighting::pattern;
use crate::progress::{Event, Progress};
use crate::resources::Resources;
use crate::selection::Selection;
use crate::tracker::Tracker;
use crate::work::{Job, Report};
use crate::workers::{self, Workers};
use crate::{CODE_DIGEST, camera_record, changed_files, clear_air, frame, labels, sensor};
use fog_dataset::{
    Attribute, Counts, DataSet, DataSetInfo, FrameFiles, FrameState, Opening, OutputSet, PlanFrame, Raster,
};
use fog_plan::{FrameSpec, Plan};
use serde_json::json;
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

/// How a sweep goes about its work.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SweepOptions {
    /// Which frames.
    pub selection: Selection,
    /// What becomes of a data set that is there already.
    pub opening: Opening,
    /// Whether frames whose failure is on record are tried again.
    pub retry_failed: bool,
    /// Whether the files of frames that are done are hashed, so that damaged frames are rendered again.
    pub recheck: bool,
    /// Processes to work with; none: the current rayon pool of this one.
    pub workers: Option<Workers>,
}

/// Renders what is missing of the selected frames into the data set in `dir`.
///
/// A frame that fails is recorded with its reason and the others go on: look at the returned counts.
///
/// With [`Workers`] the process is forked, and must have no threads but the caller's.
///
/// # Errors
/// If nothing can be rendered at all (scene, fog, optics table, denoiser), if `dir` cannot be used, holds another data set or frames
/// made from other contents of the fogs' files, or if `progress` asked to stop.
pub fn sweep(
    plan: &Plan,
    options: &SweepOptions,
    dir: &Path,
    resources: &mut Resources,
    progress: &dyn Progress,
) -> Result<Counts, Error> {
    let job = match options.workers {
        None => prepare(plan, options, dir, resources, progress)?,
        // On threads that have ended when the workers are forked.
        Some(_) => rayon::ThreadPoolBuilder::new()
            .build_scoped(rayon::ThreadBuilder::run, |pool| {
                pool.install(|| prepare(plan, options, dir, resources, progress))
            })
            .map_err(|e| Error::Workers(e.to_string()))??,
    };
    let stopped = match run(&job, options.workers, resources, progress) {
        Ok(()) => false,
        Err(Error::Cancelled) => true,
        Err(e) => return Err(e),
    };
    // Of a sweep that was stopped, too, the index says what is done.
    let counts = job.data_set.finish()?;
    if stopped {
        return Err(Error::Cancelled);
    }
    progress.event(Event::Finished { counts });
    Ok(counts)
}

/// Reads and builds what the frames need and opens the data set.
fn prepare(
    plan: &Plan,
    options: &SweepOptions,
    dir: &Path,
    resources: &mut Resources,
    progress: &dyn Progress,
) -> Result<Job, Error> {
    // 1. The frames, and what they need.
    let frames = plan.frames().collect::<Result<Vec<_>, _>>()?;
    let mut wanted = options.selection.of(&frames)?;
    let sets = options.selection.sets(&frames, &wanted);
    let mut in_shard = vec![false; frames.len()];
    sets.iter().flatten().for_each(|&i| in_shard[i] = true);
    wanted.iter_mut().zip(in_shard).for_each(|(w, s)| *w &= s);
    let selected: Vec<usize> = (0..frames.len()).filter(|&i| wanted[i]).collect();
    for &i in sets.iter().flatten() {
        resources.prepare(&frames[i], progress);
    }
    warn_of_extrapolation(selected.iter().map(|&i| &frames[i]), resources, progress);
    warn_of_unknown_lights(selected.iter().map(|&i| &frames[i]), resources, progress);
    warn_of_unknown_classes(selected.iter().map(|&i| &frames[i]), resources, progress);
    warn_of_rolling_shutters(selected.iter().map(|&i| &frames[i]), resources, progress);
    refuse_if_nothing_works(selected.iter().map(|&i| &frames[i]), resources)?;

    // 2. The data set: new, or the same one begun earlier.
    let data_set = open(plan, &frames, dir, options.opening)?;
    changed_files::refuse(&data_set, &frames, resources)?;
    if options.opening == Opening::Overwrite {
        selected.iter().try_for_each(|&i| data_set.forget(&frames[i].id))?;
    }
    let (mut done, mut failed) = (0, 0);
    for &i in &selected {
        let id = &frames[i].id;
        let mut state = data_set.state(id);
        if options.recheck && state == FrameState::Done && !data_set.is_intact(id) {
            progress.event(Event::Warning(format!("frame {id} is damaged and will be rendered again")));
            data_set.forget(id)?;
            state = FrameState::Missing;
        }
        wanted[i] = state == FrameState::Missing || state == FrameState::Failed && options.retry_failed;
        done += usize::from(state == FrameState::Done);
        failed += usize::from(state == FrameState::Failed && !options.retry_failed);
    }
    let todo: Vec<Vec<usize>> = sets.into_iter().filter(|set| set.iter().any(|&i| wanted[i])).collect();
    let paths = todo.iter().flatten().map(|&i| path_count(&frames[i])).sum();
    let count = wanted.iter().filter(|w| **w).count();
    progress.event(Event::Ready { done, failed, paths, todo: count });
    Ok(Job { frames, wanted, todo, data_set, config_digest: plan.config_digest() })
}

/// 3. Each missing frame, with those that share its paths: render, store, or record why not.
fn run(
    job: &Job,
    workers: Option<Workers>,
    resources: &Resources,
    progress: &dyn Progress,
) -> Result<(), Error> {
    let tracker = Tracker::new(job, workers.map_or(1, |w| w.count), progress);
    if let Some(workers) = workers {
        return workers::run(job, resources, workers, &tracker);
    }
    for set in 0..job.todo.len() {
        if !tracker.begin(0, set) {
            return Err(Error::Cancelled);
        }
        job.work(set, resources, &|report| tracker.report(0, report))?;
        tracker.report(0, Report::Through);
    }
    Ok(())
}

/// If not one of the frames can be put together, that is the configuration's fault and not a frame's.
fn refuse_if_nothing_works<'f>(
    frames: impl Iterator<Item = &'f FrameSpec>,
    resources: &Resources,
) -> Result<(), Error> {
    let mut refused = Ok(());
    for frame in frames {
        let scene = frame::scene(frame, resources).and_then(|_| sensor::observer(frame, resources));
        match scene.and_then(|_| resources.denoiser(frame)) {
            Ok(_) => return Ok(()),
            Err(e) => refused = refused.and(Err(e)),
        }
    }
    refused
}

/// Says once for which fog heights a model goes beyond what was measured.
fn warn_of_extrapolation<'f>(
    frames: impl Iterator<Item = &'f FrameSpec>,
    resources: &Resources,
    progress: &dyn Progress,
) {
    let mut by_model: BTreeMap<Option<&Path>, (Vec<f64>, &[f64])> = BTreeMap::new();
    for fog in frames.map(|frame| &frame.fog) {
        if let (Some(height_m), Ok(model)) = (fog.model.advection_height_m(), resources.model(fog))
            && model.extrapolates(height_m)
        {
            let entry = by_model.entry(fog.coefficients.as_deref());
            entry.or_insert((Vec::new(), model.measured_heights_m())).0.push(height_m);
        }
    }
    for (file, (mut heights, measured)) in by_model {
        heights.sort_by(f64::total_cmp);
        heights.dedup();
        let of_file = file.map_or_else(String::new, |file| format!(" of {}", file.display()));
        progress.event(Event::Warning(format!(
            "advection fog of {heights:?} m is an extrapolation: the model{of_file} was fitted to layers of {measured:?} m"
        )));
    }
}

/// Says once for each scene which names of light groups it does not have.
fn warn_of_unknown_lights<'f>(
    frames: impl Iterator<Item = &'f FrameSpec>,
    resources: &Resources,
    progress: &dyn Progress,
) {
    let mut said = BTreeSet::new();
    for frame in frames {
        let Some(scene) = &frame.scene else { continue };
        let Ok(loaded) = resources.scene(Some(scene)) else { continue };
        for group in &frame.lighting.groups {
            for lights in group.lights.iter().filter(|lights| !pattern(lights).is_known(&loaded)) {
                let text = format!(
                    "lighting.groups: {} has nothing like {} of group `{}`",
                    scene.source,
                    json!(lights),
                    group.name
                );
                if said.insert(text.clone()) {
                    progress.event(Event::Warning(text));
                }
            }
        }
    }
}

/// Says once for each scene what is odd about its classes.
fn warn_of_unknown_classes<'f>(
    frames: impl Iterator<Item = &'f FrameSpec>,
    resources: &Resources,
    progress: &dyn Progress,
) {
    let mut seen = BTreeSet::new();
    for frame in frames.filter(|frame| labels::are_wanted(frame)) {
        if seen.insert(frame.scene.as_ref().map(|scene| scene.source.to_string())) {
            for text in labels::complaints(frame, resources) {
                progress.event(Event::Warning(text));
            }
        }
    }
}

/// Says once for each scene that things which move stand still while the rows of an image are read.
fn warn_of_rolling_shutters<'f>(
    frames: impl Iterator<Item = &'f FrameSpec>,
    resources: &Resources,
    progress: &dyn Progress,
) {
    let mut seen = BTreeSet::new();
    for frame in frames.filter(|frame| frame.readout_end.is_some()) {
        let Some(scene) = &frame.scene else { continue };
        let moves = |scene: &_| resources.scene(Some(scene)).is_ok_and(|loaded| loaded.animation.is_some());
        if seen.insert(scene.source.to_string()) && moves(scene) {
            progress.event(Event::Warning(format!(
                "sensor.shutter: the camera moves while the rows are read, but what moves in {} stands still as it is at the first row",
                scene.source
            )));
        }
    }
}

/// Number of paths that a frame takes; the least number where sampling goes by noise.
#[must_use]
pub fn path_count(spec: &FrameSpec) -> u64 {
    let pixels = u64::from(spec.sensor.width_px) * u64::from(spec.sensor.height_px);
    pixels * u64::from(spec.render.samples) * views(spec)
}

/// Number of paths that a frame takes at most: [`path_count`] unless sampling goes by noise.
#[must_use]
pub fn most_paths(spec: &FrameSpec) -> u64 {
    let most = spec.render.stop.map_or(spec.render.samples, |stop| stop.max_samples);
    u64::from(spec.sensor.width_px) * u64::from(spec.sensor.height_px) * u64::from(most) * views(spec)
}

/// Views that are rendered of a frame: its own, and that in clear air.
fn views(spec: &FrameSpec) -> u64 {
    if clear_air::is_rendered(spec) { 2 } else { 1 }
}

/// The outputs of a frame as the data set knows them.
#[must_use]
pub fn output_set(spec: &FrameSpec) -> OutputSet {
    let names: Vec<String> =
        spec.outputs.iter().filter_map(|o| Some(json!(o).as_str()?.to_owned())).collect();
    let set = OutputSet::from_names(names).unwrap_or_default();
    OutputSet { groups: !spec.lighting.groups.is_empty(), ..set }
}

fn open(plan: &Plan, frames: &[FrameSpec], dir: &Path, opening: Opening) -> Result<DataSet, Error> {
    let plan_frames = frames
        .iter()
        .map(|f| PlanFrame {
            id: f.id.clone(),
            pair_id: Some(f.pair_id.clone()),
            axes: f.axes.iter().cloned().collect(),
            outputs: output_set(f),
            spec: json!(f),
        })
        .collect();
    let details = json!({
        "generator": "Fogbank",
        "version": env!("CARGO_PKG_VERSION"),
        "axes": plan.axes().iter().map(|a| a.path.clone()).collect::<Vec<_>>(),
        "mode": plan.mode(),
    });
    let config_yaml = plan.resolved_yaml();
    let classes = labels::classes_json(frames);
    let info = DataSetInfo {
        name: plan.name(),
        config_yaml: &config_yaml,
        config_digest: &plan.config_digest(),
        code_digest: CODE_DIGEST,
        plan: plan_frames,
        classes: classes.as_ref(),
        details: &details,
    };
    let differ = |old: &str| plan.differing_keys(old).unwrap_or_default();
    Ok(DataSet::create_or_open(dir, info, opening, &differ)?)
}

pub(crate) fn store(
    data_set: &DataSet,
    spec: &FrameSpec,
    rendered: &Rendered,
    seconds: f64,
) -> Result<(), Error> {
    let attributes = camera_record::attributes(&rendered.camera);
    let mut attributes: BTreeMap<_, _> =
        attributes.into_iter().map(|(name, value)| (name.to_owned(), value)).collect();
    attributes.insert("pair_id".to_owned(), Attribute::Text(spec.pair_id.clone()));
    data_set.write_frame(&FrameFiles { seconds, ..files(spec, rendered, &attributes) })?;
    Ok(())
}

fn files<'a>(
    spec: &'a FrameSpec,
    rendered: &'a Rendered,
    attributes: &'a BTreeMap<String, Attribute>,
) -> FrameFiles<'a> {
    FrameFiles {
        id: &spec.id,
        frame: &rendered.frame,
        record: &rendered.record,
        denoised: rendered.denoised.as_ref(),
        objects: rendered.objects.as_ref(),
        camera: rendered.camera_picture.as_ref(),
        clear: rendered.clear.as_ref(),
        exposure: rendered.exposure as f32,
        instances: &rendered.instances,
        view: camera_record::view(spec, &rendered.camera),
        seconds: 0.0,
        attributes,
    }
}

impl Rendered {
    /// The pictures that the frame's outputs ask for, as a data set with it would give them back.
    #[must_use]
    pub fn rasters(&self, spec: &FrameSpec) -> BTreeMap<String, Raster> {
        Raster::of_frame(&files(spec, self, &BTreeMap::new()), output_set(spec))
    }
}
