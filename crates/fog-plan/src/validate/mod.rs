//! From the schema to a frame's content: ranges, required keys and rules between keys.

mod droplets;
mod exposure;
mod fog;
mod lens;
mod light_groups;
mod lighting;
mod patchiness;
mod runway;
mod scene;
mod sky;
mod view;

use serde::Serialize;

pub(crate) use fog::{DEFAULT_ALBEDO, DEFAULT_SCALE};
pub(crate) use lens::DEFAULT_FOV_DEG;
pub(crate) use view::DEFAULT_MAX_SAMPLES;

use crate::{
    error::{Problem, Problems},
    frame::{CameraSpec, FogSpec, LightingSpec, Output, RenderSpec, SensorSpec},
    node::Node,
    ranges::Range,
    read::read,
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
    pub(crate) sensor: SensorSpec,
    pub(crate) lighting: LightingSpec,
    pub(crate) render: RenderSpec,
    pub(crate) outputs: Vec<Output>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) runway: Option<RunwaySpec>,
}

/// Reads and checks the tree of one frame.
///
/// # Errors
/// Every problem found.
pub(crate) fn content(tree: &Node) -> Result<Content, Vec<Problem>> {
    let reading = read::<ConfigFile>(tree);
    let mut check = Check { tree, dropped: &reading.dropped, problems: Problems::default() };
    check.problems.extend(reading.problems);
    let content = reading.value.and_then(|file| check.config(&file));
    match content {
        Some(content) if check.problems.is_empty() => Ok(content),
        _ => Err(check.problems.into_vec()),
    }
}

/// The tree being checked, for positions, and the problems so far.
struct Check<'t> {
    tree: &'t Node,
    /// Parts that are wrong already: their absence is no further problem.
    dropped: &'t [Vec<String>],
    problems: Problems,
}

impl Check<'_> {
    fn config(&mut self, file: &ConfigFile) -> Option<Content> {
        // No `?` before all sections are checked: every problem is to be found.
        let scene = self.scene(file.scene.as_ref());
        let fog = self.fog(file.fog.as_ref());
        let sensor = self.sensor(&file.sensor);
        let render = self.render(&file.render);
        let lighting = self.lighting(&file.lighting, file.render.wavelength_nm);
        let camera = self.camera(&file.camera, fog.as_ref().map_or(0.0, |fog| fog.datum_m));
        let outputs = self.outputs(&file.outputs);
        let runway = self.runway(file.runway.as_ref());
        Some(Content {
            scene: scene?,
            fog: fog?,
            camera: camera?,
            sensor: sensor?,
            lighting: lighting?,
            render: render?,
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
