//! Lights of a frame from its specification.

use crate::error::Error;
use crate::resources::Resources;
use fog_core::daylight::daylight;
use fog_plan::{EnvironmentSpec, LightingSpec, LightsSpec, SunSpec};
use fog_scene::light::{Environment, Sun};
use fog_scene::light_groups::{LightGroup, LightGroups, LightPattern};
use fog_scene::sky_map::SkyMap;

/// Light from far away in the tracer's units: radiance relative to D65, which a scalar already is.
pub(crate) struct DistantLights {
    pub(crate) environment: Option<Environment>,
    pub(crate) sky: Option<SkyMap>,
    pub(crate) sun: Option<Sun>,
}

/// Environment, sky and sun (or moon) of a frame.
///
/// # Errors
/// If an image or a sky cannot be had.
pub(crate) fn distant_lights(spec: &LightingSpec, resources: &Resources) -> Result<DistantLights, Error> {
    let environment = match spec.environment {
        Some(EnvironmentSpec::Uniform { radiance, .. }) if radiance > 0.0 => {
            Some(Environment { radiance: radiance as f32 })
        }
        _ => None,
    };
    let of_one = spec.luminance_of_one_cd_m2;
    let surroundings = resources.surroundings();
    let sun = spec.sun.as_ref().and_then(|sun| plain_sun(sun, resources));
    Ok(match surroundings.sky(spec)? {
        Some(sky) => DistantLights {
            environment,
            sky: Some(sky.dome.map.scaled(1.0 / of_one)),
            sun: sun.or_else(|| sky.sun(&resources.observer, of_one)),
        },
        None => DistantLights { environment, sky: surroundings.image(spec)?, sun },
    })
}

/// A sun whose irradiance is given.
fn plain_sun(spec: &SunSpec, resources: &Resources) -> Option<Sun> {
    let irradiance = spec.irradiance.filter(|&irradiance| irradiance > 0.0)?;
    let sun = Sun::new(spec.elevation_deg, spec.azimuth_deg, irradiance, spec.angular_diameter_deg);
    Some(match spec.color_temperature_k {
        Some(k) => sun.with_colour(daylight(&resources.observer, k)),
        None => sun,
    })
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
