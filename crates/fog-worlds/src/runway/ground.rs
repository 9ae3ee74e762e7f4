//! The runway's slab, a parallel taxiway and the land around.

use super::markings::bar;
use super::{Runway, place};
use crate::error::WorldError;
use crate::glb::{Glb, Sampling};
use crate::mesh::{Mesh, Model};
use crate::noise::{self, Chance};
use crate::objects::tree;
use crate::paint::Paint;
use crate::place::Place;
use crate::shapes::{Grid, block, cylinder, lathe};
use fog_core::{Vec2, Vec3};

/// Distance of the taxiway's centre line from the runway's (ICAO Annex 14, code 4E: 182.5 m) and its width (code E: 23 m).
pub(super) const TAXIWAY_ASIDE: f32 = 182.5;
pub(super) const TAXIWAY_WIDTH: f32 = 23.0;
/// Distance of the hold lines from the runway's centre line (ICAO Annex 14, Table 3-2, code 4 precision: 90 m).
const HOLD: f32 = 90.0;
/// Altitudes of the grass and of yellow paint.
const GRASS: f32 = -0.04;
const PAINT: f32 = 0.006;
/// Land: beyond the runway's ends, to the sides, edge of a cell, width that is level, height of the hills.
const BEHIND: f32 = 3000.0;
const BEFORE: f32 = 8000.0;
const ASIDE: f32 = 4000.0;
const CELL: f32 = 200.0;
const LEVEL: f32 = 600.0;
const HILLS: f32 = 60.0;
/// Edge of the textures' squares in metres.
const GRASS_TILE: f32 = 60.0;
const ASPHALT_TILE: f32 = 15.0;

/// Where ways join runway and taxiway.
pub(super) fn connectors(length: f32) -> [f32; 3] {
    [0.5 * TAXIWAY_WIDTH, 0.5 * length, length - 0.5 * TAXIWAY_WIDTH]
}

pub(super) fn ground(glb: &mut Glb, options: &Runway, seed: u64) -> Result<(), WorldError> {
    let asphalt = noise::picture(seed, 128, 16, 3, [0.055, 0.055, 0.058], [0.105, 0.105, 0.11]);
    let asphalt = glb.texture("asphalt", &asphalt, Sampling::Repeated)?;
    let asphalt = glb.material(&Paint::new("asphalt", [1.0; 3]).textured(asphalt));
    let half = 0.5 * options.width_m;
    let mut slab = Model::default();
    paved(slab.part(asphalt), [-half, half], [0.0, options.length_m]);
    let shape = glb.shape("runway", &slab);
    glb.node_with("runway", "runway", shape, place(0.0, 0.0, 0.0, 0.0), keypoints(options));

    let mut ways = Model::default();
    let (left, right) = (TAXIWAY_ASIDE - 0.5 * TAXIWAY_WIDTH, TAXIWAY_ASIDE + 0.5 * TAXIWAY_WIDTH);
    paved(ways.part(asphalt), [left, right], [0.0, options.length_m]);
    let yellow = glb.material(&Paint::new("yellow runway paint", [0.75, 0.5, 0.03]));
    let mut lines = Mesh::default();
    bar(&mut lines, 0.0, TAXIWAY_ASIDE - 0.075, 0.15, options.length_m);
    for along in connectors(options.length_m) {
        let span = [along - 0.5 * TAXIWAY_WIDTH, along + 0.5 * TAXIWAY_WIDTH];
        paved(ways.part(asphalt), [half, left], span);
        bar(&mut lines, along - 0.075, half, TAXIWAY_ASIDE - half, 0.15);
        hold_lines(&mut lines, span);
    }
    let shape = glb.shape("taxiway", &ways);
    glb.node("taxiway", "taxiway", shape, place(0.0, 0.0, 0.0, 0.0));
    let mut model = Model::default();
    model.add(yellow, &lines);
    let shape = glb.shape("taxiway markings", &model);
    glb.node("taxiway_markings", "marking", shape, place(0.0, 0.0, PAINT, 0.0));

    land(glb, options, seed)?;
    tower(glb, options);
    Ok(())
}

/// Points of the runway by name, in metres: corners of the pavement, ends of the centre line, aiming point.
fn keypoints(options: &Runway) -> serde_json::Map<String, serde_json::Value> {
    let (half, length) = (0.5 * options.width_m, options.length_m);
    let points = serde_json::json!({
        "threshold_left": [-half, 0, 0], "threshold": [0, 0, 0], "threshold_right": [half, 0, 0],
        "end_left": [-half, 0, -length], "end": [0, 0, -length], "end_right": [half, 0, -length],
        "aiming_point": [0, 0, -super::markings::AIMING_POINT],
    });
    serde_json::Map::from_iter([("keypoints".to_owned(), points)])
}

/// A paved rectangle with its texture in metres, a skirt around it.
fn paved(mesh: &mut Mesh, [x0, x1]: [f32; 2], [near, far]: [f32; 2]) {
    let (w, l) = (x1 - x0, far - near);
    let repeats = Vec2::new(w, l) / ASPHALT_TILE;
    mesh.tiled(Vec3::new(x0, 0.0, -near), Vec3::X * w, Vec3::NEG_Z * l, repeats);
    let down = Vec3::Y * (2.0 * GRASS);
    for (o, along) in [
        (Vec3::new(x0, 0.0, -near), Vec3::X * w),
        (Vec3::new(x1, 0.0, -near), Vec3::NEG_Z * l),
        (Vec3::new(x1, 0.0, -far), Vec3::NEG_X * w),
        (Vec3::new(x0, 0.0, -far), Vec3::Z * l),
    ] {
        mesh.quad(o + down, along, -down);
    }
}

/// Two unbroken and two broken lines across a way to the runway (AC 150/5340-1: 12 in lines and gaps, 3 ft dashes).
fn hold_lines(mesh: &mut Mesh, [near, far]: [f32; 2]) {
    const FOOT: f32 = super::FT;
    for k in 0..2 {
        bar(mesh, near, HOLD + 2.0 * FOOT * k as f32 + 4.0 * FOOT, FOOT, far - near);
        let dashes = ((far - near) / (6.0 * FOOT)) as u32;
        for i in 0..dashes {
            bar(mesh, near + 6.0 * FOOT * i as f32, HOLD + 2.0 * FOOT * k as f32, FOOT, 3.0 * FOOT);
        }
    }
}

/// Grass, level around the runway and its approach, hilly beyond, with groups of trees.
fn land(glb: &mut Glb, options: &Runway, seed: u64) -> Result<(), WorldError> {
    let grass = noise::picture(seed ^ 1, 128, 8, 4, [0.06, 0.12, 0.025], [0.15, 0.21, 0.075]);
    let grass = glb.texture("grass", &grass, Sampling::Repeated)?;
    let grass = glb.material(&Paint::lambertian("grass", [1.0; 3]).textured(grass));
    let (x_cells, z_cells) =
        ((2.0 * ASIDE / CELL) as usize, ((BEFORE + options.length_m + BEHIND) / CELL) as usize);
    let height = |x: f32, z: f32| {
        let t = ((x.abs() - LEVEL) / 1500.0).clamp(0.0, 1.0);
        let field = noise::value(seed ^ 2, x / 900.0, z / 900.0, 1 << 20);
        GRASS + HILLS * t * t * (3.0 - 2.0 * t) * field
    };
    let point = |i: usize, j: usize| {
        let (x, z) = (-ASIDE + CELL * j as f32, BEFORE - CELL * i as f32);
        Vec3::new(x, height(x, z), z)
    };
    let rows = (0..=z_cells).map(|i| (0..=x_cells).map(|j| point(i, j)).rev().collect()).collect();
    let mut mesh = Grid::new(rows).mesh();
    for (uv, p) in mesh.uv.iter_mut().zip(&mesh.positions) {
        *uv = Vec2::new(p.x, p.z) / GRASS_TILE;
    }
    let mut model = Model::default();
    model.add(grass, &mesh);
    let shape = glb.shape("grassland", &model);
    glb.node("grassland", "terrain", shape, Place::at(0.0, 0.0, 0.0));

    let trees: Vec<_> = (0..3u64).map(|k| tree::tree(glb, seed, k, tree::Leaves::Coarse)).collect();
    let mut chance = Chance::new(seed, "woods", 0);
    let mut n = 0;
    for _ in 0..24 {
        let side = if chance.happens(0.5) { 1.0 } else { -1.0 };
        let (x, z) = (side * chance.between(330.0, 900.0), chance.between(-options.length_m - 800.0, 2500.0));
        for _ in 0..3 + chance.below(6) {
            let (x, z) = (x + chance.between(-25.0, 25.0), z + chance.between(-25.0, 25.0));
            let heading = chance.between(0.0, 360.0);
            let place = Place::at(x, height(x, z), z).facing(heading);
            glb.node(&format!("tree_{n:03}"), "vegetation", *chance.pick(&trees), place);
            n += 1;
        }
    }
    Ok(())
}

/// A control tower beyond the taxiway.
fn tower(glb: &mut Glb, options: &Runway) {
    let concrete = glb.material(&Paint::new("concrete", [0.45, 0.44, 0.42]));
    let glass = glb.material(&Paint::new("dark glass", [0.02, 0.03, 0.035]).smooth(0.05));
    let mut model = Model::default();
    model.add(concrete, &cylinder(Vec3::ZERO, Vec3::Y * 30.0, 4.0, 3.0, 24));
    model.add(concrete, &lathe(&[[3.0, 27.0], [5.5, 30.0], [5.5, 30.6], [0.0, 30.6]], 24));
    model.add(glass, &lathe(&[[5.0, 30.6], [6.2, 34.0]], 8));
    model.add(concrete, &lathe(&[[6.2, 34.0], [6.4, 34.0], [6.4, 34.5], [0.0, 35.2]], 8));
    model.add(concrete, &block(Vec3::new(-20.0, 0.0, -8.0), Vec3::new(20.0, 8.0, 8.0)));
    let shape = glb.shape("control tower", &model);
    glb.node(
        "control_tower",
        "building",
        shape,
        place(0.4 * options.length_m, TAXIWAY_ASIDE + 160.0, 0.0, 0.0),
    );
}
