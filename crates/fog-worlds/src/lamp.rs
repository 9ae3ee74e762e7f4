//! Lamps: lights of `KHR_lights_punctual`, with the distribution of their intensity and the size of their lens in `extras`.

use serde_json::{Value, json};

/// A lamp.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Lamp {
    pub(crate) name: String,
    /// Colour in linear sRGB, its luminance 1 if possible: see [`colour`].
    pub(crate) color: [f32; 3],
    /// Luminous intensity in cd: of a cone on its axis, of a table as its source states it.
    pub(crate) candela: f32,
    /// Half-angles in degrees inside of which the intensity is whole and outside of which it is 0, for a table what comes near it
    /// for programs that read none; `None`: all around.
    pub(crate) cone_deg: Option<[f32; 2]>,
    pub(crate) table: Option<Table>,
    /// Radius in metres of the disc that its lens is.
    pub(crate) radius_m: f32,
    /// Where its intensity and beam come from.
    pub(crate) source: &'static str,
}

/// Intensities of a beam along −Z of its node in cd, by elevation and azimuth.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Table {
    up_deg: Vec<f32>,
    aside_deg: Vec<f32>,
    /// Elevation by elevation of the first azimuth, then of the next.
    candela: Vec<f32>,
}

impl Table {
    /// `candela(aside, up)` at elevations in degrees and at azimuths from 0 or −180 to 180, to the left positive as seen from
    /// behind the lamp; azimuths from 0 on are alike on both sides.
    pub(crate) fn new(up_deg: Vec<f32>, aside_deg: Vec<f32>, candela: impl Fn(f32, f32) -> f32) -> Self {
        let values = aside_deg.iter().flat_map(|&a| up_deg.iter().map(move |&u| (a, u)));
        // A thousandth of a candela is enough, and short.
        let candela = values.map(|(a, u)| (1e3 * candela(a, u)).round() * 1e-3).collect();
        Self { up_deg, aside_deg, candela }
    }

    /// `extras.photometry` of a light.
    fn json(&self) -> Value {
        let short = |x: f32| (f64::from(x) * 1e4).round() * 1e-4;
        let numbers = |list: &[f32]| list.iter().map(|&x| short(x)).collect::<Vec<f64>>();
        let up: Vec<f32> = self.up_deg.iter().map(|u| 90.0 + u).collect();
        json!({
            "pole": "down", "vertical_deg": numbers(&up), "horizontal_deg": numbers(&self.aside_deg),
            "candela": numbers(&self.candela),
        })
    }
}

impl Lamp {
    /// glTF's light.
    pub(crate) fn json(&self) -> Value {
        let strongest = self.color.iter().fold(0.0f32, |a, &b| a.max(b));
        // The colour's components are at most 1, so that the rest goes into the intensity: the luminance stays.
        let color = self.color.map(|c| c / strongest);
        let mut light = json!({
            "name": self.name, "color": color, "intensity": self.candela * strongest,
            "type": if self.cone_deg.is_some() { "spot" } else { "point" },
            "extras": {"candela": self.candela, "radius_m": self.radius_m, "source": self.source},
        });
        if let Some(table) = &self.table {
            light["extras"]["photometry"] = table.json();
        }
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
