//! Lights without extent, as glTF's `KHR_lights_punctual` has them: no ray meets them by chance.

use crate::light_tree::{Bound, Light, LightTree, Reach};
use crate::photometry::Photometry;
use fog_core::colour::Rgb;
use fog_core::{Vec3A, math};
use glam::Mat3A;
use std::sync::Arc;

/// The lamps of a scene, ready to be chosen from.
pub type LampTree = LightTree<Lamp>;

/// A light at a point.
#[derive(Clone, Debug, PartialEq)]
pub struct Lamp {
    /// Where it is, in the world.
    pub position: Vec3A,
    /// Greatest luminous intensity of any direction in cd for each of red, green and blue (linear sRGB; equal values are the
    /// white of D65). In a [`crate::scene::Scene`]: relative radiance × m².
    pub intensity: Rgb,
    /// Where it shines.
    pub pattern: Pattern,
    /// Radius in metres of the disc that a camera sees in its place, 0 or more; what it lights is lit from a point.
    pub radius_m: f32,
}

/// How a lamp's intensity depends on the direction.
#[derive(Clone, Debug, PartialEq)]
pub enum Pattern {
    /// Alike all around.
    Even,
    /// In a cone.
    Cone(Cone),
    /// As measured.
    Measured(Measured),
}

/// A measured distribution with its orientation.
#[derive(Clone, Debug, PartialEq)]
pub struct Measured {
    /// The distribution.
    pub photometry: Arc<Photometry>,
    /// Turns directions of the world into those of [`Photometry::candela_along`].
    pub lamp_from_world: Mat3A,
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
    /// A lamp that shines alike all around.
    #[must_use]
    pub fn even(position: Vec3A, intensity: Rgb) -> Self {
        Self { position, intensity, pattern: Pattern::Even, radius_m: 0.0 }
    }

    /// A lamp that shines in a cone.
    #[must_use]
    pub fn spot(position: Vec3A, intensity: Rgb, cone: Cone) -> Self {
        Self { pattern: Pattern::Cone(cone), ..Self::even(position, intensity) }
    }

    /// Share of the greatest intensity in a unit direction away from the lamp, in [0, 1]. Of a cone: the specification's
    /// smooth falloff, the square of a ramp of the cosine between the two half-angles.
    #[inline]
    #[must_use]
    pub fn falloff(&self, away: Vec3A) -> f32 {
        match &self.pattern {
            Pattern::Even => 1.0,
            Pattern::Cone(cone) => {
                let scale = 1.0 / (cone.cos_inner - cone.cos_outer).max(0.001);
                let ramp = ((cone.axis.dot(away) - cone.cos_outer) * scale).clamp(0.0, 1.0);
                ramp * ramp
            }
            Pattern::Measured(measured) => measured.share(away),
        }
    }

    /// Unit vector along the axis of a cone, or towards the middle of a measured distribution; `None` if it shines alike all around.
    #[must_use]
    pub fn axis(&self) -> Option<Vec3A> {
        match &self.pattern {
            Pattern::Even => None,
            Pattern::Cone(cone) => Some(cone.axis),
            Pattern::Measured(measured) => Some(measured.axis()),
        }
    }

    /// Largest component of the intensity in any direction.
    #[inline]
    #[must_use]
    pub fn strength(&self) -> f32 {
        self.intensity.iter().fold(0.0, |a, &b| a.max(b))
    }
}

impl Measured {
    fn axis(&self) -> Vec3A {
        self.lamp_from_world.transpose() * self.photometry.reach().axis
    }

    fn share(&self, away: Vec3A) -> f32 {
        let greatest = self.photometry.greatest_candela();
        if greatest == 0.0 {
            0.0
        } else {
            self.photometry.candela_along(self.lamp_from_world * away) / greatest
        }
    }
}

impl Light for Lamp {
    const COSINE: bool = false;

    fn bound(&self) -> Bound {
        let reach = match &self.pattern {
            Pattern::Even => Reach::ALL,
            Pattern::Cone(cone) => {
                Reach { axis: cone.axis, angle: math::f32::acos(cone.cos_outer.clamp(-1.0, 1.0)) }
            }
            Pattern::Measured(measured) => Reach { axis: measured.axis(), ..measured.photometry.reach() },
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
        let lamp = Lamp::spot(Vec3A::ZERO, [1.0, 2.0, 0.5], cone);
        let at = |cos: f32| lamp.falloff(Vec3A::new((1.0 - cos * cos).sqrt(), 0.0, -cos));
        assert_eq!(lamp.strength(), 2.0);
        for (cos, want) in [(1.0, 1.0), (0.91, 1.0), (0.7, 0.25), (0.8, 0.5625), (0.49, 0.0), (-1.0, 0.0)] {
            assert!((at(cos) - want).abs() < 1e-5, "{cos}: {}", at(cos));
        }
        assert_eq!(Lamp::even(Vec3A::ZERO, [1.0; 3]).falloff(Vec3A::Y), 1.0);
        // A hard edge is as narrow as the specification's 0.001.
        let hard = Lamp::spot(Vec3A::ZERO, [1.0; 3], Cone { cos_inner: 0.5, ..cone });
        assert_eq!(hard.falloff(Vec3A::NEG_Z), 1.0);
        assert_eq!(hard.falloff(Vec3A::X), 0.0);
    }
}
