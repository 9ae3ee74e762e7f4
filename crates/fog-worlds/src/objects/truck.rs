//! A box truck and a city bus.

use super::vehicle::{Finish, Vehicle, finish};
use super::wheel::wheel;
use crate::glb::Glb;
use crate::mesh::Model;
use crate::paint::Paint;
use crate::shapes::{ball, block, limb, rounded_box};
use fog_core::Vec3;

/// Box truck: length, width, height of the box (European limits of 1996/53/EC: 12 m, 2.55 m, 4 m), wheel radius.
const LENGTH: f32 = 8.4;
const WIDTH: f32 = 2.5;
const BOX_TOP: f32 = 3.6;
const RADIUS: f32 = 0.48;
/// Back of the cab.
const CAB: f32 = 2.0;
const BUS_LENGTH: f32 = 12.0;
const BUS_HEIGHT: f32 = 3.1;

/// The side of a box as a dark pane, from `z0` to `z1` and `y0` to `y1`, proud of `x` by 1 cm, on both sides.
fn side_pane(model: &mut Model, finish: &Finish, x: f32, [z0, z1]: [f32; 2], [y0, y1]: [f32; 2]) {
    let pane = rounded_box(Vec3::new(x - 0.03, y0, z0), Vec3::new(x + 0.012, y1, z1), 0.012, 2);
    model.add(finish.skin.glass, &pane.mirrored());
}

/// Lamps on a flat front and back; the place of the right head lamp's lens.
fn lamps(model: &mut Model, finish: &Finish, half_length: f32, x: f32, [front_y, rear_y]: [f32; 2]) -> Vec3 {
    let head = ball(Vec3::new(x, front_y, -half_length), Vec3::new(0.17, 0.11, 0.06), 16);
    model.add(finish.head, &head.mirrored());
    let turn =
        ball(Vec3::new(x + 0.12, front_y - 0.16, -half_length + 0.03), Vec3::new(0.08, 0.05, 0.06), 12);
    model.add(finish.amber, &turn.mirrored());
    let tail = rounded_box(
        Vec3::new(x - 0.22, rear_y - 0.07, half_length - 0.03),
        Vec3::new(x + 0.15, rear_y + 0.07, half_length + 0.02),
        0.02,
        2,
    );
    model.add(finish.tail, &tail.mirrored());
    Vec3::new(x, front_y, -half_length - 0.06)
}

fn mirrors(model: &mut Model, finish: &Finish, x: f32, y: f32, z: f32) {
    let housing =
        rounded_box(Vec3::new(x + 0.1, y - 0.22, z - 0.06), Vec3::new(x + 0.32, y + 0.22, z + 0.06), 0.04, 3);
    model.add(finish.skin.trim, &housing.mirrored());
    let arm = limb(Vec3::new(x - 0.05, y + 0.15, z + 0.1), Vec3::new(x + 0.2, y + 0.18, z), 0.02, 0.02, 8);
    model.add(finish.skin.trim, &arm.mirrored());
}

/// The cab of a truck whose front is at z = `front`.
fn cab(model: &mut Model, finish: &Finish, front: f32) {
    let w = 0.5 * WIDTH;
    // Cab: lower body, upper body a little narrower, roof.
    let cab_back = front + CAB;
    model.add(
        finish.skin.paint,
        &rounded_box(Vec3::new(-w + 0.05, 0.55, front), Vec3::new(w - 0.05, 1.75, cab_back), 0.14, 5),
    );
    model.add(
        finish.skin.paint,
        &rounded_box(Vec3::new(-w + 0.1, 1.45, front + 0.07), Vec3::new(w - 0.1, 2.85, cab_back), 0.22, 5),
    );
    let deflector = ball(Vec3::new(0.0, 2.75, cab_back - 0.25), Vec3::new(0.95, 0.55, 1.0), 20);
    model.add(finish.skin.paint, &deflector);
    let screen = rounded_box(
        Vec3::new(-w + 0.22, 1.62, front + 0.045),
        Vec3::new(w - 0.22, 2.55, front + 0.3),
        0.1,
        4,
    );
    model.add(finish.skin.glass, &screen);
    side_pane(model, finish, w - 0.1, [front + 0.35, front + 1.25], [1.65, 2.4]);
    // Grille, bumper, steps.
    model.add(
        finish.skin.trim,
        &rounded_box(Vec3::new(-0.75, 0.85, front - 0.015), Vec3::new(0.75, 1.4, front + 0.2), 0.04, 3),
    );
    for k in 0..4 {
        let y = 0.93 + 0.12 * k as f32;
        model
            .add(finish.chrome, &block(Vec3::new(-0.68, y, front - 0.022), Vec3::new(0.68, y + 0.03, front)));
    }
    model.add(
        finish.skin.trim,
        &rounded_box(
            Vec3::new(-w + 0.03, 0.32, front - 0.05),
            Vec3::new(w - 0.03, 0.7, front + 0.5),
            0.07,
            3,
        ),
    );
    mirrors(model, finish, w - 0.1, 2.15, front + 0.22);
}

/// A truck with a closed box behind its cab.
pub(crate) fn truck(glb: &mut Glb, colour_index: usize, lit: bool) -> Vehicle {
    let finish = finish(glb, colour_index, lit);
    let cargo = glb.material(&Paint::new("truck box", [0.66, 0.66, 0.64]).smooth(0.5));
    let (w, half) = (0.5 * WIDTH, 0.5 * LENGTH);
    let front = -half;
    let mut model = Model::default();
    cab(&mut model, &finish, front);
    // Box, frame, guards.
    let box_front = front + CAB + 0.2;
    model.add(
        cargo,
        &rounded_box(Vec3::new(-w, 1.05, box_front), Vec3::new(w, BOX_TOP, half - 0.02), 0.03, 2),
    );
    model.add(
        finish.skin.trim,
        &block(Vec3::new(-0.45, 0.65, front + 0.6), Vec3::new(0.45, 1.06, half - 0.1)),
    );
    let rail = block(Vec3::new(w - 0.06, 0.5, box_front + 1.0), Vec3::new(w - 0.02, 0.75, half - 2.9));
    model.add(cargo, &rail.mirrored());
    model.add(
        finish.skin.trim,
        &block(Vec3::new(-w + 0.1, 0.45, half - 0.16), Vec3::new(w - 0.1, 0.6, half - 0.06)),
    );
    for x in [-0.02, 0.02] {
        model.add(
            finish.skin.trim,
            &block(
                Vec3::new(x - 0.006, 1.15, half - 0.02),
                Vec3::new(x + 0.006, BOX_TOP - 0.1, half - 0.012),
            ),
        );
    }
    let head_lamp = lamps(&mut model, &finish, half - 0.02, 0.9, [0.8, 0.92]);
    for (axle, double) in [(front + 1.35, false), (half - 2.2, true)] {
        let width = if double { 0.55 } else { 0.3 };
        for (x, left) in [(-w + 0.5 * width + 0.04, true), (w - 0.5 * width - 0.04, false)] {
            wheel(&mut model, finish.wheels, Vec3::new(x, RADIUS, axle), RADIUS, width, left);
        }
        let fender = rounded_box(
            Vec3::new(w - 0.62, 0.98, axle - 0.62),
            Vec3::new(w - 0.02, 1.06, axle + 0.62),
            0.03,
            2,
        );
        model.add(finish.skin.trim, &fender.mirrored());
    }
    let state = if lit { "lit" } else { "dark" };
    let shape = glb.shape(&format!("truck {colour_index}, {state}"), &model);
    let plates = [Vec3::new(0.0, 0.5, -half - 0.056), Vec3::new(0.0, 0.83, half + 0.0)];
    Vehicle { class: "truck", shape, length: LENGTH, head_lamp, plates, lit }
}

/// A city bus.
pub(crate) fn bus(glb: &mut Glb, colour_index: usize, lit: bool) -> Vehicle {
    let finish = finish(glb, colour_index, lit);
    let (w, half) = (0.5 * WIDTH, 0.5 * BUS_LENGTH);
    let mut model = Model::default();
    model.add(
        finish.skin.paint,
        &rounded_box(Vec3::new(-w, 0.32, -half), Vec3::new(w, BUS_HEIGHT, half), 0.16, 5),
    );
    model.add(
        finish.skin.trim,
        &rounded_box(
            Vec3::new(-w - 0.01, 0.28, -half - 0.02),
            Vec3::new(w + 0.01, 0.5, half + 0.02),
            0.08,
            3,
        ),
    );
    let screen =
        rounded_box(Vec3::new(-w + 0.1, 1.15, -half - 0.03), Vec3::new(w - 0.1, 2.55, -half + 0.3), 0.14, 4);
    model.add(finish.skin.glass, &screen);
    let rear =
        rounded_box(Vec3::new(-w + 0.25, 1.6, half - 0.3), Vec3::new(w - 0.25, 2.5, half + 0.02), 0.1, 3);
    model.add(finish.skin.glass, &rear);
    for k in 0..7 {
        let z = -half + 0.35 + 1.62 * k as f32;
        side_pane(&mut model, &finish, w, [z, z + 1.52], [1.35, 2.5]);
    }
    // Doors on the right: panes down to the floor.
    for z in [-half + 0.4, -0.6] {
        let door = rounded_box(Vec3::new(w - 0.03, 0.42, z), Vec3::new(w + 0.016, 2.45, z + 1.2), 0.014, 2);
        model.add(finish.skin.glass, &door);
    }
    let sign = block(Vec3::new(-0.8, 2.62, -half - 0.012), Vec3::new(0.8, 2.86, -half));
    model.add(finish.skin.trim, &sign);
    mirrors(&mut model, &finish, w - 0.05, 2.3, -half - 0.05);
    let head_lamp = lamps(&mut model, &finish, half, 0.9, [0.75, 1.0]);
    for axle in [-half + 2.7, half - 3.4] {
        for (x, left) in [(-w + 0.16, true), (w - 0.16, false)] {
            wheel(&mut model, finish.wheels, Vec3::new(x, RADIUS, axle), RADIUS, 0.35, left);
        }
    }
    let state = if lit { "lit" } else { "dark" };
    let shape = glb.shape(&format!("bus {colour_index}, {state}"), &model);
    let plates = [Vec3::new(0.0, 0.42, -half - 0.03), Vec3::new(0.0, 0.8, half + 0.004)];
    Vehicle { class: "bus", shape, length: BUS_LENGTH, head_lamp, plates, lit }
}
