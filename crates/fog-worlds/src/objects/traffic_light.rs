//! Traffic lights: three lenses of 200 mm on a pole (EN 12368: 200 cd on the axis, performance level 2, from general
//! knowledge).

use crate::glb::{Glb, Shape};
use crate::lamp::colour;
use crate::mesh::Model;
use crate::paint::Paint;
use crate::place::shift;
use crate::shapes::{ball_part, cylinder, lathe, rounded_box};
use fog_core::Vec3;

/// Which lens is lit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Signal {
    Red,
    Green,
}

/// Diameter of a lens and its luminous intensity.
const LENS: f32 = 0.2;
const CANDELA: f32 = 200.0;
/// Height of the lowest lens.
const LOWEST: f32 = 2.4;

/// A traffic light on its pole, its lenses towards −Z.
pub(crate) fn traffic_light(glb: &mut Glb, signal: Signal) -> Shape {
    let black = glb.material(&Paint::new("signal housing", [0.015, 0.015, 0.016]).smooth(0.5));
    let steel = glb.material(&Paint::new("galvanised steel", [0.45, 0.46, 0.46]).metal(0.5));
    let mut model = Model::default();
    model.add(steel, &cylinder(Vec3::ZERO, Vec3::Y * (LOWEST + 0.9), 0.06, 0.055, 14));
    let (min, max) = (Vec3::new(-0.17, LOWEST - 0.17, -0.24), Vec3::new(0.17, LOWEST + 0.77, -0.06));
    model.add(black, &rounded_box(min, max, 0.04, 3));
    // A back plate around the housing.
    let plate =
        rounded_box(Vec3::new(-0.3, LOWEST - 0.3, -0.10), Vec3::new(0.3, LOWEST + 0.9, -0.085), 0.006, 2);
    model.add(black, &plate);
    let radius = 0.5 * LENS;
    let luminance = CANDELA / (core::f32::consts::PI * radius * radius);
    for (k, (name, rgb, lit)) in [
        ("green", colour::GREEN, signal == Signal::Green),
        ("amber", colour::YELLOW, false),
        ("red", colour::RED, signal == Signal::Red),
    ]
    .into_iter()
    .enumerate()
    {
        let (rgb, strongest) = colour::split(rgb);
        let dark = Paint::new(&format!("signal {name}, dark"), rgb.map(|c| 0.01 + 0.05 * c)).smooth(0.2);
        let paint = if lit {
            Paint { name: format!("signal {name}, lit"), ..dark }.shining(rgb, luminance * strongest)
        } else {
            dark
        };
        let lens = glb.material(&paint);
        let y = LOWEST + 0.3 * k as f32;
        let forward = shift(0.0, y, -0.235) * crate::place::turn_x(-90.0);
        model.add(
            lens,
            &ball_part(Vec3::ZERO, Vec3::new(radius, 0.025, radius), 20, 0.0, 90.0).placed(forward),
        );
        // The visor: a tube open below, made double by its inner face.
        let tube = lathe(&[[radius + 0.012, 0.0], [radius + 0.008, 0.16]], 20);
        let inside = lathe(&[[radius + 0.006, 0.16], [radius + 0.010, 0.0]], 20);
        model.add(black, &tube.placed(forward));
        model.add(black, &inside.placed(forward));
    }
    glb.shape(if signal == Signal::Red { "traffic light, red" } else { "traffic light, green" }, &model)
}
