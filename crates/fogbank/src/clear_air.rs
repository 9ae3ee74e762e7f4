//! The view of a frame in clear air, for the output `pair`.

use crate::error::Error;
use crate::frame::settings;
use crate::sensor::Chain;
use fog_core::colour::Observer;
use fog_dataset::ClearPicture;
use fog_film::Frame;
use fog_plan::{FogModel, FrameSpec, Output};
use fog_scene::camera::Camera;
use fog_scene::scene::Scene;
use fog_tracer::render::{Work, render};
use serde_json::{Value, json};

/// Whether a frame's outputs ask for it.
pub(crate) fn is_wanted(spec: &FrameSpec) -> bool {
    spec.outputs.contains(&Output::Pair)
}

/// Whether it takes paths of its own: not where the air is clear anyway.
pub(crate) fn is_rendered(spec: &FrameSpec) -> bool {
    is_wanted(spec) && spec.fog.model != FogModel::None
}

/// Renders the view of a frame without its fog, with the same seed and settings; of a frame without fog it is that frame.
///
/// # Errors
/// If a pixel is not finite, or `progress` asked to stop.
pub(crate) fn render_clear(
    spec: &FrameSpec,
    scene: &Scene,
    (camera, observer): (&Camera, &Observer),
    frame: &Frame,
    progress: &(dyn Fn(Work) -> bool + Sync),
) -> Result<Frame, Error> {
    if !is_rendered(spec) {
        return Ok(frame.clone());
    }
    render(&scene.without_fog(), camera, observer, &settings(spec), spec.seed, progress)?
        .ok_or(Error::Cancelled)
}

/// Its files' content, at the exposure of the foggy frame; a sensor has random numbers of its own for it.
pub(crate) fn picture(frame: Frame, chain: Option<&Chain<'_>>, exposure: f64) -> ClearPicture {
    let srgb8 = match chain {
        Some(chain) => chain.pictures(&frame, 1).srgb8,
        None => frame.to_srgb8(exposure as f32),
    };
    ClearPicture { frame, srgb8 }
}

/// What the frame's record says of it.
pub(crate) fn record_json(spec: &FrameSpec, clear: &Frame) -> Value {
    json!({
        "is": "the same view in clear air, rendered with the seed and settings of this frame and shown at its exposure",
        "files": [format!("{}.clear.exr", spec.id), format!("{}.clear.rgb.png", spec.id)],
        "relative_standard_error": clear.noise_estimate(),
    })
}
