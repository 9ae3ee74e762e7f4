//! The street of Kolářová et al. 2024, Sec. 6.1: bright checkered buildings left and right, a tower at the end.
//!
//! Y up, the street runs along −Z from the viewer at the origin. All surfaces are Lambertian, in squares of 2 m; every
//! square of buildings, tower and street also emits, red or blue, radiance 1: lighting by day leaves that out.

use super::glb::Glb;
use super::quads::Quads;
use fog_core::colour::Rgb;
use serde_json::json;

/// Edge of a square in metres.
const SQUARE: f32 = 2.0;
const RED: Rgb = [1.0, 0.0, 0.0];
const BLUE: Rgb = [0.0, 0.0, 1.0];

/// Names and linear reflectances of the buildings' two colours.
const PALETTE: [(&str, Rgb, Rgb); 6] = [
    ("red and white", [0.80, 0.10, 0.08], [0.85, 0.85, 0.85]),
    ("green and yellow", [0.10, 0.55, 0.12], [0.85, 0.80, 0.10]),
    ("blue and white", [0.08, 0.20, 0.75], [0.85, 0.85, 0.85]),
    ("orange and navy", [0.85, 0.45, 0.05], [0.10, 0.10, 0.60]),
    ("purple and yellow", [0.70, 0.08, 0.60], [0.80, 0.80, 0.15]),
    ("cyan and red", [0.05, 0.65, 0.70], [0.80, 0.15, 0.10]),
];
const TOWER: (&str, Rgb, Rgb) = ("tower", [0.85, 0.08, 0.08], [0.85, 0.85, 0.85]);
const STREET: (&str, Rgb, Rgb) = ("street", [0.75, 0.75, 0.75], [0.15, 0.15, 0.55]);
const GROUND: (&str, Rgb, Rgb) = ("ground", [0.60, 0.60, 0.20], [0.15, 0.45, 0.15]);

/// Heights and widths of the buildings in metres, from the viewer on.
const LEFT: [(f32, f32); 12] = [
    (12.0, 18.0),
    (30.0, 22.0),
    (8.0, 14.0),
    (44.0, 20.0),
    (20.0, 24.0),
    (60.0, 18.0),
    (16.0, 16.0),
    (36.0, 22.0),
    (26.0, 20.0),
    (52.0, 18.0),
    (10.0, 24.0),
    (40.0, 16.0),
];
const RIGHT: [(f32, f32); 12] = [
    (24.0, 22.0),
    (8.0, 16.0),
    (50.0, 20.0),
    (16.0, 18.0),
    (38.0, 22.0),
    (12.0, 24.0),
    (60.0, 16.0),
    (22.0, 20.0),
    (46.0, 18.0),
    (14.0, 22.0),
    (34.0, 20.0),
    (54.0, 18.0),
];
/// Distance of the facades from the middle, distance of the first building, gaps, depth of the buildings: metres.
const FACADE: f32 = 14.0;
const FIRST: f32 = 20.0;
const GAP: f32 = 12.0;
const DEPTH: f32 = 16.0;

/// The scene as GLB.
pub(super) fn street() -> Vec<u8> {
    let mut glb = Glb::default();
    let glow = glb.checker("red and blue light", RED, BLUE);
    let checkered = |glb: &mut Glb, (name, a, b): (&str, Rgb, Rgb), emits: bool| {
        let texture = glb.checker(name, a, b);
        let emission = json!({"emissiveTexture": {"index": glow}, "emissiveFactor": [1, 1, 1]});
        let more = if emits { emission } else { json!({}) };
        glb.lambertian(name, json!({"baseColorTexture": {"index": texture}}), more)
    };
    let buildings = PALETTE.map(|colours| checkered(&mut glb, colours, true));
    let tower = checkered(&mut glb, TOWER, true);
    let street = checkered(&mut glb, STREET, true);
    let ground = checkered(&mut glb, GROUND, false);

    for (side, first_colour, sizes) in [("L", 0, LEFT), ("R", 3, RIGHT)] {
        let x = if side == "L" { -FACADE - DEPTH } else { FACADE };
        let mut near = FIRST;
        for (i, (height, width)) in sizes.into_iter().enumerate() {
            let (min, max) = ([x, 0.0, -(near + width)], [x + DEPTH, height, -near]);
            let material = buildings[(i + first_colour) % buildings.len()];
            block(&mut glb, &format!("b{side}{i:02}"), "building", material, min, max);
            near += width + GAP;
        }
    }
    block(&mut glb, "tower", "pole", tower, [-3.0, 0.0, -406.0], [3.0, 120.0, -400.0]);
    flat(&mut glb, "street", "road", street, [-8.0, 20.0], [8.0, -420.0]);
    flat(&mut glb, "groundL", "terrain", ground, [-1200.0, 1200.0], [-8.0, -1200.0]);
    flat(&mut glb, "groundR", "terrain", ground, [8.0, 1200.0], [1200.0, -1200.0]);
    flat(&mut glb, "groundF", "terrain", ground, [-8.0, 1200.0], [8.0, 20.0]);
    flat(&mut glb, "groundB", "terrain", ground, [-8.0, -420.0], [8.0, -1200.0]);
    glb.finish()
}

/// A building: a box without a floor.
fn block(glb: &mut Glb, name: &str, class: &str, material: usize, min: [f32; 3], max: [f32; 3]) {
    let mut quads = Quads::default();
    Quads::each_face(min, max, |o, u, v| quads.checkered(o, u, v, SQUARE));
    let mesh = glb.mesh(name, &quads, material);
    glb.node(name, class, mesh, None);
}

/// A rectangle at altitude 0 between two corners (x, z), z falling.
fn flat(glb: &mut Glb, name: &str, class: &str, material: usize, from: [f32; 2], to: [f32; 2]) {
    let mut quads = Quads::default();
    let (u, v) = ([to[0] - from[0], 0.0, 0.0], [0.0, 0.0, to[1] - from[1]]);
    quads.checkered([from[0], 0.0, from[1]], u, v, SQUARE);
    let mesh = glb.mesh(name, &quads, material);
    glb.node(name, class, mesh, None);
}
