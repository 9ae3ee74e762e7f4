//! Passenger cars: a saloon, a hatchback, an SUV and a van.

use super::body::Body;
use super::vehicle::{Finish, Vehicle, finish};
use super::wheel::wheel;
use crate::glb::Glb;
use crate::mesh::Model;
use crate::place::shift;
use crate::shapes::{ball, block, rounded_box};
use fog_core::Vec3;

/// A kind of car.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Kind {
    Saloon,
    Hatchback,
    Suv,
    Van,
}

pub(crate) const KINDS: [Kind; 4] = [Kind::Saloon, Kind::Hatchback, Kind::Suv, Kind::Van];

impl Kind {
    fn name(self) -> &'static str {
        match self {
            Self::Saloon => "saloon",
            Self::Hatchback => "hatchback",
            Self::Suv => "suv",
            Self::Van => "van",
        }
    }

    fn body(self) -> Body {
        match self {
            Self::Saloon => SALOON,
            Self::Hatchback => HATCHBACK,
            Self::Suv => SUV,
            Self::Van => VAN,
        }
    }
}

/// A saloon: bonnet, cabin, boot.
const SALOON: Body = Body {
    length: 4.65,
    width: 1.82,
    top: &[
        [0.0, 0.66],
        [0.06, 0.71],
        [0.3, 0.80],
        [0.9, 0.90],
        [1.38, 0.965],
        [1.5, 1.01],
        [2.1, 1.35],
        [2.45, 1.43],
        [2.9, 1.45],
        [3.3, 1.41],
        [3.6, 1.31],
        [4.05, 1.10],
        [4.2, 1.06],
        [4.5, 1.03],
        [4.6, 1.0],
        [4.65, 0.95],
    ],
    belt: &[[0.0, 0.62], [0.3, 0.74], [1.3, 0.87], [2.0, 0.90], [3.4, 0.95], [4.2, 0.98], [4.65, 0.90]],
    sill: 0.20,
    axles: [0.88, 3.58],
    wheel_radius: 0.325,
    windscreen: [1.44, 2.16],
    rear_window: [3.34, 4.02],
    windows: &[[1.72, 2.46], [2.54, 3.32], [3.36, 3.62]],
    gaps: &[1.5, 2.5, 3.35],
    roof: 0.66,
    nose: 0.74,
    tail: 0.80,
};

/// A hatchback.
const HATCHBACK: Body = Body {
    length: 4.15,
    width: 1.78,
    top: &[
        [0.0, 0.68],
        [0.06, 0.74],
        [0.3, 0.84],
        [0.8, 0.95],
        [1.12, 1.01],
        [1.25, 1.06],
        [1.85, 1.40],
        [2.2, 1.48],
        [2.7, 1.50],
        [3.3, 1.47],
        [3.65, 1.41],
        [3.95, 1.17],
        [4.08, 1.02],
        [4.15, 0.92],
    ],
    belt: &[[0.0, 0.64], [0.3, 0.77], [1.1, 0.92], [1.8, 0.95], [3.2, 1.00], [3.9, 1.02], [4.15, 0.86]],
    sill: 0.20,
    axles: [0.82, 3.42],
    wheel_radius: 0.315,
    windscreen: [1.18, 1.92],
    rear_window: [3.68, 3.99],
    windows: &[[1.5, 2.28], [2.36, 3.1], [3.16, 3.55]],
    gaps: &[1.25, 2.32, 3.12],
    roof: 0.68,
    nose: 0.74,
    tail: 0.82,
};

/// A tall car with a steep tail.
const SUV: Body = Body {
    length: 4.6,
    width: 1.9,
    top: &[
        [0.0, 0.82],
        [0.06, 0.90],
        [0.3, 1.00],
        [0.9, 1.08],
        [1.3, 1.13],
        [1.42, 1.18],
        [2.0, 1.55],
        [2.35, 1.65],
        [2.9, 1.68],
        [3.7, 1.65],
        [4.15, 1.59],
        [4.42, 1.30],
        [4.54, 1.12],
        [4.6, 1.0],
    ],
    belt: &[[0.0, 0.78], [0.3, 0.92], [1.3, 1.05], [2.0, 1.07], [3.6, 1.12], [4.3, 1.14], [4.6, 0.95]],
    sill: 0.26,
    axles: [0.9, 3.58],
    wheel_radius: 0.36,
    windscreen: [1.36, 2.08],
    rear_window: [4.18, 4.46],
    windows: &[[1.68, 2.44], [2.53, 3.3], [3.38, 4.0]],
    gaps: &[1.42, 2.48, 3.34],
    roof: 0.70,
    nose: 0.78,
    tail: 0.84,
};

/// A van: panels behind the front doors.
const VAN: Body = Body {
    length: 5.3,
    width: 1.98,
    top: &[
        [0.0, 0.86],
        [0.05, 0.96],
        [0.25, 1.08],
        [0.6, 1.20],
        [0.78, 1.30],
        [1.3, 1.80],
        [1.65, 1.97],
        [2.2, 2.02],
        [3.5, 2.03],
        [4.9, 2.0],
        [5.15, 1.92],
        [5.26, 1.6],
        [5.3, 1.1],
    ],
    belt: &[[0.0, 0.82], [0.3, 1.00], [0.8, 1.14], [1.6, 1.18], [4.8, 1.2], [5.3, 1.0]],
    sill: 0.24,
    axles: [0.98, 4.08],
    wheel_radius: 0.345,
    windscreen: [0.70, 1.45],
    rear_window: [5.16, 5.27],
    windows: &[[1.2, 2.0]],
    gaps: &[1.05, 2.1, 3.5],
    roof: 0.80,
    nose: 0.78,
    tail: 0.90,
};

/// A car of a kind and colour, its lamps lit or not.
pub(crate) fn car(glb: &mut Glb, kind: Kind, colour_index: usize, lit: bool) -> Vehicle {
    let body = kind.body();
    let finish = finish(glb, colour_index, lit);
    let mut model = Model::default();
    body.build(&mut model, finish.skin);
    let half = 0.5 * body.length;
    let track = 0.5 * body.width - 0.115;
    for axle in body.axles {
        for (x, left) in [(-track, true), (track, false)] {
            let middle = Vec3::new(x, body.wheel_radius, axle - half);
            wheel(&mut model, finish.wheels, middle, body.wheel_radius, 0.21, left);
        }
    }
    let (head_lamp, plates) = front_and_rear(&mut model, &body, &finish);
    sides(&mut model, &body, &finish);
    let state = if lit { "lit" } else { "dark" };
    let shape = glb.shape(&format!("{} {colour_index}, {state}", kind.name()), &model);
    Vehicle { class: "car", shape, length: body.length, head_lamp, plates, lit }
}

/// Lamps, grille, bumpers; the place of the right head lamp's lens and of the plates.
fn front_and_rear(model: &mut Model, body: &Body, finish: &Finish) -> (Vec3, [Vec3; 2]) {
    let (w, half) = (0.5 * body.width, 0.5 * body.length);
    let nose = super::body::along(body.top, 0.02);
    let tail = super::body::along(body.belt, body.length - 0.2);
    // Head lamps sit in the shoulder, where nose and side meet.
    let s = 0.17;
    let corner = body.on_side(s, 4.6);
    let lamp = Vec3::new(corner.x - 0.09, corner.y - 0.03, s - half);
    let head = ball(Vec3::ZERO, Vec3::new(0.19, 0.07, 0.17), 20)
        .placed(shift(lamp.x, lamp.y, lamp.z - 0.02) * crate::place::turn_y(-28.0));
    model.add(finish.head, &head.mirrored());
    let turn = ball(Vec3::new(lamp.x + 0.11, lamp.y - 0.01, lamp.z + 0.07), Vec3::new(0.06, 0.045, 0.09), 12);
    model.add(finish.amber, &turn.mirrored());
    // Grille and lower intake, hardly proud of the nose.
    let mid = 0.5 * (body.sill + nose);
    let grille = |x: f32, low: f32, high: f32| {
        rounded_box(Vec3::new(-x, low, -half - 0.012), Vec3::new(x, high, -half + 0.1), 0.012, 2)
    };
    model.add(finish.skin.trim, &grille(0.52 * w, mid + 0.02, mid + 0.125));
    model.add(finish.skin.trim, &grille(0.58 * w, mid - 0.145, mid - 0.045));
    model.add(
        finish.chrome,
        &block(Vec3::new(-0.5 * w, mid + 0.068, -half - 0.016), Vec3::new(0.5 * w, mid + 0.078, -half)),
    );
    let badge = ball(Vec3::new(0.0, mid + 0.073, -half - 0.012), Vec3::new(0.05, 0.05, 0.012), 12);
    model.add(finish.chrome, &badge);
    // Tail lamps around the corners of the tail.
    let s = body.length - 0.1;
    let corner = body.on_side(s, 4.3);
    let lamp_rear = Vec3::new(corner.x - 0.08, corner.y - 0.03, s - half);
    let red = ball(Vec3::ZERO, Vec3::new(0.15, 0.085, 0.095), 20)
        .placed(shift(lamp_rear.x + 0.01, lamp_rear.y, lamp_rear.z + 0.03) * crate::place::turn_y(20.0));
    model.add(finish.tail, &red.mirrored());
    let bumper = 0.5 * (body.sill + tail) - 0.12;
    let valance = rounded_box(
        Vec3::new(-0.62 * w, bumper - 0.07, half - 0.1),
        Vec3::new(0.62 * w, bumper + 0.04, half + 0.014),
        0.012,
        2,
    );
    model.add(finish.skin.trim, &valance);
    let reflector = block(
        Vec3::new(0.5 * w, bumper + 0.06, half - 0.05),
        Vec3::new(0.66 * w, bumper + 0.085, half + 0.006),
    );
    model.add(finish.tail, &reflector.mirrored());
    let plates = [
        Vec3::new(0.0, mid - 0.04, -half - 0.016),
        Vec3::new(0.0, 0.5 * (bumper + tail) + 0.05, half + 0.006),
    ];
    (Vec3::new(lamp.x, lamp.y, lamp.z - 0.19), plates)
}

/// Mirrors and door handles.
fn sides(model: &mut Model, body: &Body, finish: &Finish) {
    let half = 0.5 * body.length;
    let first = body.windows[0][0];
    let base = body.on_side(first, 6.2);
    let mirror =
        ball(Vec3::new(base.x + 0.12, base.y + 0.05, first + 0.1 - half), Vec3::new(0.11, 0.075, 0.07), 16);
    model.add(finish.skin.paint, &mirror.mirrored());
    let stalk = block(
        Vec3::new(base.x - 0.03, base.y - 0.01, first + 0.06 - half),
        Vec3::new(base.x + 0.08, base.y + 0.03, first + 0.12 - half),
    );
    model.add(finish.skin.trim, &stalk.mirrored());
    for &gap in body.gaps.iter().skip(1) {
        let at = body.on_side(gap - 0.16, 3.9);
        let handle = rounded_box(Vec3::new(-0.02, -0.012, -0.09), Vec3::new(0.025, 0.012, 0.09), 0.01, 2);
        model.add(finish.chrome, &handle.placed(shift(at.x, at.y, at.z)).mirrored());
    }
}
