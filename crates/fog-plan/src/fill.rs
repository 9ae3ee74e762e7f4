//! Writes the schema's defaults into the tree, so that axes and `--set` find what they refer to, and so that the
//! resolved configuration shows every value in use.

use serde::Serialize;

use crate::{
    node::{Entry, Node, Value},
    origin::Origin,
    presets::is_over_preset,
    schema::{
        AEROSOL_OPTICAL_DEPTH, CameraFile, DEFAULT_SEED, FogFile, GROUND_ALBEDO, LightingFile, LightingMap,
        NIGHT_LUMINANCE_CD_M2, OZONE_DU, Outputs, PatchinessFile, RenderFile, SensorFile, SunFile, SweepFile,
        VerticalFile,
    },
    set::remove,
    validate::{DEFAULT_ALBEDO, DEFAULT_FOV_DEG, DEFAULT_MAX_SAMPLES, DEFAULT_SCALE},
};

/// Fills in the defaults that do not depend on other keys.
pub(crate) fn fill_sections(root: &mut Node) {
    put(root, "seed", &DEFAULT_SEED);
    if has_path(root) {
        // It says where the camera is. Its defaults may have come before an override made it.
        if root.child("camera").is_some_and(|camera| camera.origin == Origin::Default) {
            remove(root, &["camera".to_owned()]);
        }
    } else {
        put(root, "camera", &CameraFile::default());
    }
    put(root, "sensor", &SensorFile::default());
    put(root, "lighting", &LightingFile::default());
    put(root, "render", &RenderFile::default());
    put(root, "outputs", &Outputs::default());
    for (section, fill) in [
        ("fog", fill_fog as fn(&mut Node)),
        ("lighting", fill_lighting),
        ("render", fill_render),
        ("sweep", fill_sweep),
    ] {
        if let Some(node) = root.child_mut(section) {
            fill(node);
        }
    }
}

/// Whether a path is there, or an axis brings one.
fn has_path(root: &Node) -> bool {
    let of_axes = |axes: &Node| match &axes.value {
        Value::Map(entries) => {
            entries.iter().any(|axis| axis.key.split(',').any(|path| path.trim() == "path"))
        }
        _ => false,
    };
    root.child("path").is_some()
        || root.child("sweep").and_then(|sweep| sweep.child("axes")).is_some_and(of_axes)
}

/// Fills in the fog keys that its model has. Not when an axis changes the model: they may not belong to the next.
pub(crate) fn fill_model(root: &mut Node) {
    let Some(fog) = root.child_mut("fog") else { return };
    let Some(Value::Text(model)) = fog.child("model").map(|node| node.value.clone()) else { return };
    match model.as_str() {
        "advection" => put(fog, "number_density_scale", &DEFAULT_SCALE),
        "droplets" => put(fog, "vertical", &VerticalFile::Uniform),
        "homogeneous" | "linear_gradient" | "layered" => {
            put(fog, "single_scattering_albedo", &DEFAULT_ALBEDO)
        }
        _ => {}
    }
}

/// Fills in the keys of a clear sky. Not when an axis changes the model.
pub(crate) fn fill_sky(root: &mut Node) {
    let Some(lighting) = root.child_mut("lighting").filter(|lighting| !is_over_preset(lighting)) else {
        return;
    };
    let Some(sky) = lighting.child_mut("sky") else { return };
    let Some(Value::Text(model)) = sky.child("model").map(|node| node.value.clone()) else { return };
    if model == "clear" {
        put(sky, "aerosol_optical_depth", &AEROSOL_OPTICAL_DEPTH);
        put(sky, "ozone_du", &OZONE_DU);
        put(sky, "night_luminance_cd_m2", &NIGHT_LUMINANCE_CD_M2);
    }
    put(sky, "ground_albedo", &GROUND_ALBEDO);
}

/// Fills in the field of view of a pinhole camera without intrinsics. Not when an axis changes lens or intrinsics.
pub(crate) fn fill_fov(root: &mut Node) {
    let Some(sensor) = root.child_mut("sensor") else { return };
    let pinhole = sensor.child("lens").is_none_or(|lens| lens.value == Value::Text("pinhole".to_owned()));
    if pinhole && sensor.child("intrinsics").is_none() && sensor.child("horizontal_fov_deg").is_none() {
        add(sensor, "horizontal_fov_deg", &DEFAULT_FOV_DEG.into());
    }
}

fn fill_fog(fog: &mut Node) {
    merge(fog, &FogFile::default());
    if let Some(patchiness) = fog.child_mut("patchiness") {
        merge(patchiness, &PatchinessFile::default());
    }
}

fn fill_lighting(lighting: &mut Node) {
    // Defaults would hide what the preset says.
    if is_over_preset(lighting) {
        return;
    }
    merge(lighting, &LightingMap::default());
    if let Some(sun) = lighting.child_mut("sun") {
        merge(sun, &SunFile::default());
    }
}

/// The limit of samples that goes with a noise target; without one there is none.
fn fill_render(render: &mut Node) {
    if render.child("noise").is_none() || render.child("max_samples").is_some() {
        return;
    }
    // Any other `samples` is a problem that is reported later.
    let samples = match render.child("samples").map(|node| &node.value) {
        Some(Value::Int(samples)) => u32::try_from(*samples).unwrap_or_default(),
        Some(Value::Float(samples)) => *samples as u32,
        _ => 0,
    };
    add(render, "max_samples", &samples.max(DEFAULT_MAX_SAMPLES).into());
}

fn fill_sweep(sweep: &mut Node) {
    merge(sweep, &SweepFile::default());
}

/// Puts a default at `key` of a map: all of it, or what is absent.
fn put(map: &mut Node, key: &str, default: &impl Serialize) {
    match map.child_mut(key) {
        Some(node) => merge(node, default),
        None => add(map, key, &json(default)),
    }
}

/// Adds the keys that a map does not have. Leaves any other kind of node, and keys without default.
fn merge(node: &mut Node, default: &impl Serialize) {
    if let serde_json::Value::Object(defaults) = json(default) {
        for (key, value) in &defaults {
            if node.child(key).is_none() && !value.is_null() {
                add(node, key, value);
            }
        }
    }
}

fn add(map: &mut Node, key: &str, value: &serde_json::Value) {
    if let Value::Map(entries) = &mut map.value {
        let node = Node::from_json(value, &Origin::Default);
        entries.push(Entry { key: key.to_owned(), key_origin: Origin::Default, node });
    }
}

fn json(default: &impl Serialize) -> serde_json::Value {
    serde_json::to_value(default).unwrap_or_default()
}
