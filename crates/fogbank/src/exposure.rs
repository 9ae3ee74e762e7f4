//! Exposure of a frame: the factor that is used, from what its specification asks for.

use fog_film::Frame;
use fog_plan::{ExposureSpec, FrameSpec};
use fog_sensor::exposure::{Photographic, automatic};
use serde_json::{Value, json};

/// Factors that are used at least and at most.
const LIMITS: [f64; 2] = [1e-9, 1e9];

/// The factor on a frame's radiance whose product is 1 at white. A frame that is dark at the percentile of automatic exposure
/// gets 1.
pub(crate) fn factor(spec: &FrameSpec, frame: &Frame) -> f64 {
    match spec.sensor.exposure {
        ExposureSpec::Factor(factor) => factor,
        ExposureSpec::Automatic { percentile, target } => {
            let luminances = (0..frame.pixel_count()).map(|i| frame.luminance(i));
            automatic(luminances, percentile, target).map_or(1.0, |factor| factor.clamp(LIMITS[0], LIMITS[1]))
        }
        ExposureSpec::Photographic { .. } => photographic(spec)
            .map_or(1.0, |p| p.factor(spec.lighting.luminance_of_one_cd_m2).clamp(LIMITS[0], LIMITS[1])),
    }
}

/// The photographer's exposure of a frame that has one.
pub(crate) fn photographic(spec: &FrameSpec) -> Option<Photographic> {
    match spec.sensor.exposure {
        ExposureSpec::Photographic { iso, shutter_s, f_number, lens_transmission } => {
            Some(Photographic { iso, shutter_s, f_number, lens_transmission })
        }
        _ => None,
    }
}

/// Writes the factor that is used into the frame's record, and beside it what it comes from.
pub(crate) fn write(spec: &FrameSpec, factor: f64, record: &mut Value) {
    let sensor = &mut record["sensor"];
    if !matches!(spec.sensor.exposure, ExposureSpec::Factor(_)) {
        sensor["exposure_from"] = json!(spec.sensor.exposure);
        if let Some(p) = photographic(spec) {
            sensor["exposure_from"]["saturation_luminance_cd_m2"] = json!(p.saturation_cd_m2());
        }
    }
    sensor["exposure"] = json!(factor);
}
