//! The plan: frames by index, made when asked for.

use std::sync::Arc;

use crate::{
    axis::Axis,
    diff::flatten,
    error::{PlanError, Problem},
    frame::FrameSpec,
    identity::{Identity, hash},
    layout::{Layout, camera_names, override_sensor, place},
    node::{Node, Value},
    origin::Source,
    path::{CsvFiles, Path},
    presets,
    set::set,
    sweep::Sweep,
    validate,
    words::short_number,
};

/// Values that an axis summary lists at most.
const SUMMARY_VALUES: usize = 16;

/// A checked configuration, multiplied out into frames.
///
/// Frames are computed from their index, so a plan of a million frames is small, and every worker can hold it.
#[derive(Clone, Debug)]
pub struct Plan {
    name: String,
    seed: u64,
    /// The whole configuration with defaults.
    pub(crate) resolved: Node,
    /// The same without `sweep`: what axes override.
    pub(crate) base: Node,
    pub(crate) sweep: Option<Sweep>,
    /// The path, if no axis changes it; it is then left out of `base`.
    pub(crate) path: Option<Arc<Path>>,
    pub(crate) files: CsvFiles,
    pub(crate) layout: Layout,
}

/// Axes' values by dotted path.
type Written = Vec<(String, serde_json::Value)>;

/// An axis, for people.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct AxisSummary {
    /// Dotted path, or several with commas, as written.
    pub path: String,
    /// Number of values; none for an interval that random and sobol draw from.
    pub len: Option<usize>,
    /// The first values (16 at most) in short form, or `2 to 30` for an interval.
    pub values: Vec<String>,
}

impl Plan {
    /// `resolved` must have been filled; `sweep` read from it.
    pub(crate) fn new(name: String, seed: u64, resolved: Node, sweep: Option<Sweep>) -> Self {
        let mut base = resolved.clone();
        crate::set::remove(&mut base, &["sweep".to_owned()]);
        let (files, layout) = (CsvFiles::default(), Layout::Even(1));
        Self { name, seed, resolved, base, sweep, path: None, files, layout }
    }

    /// Name of the configuration: `[A-Za-z0-9._-]+`.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Seed of the configuration.
    #[must_use]
    pub fn seed(&self) -> u64 {
        self.seed
    }

    /// Number of frames, at least 1.
    #[must_use]
    pub fn len(&self) -> usize {
        self.layout.len(self.combinations())
    }

    /// Number of combinations of axis values.
    pub(crate) fn combinations(&self) -> usize {
        self.sweep.as_ref().map_or(1, |sweep| sweep.len)
    }

    /// Whether there are no frames: never, a plan has at least one.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The axes in the order written, then the poses of the path and the cameras of the rig.
    #[must_use]
    pub fn axes(&self) -> Vec<AxisSummary> {
        let summary = |axis: &Axis| AxisSummary {
            path: axis.name.clone(),
            len: axis.values.len(),
            values: axis.values.short(SUMMARY_VALUES),
        };
        let axes = self.sweep.iter().flat_map(|sweep| &sweep.axes).map(summary);
        axes.chain(self.path_summary()).chain(self.rig_summary()).collect()
    }

    fn path_summary(&self) -> Option<AxisSummary> {
        let path = self.path.as_ref()?;
        let first = path.poses.iter().take(SUMMARY_VALUES).enumerate();
        let values = first
            .map(|(i, p)| if path.moves { format!("{} s", short_number(p.time_s)) } else { i.to_string() });
        Some(AxisSummary { path: "path".into(), len: Some(path.poses.len()), values: values.collect() })
    }

    fn rig_summary(&self) -> Option<AxisSummary> {
        let names = camera_names(&self.base);
        let values = names.iter().take(SUMMARY_VALUES).cloned().collect();
        (!names.is_empty()).then(|| AxisSummary { path: "cameras".into(), len: Some(names.len()), values })
    }

    /// How the axes combine: `grid`, `zip`, `random` or `sobol`; none without a sweep.
    #[must_use]
    pub fn mode(&self) -> Option<&'static str> {
        use crate::schema::SweepMode::{Grid, Random, Sobol, Zip};
        self.sweep.as_ref().map(|sweep| match sweep.mode {
            Grid => "grid",
            Zip => "zip",
            Random => "random",
            Sobol => "sobol",
        })
    }

    /// Frame `index`, counted from 0.
    ///
    /// # Errors
    /// The problems of the frame, which `load` has not seen if the plan is too long to check every frame; or an index
    /// that is not below [`Plan::len`].
    pub fn frame(&self, index: usize) -> Result<FrameSpec, PlanError> {
        if index >= self.len() {
            let message = format!("there is no frame {index}; the plan has {}", self.len());
            return Err(PlanError::Invalid(vec![Problem::new(&self.base.origin, "", message)]));
        }
        let (combination, within) = self.layout.locate(index);
        let (mut tree, mut written) =
            self.tree(combination).map_err(|problem| PlanError::Invalid(vec![problem]))?;
        let names = camera_names(&tree);
        let place = place(within, &names, self);
        let mut own = Vec::new();
        if let Some(camera) = place.camera {
            own = override_sensor(&mut tree, camera).map_err(|problem| PlanError::Invalid(vec![problem]))?;
        }
        presets::expand(&mut tree);
        // What is wrong with keys of one camera is told of that camera.
        let of_camera = |mut problem: Problem| {
            let key = problem.path.strip_prefix("sensor.").and_then(|rest| rest.split('.').next());
            if let (Some(key), Some(camera)) = (key, place.camera)
                && own.iter().any(|k| k == key)
            {
                problem.path = format!("cameras.{camera}.{}", problem.path);
            }
            if problem.path == "path" {
                // Frames may not carry it.
                problem.origin = self.resolved.origin_of("path").clone();
            }
            self.name_axis(problem)
        };
        let content = validate::content(&tree, &place)
            .map_err(|problems| PlanError::Invalid(problems.into_iter().map(of_camera).collect()))?;
        let identity = Identity::of(&content);
        let mut words: Vec<String> = self.values(combination).iter().map(Node::short).collect();
        if words.is_empty() {
            words.push(self.name.clone());
        }
        if let Some(path) = &content.path {
            words.push(format!("{:04}", path.index));
            written.push(("path.index".to_owned(), path.index.into()));
        }
        if let Some(camera) = place.camera {
            words.push(camera.to_owned());
            written.push(("rig.camera".to_owned(), camera.into()));
        }
        let validate::Content {
            scene,
            fog,
            camera,
            rig,
            path,
            readout_end,
            sensor,
            lighting,
            render,
            labels,
            outputs,
            runway,
        } = content;
        Ok(FrameSpec {
            id: identity.id(&words),
            index,
            pair_id: identity.pair_id(),
            seed: identity.seed(self.seed),
            digest: identity.digest.to_hex().to_string(),
            axes: written,
            scene,
            fog,
            camera,
            rig,
            path,
            readout_end,
            sensor,
            lighting,
            render,
            labels,
            outputs,
            runway,
        })
    }

    /// Values of the axes in a combination.
    fn values(&self, combination: usize) -> Vec<Node> {
        self.sweep.as_ref().map_or_else(Vec::new, |sweep| sweep.values(combination, self.seed))
    }

    /// The document with the axes' values of a combination in their places, and these values.
    pub(crate) fn tree(&self, combination: usize) -> Result<(Node, Written), Problem> {
        let axes = self.sweep.as_ref().map_or(&[][..], |sweep| &sweep.axes);
        let mut tree = self.base.clone();
        let mut written = Vec::new();
        for (axis, value) in axes.iter().zip(&self.values(combination)) {
            for (path, part) in axis.parts(value) {
                if let Err(message) = set(&mut tree, path, &axis.key_origin, part.clone()) {
                    return Err(self.name_axis(Problem::new(&part.origin, path, message)));
                }
                written.push((path.to_owned(), part.to_json()));
            }
        }
        Ok((tree, written))
    }

    /// All frames in order.
    pub fn frames(&self) -> impl ExactSizeIterator<Item = Result<FrameSpec, PlanError>> + '_ {
        (0..self.len()).map(|index| self.frame(index))
    }

    /// The resolved configuration: every key with its value in use. Values of axes are as written.
    #[must_use]
    pub fn resolved_json(&self) -> serde_json::Value {
        self.resolved.to_json()
    }

    /// The resolved configuration as YAML text, which parses back to the same plan.
    #[must_use]
    pub fn resolved_yaml(&self) -> String {
        // A tree of maps, lists and finite scalars always has a YAML form.
        serde_yaml::to_string(&self.resolved_json()).unwrap_or_default()
    }

    /// Hex of blake3 over the resolved configuration with its sweep. Comments, order of keys (but not of axes) and forms
    /// of numbers do not matter.
    #[must_use]
    pub fn config_digest(&self) -> String {
        let mut json = self.resolved_json();
        // The order of axes is the order of frames, that of classes their numbers: keep them through the sorting of keys.
        for ordered in ["/sweep/axes", "/classes"] {
            let Some(map) = json.pointer_mut(ordered) else { continue };
            let pairs =
                map.as_object().map(|map| map.iter().map(|(k, v)| serde_json::json!([k, v])).collect());
            *map = pairs.unwrap_or_default();
        }
        hash(&json).to_hex().to_string()
    }

    /// What differs between the configuration of an earlier run (its [`Plan::resolved_yaml`]) and this one: entries like
    /// `fog.height_m: was 100, is now 260`. Empty when both mean the same.
    ///
    /// # Errors
    /// `old_yaml` is not a YAML document.
    pub fn differing_keys(&self, old_yaml: &str) -> Result<Vec<String>, PlanError> {
        let old = crate::yaml::parse(old_yaml, &Source::named("config.resolved.yaml"))
            .map_err(|problem| PlanError::Invalid(vec![problem]))?;
        Ok(crate::diff::differing(&flatten(&old), &flatten(&self.resolved)))
    }

    /// Adds to a problem the axis that it comes from, if any.
    fn name_axis(&self, mut problem: Problem) -> Problem {
        let under = |part: &str, whole: &str| {
            part == whole || part.strip_prefix(whole).is_some_and(|r| r.starts_with('.'))
        };
        let axes = self.sweep.iter().flat_map(|sweep| &sweep.axes);
        // The last one wins, as it does in the tree.
        let axis = axes.rev().find(|axis| axis.paths.iter().any(|path| under(&problem.path, path)));
        if let Some(axis) = axis {
            problem.message.push_str(&format!(" (from axis `{}`)", axis.name));
        }
        problem
    }
}

impl Node {
    /// Top-level keys in the order of the schema.
    pub(crate) fn sort_sections(&mut self) {
        const ORDER: [&str; 16] = [
            "version", "name", "seed", "scene", "fog", "camera", "path", "cameras", "sensor", "lighting",
            "render", "classes", "labels", "outputs", "runway", "sweep",
        ];
        if let Value::Map(entries) = &mut self.value {
            entries.sort_by_key(|entry| ORDER.iter().position(|key| *key == entry.key));
        }
    }
}
