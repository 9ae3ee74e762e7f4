//! People: standing, walking, and riding a bicycle.

use crate::glb::Glb;
use crate::mesh::{Mat, Model};
use crate::noise::Chance;
use crate::paint::Paint;
use crate::place::{shift, sin_cos};
use crate::shapes::{Grid, ball, ball_part, limb, rounded_box};
use fog_core::Vec3;

/// Clothes and skin.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Look {
    pub(crate) skin: Mat,
    pub(crate) hair: Mat,
    pub(crate) top: Mat,
    pub(crate) trousers: Mat,
    pub(crate) shoes: Mat,
}

const SKINS: [[f32; 3]; 4] = [[0.55, 0.33, 0.23], [0.42, 0.23, 0.14], [0.24, 0.12, 0.07], [0.10, 0.05, 0.03]];
const HAIRS: [[f32; 3]; 4] =
    [[0.01, 0.008, 0.007], [0.05, 0.025, 0.012], [0.22, 0.14, 0.06], [0.3, 0.3, 0.3]];
const TOPS: [[f32; 3]; 8] = [
    [0.35, 0.03, 0.03],
    [0.03, 0.07, 0.22],
    [0.02, 0.02, 0.022],
    [0.55, 0.54, 0.50],
    [0.06, 0.14, 0.07],
    [0.45, 0.30, 0.05],
    [0.16, 0.16, 0.17],
    [0.25, 0.10, 0.22],
];
const TROUSERS: [[f32; 3]; 5] =
    [[0.02, 0.035, 0.09], [0.015, 0.015, 0.017], [0.10, 0.10, 0.11], [0.22, 0.17, 0.10], [0.05, 0.045, 0.03]];

/// Clothes by chance.
pub(crate) fn look(glb: &mut Glb, chance: &mut Chance) -> Look {
    let mut dyed = |what: &str, colours: &[[f32; 3]]| {
        let k = chance.below(colours.len());
        glb.material(&Paint::new(&format!("{what} {k}"), colours[k]))
    };
    let (skin, hair) = (dyed("skin", &SKINS), dyed("hair", &HAIRS));
    let (top, trousers) = (dyed("coat", &TOPS), dyed("trousers", &TROUSERS));
    Look { skin, hair, top, trousers, shoes: glb.material(&Paint::new("shoes", [0.03, 0.02, 0.016])) }
}

/// Where the joints are; front is −Z.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pose {
    pub(crate) hip: Vec3,
    pub(crate) neck: Vec3,
    /// Left and right: knee, ankle, elbow, hand.
    pub(crate) knees: [Vec3; 2],
    pub(crate) ankles: [Vec3; 2],
    pub(crate) elbows: [Vec3; 2],
    pub(crate) hands: [Vec3; 2],
}

/// A person of 1.75 m at a phase of the stride in degrees; `stride` 0 stands, 1 walks.
pub(crate) fn walking(phase_deg: f32, stride: f32) -> Pose {
    let swing = |offset: f32| stride * sin_cos(phase_deg + offset).0;
    let hip = Vec3::new(0.0, 0.93 - 0.03 * stride * swing(0.0).abs(), 0.0);
    let mut pose = Pose {
        hip,
        neck: hip + Vec3::new(0.0, 0.52, -0.03 * stride),
        knees: [hip; 2],
        ankles: [hip; 2],
        elbows: [hip; 2],
        hands: [hip; 2],
    };
    for (k, side) in [(0, -1.0), (1, 1.0)] {
        let forward = swing(180.0 * k as f32);
        // A leg behind the body bends more.
        let bend = if forward < 0.0 { -28.0 * forward } else { 8.0 * forward };
        let leg = |angle: f32, length: f32| {
            let (s, c) = sin_cos(angle);
            Vec3::new(0.0, -length * c, -length * s)
        };
        let hip_joint = hip + Vec3::new(0.095 * side, -0.02, 0.0);
        let thigh = 24.0 * forward + 0.3 * bend;
        pose.knees[k] = hip_joint + leg(thigh, 0.42);
        pose.ankles[k] = pose.knees[k] + leg(thigh - bend - 2.0, 0.41);
        let shoulder = pose.neck + Vec3::new(0.20 * side, -0.07, 0.0);
        let arm = -22.0 * forward;
        pose.elbows[k] = shoulder + leg(arm, 0.29) + Vec3::X * 0.05 * side;
        pose.hands[k] = pose.elbows[k] + leg(arm + 18.0 + 10.0 * stride, 0.26);
    }
    // The lower foot stands on the ground.
    let lowest = pose.ankles[0].y.min(pose.ankles[1].y) - 0.075;
    let down = Vec3::Y * lowest;
    pose.hip -= down;
    pose.neck -= down;
    for joints in [&mut pose.knees, &mut pose.ankles, &mut pose.elbows, &mut pose.hands] {
        joints.iter_mut().for_each(|j| *j -= down);
    }
    pose
}

/// Adds the body in a pose.
pub(crate) fn body(model: &mut Model, look: Look, pose: &Pose, helmet: Option<Mat>) {
    let Pose { hip, neck, knees, ankles, elbows, hands } = *pose;
    // Trunk: elliptic sections from the hips to the shoulders.
    let up = (neck - hip).normalize_or(Vec3::Y);
    let back = Vec3::X.cross(up);
    let length = (neck - hip).length();
    let sections = [
        (-0.12, 0.02, 0.02),
        (-0.11, 0.13, 0.10),
        (0.0, 0.175, 0.12),
        (0.35, 0.165, 0.115),
        (0.65, 0.195, 0.13),
        (0.85, 0.205, 0.115),
        (0.94, 0.16, 0.09),
        (1.0, 0.07, 0.06),
        (1.01, 0.02, 0.02),
    ];
    let ring = |&(t, a, b): &(f32, f32, f32)| {
        let at = |k: usize| {
            let (s, c) = sin_cos(18.0 * (k % 20) as f32);
            hip + up * (t * length) + Vec3::X * a * s + back * b * c
        };
        (0..=20).rev().map(at).collect()
    };
    model.add(look.top, &Grid::new(sections.iter().map(ring).collect()).mesh());
    for (k, side) in [(0, -1.0), (1, 1.0)] {
        let hip_joint = hip + Vec3::new(0.095 * side, -0.02, 0.0);
        model.add(look.trousers, &limb(hip_joint, knees[k], 0.098, 0.066, 14));
        model.add(look.trousers, &limb(knees[k], ankles[k], 0.064, 0.047, 14));
        let shoe = rounded_box(Vec3::new(-0.047, -0.07, -0.19), Vec3::new(0.047, 0.035, 0.085), 0.04, 3);
        model.add(look.shoes, &shoe.placed(shift(ankles[k].x, ankles[k].y, ankles[k].z)));
        let shoulder = neck + Vec3::X * 0.185 * side - up * 0.08;
        model.add(look.top, &limb(shoulder, elbows[k], 0.064, 0.05, 12));
        model.add(look.top, &limb(elbows[k], hands[k], 0.049, 0.036, 12));
        model.add(
            look.skin,
            &ball(hands[k] + (hands[k] - elbows[k]) * 0.16, Vec3::new(0.038, 0.065, 0.045), 10),
        );
    }
    model.add(look.skin, &limb(neck - up * 0.04, neck + Vec3::Y * 0.09, 0.056, 0.052, 12));
    let head = neck + Vec3::new(0.0, 0.185, -0.015);
    model.add(look.skin, &ball(head, Vec3::new(0.075, 0.112, 0.092), 18));
    model.add(look.skin, &ball(head + Vec3::new(0.0, -0.015, -0.092), Vec3::new(0.014, 0.02, 0.018), 8));
    match helmet {
        Some(shell) => {
            model.add(shell, &ball_part(head + Vec3::Y * 0.02, Vec3::new(0.098, 0.115, 0.128), 18, 2.0, 90.0))
        }
        None => {
            let cap = ball(head + Vec3::new(0.0, 0.026, 0.018), Vec3::new(0.083, 0.103, 0.094), 16);
            model.add(look.hair, &cap);
        }
    }
}

/// A pedestrian in clothes and a stride by chance: the model, 1.55 to 1.9 m high.
pub(crate) fn pedestrian(glb: &mut Glb, chance: &mut Chance, walks: bool) -> Model {
    let look = look(glb, chance);
    let stride = if walks { chance.between(0.75, 1.0) } else { 0.06 };
    let pose = walking(chance.between(0.0, 360.0), stride);
    let mut model = Model::default();
    body(&mut model, look, &pose, None);
    if chance.happens(0.35) {
        // A bag on the back.
        let bag = rounded_box(Vec3::new(-0.14, 0.0, 0.0), Vec3::new(0.14, 0.4, 0.15), 0.05, 3);
        let at = pose.hip + Vec3::new(0.0, 0.1, 0.1);
        model.add(look.trousers, &bag.placed(shift(at.x, at.y, at.z)));
    }
    let scale = chance.between(0.89, 1.08);
    let mut scaled = Model::default();
    scaled.join(&model, crate::place::stretch(scale, scale, scale));
    scaled
}
