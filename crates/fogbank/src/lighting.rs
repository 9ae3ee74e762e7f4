//! Lights of a frame from its specification.

use fog_plan::{LightingSpec, LightsSpec};
use fog_scene::light::{Environment, Sun};
use fog_scene::light_groups::{LightGroup, LightGroups, LightPattern};

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

/// The groups of lights that are told apart, if any.
pub(crate) fn light_groups(spec: &LightingSpec) -> Option<LightGroups> {
    let group = |group: &fog_plan::LightGroupSpec| LightGroup {
        name: group.name.clone(),
        lights: group.lights.iter().map(pattern).collect(),
        intensity: group.intensity as f32,
    };
    (!spec.groups.is_empty()).then(|| LightGroups::new(spec.groups.iter().map(group).collect()))
}

pub(crate) fn pattern(lights: &LightsSpec) -> LightPattern {
    match lights {
        LightsSpec::Environment => LightPattern::Environment,
        LightsSpec::Sun => LightPattern::Sun,
        LightsSpec::Lamps => LightPattern::Lamps,
        LightsSpec::Directional => LightPattern::Beams,
        LightsSpec::Emitters => LightPattern::Emitters,
        LightsSpec::Node(name) => LightPattern::Node(name.clone()),
        LightsSpec::Material(name) => LightPattern::Material(name.clone()),
    }
}
