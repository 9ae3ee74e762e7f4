//! Lights of a frame from its specification.

use fog_plan::LightingSpec;
use fog_scene::light::{Environment, Sun};

/// Environment and sun in the tracer's units: radiance relative to D65, which a scalar already is.
pub(crate) fn lights(spec: &LightingSpec) -> (Option<Environment>, Option<Sun>) {
    let environment =
        spec.environment.filter(|e| e.radiance > 0.0).map(|e| Environment { radiance: e.radiance as f32 });
    let sun = spec
        .sun
        .filter(|s| s.irradiance > 0.0)
        .map(|s| Sun::new(s.elevation_deg, s.azimuth_deg, s.irradiance, s.angular_diameter_deg));
    (environment, sun)
}
