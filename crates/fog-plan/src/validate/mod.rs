//! From the schema to a frame's content: ranges, required keys and rules between keys.

mod approach;
mod droplets;
mod exposure;
mod fog;
mod labels;
mod lens;
mod light_groups;
mod lighting;
mod patchiness;
mod path;
mod pose;
mod runway;
mod scene;
mod sensor_model;
mod sky;
mod view;

use std::sync::Arc;

use serde::Serialize;

pub(crate) use fog::{DEFAULT_ALBEDO, DEFAULT_SCALE};
pub(crate) use lens::DEFAULT_FOV_DEG;
pub(crate) use view::DEFAULT_MAX_SAMPLES;

use pose::View;

use crate::{
    error::{Problem, Problems},
    frame::{CameraSpec, FogSpec, LightingSpec, Output, RenderSpec, SensorSpec},
    labels::LabelsSpec,
    node::{Entry, Node, Value},
    path::{CsvFiles, Path, PathSpec},
    ranges::Range,
    read::read,
    rig::RigSpec,
    runway::RunwaySpec,
    scene::SceneSpec,
    schema::ConfigFile,
    words::did_you_mean,
};

/// What a frame shows: all that its digest covers.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct Content {
    pub(crate) scene: Option<SceneSpec>,
    pub(crate) fog: FogSpec,
    pub(crate) camera: CameraSpec,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) rig: Option<RigSpec>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) path: Option<PathSpec>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) readout_end: Option<CameraSpec>,
    pub(crate) sensor: SensorSpec,
    pub(crate) lighting: LightingSpec,
    pub(crate) render: RenderSpec,
    #[serde(skip_serializing_if = "LabelsSpec::is_default")]
    pub(crate) labels: LabelsSpec,
    pub(crate) outputs: Vec<Output>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) runway: Option<RunwaySpec>,
}

/// Which of the frames of a combination of axis values.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Place<'p> {
    /// Name of the rig's camera, if there is a rig.
    pub(crate) camera: Option<&'p str>,
    /// Position among the path's poses.
    pub(crate) pose: usize,
    /// The path where it is not in the tree because all frames have the same.
    pub(crate) path: Option<&'p Arc<Path>>,
    pub(crate) files: &'p CsvFiles,
}

/// Reads and checks the tree of one frame.
///
/// # Errors
/// Every problem found.
pub(crate) fn content(tree: &Node, place: &Place<'_>) -> Result<Content, Vec<Problem>> {
    checked(tree, place.files, |check, file| check.config(file, place))
}

/// Reads and checks the path of a tree that has one.
///
/// # Errors
/// Every problem of the path.
pub(crate) fn path(tree: &Node, files: &CsvFiles) -> Result<Arc<Path>, Vec<Problem>> {
    let path = tree.child("path").cloned();
    // Nothing else of the tree matters here.
    let entries = path.map(|node| Entry { key: "path".to_owned(), key_origin: node.origin.clone(), node });
    let alone = Node::new(Value::Map(entries.into_iter().collect()), &tree.origin);
    checked(&alone, files, |check, file| check.path(file.path.as_ref()?))
}

fn checked<T>(
    tree: &Node,
    files: &CsvFiles,
    check_it: impl Fn(&mut Check<'_>, &ConfigFile) -> Option<T>,
) -> Result<T, Vec<Problem>> {
    let reading = read::<ConfigFile>(tree);
    let mut check = Check { tree, files, dropped: &reading.dropped, problems: Problems::default() };
    check.problems.extend(reading.problems);
    let value = reading.value.and_then(|file| check_it(&mut check, &file));
    match value {
        Some(value) if check.problems.is_empty() => Ok(value),
        _ => Err(check.problems.into_vec()),
    }
}

/// The tree being checked, for positions, and the problems so far.
struct Check<'t> {
    tree: &'t Node,
    files: &'t CsvFiles,
    /// Parts that are wrong already: their absence is no further problem.
    dropped: &'t [Vec<String>],
    problems: Problems,
}

impl Check<'_> {
    fn config(&mut self, file: &ConfigFile, place: &Place<'_>) -> Option<Content> {
        // No `?` before all sections are checked: every problem is to be found.
        let scene = self.scene(file.scene.as_ref());
        let fog = self.fog(file.fog.as_ref());
        let sensor = self.sensor(&file.sensor);
        let render = self.render(&file.render);
        let lighting = self.lighting(&file.lighting, file.render.wavelength_nm);
        let view = self.view(file, place, fog.as_ref().map_or(0.0, |fog| fog.datum_m));
        let labels = self.labels(file.classes.as_ref(), file.labels.as_ref());
        let outputs = self.outputs(&file.outputs, file.path.is_some() || place.path.is_some());
        let runway = self.runway(file.runway.as_ref());
        self.sensor_rules(file, sensor.as_ref());
        let View { camera, rig, path, readout_end } = view?;
        let mut scene = scene?;
        if let (Some(scene), Some(path)) = (&mut scene, &path) {
            scene.time_s += path.time_s;
        }
        Some(Content {
            scene,
            fog: fog?,
            camera,
            rig,
            path,
            readout_end,
            sensor: sensor?,
            lighting: lighting?,
            render: render?,
            labels: labels?,
            outputs: outputs?,
            runway: runway?,
        })
    }

    /// Reports `message` about the key at `path`.
    fn problem(&mut self, path: &str, message: impl Into<String>) {
        self.problems.add(Problem::new(self.tree.origin_of(path), path, message));
    }

    /// Reports a key of `section` that belongs to other values of its key `selector` (with their names) than `found`.
    fn belongs(&mut self, section: &str, key: &str, (selector, owners): (&str, &[&str]), found: &str) {
        let plural = if owners.len() == 1 { "" } else { "s" };
        let message = format!("`{key}` belongs to {selector}{plural} {}, not {found}", owners.join(", "));
        self.problem(&format!("{section}.{key}"), message);
    }

    /// `value`, if the range contains it.
    fn range(&mut self, path: &str, value: f64, range: Range) -> Option<f64> {
        if range.contains(value) {
            return Some(value);
        }
        let key = path.rsplit('.').find(|key| key.parse::<usize>().is_err()).unwrap_or(path);
        self.problem(path, range.message(key, value));
        None
    }

    /// As [`Check::range`] for a whole number.
    fn whole(&mut self, path: &str, value: i64, range: Range) -> Option<u32> {
        self.range(path, value as f64, range)?;
        u32::try_from(value).ok()
    }

    /// A key that may be absent. The outer option is the check's success.
    fn optional(&mut self, path: &str, value: Option<f64>, range: Range) -> Option<Option<f64>> {
        value.map_or(Some(None), |value| self.range(path, value, range).map(Some))
    }

    /// A key that must be there; `why` says what it is for.
    fn required<T>(&mut self, path: &str, value: Option<T>, why: &str) -> Option<T> {
        if value.is_none() && !self.reported(path) {
            self.problem(path, format!("missing; {why}"));
        }
        value
    }

    /// Whether the key at `path` is absent because it, or a misspelling of it, is a problem already.
    fn reported(&self, path: &str) -> bool {
        let keys: Vec<String> = path.split('.').map(str::to_owned).collect();
        let Some((key, parent)) = keys.split_last() else { return false };
        self.dropped.iter().any(|dropped| match dropped.split_last() {
            Some((word, around)) if around == parent => did_you_mean(word, &[key]).is_some(),
            _ => keys.starts_with(dropped),
        })
    }
}
