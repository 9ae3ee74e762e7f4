//! Records of the things in a picture, for `<id>.objects.json`.

use fog_core::{DMat3, DQuat, DVec3, math};
use fog_film::{Channels, Frame};
use fog_plan::FrameSpec;
use fog_scene::camera::Camera;
use fog_scene::labels::Labels;
use fog_scene::scene::Scene;
use fog_tracer::objects::{Contrast, Keypoint, LabelledView, ObjectTruth, objects};
use serde_json::{Value, json};

/// Content of `<id>.objects.json`. `clear` is the same view in clear air, where it is known.
pub(crate) fn objects_json(
    spec: &FrameSpec,
    scene: &Scene,
    camera: &Camera,
    labels: &Labels,
    frame: &Frame,
    clear: Option<&Frame>,
) -> Value {
    let view = LabelledView { scene, camera, labels, frame, clear };
    let all = objects(&view);
    let records: Vec<Value> = all.iter().map(|object| record(spec, &view, object)).collect();
    json!({
        "id": spec.id,
        "contrast_threshold": spec.labels.contrast_threshold,
        "min_pixels": spec.labels.min_pixels,
        "definitions": {
            "box_2d": "left, top, right, bottom in pixels from the image's top left corner, pixel centres at + 0.5; `full` as if \
                       nothing stood in front and the image had no edge, at most one image's size beyond it (`is_cut`)",
            "box_3d": "axes right, up, back of a thing that looks along -Z; camera: OpenCV axes; heading clockwise from -Z",
            "occlusion": "share of the pixels that would show it alone in the image and do not",
            "truncation": "share of its projection outside of the image, within the full box",
            "contrast": "mean luminance of the visible pixels over that of the pixels around them, less 1",
            "unveiled": "the same of direct light over transmittance: without the fog in between, lit as in the fog",
            "certain": "the contrast is more than two standard errors from the threshold",
            "more": "docs/labels.md",
        },
        "objects": records,
    })
}

fn record(spec: &FrameSpec, view: &LabelledView<'_>, object: &ObjectTruth) -> Value {
    let instance = &view.labels.instances()[usize::from(object.instance) - 1];
    let loaded = view.scene.loaded();
    let nodes: Vec<&str> = instance.nodes.iter().map(|&node| loaded.node_name(node)).collect();
    let verdict = object.verdict(spec.labels.contrast_threshold, u64::from(spec.labels.min_pixels));
    let centre = object.oriented_box.centre - view.camera.pose.position.as_dvec3();
    json!({
        "instance": object.instance,
        "name": instance.name,
        "class": view.labels.table().name(instance.class),
        "class_id": instance.class,
        "nodes": nodes,
        "box_2d": {
            "full": object.full_box.sides.map(pixel),
            "is_cut": object.full_box.is_cut,
            "visible": object.visible_box,
        },
        "box_3d": box_json(view.camera, object),
        "visible_pixels": object.visible_pixels,
        "silhouette_pixels": object.silhouette_pixels,
        "occlusion": object.occlusion.map(share),
        "truncation": share(object.truncation),
        "distance_m": { "nearest": metre(object.nearest_m), "centre": metre(centre.length()) },
        "transmittance": transmittance_json(view.frame, object),
        "contrast": contrast_json(object),
        "detectable": verdict.hidden.is_none(),
        "hidden_by": verdict.hidden.map(|hidden| hidden.name()),
        "certain": verdict.is_certain,
        "keypoints": object.keypoints.iter().map(keypoint_json).collect::<Vec<_>>(),
    })
}

fn box_json(camera: &Camera, object: &ObjectTruth) -> Value {
    let b = &object.oriented_box;
    let pose = &camera.pose;
    let world_from_camera =
        DMat3::from_cols(pose.right.as_dvec3(), pose.down.as_dvec3(), pose.forward.as_dvec3());
    let camera_from_world = world_from_camera.transpose();
    let forward = -b.axes.z_axis;
    let place = |centre: DVec3, axes: DMat3| {
        let q = DQuat::from_mat3(&axes);
        let wxyz = [q.w, q.x, q.y, q.z].map(share);
        json!({ "centre_m": centre.to_array().map(metre), "quaternion_wxyz": wxyz })
    };
    let mut world = place(b.centre, b.axes);
    world["heading_deg"] = json!(share(math::f64::atan2(forward.x, -forward.z).to_degrees()));
    json!({
        "size_m": b.size.to_array().map(metre),
        "axes": if b.is_of_node { "node" } else { "minimum_area" },
        "world": world,
        "camera": place(camera_from_world * (b.centre - pose.position.as_dvec3()), camera_from_world * b.axes),
    })
}

/// By the frame's bands, or the one wavelength.
fn transmittance_json(frame: &Frame, object: &ObjectTruth) -> Value {
    match (object.transmittance, frame.channels) {
        (None, _) => Value::Null,
        (Some(t), Channels::Rgb) => json!(t.map(significant)),
        (Some([t, ..]), Channels::Mono { .. }) => json!([significant(t)]),
    }
}

fn contrast_json(object: &ObjectTruth) -> Value {
    // JSON has no infinity: nothing is said of the contrast with black.
    let value = |contrast: Option<Contrast>| contrast.map(|c| significant(c.value)).filter(|c| c.is_finite());
    let error = |contrast: Option<Contrast>| contrast.map(|c| significant(c.standard_error));
    let mut out = json!({
        "apparent": value(object.contrast),
        "standard_error": error(object.contrast),
        "unveiled": object.unveiled_contrast.map(significant),
    });
    if object.clear_contrast.is_some() {
        out["clear"] = json!(value(object.clear_contrast));
        out["clear_standard_error"] = json!(error(object.clear_contrast));
    }
    out
}

fn keypoint_json(point: &Keypoint) -> Value {
    json!({
        "name": point.name,
        "world_m": point.world.to_array().map(metre),
        "image_px": point.image.map(|image| image.map(pixel)),
        "visible": point.is_visible,
        "distance_m": metre(point.distance_m),
        "transmittance": significant(point.transmittance),
    })
}

/// Rounded to a decimal place.
fn rounded(value: f64, places: i32) -> f64 {
    let unit = 10f64.powi(places);
    // Adding zero turns −0 into 0.
    (value * unit).round() / unit + 0.0
}

fn pixel(value: f64) -> f64 {
    rounded(value, 3)
}

fn metre(value: f64) -> f64 {
    rounded(value, 4)
}

fn share(value: f64) -> f64 {
    rounded(value, 6)
}

/// Six significant digits.
fn significant(value: f64) -> f64 {
    format!("{value:.5e}").parse().unwrap_or(value)
}
