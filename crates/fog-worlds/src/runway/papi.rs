//! The precision approach path indicator: four L-880 units (AC 150/5345-28; UFC 3-535-01, Sec. 3-5).

use super::fixtures::Fixtures;
use super::{FT, Runway, place};
use crate::lamp::{Lamp, colour};
use crate::mesh::Model;
use crate::paint::Paint;
use crate::place::{Place, sin_cos};
use crate::shapes::{block, cylinder, rounded_box};
use fog_core::Vec3;

/// Distance of the innermost unit from the runway's edge, and between units.
pub(super) const FROM_EDGE: f32 = 50.0 * FT;
const SPACING: f32 = 30.0 * FT;
/// Distance from the threshold: beside the aiming point. On a path of 3° the eye crosses the threshold 16.3 m high.
pub(super) const ALONG: f32 = 1020.0 * FT;
/// Height of the lenses.
pub(super) const LENS_UP: f32 = 0.75;
/// Elevations of the units' colour boundaries over the glide path, from the innermost on, in degrees (30′, 10′).
const OFFSETS_DEG: [f32; 4] = [0.5, 1.0 / 6.0, -1.0 / 6.0, -0.5];
/// Intensity of white and red light (ICAO Annex 14, Fig. A2-23: 15,000 cd in red; general knowledge).
const CANDELA: f32 = 15_000.0;
/// Half-angle of each colour's round cone; its edge crosses the centre plane at the boundary.
///
/// A real unit's beam is a flat fan with a level boundary 3′ thick. A round cone of this size departs from level by 0.03° at
/// 1° of azimuth, and glTF's narrowest falloff (0.001 of the cosine) makes the boundary 0.22° thick.
const CONE_DEG: f32 = 15.0;
/// From a cone's edge to where it has half of its intensity: the falloff is the square of (cos θ − cos 15°) / 0.001.
const HALF_INSIDE_DEG: f32 = 0.157;

pub(super) fn papi(lights: &mut Fixtures<'_>, options: &Runway) {
    let lamp = |name: &str, color: [f32; 3]| Lamp {
        name: format!("PAPI, {name}"),
        color,
        candela: CANDELA * 0.01 * options.lights_percent,
        cone_deg: Some([CONE_DEG - 0.2, CONE_DEG]),
        source: "FAA AC 150/5345-28, L-880; ICAO Annex 14 Fig. A2-23",
    };
    let (white, red) = (lamp("white", colour::HALOGEN), lamp("red", colour::RED));
    let half = 0.5 * options.width_m;
    for (i, offset) in OFFSETS_DEG.into_iter().enumerate() {
        // As on the glide path: the outer two white, the inner two red.
        let shown = if offset < 0.0 { &white } else { &red };
        let shape = unit(lights, shown);
        let x = -(half + FROM_EDGE + SPACING * i as f32);
        let name = format!("papi_{i}");
        let boundary = options.papi_deg + offset;
        let facts = serde_json::json!({"boundary_deg": boundary});
        let mut extras = serde_json::Map::new();
        extras.extend(facts.as_object().cloned().into_iter().flatten());
        let unit_place = place(ALONG, x, 0.0, 180.0);
        lights.glb.node_with(&name, "papi", shape, unit_place, extras);
        let at = unit_place.point(Vec3::new(0.0, LENS_UP, -0.63));
        for (lamp, side) in [(&white, 1.0), (&red, -1.0)] {
            let (up, level) = sin_cos(boundary + side * (CONE_DEG - HALF_INSIDE_DEG));
            let aim = Place::at(at.x, at.y, at.z).aimed(Vec3::new(0.0, up, level));
            lights.glb.lamp(
                &format!("{name}_{}", if side > 0.0 { "white" } else { "red" }),
                "papi",
                &name,
                lamp,
                aim,
            );
        }
    }
}

/// A box on legs with three lenses; its front looks along −Z.
fn unit(lights: &mut Fixtures<'_>, shown: &Lamp) -> crate::glb::Shape {
    let body = lights.glb.material(&Paint::new("PAPI housing", [0.85, 0.5, 0.05]).smooth(0.4));
    let legs = lights.glb.material(&Paint::new("galvanised legs", [0.5, 0.5, 0.5]).metal(0.5));
    let (rgb, strongest) = colour::split(shown.color);
    let luminance = shown.lens_luminance(3.0 * 0.16 * 0.1) * strongest;
    let lens = Paint::new(&format!("{} lens", shown.name), rgb.map(|c| 0.2 + 0.3 * c)).smooth(0.1);
    let lens = lights.glb.material(&lens.shining(rgb, luminance));
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
    lights.glb.shape(&format!("papi unit, {}", shown.name), &model)
}
