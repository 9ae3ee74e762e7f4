//! Lights of nodes: `KHR_lights_punctual` (Khronos, ratified 2018), with measured distributions and a visible size in `extras`.

use super::Warnings;
use super::distributions::Distributions;
use crate::error::{Failure, SceneErrorKind};
use crate::lamp::{Beam, Cone, Lamp, LightNames, Pattern, PunctualLights};
use fog_core::colour::luminance;
use fog_core::{Vec3A, math};
use glam::{DMat4, DVec3};
use gltf::Node;
use gltf::khr_lights_punctual::{Kind, Light};

/// Largest radius of a lamp's visible disc in metres.
const MAX_RADIUS_M: f64 = 100.0;

/// Adds the light of a node of this name; `world` is the node's matrix. Its scale turns nothing but the axes, and dims
/// nothing.
pub(super) fn place(
    (light, of_node): (&Light<'_>, &Node<'_>),
    (node, world): (&str, &DMat4),
    distributions: &mut Distributions,
    (out, names): (&mut PunctualLights, &mut LightNames),
    warnings: &mut Warnings,
) -> Result<(), Failure> {
    let name = light.name().map_or_else(|| light.index().to_string(), str::to_owned);
    let fail = |text: String| SceneErrorKind::Light(text).at(|| format!("light `{name}`"));
    let intensity = light.intensity();
    if !(intensity >= 0.0 && intensity.is_finite()) {
        return Err(fail(format!("intensity is {intensity}; valid: 0 or more, finite")));
    }
    if let Some(wrong) = light.color().into_iter().find(|c| !(0.0..=1.0).contains(c)) {
        return Err(fail(format!("color has the component {wrong}; valid: 0 to 1, linear")));
    }
    if light.range().is_some() {
        warnings.add(format!(
            "light `{name}`: its range, a hint for real-time programs, was ignored: light falls with the squared distance alone"
        ));
    }
    let rgb = light.color().map(|c| c * intensity);
    // −Z of the node, whatever its scale.
    let axis = || {
        let axis = world.transform_vector3(DVec3::NEG_Z).try_normalize();
        let axis = axis.ok_or_else(|| fail("its node has a scale of 0 along the light's axis".into()))?;
        Ok::<_, Failure>(Vec3A::from(axis.as_vec3()))
    };
    let at = world.transform_point3(DVec3::ZERO);
    let position = Vec3A::from(at.as_vec3());
    if !at.to_array().iter().all(|c| c.abs() <= super::nodes::FARTHEST) {
        return Err(fail(format!("it is at {at} m: not finite, or farther than 1e9 m from the origin")));
    }
    let measured = distributions.of(light, of_node, world).map_err(|e| e.at(|| format!("light `{name}`")))?;
    let radius_m = match super::nodes::extra(light.extras(), "radius_m") {
        None => 0.0,
        Some(radius) => radius
            .as_f64()
            .filter(|r| (0.0..=MAX_RADIUS_M).contains(r))
            .ok_or_else(|| fail(format!("extras.radius_m is {radius}; valid: 0 to {MAX_RADIUS_M}")))?,
    };
    let radius_m = radius_m as f32;
    match light.kind() {
        Kind::Directional if measured.is_some() => {
            return Err(fail("it is directional: a measured distribution belongs to a point or spot".into()));
        }
        Kind::Directional => out.beams.push(Beam { direction: -axis()?, illuminance: rgb }),
        _ if measured.is_some() => {
            let (measured, factor) = measured.expect("asked before");
            // The colour gives the hue alone.
            let candela = measured.photometry.greatest_candela() * factor as f32;
            let hue = luminance(light.color().map(f64::from)) as f32;
            let intensity = light.color().map(|c| if hue > 0.0 { candela * c / hue } else { 0.0 });
            out.lamps.push(Lamp { position, intensity, pattern: Pattern::Measured(measured), radius_m });
        }
        Kind::Point => out.lamps.push(Lamp { radius_m, ..Lamp::even(position, rgb) }),
        Kind::Spot { inner_cone_angle: inner, outer_cone_angle: outer } => {
            if !(inner >= 0.0 && inner < outer && outer <= math::PI_F32 / 2.0 + 1e-6) {
                let text = format!(
                    "innerConeAngle is {inner} and outerConeAngle {outer} rad; valid: 0 <= inner < outer <= pi/2"
                );
                return Err(fail(text));
            }
            let cos = |angle: f32| math::f64::cos(f64::from(angle)).max(0.0) as f32;
            let cone = Cone { axis: axis()?, cos_inner: cos(inner), cos_outer: cos(outer) };
            out.lamps.push(Lamp { radius_m, ..Lamp::spot(position, rgb, cone) });
        }
    }
    names.lamps.resize(out.lamps.len(), node.to_owned());
    names.beams.resize(out.beams.len(), node.to_owned());
    Ok(())
}
