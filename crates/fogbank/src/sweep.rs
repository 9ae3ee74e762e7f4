//! All frames of a plan, or some of them, into a data set.

use crate::error::Error;
use crate::forecast::Forecast;
use crate::frame::{Rendered, render_frame};
use crate::lighting::pattern;
use crate::progress::{Event, Progress};
use crate::resources::Resources;
use crate::shared::{render_set, share_sets};
use crate::{CODE_DIGEST, changed_files, frame, labels};
use fog_dataset::{Attribute, Counts, DataSet, DataSetInfo, FrameFiles, OutputSet, PlanFrame};
use fog_plan::{FrameSpec, Plan};
use fog_tracer::render::Work;
use serde_json::json;
use std::collections::{BTreeMap, BTreeSet};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;
use std::time::Instant;

/// Which of a plan's frames are to be rendered.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum Selection {
    /// All of them.
    #[default]
    All,
    /// The one with this id, index, or unambiguous beginning of an id.
    One(String),
}

impl Selection {
    /// Indices of the selected frames.
    pub(crate) fn indices(&self, frames: &[FrameSpec]) -> Result<Vec<usize>, Error> {
        let Self::One(wanted) = self else { return Ok((0..frames.len()).collect()) };
        let exact = frames.iter().position(|f| f.id == *wanted);
        let by_index = || wanted.parse::<usize>().ok().filter(|&i| i < frames.len());
        // A number is an index and nothing else: a job array that counts too far must not render some frame twice.
        let by_prefix = || {
            if wanted.bytes().all(|b| b.is_ascii_digit()) {
                return None;
            }
            let mut matches = (0..frames.len()).filter(|&i| frames[i].id.starts_with(wanted.as_str()));
            matches.next().filter(|_| matches.next().is_none())
        };
        exact.or_else(by_index).or_else(by_prefix).map(|i| vec![i]).ok_or_else(|| Error::UnknownFrame {
            wanted: wanted.clone(),
            count: frames.len(),
            example: frames[0].id.clone(),
        })
    }
}

/// Renders what is missing of the selected frames into the data set in `dir`, on the current rayon pool.
///
/// A frame that fails is recorded with its reason and the others go on: look at the returned counts.
///
/// # Errors
/// If nothing can be rendered at all (scene, fog, optics table, denoiser), if `dir` cannot be used, holds another data set or frames
/// made from other contents of the fogs' files, or if `progress` asked to stop.
pub fn sweep(
    plan: &Plan,
    selection: &Selection,
    dir: &Path,
    resources: &mut Resources,
    progress: &dyn Progress,
) -> Result<Counts, Error> {
    // 1. The frames, and what they need.
    let frames = plan.frames().collect::<Result<Vec<_>, _>>()?;
    let selected = selection.indices(&frames)?;
    let mut wanted = vec![false; frames.len()];
    selected.iter().for_each(|&i| wanted[i] = true);
    // A frame takes its whole set to be rendered.
    let sets: Vec<Vec<usize>> =
        share_sets(&frames).into_iter().filter(|set| set.iter().any(|&i| wanted[i])).collect();
    for &i in sets.iter().flatten() {
        resources.prepare(&frames[i], progress);
    }
    warn_of_extrapolation(selected.iter().map(|&i| &frames[i]), resources, progress);
    warn_of_unknown_lights(selected.iter().map(|&i| &frames[i]), resources, progress);
    warn_of_unknown_classes(selected.iter().map(|&i| &frames[i]), resources, progress);
    // If not one of them can be put together, that is the configuration's fault and not a frame's.
    let mut refused = None;
    for &i in &selected {
        let scene = frame::scene(&frames[i], resources);
        match scene.and_then(|_| resources.denoiser(&frames[i])) {
            Ok(_) => {
                refused = None;
                break;
            }
            Err(e) => refused = refused.or(Some(e)),
        }
    }
    if let Some(e) = refused {
        return Err(e);
    }

    // 2. The data set: new, or the same one begun earlier.
    let data_set = open(plan, &frames, dir)?;
    changed_files::refuse(&data_set, &frames, resources)?;
    selected.iter().filter(|&&i| data_set.is_done(&frames[i].id)).for_each(|&i| wanted[i] = false);
    let todo: Vec<&Vec<usize>> = sets.iter().filter(|set| set.iter().any(|&i| wanted[i])).collect();
    let traced: Vec<&FrameSpec> = todo.iter().flat_map(|set| set.iter()).map(|&i| &frames[i]).collect();
    let (paths, count) = (traced.iter().map(|f| path_count(f)).sum(), wanted.iter().filter(|w| **w).count());
    progress.event(Event::Ready { done: selected.len() - count, paths, todo: count });

    // 3. Each missing frame, with those that share its paths: render, store, or record why not.
    let config_digest = plan.config_digest();
    let mut forecast = Forecast::new(&traced);
    for set in todo {
        let specs: Vec<&FrameSpec> = set.iter().map(|&i| &frames[i]).collect();
        let first = set.iter().position(|&i| wanted[i]).unwrap_or(0);
        if !progress.event(Event::FrameStarted { id: &specs[first].id }) {
            return Err(Error::Cancelled);
        }
        let started = Instant::now();
        forecast.begin(&specs);
        let on_work = |work: Work| match work {
            Work::Traced(n) => {
                forecast.count(n);
                progress.event(Event::Paths(n))
            }
            Work::Left(n) => progress.event(Event::Expected(forecast.total(n))),
        };
        let rendered = guarded(|| match specs[..] {
            [spec] => render_frame(spec, resources, &config_digest, &on_work).map(|frame| vec![Ok(frame)]),
            _ => render_set(&specs, resources, &config_digest, &on_work),
        });
        forecast.end();
        let mut rendered = match rendered {
            Err(Error::Cancelled) => return Err(Error::Cancelled),
            Ok(frames) => frames.into_iter().map(|frame| frame.map_err(|e| e.to_string())).collect(),
            Err(e) => vec![Err(e.to_string()); specs.len()],
        };
        // What the set took, by frame.
        let seconds = started.elapsed().as_secs_f64() / specs.len() as f64;
        for ((spec, &i), rendered) in specs.iter().zip(set).zip(rendered.drain(..)) {
            if !wanted[i] {
                continue;
            }
            let begun = Instant::now();
            let stored = rendered.and_then(|r| {
                let seconds = seconds + begun.elapsed().as_secs_f64();
                let stored = store(&data_set, spec, &r, seconds).map_err(|e| e.to_string());
                stored.map(|()| r.frame.noise_estimate())
            });
            match stored {
                Ok(noise) => {
                    let seconds = seconds + begun.elapsed().as_secs_f64();
                    progress.event(Event::FrameDone { id: &spec.id, seconds, noise });
                }
                Err(reason) => {
                    let paths = path_count(spec);
                    progress.event(Event::FrameFailed { id: &spec.id, reason: &reason, paths });
                    // If even this cannot be written, the folder is of no use any more.
                    data_set.record_failure(&spec.id, &reason)?;
                }
            }
        }
    }

    // 4. The index, from what is there.
    let counts = data_set.finish()?;
    progress.event(Event::Finished { counts });
    Ok(counts)
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
        let Some(file) = frame.scene.as_ref().map(|s| s.file.as_path()) else { continue };
        let Ok(loaded) = resources.scene(Some(file)) else { continue };
        for group in &frame.lighting.groups {
            for lights in group.lights.iter().filter(|lights| !pattern(lights).is_known(&loaded)) {
                let text = format!(
                    "lighting.groups: {} has nothing like {} of group `{}`",
                    file.display(),
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
        if seen.insert(frame.scene.as_ref().map(|scene| &scene.file)) {
            for text in labels::complaints(frame, resources) {
                progress.event(Event::Warning(text));
            }
        }
    }
}

/// Number of paths that a frame takes; the least number where sampling goes by noise.
#[must_use]
pub fn path_count(spec: &FrameSpec) -> u64 {
    u64::from(spec.sensor.width_px) * u64::from(spec.sensor.height_px) * u64::from(spec.render.samples)
}

/// Number of paths that a frame takes at most: [`path_count`] unless sampling goes by noise.
#[must_use]
pub fn most_paths(spec: &FrameSpec) -> u64 {
    let most = spec.render.stop.map_or(spec.render.samples, |stop| stop.max_samples);
    u64::from(spec.sensor.width_px) * u64::from(spec.sensor.height_px) * u64::from(most)
}

/// The outputs of a frame as the data set knows them.
#[must_use]
pub fn output_set(spec: &FrameSpec) -> OutputSet {
    let names: Vec<String> =
        spec.outputs.iter().filter_map(|o| Some(json!(o).as_str()?.to_owned())).collect();
    let set = OutputSet::from_names(names).unwrap_or_default();
    OutputSet { groups: !spec.lighting.groups.is_empty(), ..set }
}

fn open(plan: &Plan, frames: &[FrameSpec], dir: &Path) -> Result<DataSet, Error> {
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
    Ok(DataSet::create_or_open(dir, info, &differ)?)
}

fn store(data_set: &DataSet, spec: &FrameSpec, rendered: &Rendered, seconds: f64) -> Result<(), Error> {
    let pose = rendered.camera.pose.world_from_camera().transpose().to_cols_array();
    let mut attributes = BTreeMap::from([
        ("world_from_camera".to_owned(), Attribute::Matrix(pose)),
        ("pair_id".to_owned(), Attribute::Text(spec.pair_id.clone())),
    ]);
    if let Some(intrinsics) = rendered.camera.lens.intrinsics() {
        attributes.insert("focal_px".to_owned(), Attribute::Number(intrinsics.fx_px as f32));
    }
    data_set.write_frame(&FrameFiles {
        id: &spec.id,
        frame: &rendered.frame,
        record: &rendered.record,
        denoised: rendered.denoised.as_ref(),
        objects: rendered.objects.as_ref(),
        exposure: rendered.exposure as f32,
        seconds,
        attributes: &attributes,
    })?;
    Ok(())
}

/// Runs the renderer so that a panic in it costs one frame and not the sweep.
fn guarded<T>(f: impl FnOnce() -> Result<T, Error>) -> Result<T, Error> {
    catch_unwind(AssertUnwindSafe(f)).unwrap_or_else(|payload| {
        let text = payload
            .downcast_ref::<String>()
            .cloned()
            .or_else(|| payload.downcast_ref::<&str>().map(|s| (*s).to_owned()));
        Err(Error::Panic(text.unwrap_or_else(|| "unknown panic".to_owned())))
    })
}
