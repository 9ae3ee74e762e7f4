//! Road, pavements and their markings.

use super::{ASIDE, BEHIND, FRONT, KERB, LANE, Plan, ROAD, at};
use crate::error::WorldError;
use crate::glb::{Glb, Sampling};
use crate::mesh::{Mat, Mesh, Model};
use crate::noise;
use crate::paint::Paint;
use crate::signs::Style;
use fog_core::{Vec2, Vec3};

/// Altitude of paint; edges of the textures' squares.
const PAINT: f32 = 0.004;
const ASPHALT_TILE: f32 = 6.0;
const SLAB_TILE: f32 = 2.0;
/// Half the edge of the land around.
const LAND: f32 = 1500.0;
/// Dashes of the centre line: stroke and gap in towns (RMS 1: 3 m and 6 m), their width.
const DASH: f32 = 3.0;
const DASH_GAP: f32 = 6.0;
const LINE: f32 = 0.12;
/// Crosswalk: width of bars and gaps, length; stop line.
const BAR: f32 = 0.5;
const CROSSWALK: f32 = 3.5;
const STOP: f32 = 0.5;

/// Draws a level rectangle between two corners along a street.
type Draw<'a> = dyn FnMut(&mut Mesh, [f32; 2], [f32; 2]) + 'a;

/// A level rectangle between corners (x, z) with x0 < x1, z0 > z1, its texture in metres.
fn level(mesh: &mut Mesh, [x0, z0]: [f32; 2], [x1, z1]: [f32; 2], y: f32, tile: f32) {
    let corner = |x: f32, z: f32| (Vec3::new(x, y, z), Vec2::new(x, z) / tile);
    mesh.polygon(&[corner(x0, z0), corner(x1, z0), corner(x1, z1), corner(x0, z1)]);
}

pub(super) fn ground(glb: &mut Glb, plan: &Plan<'_>) -> Result<(), WorldError> {
    let texture = noise::picture(plan.seed, 128, 16, 3, [0.06, 0.06, 0.062], [0.115, 0.115, 0.118]);
    let texture = glb.texture("asphalt", &texture, Sampling::Repeated)?;
    let asphalt = glb.material(&Paint::new("asphalt", [1.0; 3]).textured(texture));
    let grass = glb.material(&Paint::lambertian("grass", [0.09, 0.15, 0.045]));
    let paint = glb.material(&Paint::new("road paint", [0.70, 0.70, 0.68]));
    let yellow = glb.material(&Paint::new("yellow road paint", [0.70, 0.42, 0.02]));

    let mut model = Model::default();
    level(model.part(grass), [-LAND, LAND], [LAND, -LAND], -0.1, 1.0);
    let shape = glb.shape("land", &model);
    glb.node("land", "terrain", shape, at(0.0, 0.0, 0.0, 0.0));

    let mut road = Model::default();
    let mesh = road.part(asphalt);
    level(mesh, [-ROAD, BEHIND], [ROAD, plan.end], 0.0, ASPHALT_TILE);
    let (z0, z1) = (plan.crossing + ROAD, plan.crossing - ROAD);
    level(mesh, [-ASIDE, z0], [-ROAD, z1], 0.0, ASPHALT_TILE);
    level(mesh, [ROAD, z0], [ASIDE, z1], 0.0, ASPHALT_TILE);
    let shape = glb.shape("road", &road);
    glb.node("road", "road", shape, at(0.0, 0.0, 0.0, 0.0));

    pavements(glb, plan)?;
    let (white, mesh_yellow) = markings(plan);
    let mut lines = Model::default();
    lines.add(paint, &white);
    if !mesh_yellow.indices.is_empty() {
        lines.add(yellow, &mesh_yellow);
    }
    let shape = glb.shape("markings", &lines);
    glb.node("markings", "marking", shape, at(0.0, 0.0, 0.0, 0.0));
    Ok(())
}

/// Four pavements, one at each corner of the crossing: along the street and along the crossing street.
fn pavements(glb: &mut Glb, plan: &Plan<'_>) -> Result<(), WorldError> {
    // Slabs of 50 cm with dark joints, a grain over them.
    let n = 128usize;
    let pixel = |i: usize| {
        let (x, y) = (i % n, i / n);
        let joint = x % 32 == 0 || (y + 16 * (x / 32 % 2)) % 32 == 0;
        let grain = noise::value(plan.seed ^ 3, x as f32 / 4.0, y as f32 / 4.0, 32);
        let slab = noise::value(plan.seed ^ 4, (x / 32) as f32, ((y + 16 * (x / 32 % 2)) / 32) as f32, 4);
        let grey = if joint { 0.16 } else { 0.26 + 0.05 * grain + 0.05 * slab };
        [grey, grey * 0.98, grey * 0.94]
    };
    let slabs = crate::picture::Picture::from_pixels(n, (0..n * n).map(pixel).collect());
    let slabs = glb.texture("paving slabs", &slabs, Sampling::Repeated)?;
    let slabs = glb.material(&Paint::new("paving slabs", [1.0; 3]).textured(slabs));
    let stone = glb.material(&Paint::new("kerb stone", [0.36, 0.36, 0.35]));
    for (name, side, near, far) in [
        ("pavement_near_right", 1.0, BEHIND, plan.crossing + ROAD),
        ("pavement_near_left", -1.0, BEHIND, plan.crossing + ROAD),
        ("pavement_far_right", 1.0, plan.crossing - ROAD, plan.end),
        ("pavement_far_left", -1.0, plan.crossing - ROAD, plan.end),
    ] {
        let mut model = Model::default();
        let span = |a: f32, b: f32| if side > 0.0 { [a, b] } else { [-b, -a] };
        let along_street = span(ROAD, FRONT + 0.5);
        let crossing_edge = if side_is_near(near) { far } else { near };
        let away = if side_is_near(near) { 1.0 } else { -1.0 };
        slab(&mut model, slabs, stone, along_street, [near, far]);
        // Along the crossing street, beyond the corner.
        let across = span(FRONT + 0.5, ASIDE);
        let inner = crossing_edge + away * (FRONT - ROAD + 0.5);
        slab(&mut model, slabs, stone, across, [inner.max(crossing_edge), inner.min(crossing_edge)]);
        let shape = glb.shape(name, &model);
        glb.node(name, "sidewalk", shape, at(0.0, 0.0, 0.0, 0.0));
    }
    Ok(())
}

fn side_is_near(near: f32) -> bool {
    near == BEHIND
}

/// A raised slab with kerb stones 15 cm wide around its top.
fn slab(model: &mut Model, slabs: Mat, stone: Mat, [x0, x1]: [f32; 2], [z0, z1]: [f32; 2]) {
    const STONE: f32 = 0.15;
    level(model.part(slabs), [x0 + STONE, z0 - STONE], [x1 - STONE, z1 + STONE], KERB, SLAB_TILE);
    let kerb = model.part(stone);
    level(kerb, [x0, z0], [x0 + STONE, z1], KERB, 1.0);
    level(kerb, [x1 - STONE, z0], [x1, z1], KERB, 1.0);
    level(kerb, [x0 + STONE, z0], [x1 - STONE, z0 - STONE], KERB, 1.0);
    level(kerb, [x0 + STONE, z1 + STONE], [x1 - STONE, z1], KERB, 1.0);
    let (dx, dz, up) = (Vec3::X * (x1 - x0), Vec3::NEG_Z * (z0 - z1), Vec3::Y * KERB);
    kerb.quad(Vec3::new(x0, 0.0, z0), dx, up);
    kerb.quad(Vec3::new(x1, 0.0, z0), dz, up);
    kerb.quad(Vec3::new(x1, 0.0, z1), -dx, up);
    kerb.quad(Vec3::new(x0, 0.0, z1), -dz, up);
}

/// White and yellow lines of both streets.
fn markings(plan: &Plan<'_>) -> (Mesh, Mesh) {
    let (mut white, mut yellow) = (Mesh::default(), Mesh::default());
    let stop = FRONT + CROSSWALK - 1.5;
    // Along the street, before and after the crossing; then the crossing street, with x for −z.
    let c = plan.crossing;
    let mut main = |mesh: &mut Mesh, a: [f32; 2], b: [f32; 2]| level(mesh, a, b, PAINT, 1.0);
    let runs = [(BEHIND, c + stop + STOP), (c - stop - STOP, plan.end)];
    for (near, far) in runs {
        lines(plan.options.style, near, far, &mut white, &mut yellow, &mut main);
    }
    let mut turned = |mesh: &mut Mesh, [x0, z0]: [f32; 2], [x1, z1]: [f32; 2]| {
        level(mesh, [-z0, c - x0], [-z1, c - x1], PAINT, 1.0);
    };
    for (near, far) in [(ASIDE, stop + STOP), (-stop - STOP, -ASIDE)] {
        lines(plan.options.style, near, far, &mut white, &mut yellow, &mut turned);
    }
    for side in [1.0, -1.0] {
        // Crosswalks and stop lines of the arms towards +z and −z, and towards +x and −x.
        let span = |from: f32, to: f32| if side > 0.0 { [to, from] } else { [-from, -to] };
        let mut bars = |draw: &mut Draw<'_>, middle: f32| {
            let [far, near] = span(FRONT - 2.6, FRONT - 2.6 + CROSSWALK - 0.5);
            let n = (2.0 * ROAD / (2.0 * BAR)) as i32;
            for k in 0..n {
                let x = -ROAD + (2.0 * k as f32 + 0.6) * BAR;
                draw(&mut white, [x, middle + far], [x + BAR, middle + near]);
            }
            let [far, near] = span(stop, stop + STOP);
            let (x0, x1) = if side > 0.0 { (0.06, ROAD) } else { (-ROAD, -0.06) };
            draw(&mut white, [x0, middle + far], [x1, middle + near]);
        };
        bars(&mut main, c);
        bars(&mut turned, 0.0);
    }
    (white, yellow)
}

/// Lines along a street from `near` to `far` (falling): middle and edges of the parking strips.
fn lines(style: Style, near: f32, far: f32, white: &mut Mesh, yellow: &mut Mesh, draw: &mut Draw<'_>) {
    match style {
        Style::Vienna => {
            let mut z = near;
            while z - DASH > far {
                draw(white, [-0.5 * LINE, z], [0.5 * LINE, z - DASH]);
                z -= DASH + DASH_GAP;
            }
        }
        // Two solid yellow lines.
        Style::Mutcd => {
            for x in [-0.15, 0.05] {
                draw(yellow, [x, near], [x + 0.1, far]);
            }
        }
    }
    for x in [-LANE, LANE] {
        draw(white, [x - 0.5 * LINE, near], [x + 0.5 * LINE, far]);
    }
}
