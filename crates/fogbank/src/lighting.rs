//! Lights of a frame from its specification.

use crate::error::Error;
use crate::resources::Resources;
use fog_plan::{EnvironmentSpec, LightingSpec, LightsSpec};
use fog_scene::light::{Environment, Sun};
use fog_scene::light_groups::{LightGroup, LightGroups, LightPattern};
use fog_scene::sky_map::SkyMap;

/// Light from far away in the tracer's units: radiance relative to D65, which a scalar already is.
pub(crate) struct DistantLights {
    pub(crate) environment: Option<Environment>,
    pub(crate) sky: Option<SkyMap>,
    pub(crate) sun: Option<Sun>,
}

/// Environment, sky and sun of a frame.
///
/// # Errors
/// If an image cannot be had.
pub(crate) fn distant_lights(spec: &LightingSpec, resources: &Resources) -> Result<DistantLights, Error> {
    let environment = match spec.environment {
        Some(EnvironmentSpec::Uniform { radiance, .. }) if radiance > 0.0 => {
            Some(Environment { radiance: radiance as f32 })
        }
        _ => None,
    };
    let sun = spec
        .sun
        .filter(|s| s.irradiance > 0.0)
        .map(|s| Sun::new(s.elevation_deg, s.azimuth_deg, s.irradiance, s.angular_diameter_deg));
    Ok(DistantLights { environment, sky: resources.surroundings().image(spec)?, sun })
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
