//! Carriageways, their markings, and the land.

use super::{BEHIND, Highway, LANES, MEDIAN, at, edges};
use crate::error::WorldError;
use crate::glb::{Glb, Sampling};
use crate::mesh::{Mesh, Model};
use crate::noise::{self, Chance};
use crate::objects::tree;
use crate::paint::Paint;
use crate::shapes::Grid;
use crate::signs::Style;
use fog_core::{Vec2, Vec3};

const PAINT: f32 = 0.004;
const ASPHALT_TILE: f32 = 8.0;
const GRASS_TILE: f32 = 20.0;
/// Land: to the sides and beyond the ends, size of a cell, height of the hills, width that is level.
const LAND: f32 = 1200.0;
const CELL: f32 = 40.0;
const HILLS: f32 = 30.0;
const LEVEL: f32 = 40.0;
/// Dashes between lanes: stroke and gap. RMS 1993: 6 m and 12 m; MUTCD 3A.06: 10 ft and 30 ft.
const VIENNA_DASH: [f32; 2] = [6.0, 12.0];
const MUTCD_DASH: [f32; 2] = [3.05, 9.14];
/// Widths of the lines between lanes and along the edges.
const LANE_LINE: f32 = 0.15;
const EDGE_LINE: f32 = 0.30;

pub(super) fn ground(glb: &mut Glb, options: &Highway, seed: u64) -> Result<(), WorldError> {
    let texture = noise::picture(seed, 128, 16, 3, [0.07, 0.07, 0.072], [0.125, 0.125, 0.128]);
    let texture = glb.texture("asphalt", &texture, Sampling::Repeated)?;
    let asphalt = glb.material(&Paint::new("asphalt", [1.0; 3]).textured(texture));
    let [_, outer] = edges();
    let end = -options.length_m;
    for (name, x0, x1) in [("right", MEDIAN, outer), ("left", -outer, -MEDIAN)] {
        let mut model = Model::default();
        strip(model.part(asphalt), [x0, x1], [BEHIND, end], 0.0, ASPHALT_TILE);
        let shape = glb.shape(&format!("carriageway {name}"), &model);
        glb.node(&format!("carriageway_{name}"), "road", shape, at(0.0, 0.0, 0.0, 0.0));
    }
    markings(glb, options);
    land(glb, options, seed)
}

/// A level strip between x0 < x1 and z0 > z1.
fn strip(mesh: &mut Mesh, [x0, x1]: [f32; 2], [z0, z1]: [f32; 2], y: f32, tile: f32) {
    let corner = |x: f32, z: f32| (Vec3::new(x, y, z), Vec2::new(x, z) / tile);
    mesh.polygon(&[corner(x0, z0), corner(x1, z0), corner(x1, z1), corner(x0, z1)]);
}

fn markings(glb: &mut Glb, options: &Highway) {
    let paint = glb.material(&Paint::new("road paint", [0.70, 0.70, 0.68]));
    let yellow = glb.material(&Paint::new("yellow road paint", [0.70, 0.42, 0.02]));
    let [inner, _] = edges();
    let [stroke, gap] = if options.style == Style::Vienna { VIENNA_DASH } else { MUTCD_DASH };
    let median = if options.style == Style::Vienna { paint } else { yellow };
    let mut model = Model::default();
    let end = -options.length_m;
    for side in [1.0f32, -1.0] {
        let mut line = |material, x: f32, width: f32, z: [f32; 2]| {
            let (a, b) = (side * x - 0.5 * width, side * x + 0.5 * width);
            strip(model.part(material), [a, b], z, PAINT, 1.0);
        };
        line(median, inner - 0.5 * EDGE_LINE, EDGE_LINE, [BEHIND, end]);
        let total: f32 = LANES.iter().sum();
        line(paint, inner + total + 0.5 * EDGE_LINE, EDGE_LINE, [BEHIND, end]);
        let mut x = inner;
        for lane in &LANES[..2] {
            x += lane;
            let mut z = BEHIND;
            while z - stroke > end {
                line(paint, x, LANE_LINE, [z, z - stroke]);
                z -= stroke + gap;
            }
        }
    }
    let shape = glb.shape("markings", &model);
    glb.node("markings", "marking", shape, at(0.0, 0.0, 0.0, 0.0));
}

/// Grass: level beside the road, then hills, with trees behind the barriers.
fn land(glb: &mut Glb, options: &Highway, seed: u64) -> Result<(), WorldError> {
    let grass = noise::picture(seed ^ 1, 128, 8, 4, [0.06, 0.12, 0.025], [0.15, 0.21, 0.075]);
    let grass = glb.texture("grass", &grass, Sampling::Repeated)?;
    let grass = glb.material(&Paint::lambertian("grass", [1.0; 3]).textured(grass));
    let height = |x: f32, z: f32| {
        let t = ((x.abs() - LEVEL) / 400.0).clamp(0.0, 1.0);
        -0.06 + HILLS * t * t * (3.0 - 2.0 * t) * noise::value(seed ^ 2, x / 260.0, z / 260.0, 1 << 20)
    };
    let (columns, rows) = ((2.0 * LAND / CELL) as usize, ((2.0 * LAND + options.length_m) / CELL) as usize);
    let point = |i: usize, j: usize| {
        let (x, z) = (-LAND + CELL * j as f32, LAND - CELL * i as f32);
        Vec3::new(x, height(x, z), z)
    };
    let points = (0..=rows).map(|i| (0..=columns).map(|j| point(i, j)).rev().collect()).collect();
    let mut mesh = Grid::new(points).mesh();
    for (uv, p) in mesh.uv.iter_mut().zip(&mesh.positions) {
        *uv = Vec2::new(p.x, p.z) / GRASS_TILE;
    }
    let mut model = Model::default();
    model.add(grass, &mesh);
    let shape = glb.shape("land", &model);
    glb.node("land", "terrain", shape, at(0.0, 0.0, 0.0, 0.0));

    let trees: Vec<_> = (0..3).map(|k| tree::tree(glb, seed, k, tree::Leaves::Fine)).collect();
    let mut chance = Chance::new(seed, "trees", 0);
    let many = (0.12 * (options.length_m + BEHIND)) as usize;
    for n in 0..many {
        let side = if chance.happens(0.5) { 1.0 } else { -1.0 };
        let (x, z) = (side * chance.between(26.0, 110.0), chance.between(-options.length_m, BEHIND));
        let place = at(x, height(x, z) - 0.1, z, chance.between(0.0, 360.0));
        glb.node(&format!("tree_{n:03}"), "vegetation", *chance.pick(&trees), place);
    }
    Ok(())
}
