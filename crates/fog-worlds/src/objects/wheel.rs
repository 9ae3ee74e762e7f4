//! Wheels of cars and trucks.

use crate::mesh::{Mat, Model};
use crate::place::{shift, stretch, turn_y, turn_z};
use crate::shapes::{block, lathe};
use fog_core::Vec3;
use glam::Affine3A;

/// Materials of wheels.
#[derive(Clone, Copy, Debug)]
pub(crate) struct WheelSkin {
    pub(crate) tyre: Mat,
    pub(crate) rim: Mat,
    pub(crate) dark: Mat,
}

/// Adds a wheel whose axis is x, its outer side towards +x, or −x where `left`: middle, radius, width.
pub(crate) fn wheel(model: &mut Model, skin: WheelSkin, middle: Vec3, radius: f32, width: f32, left: bool) {
    let (r, h) = (radius, 0.5 * width);
    let rim = 0.66 * r;
    // The axis of the lathe becomes x.
    let side: Affine3A = if left { stretch(-1.0, 1.0, 1.0) } else { Affine3A::IDENTITY };
    let frame = shift(middle.x, middle.y, middle.z) * side * turn_z(-90.0);
    let tyre = [
        [rim, -0.92 * h],
        [0.93 * r, -h],
        [0.985 * r, -0.86 * h],
        [r, -0.6 * h],
        [r, 0.6 * h],
        [0.985 * r, 0.86 * h],
        [0.93 * r, h],
        [rim, 0.92 * h],
    ];
    model.add(skin.tyre, &lathe(&tyre, 28).placed(frame));
    model.add(
        skin.rim,
        &lathe(&[[rim, 0.92 * h], [0.9 * rim, 0.86 * h], [0.88 * rim, 0.5 * h]], 28).placed(frame),
    );
    model.add(skin.dark, &lathe(&[[0.89 * rim, 0.5 * h], [0.0, 0.5 * h]], 28).placed(frame));
    model.add(skin.dark, &lathe(&[[0.0, -0.9 * h], [rim, -0.9 * h]], 28).placed(frame));
    model.add(
        skin.rim,
        &lathe(&[[0.24 * rim, 0.5 * h], [0.22 * rim, 0.84 * h], [0.0, 0.86 * h]], 16).placed(frame),
    );
    let spoke =
        block(Vec3::new(-0.11 * rim, 0.52 * h, 0.1 * rim), Vec3::new(0.11 * rim, 0.82 * h, 0.9 * rim));
    for k in 0..5 {
        model.add(skin.rim, &spoke.clone().placed(frame * turn_y(72.0 * k as f32)));
    }
}
