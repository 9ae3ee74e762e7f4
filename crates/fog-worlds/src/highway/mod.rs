//! A motorway: three lanes each way, barriers, gantries with signs, reflector posts every 50 m.
//!
//! It runs straight along −Z; the right carriageway lies at x > 0 and leads towards −Z. A camera at (11.3, 1.5, 0) with heading
//! 0 stands in the right lane. The road's surface has altitude 0. Cross-section after the German RAA (2008) RQ 36: lanes of
//! 3.75 and 3.5 m, hard shoulder 2.5 m, edge strips, median 4 m; general knowledge, rounded.

mod furniture;
mod ground;
mod traffic;

use crate::error::{WorldError, within};
use crate::glb::Glb;
use crate::place::Place;
use crate::signs::Style;

/// Options of [`crate::World::Highway`].
#[derive(Clone, Debug, PartialEq)]
pub struct Highway {
    /// Length in metres, 200 to 5000; the road begins 200 m behind the origin.
    pub length_m: f32,
    /// Signs, plates and markings.
    pub style: Style,
    /// How full the lanes are, 0 to 1.
    pub traffic: f32,
    /// Distance between gantries in metres, 100 to 5000.
    pub gantries_m: f32,
}

impl Default for Highway {
    fn default() -> Self {
        Self { length_m: 1000.0, style: Style::Vienna, traffic: 0.4, gantries_m: 400.0 }
    }
}

/// Half of the median, strip inside the fast lane, lanes, strip outside the slow lane, hard shoulder: metres.
const MEDIAN: f32 = 2.0;
const INNER_STRIP: f32 = 0.75;
const LANES: [f32; 3] = [3.5, 3.5, 3.75];
const OUTER_STRIP: f32 = 0.5;
const SHOULDER: f32 = 2.5;
/// Distance of the reflector posts from one another and from the pavement (German RPS and HLB practice: 50 m and 0.5 m).
pub(crate) const POST_STEP: f32 = 50.0;
const POST_ASIDE: f32 = 0.5;
/// The road begins behind the origin.
const BEHIND: f32 = 200.0;

/// Inner edge of the driving lanes, and outer edge of the paved carriageway, as distances from the road's middle.
fn edges() -> [f32; 2] {
    let inner = MEDIAN + INNER_STRIP;
    [inner, inner + LANES.iter().sum::<f32>() + OUTER_STRIP + SHOULDER]
}

/// Middle of a lane, 0 the fast one.
fn lane_middle(lane: usize) -> f32 {
    edges()[0] + LANES[..lane].iter().sum::<f32>() + 0.5 * LANES[lane]
}

/// Checks the options and makes the scene.
pub(crate) fn highway(options: &Highway, seed: u64) -> Result<Vec<u8>, WorldError> {
    within("length of the motorway", options.length_m, (200.0, 5000.0), "200 to 5000 m")?;
    within("traffic", options.traffic, (0.0, 1.0), "0 to 1")?;
    within("distance of the gantries", options.gantries_m, (100.0, 5000.0), "100 to 5000 m")?;
    let mut glb = Glb::default();
    ground::ground(&mut glb, options, seed)?;
    furniture::furniture(&mut glb, options)?;
    traffic::traffic(&mut glb, options, seed)?;
    glb.note(
        "highway",
        serde_json::json!({
            "length_m": options.length_m, "lane_middles_m": [lane_middle(0), lane_middle(1), lane_middle(2)],
            "posts_every_m": POST_STEP, "driver_m": [lane_middle(2), 1.5, 0],
        }),
    );
    Ok(glb.finish())
}

fn at(x: f32, y: f32, z: f32, heading_deg: f32) -> Place {
    Place::at(x, y, z).facing(heading_deg)
}
