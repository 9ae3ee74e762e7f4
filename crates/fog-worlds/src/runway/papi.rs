//! The precision approach path indicator: four L-880 units (AC 150/5345-28; UFC 3-535-01, Sec. 3-5).

use super::fixtures::Fixtures;
use super::{FT, Runway, place};
use crate::lamp::{Lamp, Table, colour};
use crate::mesh::Model;
use crate::paint::Paint;
use crate::place::{Place, sin_cos};
use crate::shapes::{block, cylinder, rounded_box};
use fog_core::{Vec3, math};

/// Distance of the innermost unit from the runway's edge, and between units.
pub(super) const FROM_EDGE: f32 = 50.0 * FT;
const SPACING: f32 = 30.0 * FT;
/// Distance from the threshold: beside the aiming point. On a path of 3° the eye crosses the threshold 16.3 m high.
pub(super) const ALONG: f32 = 1020.0 * FT;
/// Height of the lenses.
pub(super) const LENS_UP: f32 = 0.75;
/// Elevations of the units' colour boundaries over the glide path, from the innermost on, in degrees (30′, 10′).
const OFFSETS_DEG: [f32; 4] = [0.5, 1.0 / 6.0, -1.0 / 6.0, -0.5];
/// Intensity of red light in the middle of the beam, and how much more white light has (ICAO Annex 14, Fig. A2-23: 15,000 cd in
/// red, from 2 to 6.5 times as much in white; general knowledge).
const RED_CANDELA: f32 = 15_000.0;
const WHITE_OVER_RED: f32 = 2.0;
/// Half of the thickness of the boundary between the colours: 3 minutes of arc at most (AC 150/5345-28; general knowledge).
const HALF_BOUNDARY_DEG: f32 = 0.025;
/// Where the intensity is half of that in the middle, aside and up or down; of the order of the figure's curves.
const HALF_DEG: [f32; 2] = [8.0, 4.0];
/// How far light goes aside, and up or down.
const END_DEG: [f32; 2] = [20.0, 12.0];
/// Radius of a disc of the area of the three lenses, 160 mm by 100 mm each.
const RADIUS: f32 = 0.124;

/// One colour's half of the beam: `side` is 1 over the boundary and −1 under it.
fn half_beam(candela: f32, side: f32) -> Table {
    let steps = |end: f32| (1..=(2.0 * end) as i32).map(|k| 0.5 * k as f32);
    let from_boundary = [-HALF_BOUNDARY_DEG, HALF_BOUNDARY_DEG].into_iter().chain(steps(END_DEG[1]));
    let mut up: Vec<f32> = from_boundary.map(|v| side * v).collect();
    up.sort_by(f32::total_cmp);
    let aside = [0.0].into_iter().chain(steps(END_DEG[0])).chain([180.0]).collect();
    Table::new(up, aside, |aside, up| {
        let ends = [aside / END_DEG[0], up / END_DEG[1]].map(|x| (1.0 - x * x).max(0.0));
        if side * up <= 0.0 || ends[0] * ends[1] == 0.0 {
            return 0.0;
        }
        let squares = (aside / HALF_DEG[0]).powi(2) + (up / HALF_DEG[1]).powi(2);
        candela * math::f32::exp(-core::f32::consts::LN_2 * squares)
    })
}

pub(super) fn papi(lights: &mut Fixtures<'_>, options: &Runway) {
    let percent = 0.01 * options.lights_percent;
    let lamp = |name: &str, color: [f32; 3], candela: f32, side: f32| Lamp {
        name: format!("PAPI, {name}"),
        color,
        candela: candela * percent,
        cone_deg: Some([0.5 * HALF_DEG[1], END_DEG[1]]),
        table: Some(half_beam(candela * percent, side)),
        radius_m: RADIUS,
        source: "FAA AC 150/5345-28, L-880; ICAO Annex 14 Fig. A2-23",
    };
    let white = lamp("white", colour::HALOGEN, WHITE_OVER_RED * RED_CANDELA, 1.0);
    let red = lamp("red", colour::RED, RED_CANDELA, -1.0);
    let shape = unit(lights);
    let half = 0.5 * options.width_m;
    for (i, offset) in OFFSETS_DEG.into_iter().enumerate() {
        let x = -(half + FROM_EDGE + SPACING * i as f32);
        let name = format!("papi_{i}");
        let boundary = options.papi_deg + offset;
        let facts = serde_json::json!({"boundary_deg": boundary});
        let mut extras = serde_json::Map::new();
        extras.extend(facts.as_object().cloned().into_iter().flatten());
        let unit_place = place(ALONG, x, 0.0, 180.0);
        lights.glb.node_with(&name, "papi", shape, unit_place, extras);
        let at = unit_place.point(Vec3::new(0.0, LENS_UP, -0.63));
        let (up, level) = sin_cos(boundary);
        let aim = Place::at(at.x, at.y, at.z).aimed(Vec3::new(0.0, up, level));
        for (lamp, colour) in [(&white, "white"), (&red, "red")] {
            lights.glb.lamp(&format!("{name}_{colour}"), "papi", &name, lamp, aim);
        }
    }
}

/// A box on legs with three lenses; its front looks along −Z.
fn unit(lights: &mut Fixtures<'_>) -> crate::glb::Shape {
    let body = lights.glb.material(&Paint::new("PAPI housing", [0.85, 0.5, 0.05]).smooth(0.4));
    let legs = lights.glb.material(&Paint::new("galvanised legs", [0.5, 0.5, 0.5]).metal(0.5));
    let lens = lights.glb.material(&Paint::new("PAPI lens", [0.4, 0.4, 0.4]).smooth(0.1));
    let mut model = Model::default();
    let (min, max) = (Vec3::new(-0.45, LENS_UP - 0.17, -0.6), Vec3::new(0.45, LENS_UP + 0.17, 0.6));
    model.add(body, &rounded_box(min, max, 0.04, 3));
    for x in [-0.28, 0.0, 0.28] {
        let (a, b) = (Vec3::new(x - 0.08, LENS_UP - 0.05, -0.61), Vec3::new(x + 0.08, LENS_UP + 0.05, -0.59));
        model.add(lens, &block(a, b));
    }
    for (x, z) in [(-0.35, -0.45), (0.35, -0.45), (0.0, 0.45)] {
        model.add(legs, &cylinder(Vec3::new(x, 0.0, z), Vec3::new(x, LENS_UP, z), 0.03, 0.03, 8));
    }
    lights.glb.shape("papi unit", &model)
}
