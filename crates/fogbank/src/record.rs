//! The metadata of a frame: everything that it depends on, and what its camera and fog were, with units in the keys.

use crate::CODE_DIGEST;
use crate::camera_record::{self, depth_convention};
use crate::denoise;
use crate::fog::Fog;
use fog_film::{Channels, Frame};
use fog_plan::FrameSpec;
use fog_scene::camera::Camera;
use fog_scene::scene::Scene;
use fog_tracer::truth::{TAU_NM, TRANSMITTANCE_NM};
use serde_json::{Value, json};

/// Builds `<id>.json`. It holds no duration and no clock time: the same frame has the same record.
pub(crate) fn record(
    spec: &FrameSpec,
    fog: Option<&Fog>,
    scene: &Scene,
    camera: &Camera,
    frame: &Frame,
    config_digest: &str,
) -> Value {
    let mut value = json!(spec);
    let layer = fog.map(|fog| {
        let [base, top] = fog.extent_m();
        let mut state = json!({
            "wavelength_nm": TAU_NM,
            "droplets": fog.droplets_json(),
            "at_camera": fog.state_json(fog.altitude_m(f64::from(camera.pose.position.y))),
            "at_base": fog.state_json(base),
            "at_top": fog.state_json(top),
        });
        let over = camera.pose.position;
        let patches = fog.patches_json(f64::from(over.x), f64::from(over.z));
        if !patches.is_null() {
            state["patchiness"] = patches;
        }
        for (key, value) in fog.optics_json() {
            state[key] = value;
        }
        state
    });
    value["fog_state"] = layer.unwrap_or(Value::Null);
    camera_record::write(spec, camera, &mut value);
    value["sensor"]["encoding"] = json!("sRGB of exposure × linear radiance, clipped to [0, 1]");
    value["conventions"] = json!({
        "radiance": "relative to D65: a light of scalar radiance x is recorded as R = G = B = x",
        "depth": depth_convention(&camera.lens),
        "distance": "range from the camera, m; +inf for sky",
        "transmittance": "exp(-optical depth) of the pixel-centre ray to the first surface or out of the fog",
        "transmittance_wavelengths_nm": match frame.channels {
            Channels::Rgb => json!(TRANSMITTANCE_NM),
            Channels::Mono { wavelength_nm } => json!([wavelength_nm]),
        },
        "tau_wavelength_nm": TAU_NM,
        "image": "direct + airlight",
    });
    let (lamps, beams) = (scene.lamps().lights().len(), scene.beams().len());
    if lamps + beams > 0 {
        value["lighting"]["scene_lights"] = json!({
            "points_and_spots": lamps,
            "directional": beams,
            "luminance_of_one_cd_m2": spec.lighting.luminance_of_one_cd_m2,
            "units": "cd, lx and cd/m² of the scene file, divided by the luminance that the radiance 1 stands for",
        });
    }
    if let Some(groups) = scene.light_groups() {
        let counts = groups.names().map(str::to_owned).zip(scene.light_counts().into_iter().map(Value::from));
        value["lighting"]["lights_in_group"] = counts.collect::<serde_json::Map<_, _>>().into();
    }
    if denoise::is_wanted(spec) {
        value["denoised"] = denoise::record_json(&spec.id);
    }
    value["noise"] = noise_json(spec, frame);
    value["config_digest"] = json!(config_digest);
    value["code"] = json!({ "version": env!("CARGO_PKG_VERSION"), "digest": CODE_DIGEST });
    value
}

/// How noisy the frame is and what was done about it.
fn noise_json(spec: &FrameSpec, frame: &Frame) -> Value {
    let samples = match spec.render.stop {
        None => json!(spec.render.samples),
        Some(_) => json!(frame.mean_samples()),
    };
    let mut value = json!({
        "samples_per_pixel": samples,
        "relative_standard_error": frame.noise_estimate(),
        "definition": "root mean square standard error of a pixel's luminance over the mean luminance",
    });
    let Some(stop) = spec.render.stop else { return value };
    let count = |f: fn(u64, u64) -> u64| frame.samples.iter().copied().reduce(f);
    let pixels = frame.pixel_noise(stop.noise);
    value["samples_least"] = json!(count(u64::min));
    value["samples_most"] = json!(count(u64::max));
    value["pixels"] = json!({
        "target": stop.noise,
        "share_within_target": pixels.within,
        "root_mean_square": pixels.rms,
        "largest": pixels.largest,
        "floor_luminance": pixels.floor,
        "definition": "standard error of a pixel's luminance over that luminance, or over the floor (1 % of the mean \
                       luminance) where that is more",
    });
    value
}
