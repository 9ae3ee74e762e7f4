//! Street lamps: a tapered pole with an arm and a flat LED head.

use crate::glb::{Glb, Shape};
use crate::lamp::{Lamp, colour};
use crate::mesh::Model;
use crate::paint::Paint;
use crate::place::Place;
use crate::shapes::{block, cylinder, rounded_box, tube};
use fog_core::Vec3;

/// Height of the light and reach of the arm towards −Z in metres.
pub(crate) const HEIGHT: f32 = 8.0;
const ARM: f32 = 1.6;
/// Size of the luminous window.
const WINDOW: [f32; 2] = [0.24, 0.5];

/// A street luminaire of about 8,000 lm, the usual order for 8 m poles; its cone is round, while real ones spread along the
/// street.
fn lamp() -> Lamp {
    Lamp {
        name: "street lamp".to_owned(),
        color: colour::HALOGEN,
        candela: 3_000.0,
        cone_deg: Some([30.0, 75.0]),
        table: None,
        // A disc of the window's area.
        radius_m: 0.195,
        source: "LED luminaire of warm white light, about 8 klm, in a round cone",
    }
}

/// Shape of a lamp whose arm reaches towards −Z.
pub(crate) fn street_lamp(glb: &mut Glb) -> Shape {
    let steel = glb.material(&Paint::new("galvanised steel", [0.45, 0.46, 0.46]).metal(0.5));
    let head = glb.material(&Paint::new("lamp head", [0.12, 0.125, 0.13]).smooth(0.4));
    let window = glb.material(&Paint::new("lamp window", [0.7, 0.7, 0.68]).smooth(0.2));
    let mut model = Model::default();
    model.add(steel, &cylinder(Vec3::ZERO, Vec3::Y * (HEIGHT - 0.4), 0.09, 0.05, 16));
    model.add(steel, &cylinder(Vec3::ZERO, Vec3::Y * 0.9, 0.11, 0.11, 16));
    let bend = Vec3::new(0.0, HEIGHT - 0.05, -0.35);
    model.add(
        steel,
        &tube(&[Vec3::Y * (HEIGHT - 0.45), bend, Vec3::new(0.0, HEIGHT + 0.08, -ARM + 0.3)], 0.04, 10),
    );
    let (min, max) = (Vec3::new(-0.16, HEIGHT, -ARM - 0.35), Vec3::new(0.16, HEIGHT + 0.11, -ARM + 0.32));
    model.add(head, &rounded_box(min, max, 0.04, 3));
    let (w, l) = (0.5 * WINDOW[0], 0.5 * WINDOW[1]);
    model.add(window, &block(Vec3::new(-w, HEIGHT - 0.01, -ARM - l), Vec3::new(w, HEIGHT + 0.01, -ARM + l)));
    glb.shape("street lamp", &model)
}

/// Puts a lamp into the scene.
pub(crate) fn put(glb: &mut Glb, shape: Shape, name: &str, place: Place) {
    glb.node(name, "street light", shape, place);
    let at = place.point(Vec3::new(0.0, HEIGHT - 0.04, -ARM));
    glb.lamp(
        &format!("{name}_light"),
        "street light",
        name,
        &lamp(),
        Place::at(at.x, at.y, at.z).aimed(Vec3::NEG_Y),
    );
}
