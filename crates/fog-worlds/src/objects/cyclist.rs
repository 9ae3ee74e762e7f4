//! A bicycle and its rider.

use super::person::{self, Pose};
use crate::glb::{Glb, Shape};
use crate::lamp::colour;
use crate::mesh::Model;
use crate::noise::Chance;
use crate::paint::Paint;
use crate::place::{shift, sin_cos};
use crate::shapes::{ball, limb, ring, rod, rounded_box, tube};
use fog_core::Vec3;

/// Radius of a 28-inch wheel over the tyre, and half of the wheelbase.
const RADIUS: f32 = 0.34;
const HALF_BASE: f32 = 0.53;
/// Length of the cranks.
const CRANK: f32 = 0.17;

/// Shapes of a bicycle and of who rides it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Cyclist {
    pub(crate) bicycle: Shape,
    pub(crate) rider: Shape,
}

/// A cyclist in clothes, colour and pedal position by chance.
pub(crate) fn cyclist(glb: &mut Glb, seed: u64, index: u64) -> Cyclist {
    let mut chance = Chance::new(seed, "cyclist", index);
    let pedal = chance.between(0.0, 360.0);
    let bicycle = bicycle(glb, &mut chance, pedal);
    let look = person::look(glb, &mut chance);
    let shell = glb.material(&Paint::new("helmet", [0.6, 0.6, 0.58]).smooth(0.3));
    let mut model = Model::default();
    person::body(&mut model, look, &pose(pedal), chance.happens(0.6).then_some(shell));
    Cyclist {
        bicycle: glb.shape(&format!("bicycle {index}"), &bicycle),
        rider: glb.shape(&format!("rider {index}"), &model),
    }
}

/// Crank axle.
const BRACKET: Vec3 = Vec3::new(0.0, 0.29, 0.05);
const SADDLE: Vec3 = Vec3::new(0.0, 0.98, 0.26);
const BAR: Vec3 = Vec3::new(0.0, 1.02, -0.34);

fn foot(pedal: f32, k: usize) -> Vec3 {
    let (s, c) = sin_cos(pedal + 180.0 * k as f32);
    BRACKET + Vec3::new(if k == 0 { -0.12 } else { 0.12 }, CRANK * c, -CRANK * s)
}

fn pose(pedal: f32) -> Pose {
    let hip = SADDLE + Vec3::new(0.0, 0.10, 0.0);
    let neck = hip + Vec3::new(0.0, 0.45, -0.26);
    let mut pose = Pose { hip, neck, knees: [hip; 2], ankles: [hip; 2], elbows: [hip; 2], hands: [hip; 2] };
    for (k, side) in [(0, -1.0), (1, 1.0)] {
        pose.ankles[k] = foot(pedal, k) + Vec3::new(0.0, 0.08, 0.06);
        let joint = hip + Vec3::new(0.095 * side, -0.02, 0.0);
        // The knee lies before the way from hip to ankle, so that both bones have their length.
        let way = pose.ankles[k] - joint;
        let d = way.length().min(0.83);
        let h = (0.43f32 * 0.43 - 0.25 * d * d).max(0.0).sqrt();
        let before = Vec3::new(0.0, way.z, -way.y).normalize_or(Vec3::NEG_Z);
        let before = if before.z < 0.0 { before } else { -before };
        pose.knees[k] = joint + 0.5 * way + h * before;
        pose.hands[k] = BAR + Vec3::new(0.27 * side, 0.02, 0.06);
        pose.elbows[k] = 0.5 * (pose.hands[k] + neck + Vec3::new(0.2 * side, -0.1, 0.0))
            + Vec3::new(0.06 * side, -0.05, 0.04);
    }
    pose
}

fn bicycle(glb: &mut Glb, chance: &mut Chance, pedal: f32) -> Model {
    let frames = [[0.02, 0.02, 0.022], [0.30, 0.02, 0.02], [0.03, 0.08, 0.25], [0.5, 0.5, 0.5]];
    let k = chance.below(frames.len());
    let frame = glb.material(&Paint::new(&format!("bicycle frame {k}"), frames[k]).smooth(0.25));
    let tyre = glb.material(&Paint::new("tyre", [0.018, 0.018, 0.019]));
    let steel = glb.material(&Paint::new("chrome", [0.6, 0.6, 0.6]).metal(0.12));
    let (red, strongest) = colour::split(colour::RED);
    // Rear lamp of a bicycle: 2 cd over 10 cm².
    let rear =
        Paint::new("bicycle rear lamp", [0.35, 0.01, 0.01]).smooth(0.2).shining(red, strongest * 2.0 / 1e-3);
    let rear = glb.material(&rear);
    let mut model = Model::default();
    let (front, back) = (Vec3::new(0.0, RADIUS, -HALF_BASE), Vec3::new(0.0, RADIUS, HALF_BASE));
    for hub in [front, back] {
        let at = shift(0.0, hub.y, hub.z);
        model.add(tyre, &ring(RADIUS - 0.018, 0.018, 36, 8).placed(at));
        model.add(steel, &ring(RADIUS - 0.042, 0.011, 36, 6).placed(at));
        for spoke in 0..16 {
            let (s, c) = sin_cos(22.5 * spoke as f32);
            model.add(steel, &rod(hub, hub + (RADIUS - 0.04) * Vec3::new(0.0, s, c), 0.0018, 4));
        }
        model.add(steel, &limb(hub - Vec3::X * 0.06, hub + Vec3::X * 0.06, 0.02, 0.02, 8));
    }
    let head = Vec3::new(0.0, 0.86, -0.36);
    let seat = Vec3::new(0.0, 0.80, 0.215);
    model.add(frame, &tube(&[head, seat, BRACKET, head + Vec3::new(0.0, -0.10, -0.03)], 0.017, 10));
    for x in [-0.05, 0.05] {
        let aside = Vec3::X * x;
        model.add(frame, &tube(&[seat, back + aside, BRACKET], 0.010, 8));
        model.add(frame, &tube(&[head + Vec3::new(x * 0.6, -0.12, -0.035), front + aside], 0.012, 8));
    }
    model.add(steel, &tube(&[seat, SADDLE - Vec3::Y * 0.05], 0.013, 8));
    model.add(
        tyre,
        &rounded_box(SADDLE + Vec3::new(-0.08, -0.05, -0.15), SADDLE + Vec3::new(0.08, 0.0, 0.12), 0.024, 3),
    );
    let stem = BAR + Vec3::Z * 0.02;
    model.add(steel, &tube(&[head, stem], 0.013, 8));
    model.add(
        steel,
        &tube(&[BAR + Vec3::new(-0.29, 0.0, 0.08), BAR, BAR + Vec3::new(0.29, 0.0, 0.08)], 0.012, 8),
    );
    for k in 0..2 {
        let end = foot(pedal, k);
        let inner = BRACKET + Vec3::X * if k == 0 { -0.06 } else { 0.06 };
        model.add(steel, &tube(&[inner, end.with_x(inner.x)], 0.011, 8));
        model.add(
            tyre,
            &rounded_box(
                end + Vec3::new(-0.045, -0.012, -0.04),
                end + Vec3::new(0.045, 0.012, 0.04),
                0.01,
                2,
            ),
        );
    }
    model.add(steel, &ball(BRACKET + Vec3::X * 0.05, Vec3::new(0.006, 0.09, 0.09), 20));
    model.add(rear, &ball(Vec3::new(0.0, 0.72, 0.30), Vec3::new(0.025, 0.02, 0.015), 10));
    model
}
