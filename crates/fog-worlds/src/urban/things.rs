//! Lamps, trees, signs and traffic lights.

use super::{BEHIND, FRONT, KERB, Plan, ROAD, at};
use crate::error::WorldError;
use crate::glb::Glb;
use crate::noise::Chance;
use crate::objects::traffic_light::{Signal, traffic_light};
use crate::objects::{street_lamp, tree};
use crate::signs::{self, Sign, Style};

/// Distance between lamps of one side; lamps and trees stand this far behind the kerb.
const LAMP_STEP: f32 = 30.0;
const BEHIND_KERB: f32 = 0.6;

pub(super) fn things(glb: &mut Glb, plan: &Plan<'_>) -> Result<(), WorldError> {
    lamps_and_trees(glb, plan);
    traffic_lights(glb, plan);
    put_signs(glb, plan)
}

fn lamps_and_trees(glb: &mut Glb, plan: &Plan<'_>) {
    let lamp = street_lamp::street_lamp(glb);
    let trees: Vec<_> = (0..3).map(|k| tree::tree(glb, plan.seed, k, tree::Leaves::Fine)).collect();
    let mut chance = Chance::new(plan.seed, "trees", 0);
    let x = ROAD + BEHIND_KERB;
    let (mut lamps, mut n) = (0, 0);
    for (side, offset) in [(1.0, 0.0), (-1.0, 0.5 * LAMP_STEP)] {
        let mut z = BEHIND - 8.0 - offset;
        while z > plan.end + 4.0 {
            if plan.off_crossing(z, -6.0) {
                // The arm reaches over the road.
                street_lamp::put(glb, lamp, &format!("lamp_{lamps:02}"), at(side * x, KERB, z, -90.0 * side));
                lamps += 1;
            }
            for dz in [10.0, 20.0] {
                let z = z - dz + chance.between(-1.0, 1.0);
                if plan.off_crossing(z, 2.0) && z > plan.end && chance.happens(0.7) {
                    let place = at(side * (x + 0.2), KERB, z, chance.between(0.0, 360.0));
                    glb.node(&format!("tree_{n:02}"), "vegetation", *chance.pick(&trees), place);
                    n += 1;
                }
            }
            z -= LAMP_STEP;
        }
    }
}

/// Four traffic lights, each on the right before its stop line: green along the street.
fn traffic_lights(glb: &mut Glb, plan: &Plan<'_>) {
    let (green, red) = (traffic_light(glb, Signal::Green), traffic_light(glb, Signal::Red));
    let (a, b) = (ROAD + 0.45, FRONT + 1.2);
    for (name, x, dz, facing, shape) in [
        ("signal_south", a, b, 180.0, green),
        ("signal_north", -a, -b, 0.0, green),
        ("signal_west", -b, a, -90.0, red),
        ("signal_east", b, -a, 90.0, red),
    ] {
        glb.node(name, "traffic light", shape, at(x, KERB, plan.crossing + dz, facing));
    }
}

fn put_signs(glb: &mut Glb, plan: &Plan<'_>) -> Result<(), WorldError> {
    let style = plan.options.style;
    let x = ROAD + 0.45;
    let before = plan.crossing + FRONT;
    let names = match style {
        Style::Vienna => ["LINDENALLEE", "HAFENSTRASSE"],
        Style::Mutcd => ["MAIN ST", "HARBOR AVE"],
    };
    // For those who come along −z on the right, and for the others on the left.
    let list = [
        (Sign::Limit(plan.options.limit), x, -13.0, 180.0, 2.0),
        (Sign::Crossing, x, before + 14.0, 180.0, 2.0),
        (Sign::Parking, x, 0.45 * before - 6.0, 180.0, 2.0),
        (Sign::Stop, x, plan.crossing - FRONT - 26.0, 180.0, 2.0),
        (Sign::Limit(plan.options.limit), -x, plan.end + 18.0, 0.0, 2.0),
        (Sign::Crossing, -x, plan.crossing - FRONT - 14.0, 0.0, 2.0),
        (Sign::Priority, -x, plan.crossing - FRONT - 6.5, 0.0, 2.0),
        (Sign::Yield, x + 3.0, plan.crossing - ROAD - 0.5, 90.0, 2.0),
        (Sign::NoEntry, -x - 3.0, plan.crossing + ROAD + 0.5, -90.0, 2.0),
        (Sign::Name(names[0]), x + 1.8, before - 3.1, 180.0, 2.4),
        (Sign::Name(names[1]), x + 2.6, before - 3.3, -90.0, 2.4),
    ];
    for (k, (sign, x, z, facing, clear)) in list.into_iter().enumerate() {
        let shape = signs::on_post(glb, &sign, style, clear)?;
        glb.node(&format!("sign_{k:02}"), "traffic sign", shape, at(x, KERB, z, facing));
    }
    Ok(())
}
