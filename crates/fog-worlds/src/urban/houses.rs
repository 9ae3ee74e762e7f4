//! Rows of houses along both streets.

use super::{ASIDE, BEHIND, FRONT, KERB, Plan, at};
use crate::error::WorldError;
use crate::glb::Glb;
use crate::noise::Chance;
use crate::objects::facade::Facades;

const DEPTH: f32 = 12.0;
/// Widths of houses: least and greatest.
const WIDTHS: [f32; 2] = [11.0, 19.0];

pub(super) fn houses(glb: &mut Glb, plan: &Plan<'_>) -> Result<(), WorldError> {
    let facades = Facades::new(glb, plan.seed)?;
    let mut n = 0u64;
    let mut put = |glb: &mut Glb, width: f32, sides: [bool; 4], place: crate::place::Place| {
        let mut chance = Chance::new(plan.seed, "house", n);
        let storeys = 3 + chance.below(4);
        let name = format!("house_{n:02}");
        let shape = facades.building(glb, &mut chance, &name, [width, DEPTH], storeys, sides);
        glb.node(&name, "building", shape, place);
        n += 1;
    };
    let corner = plan.crossing + FRONT + 0.5;
    let far_corner = plan.crossing - FRONT - 0.5;
    for side in [1.0f32, -1.0] {
        // A house on the right fronts to the west: heading −90; its width runs along z.
        let heading = -90.0 * side;
        for (near, far) in [(BEHIND, corner), (far_corner, plan.end)] {
            let spans = divide(plan, near, far, side);
            let last = spans.len() - 1;
            for (k, [z0, z1]) in spans.into_iter().enumerate() {
                let at_crossing = (far == corner && k == last) || (near == far_corner && k == 0);
                // The side that looks at the crossing street: seen from the front, right or left.
                let towards_end = near == far_corner;
                let right = (side > 0.0) != towards_end;
                let sides = [true, at_crossing && !right, false, at_crossing && right];
                put(glb, z0 - z1, sides, at(side * (FRONT + 0.3), KERB, 0.5 * (z0 + z1), heading));
            }
        }
        // Along the crossing street, behind the corner houses.
        for (z, heading) in [(corner, 180.0), (far_corner, 0.0)] {
            let front_z = if heading == 180.0 { z - 0.2 } else { z + 0.2 };
            let from = FRONT + DEPTH + 1.0;
            for k in 0..3 {
                let width = (ASIDE - from) / 3.0;
                let x = side * (from + width * (k as f32 + 0.5));
                put(glb, width, [true, false, false, false], at(x, KERB, front_z, heading + 180.0));
            }
        }
    }
    // A house closes the far end.
    put(glb, 2.0 * FRONT + 8.0, [true, false, false, false], at(0.0, 0.0, plan.end - 6.0, 180.0));
    Ok(())
}

/// Divides a side of the street into widths of houses.
fn divide(plan: &Plan<'_>, near: f32, far: f32, side: f32) -> Vec<[f32; 2]> {
    let length = near - far;
    let mut chance = Chance::new(plan.seed, "plots", (near.abs() * 8.0) as u64 + u64::from(side > 0.0));
    let mut widths = Vec::new();
    while widths.iter().sum::<f32>() < length {
        widths.push(chance.between(WIDTHS[0], WIDTHS[1]));
    }
    let scale = length / widths.iter().sum::<f32>();
    let mut z = near;
    widths
        .into_iter()
        .map(|w| {
            let span = [z, z - w * scale];
            z = span[1];
            span
        })
        .collect()
}
