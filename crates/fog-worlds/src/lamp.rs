//! Lamps: lights of `KHR_lights_punctual`, and how bright the lens is that a camera sees in their place.

use fog_core::math;
use serde_json::{Value, json};

/// A lamp.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Lamp {
    pub(crate) name: String,
    /// Colour in linear sRGB, its luminance 1 if possible: see [`colour`].
    pub(crate) color: [f32; 3],
    /// Luminous intensity on the axis in cd.
    pub(crate) candela: f32,
    /// Half-angles in degrees inside of which the intensity is whole and outside of which it is 0; `None`: all around.
    pub(crate) cone_deg: Option<[f32; 2]>,
    /// Where its intensity and beam come from.
    pub(crate) source: &'static str,
}

/// Share of a lamp's flux that its visible lens emits, besides the lamp.
const LENS_SHARE: f32 = 0.1;

impl Lamp {
    /// Luminance in cd/m² of a flat lens of this area in m² that emits a tenth of the lamp's flux, alike in all directions
    /// of its front.
    ///
    /// A point light cannot be seen and glTF has no surface that emits into a beam: the lens shows where the lamp is and is
    /// dimmer than the beam by this share, so that it hardly adds to the light in the fog.
    pub(crate) fn lens_luminance(&self, area_m2: f32) -> f32 {
        LENS_SHARE * self.flux_lm() / (core::f32::consts::PI * area_m2)
    }

    /// Luminous flux in lm: the intensity integrated over glTF's falloff, the square of a ramp of the cosine.
    pub(crate) fn flux_lm(&self) -> f32 {
        let tau = core::f32::consts::TAU;
        let Some([inner, outer]) = self.cone_deg else { return 2.0 * tau * self.candela };
        let cos = |deg: f32| math::f32::cos(deg.to_radians());
        let (ci, co) = (cos(inner), cos(outer));
        tau * self.candela * ((1.0 - ci) + (ci - co) / 3.0)
    }

    /// glTF's light.
    pub(crate) fn json(&self) -> Value {
        let strongest = self.color.iter().fold(0.0f32, |a, &b| a.max(b));
        // The colour's components are at most 1, so that the rest goes into the intensity: the luminance stays.
        let color = self.color.map(|c| c / strongest);
        let mut light = json!({
            "name": self.name, "color": color, "intensity": self.candela * strongest,
            "type": if self.cone_deg.is_some() { "spot" } else { "point" },
            "extras": {"candela": self.candela, "source": self.source},
        });
        if let Some([inner, outer]) = self.cone_deg {
            light["spot"] =
                json!({"innerConeAngle": inner.to_radians(), "outerConeAngle": outer.to_radians()});
        }
        light
    }
}

/// Colours of signal lights in linear sRGB with luminance 1 (Rec. 709 weights): approximations inside the gamut of sRGB of
/// the aviation and traffic colours, not their chromaticities.
pub(crate) mod colour {
    /// Variable white of a halogen lamp at 3000 K: chromaticity (0.437, 0.404).
    pub(crate) const HALOGEN: [f32; 3] = scaled([1.0, 0.69, 0.36]);
    /// White of an LED or xenon lamp: D65.
    pub(crate) const WHITE: [f32; 3] = [1.0, 1.0, 1.0];
    /// Signal red.
    pub(crate) const RED: [f32; 3] = scaled([1.0, 0.015, 0.01]);
    /// Signal green.
    pub(crate) const GREEN: [f32; 3] = scaled([0.02, 1.0, 0.35]);
    /// Signal yellow.
    pub(crate) const YELLOW: [f32; 3] = scaled([1.0, 0.48, 0.0]);
    /// Blue of taxiway edges.
    pub(crate) const BLUE: [f32; 3] = scaled([0.02, 0.08, 1.0]);

    const fn scaled([r, g, b]: [f32; 3]) -> [f32; 3] {
        let y = 0.2126 * r + 0.7152 * g + 0.0722 * b;
        [r / y, g / y, b / y]
    }

    /// The colour with its largest component 1, and that component before.
    pub(crate) fn split(color: [f32; 3]) -> ([f32; 3], f32) {
        let strongest = color.iter().fold(0.0f32, |a, &b| a.max(b));
        (color.map(|c| c / strongest), strongest)
    }
}
