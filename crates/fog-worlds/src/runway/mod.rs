//! A runway with its markings, lights, taxiway and land around.
//!
//! The threshold's middle is the origin, the runway's surface has altitude 0 and runs along −Z: its true bearing is north,
//! whatever its designator says. Dimensions are those of the FAA's advisory circulars, given there in feet; beams are those of
//! ICAO's Annex 14, as EASA prints them.

mod approach;
mod beams;
mod fixtures;
mod ground;
mod lights;
mod markings;
mod papi;

use crate::error::{WorldError, within};
use crate::glb::Glb;
use crate::place::Place;
use fog_core::Vec3;
use serde_json::json;

/// Metres in a foot.
const FT: f32 = 0.3048;

/// Options of [`crate::World::Runway`].
#[derive(Clone, Debug, PartialEq)]
pub struct Runway {
    /// Length in metres, 1200 to 5000.
    pub length_m: f32,
    /// Width in metres: 30, 45 or 60.
    pub width_m: f32,
    /// What is painted at the near end: 01 to 36, and L, C or R.
    pub designator: String,
    /// Lights before the threshold.
    pub approach: ApproachLights,
    /// Angle of the PAPI's glide path in degrees, 2 to 5.
    pub papi_deg: f32,
    /// Intensity of all lights in percent of the full one, above 0 to 100.
    pub lights_percent: f32,
    /// Whether the sequenced flashers of the approach lights are lit, all at once.
    pub flashers: bool,
}

/// A system of approach lights.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ApproachLights {
    /// None: eight threshold lights alone.
    None,
    /// Medium intensity with runway alignment indicator lights (FAA JO 6850.2).
    Malsr,
    /// High intensity for categories II and III (FAA JO 6850.2; UFC 3-535-01, Sec. 3-2).
    Alsf2,
}

impl Default for Runway {
    fn default() -> Self {
        Self {
            length_m: 2500.0,
            width_m: 45.0,
            designator: "36".to_owned(),
            approach: ApproachLights::Alsf2,
            papi_deg: 3.0,
            lights_percent: 100.0,
            flashers: false,
        }
    }
}

/// The point at a distance along the runway from the threshold and to the right of its centre line.
fn at(along: f32, right: f32, up: f32) -> Vec3 {
    Vec3::new(right, up, -along)
}

/// A place there, facing a heading.
fn place(along: f32, right: f32, up: f32, heading_deg: f32) -> Place {
    let p = at(along, right, up);
    Place::at(p.x, p.y, p.z).facing(heading_deg)
}

/// Which way an aircraft goes that a light or a marking is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum End {
    /// Landing along −Z over the threshold at the origin.
    Near,
    /// Landing along +Z over the other end.
    Far,
}

impl End {
    /// The place at `along` from this end's threshold, `right` as its pilot sees it, turned to the pilot's heading.
    fn place(self, length: f32, along: f32, right: f32, up: f32) -> Place {
        match self {
            Self::Near => place(along, right, up, 0.0),
            Self::Far => place(length - along, -right, up, 180.0),
        }
    }
}

/// Number and letter of a designator, and what stands at the other end.
fn both_designators(text: &str) -> Option<[String; 2]> {
    let digits = text.trim_end_matches(['L', 'C', 'R']);
    let letter = &text[digits.len()..];
    let number: u32 = digits.parse().ok().filter(|n| (1..=36).contains(n) && letter.len() <= 1)?;
    let other = match letter {
        "L" => "R",
        "R" => "L",
        same => same,
    };
    // One digit alone is painted as such (AC 150/5340-1).
    Some([format!("{number}{letter}"), format!("{}{other}", (number + 17) % 36 + 1)])
}

/// Checks the options and makes the scene.
pub(crate) fn runway(options: &Runway, seed: u64) -> Result<Vec<u8>, WorldError> {
    within("length of the runway", options.length_m, (1200.0, 5000.0), "1200 to 5000 m")?;
    within("angle of the PAPI", options.papi_deg, (2.0, 5.0), "2 to 5 degrees")?;
    within("intensity of the lights", options.lights_percent, (0.01, 100.0), "0.01 to 100 percent")?;
    if ![30.0, 45.0, 60.0].contains(&options.width_m) {
        let value = options.width_m.to_string();
        return Err(WorldError::Option { option: "width of the runway", value, valid: "30, 45 or 60 m" });
    }
    let Some(designators) = both_designators(&options.designator) else {
        let value = options.designator.clone();
        return Err(WorldError::Option {
            option: "designator",
            value,
            valid: "01 to 36, with L, C, R or no letter",
        });
    };
    let mut glb = Glb::default();
    ground::ground(&mut glb, options, seed)?;
    markings::markings(&mut glb, options, &designators);
    let mut lights = fixtures::Fixtures::new(&mut glb, options);
    lights::runway_lights(&mut lights, options);
    approach::approach_lights(&mut lights, options);
    papi::papi(&mut lights, options);
    let half = 0.5 * options.width_m;
    glb.note(
        "runway",
        json!({
            "designators": designators, "length_m": options.length_m, "width_m": options.width_m,
            "threshold_corners_m": [[-half, 0, 0], [half, 0, 0]],
            "end_corners_m": [[-half, 0, -options.length_m], [half, 0, -options.length_m]],
            "aiming_point_m": [0, 0, -markings::AIMING_POINT],
            "papi_m": [-(half + papi::FROM_EDGE), papi::LENS_UP, -papi::ALONG], "glide_path_deg": options.papi_deg,
        }),
    );
    Ok(glb.finish())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn designators_have_their_reciprocals() {
        let both = |text: &str| both_designators(text);
        assert_eq!(both("36"), Some(["36".into(), "18".into()]));
        assert_eq!(both("09L"), Some(["9L".into(), "27R".into()]));
        assert_eq!(both("18C"), Some(["18C".into(), "36C".into()]));
        for wrong in ["0", "37", "09LL", "X", ""] {
            assert_eq!(both(wrong), None, "{wrong}");
        }
    }
}
