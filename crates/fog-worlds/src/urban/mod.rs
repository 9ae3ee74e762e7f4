//! A street in a town: lanes, parked and driving vehicles, pavements with people, houses, lamps, signs, and a crossing with
//! traffic lights.
//!
//! The street runs along −Z; traffic keeps to the right. A camera at (1.6, 1.5, 0) with heading 0 sees what the driver of a
//! car in the right lane sees. The road's surface has altitude 0.

mod ground;
mod houses;
mod things;
mod traffic;

use crate::error::{WorldError, within};
use crate::glb::Glb;
use crate::place::Place;
use crate::signs::Style;

/// Options of [`crate::World::Urban`].
#[derive(Clone, Debug, PartialEq)]
pub struct Urban {
    /// Length of the street in metres, 80 to 600.
    pub length_m: f32,
    /// Signs, plates and markings.
    pub style: Style,
    /// How full the lanes and kerbs are, 0 to 1.
    pub traffic: f32,
    /// How full the pavements are, 0 to 1.
    pub people: f32,
    /// Speed limit on the signs: km/h, or mph with MUTCD; 5 to 130.
    pub limit: u32,
}

impl Default for Urban {
    fn default() -> Self {
        Self { length_m: 200.0, style: Style::Vienna, traffic: 0.5, people: 0.5, limit: 30 }
    }
}

/// Width of a lane, of the strip for parking, of a pavement; height of the kerb: metres.
pub(crate) const LANE: f32 = 3.25;
const PARKING: f32 = 2.1;
const PAVEMENT: f32 = 3.7;
const KERB: f32 = 0.12;
/// Half of the road between kerbs, distance of the houses from the middle.
const ROAD: f32 = LANE + PARKING;
const FRONT: f32 = ROAD + PAVEMENT;
/// The street begins behind the origin, and the crossing street reaches to both sides.
const BEHIND: f32 = 40.0;
const ASIDE: f32 = 90.0;
/// Least radius of the corners' clearance: things stay this far from the crossing's middle.
const CLEAR: f32 = FRONT + 4.0;

/// What all parts of the scene need to know.
struct Plan<'a> {
    options: &'a Urban,
    seed: u64,
    /// z of the crossing's middle.
    crossing: f32,
    /// z of the far end.
    end: f32,
}

impl Plan<'_> {
    /// Whether a place along the street is clear of the crossing by `margin` more than its corners.
    fn off_crossing(&self, z: f32, margin: f32) -> bool {
        (z - self.crossing).abs() > CLEAR + margin
    }
}

/// Checks the options and makes the scene.
pub(crate) fn urban(options: &Urban, seed: u64) -> Result<Vec<u8>, WorldError> {
    within("length of the street", options.length_m, (80.0, 600.0), "80 to 600 m")?;
    within("traffic", options.traffic, (0.0, 1.0), "0 to 1")?;
    within("people", options.people, (0.0, 1.0), "0 to 1")?;
    within("speed limit", options.limit as f32, (5.0, 130.0), "5 to 130")?;
    let plan = Plan { options, seed, crossing: -0.45 * options.length_m, end: -options.length_m };
    let mut glb = Glb::default();
    ground::ground(&mut glb, &plan)?;
    houses::houses(&mut glb, &plan)?;
    things::things(&mut glb, &plan)?;
    traffic::traffic(&mut glb, &plan)?;
    glb.note(
        "urban",
        serde_json::json!({
            "length_m": options.length_m, "lane_m": LANE, "crossing_z_m": plan.crossing, "driver_m": [0.5 * LANE, 1.5, 0],
        }),
    );
    Ok(glb.finish())
}

/// A place that faces a heading.
fn at(x: f32, y: f32, z: f32, heading_deg: f32) -> Place {
    Place::at(x, y, z).facing(heading_deg)
}
