//! Classes and instances of a frame's surfaces, and the classes of a data set.

use crate::error::Error;
use crate::frame::{next_camera, next_scene_time_s};
use crate::resources::Resources;
use fog_film::SurfaceTruth;
use fog_plan::{ClassPatternSpec, FrameSpec, LabelsSpec, Output, SceneSpec};
use fog_scene::LoadedScene;
use fog_scene::camera::Camera;
use fog_scene::labels::{ClassPattern, ClassRule, ClassTable, Labels};
use fog_scene::scene::Scene;
use fog_tracer::flow::{NextView, add_flow};
use fog_tracer::surface_truth::{SurfaceLayers, surface_truth};
use serde_json::{Value, json};
use std::sync::Arc;

/// Outputs that need classes and instances.
const LABELLED: [Output; 3] = [Output::Semantic, Output::Instance, Output::Objects];

/// Whether a frame's outputs ask for classes or instances.
pub(crate) fn are_wanted(spec: &FrameSpec) -> bool {
    spec.outputs.iter().any(|output| LABELLED.contains(output))
}

fn rules(spec: &LabelsSpec) -> Vec<ClassRule> {
    let pattern = |pattern: &ClassPatternSpec| match pattern {
        ClassPatternSpec::Node(name) => ClassPattern::Node(name.clone()),
        ClassPatternSpec::Material(name) => ClassPattern::Material(name.clone()),
    };
    let rule = |class: &fog_plan::ClassSpec| ClassRule {
        class: class.class.clone(),
        patterns: class.patterns.iter().map(pattern).collect(),
    };
    spec.classes.iter().map(rule).collect()
}

/// Labels of a frame's scene, if its outputs ask for them.
///
/// # Errors
/// If the scene has more instances than a 16-bit picture can hold.
pub(crate) fn labels(spec: &FrameSpec, scene: &Scene) -> Result<Option<Labels>, Error> {
    if !are_wanted(spec) {
        return Ok(None);
    }
    let labels = Labels::new(scene.loaded(), &rules(&spec.labels));
    labels.map(Some).map_err(|e| {
        let file = spec.scene.as_ref().map(|s| format!("{}: ", s.source)).unwrap_or_default();
        Error::Scene(format!("{file}{e}"))
    })
}

/// The scene as it is at the next pose of the frame's path.
fn next_scene(spec: &FrameSpec, resources: &Resources) -> Result<Option<Arc<LoadedScene>>, Error> {
    let (Some(scene), Some(time_s)) = (&spec.scene, next_scene_time_s(spec)) else { return Ok(None) };
    resources.scene(Some(&SceneSpec { time_s, ..scene.clone() })).map(Some)
}

/// What the first surfaces of a frame's pixels are, as far as its outputs ask for it.
///
/// # Errors
/// If the scene of the path's next pose cannot be had.
pub(crate) fn surfaces(
    spec: &FrameSpec,
    scene: &Scene,
    camera: &Camera,
    labels: Option<&Labels>,
    resources: &Resources,
) -> Result<SurfaceTruth, Error> {
    let wants = |output| spec.outputs.contains(&output);
    let mut surfaces = SurfaceTruth::default();
    let layers = SurfaceLayers {
        normals: wants(Output::Normals),
        position: wants(Output::Position),
        albedo: wants(Output::Albedo),
    };
    if layers != SurfaceLayers::default() || labels.is_some() {
        surfaces = surface_truth(scene, camera, layers, labels);
    }
    if wants(Output::Flow) {
        let then = next_scene(spec, resources)?;
        let next = next_camera(spec);
        let geometry = then.as_ref().map_or(&scene.loaded().geometry, |then| &then.geometry);
        add_flow(&mut surfaces, scene, camera, next.as_ref().map(|camera| NextView { camera, geometry }));
    }
    Ok(surfaces)
}

/// Content of `classes.json`, if any frame has classes. All frames of a plan have the same.
pub(crate) fn classes_json(frames: &[FrameSpec]) -> Option<Value> {
    let spec = frames.iter().find(|frame| are_wanted(frame))?;
    let table = ClassTable::new(spec.labels.classes.iter().map(|class| class.class.as_str()));
    let class = |class: &fog_scene::labels::Class| json!({ "id": class.id, "name": class.name, "train_id": class.train_id, "colour": class.colour });
    Some(json!({
        "classes": table.classes().iter().map(class).collect::<Vec<_>>(),
        "source": "0 to 33: Cityscapes (Cordts et al., CVPR 2016; cityscapesScripts, helpers/labels.py), where license plates \
                   are -1; beyond: Fogbank's, then the configuration's",
        "train_id": "Cityscapes' suggestion; 255: ignored",
        "colour": "8-bit sRGB",
    }))
}

/// Sentences about classes of a frame's scene that nobody knows, and about names that nothing has.
pub(crate) fn complaints(spec: &FrameSpec, resources: &Resources) -> Vec<String> {
    let Some(scene) = spec.scene.as_ref().filter(|_| are_wanted(spec)) else { return Vec::new() };
    let Ok(loaded) = resources.scene(Some(scene)) else { return Vec::new() };
    let rules = rules(&spec.labels);
    let idle = Labels::idle_rules(&loaded, &rules).into_iter().map(|(class, pattern)| {
        let name = match pattern {
            ClassPattern::Node(name) => format!("node or mesh `{name}`"),
            ClassPattern::Material(name) => format!("material `{name}`"),
        };
        format!("classes: {} has no {name} for class `{class}`", scene.source)
    });
    let mut said: Vec<String> = idle.collect();
    if let Ok(labels) = Labels::new(&loaded, &rules) {
        said.extend(labels.unknown_classes().iter().map(|class| {
            format!(
                "{}: class `{class}` is unknown, so what has it is unlabeled; to make it a class, give it a name in `classes`",
                scene.source
            )
        }));
    }
    said
}
