//! The street of Kolářová et al. 2024, Sec. 6.1: bright checkered buildings left and right, a tower at the end.
//!
//! Y up, the street runs along −Z from the viewer at the origin. All surfaces are Lambertian, in squares of 2 m; every
//! square of buildings, tower and street also emits, red or blue, radiance 1: lighting by day leaves that out.

use crate::error::WorldError;
use crate::glb::{Glb, Sampling};
use crate::mesh::{Mat, Mesh, Model};
use crate::paint::Paint;
use crate::picture::Picture;
use crate::place::Place;
use fog_core::colour::Rgb;
use fog_core::{Vec2, Vec3};

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
pub(crate) fn street() -> Result<Vec<u8>, WorldError> {
    let mut glb = Glb::default();
    let glow = checker(&mut glb, "red and blue light", RED, BLUE)?;
    let checkered = |glb: &mut Glb, (name, a, b): (&str, Rgb, Rgb), emits: bool| {
        let texture = checker(glb, name, a, b)?;
        let paint = Paint::lambertian(name, [1.0; 3]).textured(texture);
        let glowing = Paint { emissive_texture: Some(glow), ..paint.clone().shining([1.0; 3], 1.0) };
        Ok::<_, WorldError>(glb.material(if emits { &glowing } else { &paint }))
    };
    let mut buildings = Vec::new();
    for colours in PALETTE {
        buildings.push(checkered(&mut glb, colours, true)?);
    }
    let tower = checkered(&mut glb, TOWER, true)?;
    let street = checkered(&mut glb, STREET, true)?;
    let ground = checkered(&mut glb, GROUND, false)?;

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
    Ok(glb.finish())
}

/// A texture of 2 × 2 squares, colour a at the upper left and lower right, b at the others.
fn checker(glb: &mut Glb, name: &str, a: Rgb, b: Rgb) -> Result<crate::glb::Tex, WorldError> {
    glb.texture(name, &Picture::from_pixels(2, vec![a, b, b, a]), Sampling::Squares)
}

/// A rectangle in squares, whose texture begins at its corner `o`.
fn squares(mesh: &mut Mesh, o: Vec3, u: Vec3, v: Vec3) {
    let repeats = |edge: Vec3| edge.abs().element_sum() / (2.0 * SQUARE);
    let (s, t) = (repeats(u), repeats(v));
    let corners = [
        (o, Vec2::ZERO),
        (o + u, Vec2::new(s, 0.0)),
        (o + u + v, Vec2::new(s, t)),
        (o + v, Vec2::new(0.0, t)),
    ];
    mesh.polygon(&corners);
}

/// A building: a box without a floor.
fn block(glb: &mut Glb, name: &str, class: &str, material: Mat, min: [f32; 3], max: [f32; 3]) {
    let [x0, y0, z0] = min;
    let [x1, y1, z1] = max;
    let (x, y, z) = (Vec3::X * (x1 - x0), Vec3::Y * (y1 - y0), Vec3::Z * (z1 - z0));
    let faces = [
        ([x0, y0, z1], x, y),
        ([x1, y0, z1], -z, y),
        ([x1, y0, z0], -x, y),
        ([x0, y0, z0], z, y),
        ([x0, y1, z1], x, -z),
    ];
    let mut model = Model::default();
    for (o, u, v) in faces {
        squares(model.part(material), Vec3::from(o), u, v);
    }
    let shape = glb.shape(name, &model);
    glb.node(name, class, shape, Place::at(0.0, 0.0, 0.0));
}

/// A rectangle at altitude 0 between two corners (x, z), z falling.
fn flat(glb: &mut Glb, name: &str, class: &str, material: Mat, from: [f32; 2], to: [f32; 2]) {
    let mut model = Model::default();
    let (u, v) = (Vec3::X * (to[0] - from[0]), Vec3::Z * (to[1] - from[1]));
    squares(model.part(material), Vec3::new(from[0], 0.0, from[1]), u, v);
    let shape = glb.shape(name, &model);
    glb.node(name, class, shape, Place::at(0.0, 0.0, 0.0));
}
