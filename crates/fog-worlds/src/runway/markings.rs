//! Paint on the runway: AC 150/5340-1L (FAA 2013), for a precision instrument runway.
//!
//! Not verified against the circular's figures: the gap of 40 ft before the designator, the 20 ft between its letter and
//! number, the designator's line width of 5 ft.

use super::{End, FT, Runway, place};
use crate::font;
use crate::glb::Glb;
use crate::mesh::{Mat, Mesh, Model};
use crate::paint::Paint;
use crate::place::sin_cos;
use fog_core::{Vec2, Vec3};

/// Altitude of the paint over the asphalt.
const UP: f32 = 0.008;
/// Threshold stripes: from the threshold, length, width and gap.
const THRESHOLD: f32 = 20.0 * FT;
const STRIPE_LENGTH: f32 = 150.0 * FT;
const STRIPE_WIDTH: f32 = 5.75 * FT;
/// Designator: gap before it, height, line width, width of a digit, gap of letter and number, gap after it.
const DESIGNATOR_GAP: f32 = 40.0 * FT;
const DESIGNATOR_HEIGHT: f32 = 60.0 * FT;
const DESIGNATOR_LINE: f32 = 5.0 * FT;
const DIGIT_WIDTH: f32 = 20.0 * FT;
const LETTER_GAP: f32 = 20.0 * FT;
/// Centre line: stripe, gap, width.
const CENTRE_STRIPE: f32 = 120.0 * FT;
const CENTRE_GAP: f32 = 80.0 * FT;
const CENTRE_WIDTH: f32 = 3.0 * FT;
/// Aiming point: from the threshold, length, width, distance of the inner edges from the centre line.
pub(super) const AIMING_POINT: f32 = 1020.0 * FT;
const AIMING_LENGTH: f32 = 150.0 * FT;
const AIMING_WIDTH: f32 = 30.0 * FT;
const INNER: f32 = 36.0 * FT;
/// Touchdown zone: distance from the threshold in feet and bars a side; length, width, gap of the bars.
const TOUCHDOWN: [(f32, u32); 5] = [(500.0, 3), (1500.0, 2), (2000.0, 2), (2500.0, 1), (3000.0, 1)];
const BAR_LENGTH: f32 = 75.0 * FT;
const BAR_WIDTH: f32 = 6.0 * FT;
const BAR_GAP: f32 = 5.0 * FT;
/// Pairs of bars end this far before the runway's middle.
const CLEAR_OF_MIDDLE: f32 = 900.0 * FT;
const SIDE_WIDTH: f32 = 3.0 * FT;

/// Threshold stripes on both sides of the centre line by the runway's width.
fn stripes(width: f32) -> u32 {
    match width {
        w if w < 40.0 => 8,
        w if w < 50.0 => 12,
        _ => 16,
    }
}

/// All markings of both ends.
pub(super) fn markings(glb: &mut Glb, options: &Runway, designators: &[String; 2]) {
    let paint = glb.material(&Paint::new("white runway paint", [0.75, 0.75, 0.74]));
    let length = options.length_m;
    let mut designator_ends = [0.0; 2];
    for (k, (end, name)) in [(End::Near, "near"), (End::Far, "far")].into_iter().enumerate() {
        let mut node = |what: &str, mesh: Mesh| {
            let mut model = Model::default();
            model.add(paint, &mesh);
            let shape = glb.shape(what, &model);
            glb.node(&format!("{what}_{name}"), "runway marking", shape, end.place(length, 0.0, 0.0, UP));
        };
        node("threshold", threshold(options));
        let (mesh, top) = designator(&designators[k]);
        node("designator", mesh);
        designator_ends[k] = top;
        node("aiming_point", pairs(AIMING_POINT, AIMING_LENGTH, &[(INNER, AIMING_WIDTH)]));
        for (feet, bars) in TOUCHDOWN {
            let near = feet * FT;
            if near + BAR_LENGTH > 0.5 * length - CLEAR_OF_MIDDLE {
                continue;
            }
            let bars: Vec<(f32, f32)> =
                (0..bars).map(|i| (INNER + i as f32 * (BAR_WIDTH + BAR_GAP), BAR_WIDTH)).collect();
            node(&format!("touchdown_zone_{feet}"), pairs(near, BAR_LENGTH, &bars));
        }
    }
    lines(glb, options, paint, designator_ends);
}

/// Centre line and side stripes.
fn lines(glb: &mut Glb, options: &Runway, paint: Mat, designator_ends: [f32; 2]) {
    let length = options.length_m;
    let mut centre = Mesh::default();
    let (mut near, last) =
        (designator_ends[0] + DESIGNATOR_GAP, length - designator_ends[1] - DESIGNATOR_GAP);
    while near < last {
        let stripe = CENTRE_STRIPE.min(last - near);
        bar(&mut centre, near, -0.5 * CENTRE_WIDTH, CENTRE_WIDTH, stripe);
        near += CENTRE_STRIPE + CENTRE_GAP;
    }
    let mut sides = Mesh::default();
    for x in [-0.5 * options.width_m, 0.5 * options.width_m - SIDE_WIDTH] {
        bar(&mut sides, 0.0, x, SIDE_WIDTH, length);
    }
    for (name, mesh) in [("centre_line", centre), ("side_stripes", sides)] {
        let mut model = Model::default();
        model.add(paint, &mesh);
        let shape = glb.shape(name, &model);
        glb.node(name, "runway marking", shape, place(0.0, 0.0, UP, 0.0));
    }
}

/// A rectangle on the ground from `near` on, from `left` on.
pub(super) fn bar(mesh: &mut Mesh, near: f32, left: f32, width: f32, length: f32) {
    mesh.quad(Vec3::new(left, 0.0, -near), Vec3::X * width, Vec3::NEG_Z * length);
}

/// Bars on both sides, given by inner edge and width.
fn pairs(near: f32, length: f32, bars: &[(f32, f32)]) -> Mesh {
    let mut mesh = Mesh::default();
    for &(inner, width) in bars {
        bar(&mut mesh, near, inner, width, length);
        bar(&mut mesh, near, -inner - width, width, length);
    }
    mesh
}

fn threshold(options: &Runway) -> Mesh {
    let bars: Vec<(f32, f32)> = (0..stripes(options.width_m) / 2)
        .map(|i| (STRIPE_WIDTH + i as f32 * 2.0 * STRIPE_WIDTH, STRIPE_WIDTH))
        .collect();
    pairs(THRESHOLD, STRIPE_LENGTH, &bars)
}

/// Number and letter, and the distance of their upper end from the threshold.
fn designator(text: &str) -> (Mesh, f32) {
    let number = text.trim_end_matches(['L', 'C', 'R']);
    let mut near = THRESHOLD + STRIPE_LENGTH + DESIGNATOR_GAP;
    let mut mesh = Mesh::default();
    for row in [&text[number.len()..], number].into_iter().filter(|row| !row.is_empty()) {
        painted(&mut mesh, row, near);
        near += DESIGNATOR_HEIGHT + LETTER_GAP;
    }
    (mesh, near - LETTER_GAP)
}

/// A row of letters whose feet are at `near`.
fn painted(mesh: &mut Mesh, row: &str, near: f32) {
    let (lines, width) = font::lines(row);
    // The alphabet's digits are 4.4 of its units wide, centre lines half a line inside.
    let half = 0.5 * DESIGNATOR_LINE;
    let across = DIGIT_WIDTH / 4.4;
    let upward = (DESIGNATOR_HEIGHT - DESIGNATOR_LINE) / 6.0;
    let point = |[x, y]: [f32; 2]| Vec2::new(across * (x - 0.5 * width), near + half + upward * (y - 0.5));
    let on_ground = |p: Vec2| (Vec3::new(p.x, 0.0, -p.y), Vec2::ZERO);
    for line in lines {
        for pair in line.windows(2) {
            let (a, b) = (point(pair[0]), point(pair[1]));
            let side = half * (b - a).normalize_or(Vec2::Y).perp();
            mesh.polygon(&[a - side, b - side, b + side, a + side].map(on_ground));
        }
        // Joints inside a line are round.
        for &joint in line.iter().skip(1).take(line.len().saturating_sub(2)) {
            let centre = point(joint);
            let rim: Vec<_> = (0..12)
                .map(|k| {
                    let (s, c) = sin_cos(30.0 * k as f32);
                    on_ground(centre + half * Vec2::new(c, s))
                })
                .collect();
            mesh.polygon(&rim);
        }
    }
}
