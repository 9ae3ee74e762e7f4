//! Lights without extent, as glTF's `KHR_lights_punctual` has them: no ray meets them by chance.

use crate::light_tree::{Bound, Light, LightTree, Reach};
use fog_core::colour::Rgb;
use fog_core::{Vec3A, math};

/// The lamps of a scene, ready to be chosen from.
pub type LampTree = LightTree<Lamp>;

/// A light at a point: all around, or in a cone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lamp {
    /// Where it is, in the world.
    pub position: Vec3A,
    /// Luminous intensity on the axis in cd for each of red, green and blue (linear sRGB; equal values are the white of
    /// D65). In a [`crate::scene::Scene`]: relative radiance × m².
    pub intensity: Rgb,
    /// The cone of a spot light; `None`: the same intensity in every direction.
    pub cone: Option<Cone>,
}

/// The cone of a spot light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cone {
    /// Unit vector along the axis, away from the lamp.
    pub axis: Vec3A,
    /// Cosine of the half-angle inside of which the intensity is whole.
    pub cos_inner: f32,
    /// Cosine of the half-angle outside of which it is 0; 0 or more, and at most `cos_inner`.
    pub cos_outer: f32,
}

/// Parallel light from infinitely far away.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Beam {
    /// Unit vector towards the light.
    pub direction: Vec3A,
    /// Illuminance on a plane normal to the beam in lx for each of red, green and blue. In a [`crate::scene::Scene`]:
    /// relative radiance × sr.
    pub illuminance: Rgb,
}

/// The lights without extent of a scene file.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PunctualLights {
    /// Points and spots.
    pub lamps: Vec<Lamp>,
    /// Directional lights.
    pub beams: Vec<Beam>,
}

/// Names of the nodes of [`PunctualLights`], in the same order.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct LightNames {
    /// Of the lamps.
    pub lamps: Vec<String>,
    /// Of the beams.
    pub beams: Vec<String>,
}

impl PunctualLights {
    /// True if there are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.lamps.is_empty() && self.beams.is_empty()
    }
}

impl Lamp {
    /// Share of the axial intensity in a unit direction away from the lamp, in [0, 1]: the specification's smooth falloff,
    /// the square of a ramp of the cosine between the two half-angles.
    #[inline]
    #[must_use]
    pub fn falloff(&self, away: Vec3A) -> f32 {
        let Some(cone) = self.cone else { return 1.0 };
        let scale = 1.0 / (cone.cos_inner - cone.cos_outer).max(0.001);
        let ramp = ((cone.axis.dot(away) - cone.cos_outer) * scale).clamp(0.0, 1.0);
        ramp * ramp
    }

    /// Largest component of the intensity in any direction.
    #[inline]
    #[must_use]
    pub fn strength(&self) -> f32 {
        self.intensity.iter().fold(0.0, |a, &b| a.max(b))
    }
}

impl Light for Lamp {
    const COSINE: bool = false;

    fn bound(&self) -> Bound {
        let reach = match self.cone {
            Some(cone) => Reach { axis: cone.axis, angle: math::f32::acos(cone.cos_outer.clamp(-1.0, 1.0)) },
            None => Reach::ALL,
        };
        Bound { lower: self.position, upper: self.position, strength: f64::from(self.strength()), reach }
    }

    #[inline]
    fn share(&self, offset: Vec3A, _: f32) -> f32 {
        self.falloff(offset.try_normalize().unwrap_or(Vec3A::Y))
    }
}

impl Beam {
    /// Largest component of the illuminance.
    #[inline]
    #[must_use]
    pub fn strength(&self) -> f32 {
        self.illuminance.iter().fold(0.0, |a, &b| a.max(b))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn falloff_is_that_of_the_specification() {
        let cone = Cone { axis: Vec3A::NEG_Z, cos_inner: 0.9, cos_outer: 0.5 };
        let lamp = Lamp { position: Vec3A::ZERO, intensity: [1.0, 2.0, 0.5], cone: Some(cone) };
        let at = |cos: f32| lamp.falloff(Vec3A::new((1.0 - cos * cos).sqrt(), 0.0, -cos));
        assert_eq!(lamp.strength(), 2.0);
        for (cos, want) in [(1.0, 1.0), (0.91, 1.0), (0.7, 0.25), (0.8, 0.5625), (0.49, 0.0), (-1.0, 0.0)] {
            assert!((at(cos) - want).abs() < 1e-5, "{cos}: {}", at(cos));
        }
        assert_eq!(Lamp { cone: None, ..lamp }.falloff(Vec3A::Y), 1.0);
        // A hard edge is as narrow as the specification's 0.001.
        let hard = Lamp { cone: Some(Cone { cos_inner: 0.5, ..cone }), ..lamp };
        assert_eq!(hard.falloff(Vec3A::NEG_Z), 1.0);
        assert_eq!(hard.falloff(Vec3A::X), 0.0);
    }
}
