//! Vehicles, cyclists and pedestrians.

use super::{BEHIND, CLEAR, FRONT, KERB, LANE, PARKING, Plan, ROAD, at};
use crate::error::WorldError;
use crate::glb::Glb;
use crate::noise::Chance;
use crate::objects::cyclist::cyclist;
use crate::objects::fleet::Fleet;
use crate::objects::person;

/// Greatest and least gap between vehicles in a lane, by how full it is.
const GAPS: [f32; 2] = [70.0, 9.0];
/// Clear space before and behind the camera in its lane.
const CAMERA: [f32; 2] = [-11.0, 5.0];
/// Shares of trucks and buses among vehicles that drive.
const TRUCKS: f32 = 0.2;
const BUSES: f32 = 0.06;
/// Pedestrians per metre of a full pavement.
const PEOPLE_PER_M: f32 = 0.16;

pub(super) fn traffic(glb: &mut Glb, plan: &Plan<'_>) -> Result<(), WorldError> {
    let mut fleet = Fleet::new(glb, plan.seed, plan.options.style)?;
    if plan.options.traffic > 0.0 {
        lane(glb, plan, &mut fleet, 1.0);
        lane(glb, plan, &mut fleet, -1.0);
        parked(glb, plan, &mut fleet);
        waiting(glb, plan, &mut fleet);
    }
    people(glb, plan);
    Ok(())
}

/// Vehicles and cyclists that drive: `side` 1 is the right lane towards −Z.
fn lane(glb: &mut Glb, plan: &Plan<'_>, fleet: &mut Fleet, side: f32) {
    let mut chance = Chance::new(plan.seed, "lane", u64::from(side > 0.0));
    let full = plan.options.traffic;
    let mut z = BEHIND - 4.0 - chance.between(0.0, 12.0);
    let mut cyclists = 0;
    while z > plan.end + 16.0 {
        let gap = (GAPS[0] + (GAPS[1] - GAPS[0]) * full) * chance.between(0.6, 1.4);
        let heading = if side > 0.0 { 0.0 } else { 180.0 };
        if chance.happens(0.22) {
            // The gap of a cyclist is its own.
            if !in_camera(side, z, 1.0) && plan.off_crossing(z, 0.0) {
                let rider = cyclist(glb, plan.seed, (cyclists + if side > 0.0 { 0 } else { 100 }) as u64);
                let name = format!("cyclist_{}{cyclists}", if side > 0.0 { "r" } else { "l" });
                let place = at(side * (LANE - 0.65), 0.0, z, heading);
                glb.node(&format!("{name}_bicycle"), "bicycle", rider.bicycle, place);
                glb.node(&name, "rider", rider.rider, place);
                cyclists += 1;
            }
            z -= 3.0 + 0.4 * gap;
            continue;
        }
        let vehicle = if chance.happens(TRUCKS) {
            fleet.truck(glb, &mut chance)
        } else if chance.happens(BUSES) {
            fleet.bus(glb, &mut chance)
        } else {
            fleet.car(glb, &mut chance, true)
        };
        let middle = z - 0.5 * vehicle.length;
        if !in_camera(side, middle, 0.5 * vehicle.length)
            && plan.off_crossing(middle, 0.5 * vehicle.length - 8.0)
        {
            fleet.put(glb, &vehicle, at(side * 0.5 * LANE, 0.0, middle, heading));
        }
        z -= vehicle.length + gap;
    }
}

/// Whether something in a lane would stand where the camera does.
fn in_camera(side: f32, z: f32, half: f32) -> bool {
    side > 0.0 && z - half < CAMERA[1] && z + half > CAMERA[0]
}

/// Cars at both kerbs.
fn parked(glb: &mut Glb, plan: &Plan<'_>, fleet: &mut Fleet) {
    for side in [1.0, -1.0] {
        let mut chance = Chance::new(plan.seed, "parked", u64::from(side > 0.0));
        let mut z = BEHIND - 4.0;
        while z > plan.end + 8.0 {
            if chance.happens(0.25 + 0.65 * plan.options.traffic) && plan.off_crossing(z - 2.7, 5.0) {
                let vehicle = fleet.car(glb, &mut chance, false);
                let x = side * (LANE + 0.5 * PARKING + 0.05 + chance.between(-0.1, 0.05));
                let heading = if side > 0.0 { 0.0 } else { 180.0 } + chance.between(-1.5, 1.5);
                fleet.put(glb, &vehicle, at(x, 0.0, z - 0.5 * vehicle.length, heading));
            }
            z -= 6.3;
        }
    }
}

/// Cars that wait in the crossing street.
fn waiting(glb: &mut Glb, plan: &Plan<'_>, fleet: &mut Fleet) {
    let mut chance = Chance::new(plan.seed, "waiting", 0);
    for side in [1.0f32, -1.0] {
        let vehicle = fleet.car(glb, &mut chance, true);
        let x = side * (CLEAR + 0.5 * vehicle.length - 1.0);
        // From the right one comes towards −x, in the lane at −z.
        fleet.put(glb, &vehicle, at(x, 0.0, plan.crossing - side * 0.5 * LANE, -90.0 * side));
    }
}

/// Pedestrians on both pavements, and two on the crosswalk.
fn people(glb: &mut Glb, plan: &Plan<'_>) {
    let mut chance = Chance::new(plan.seed, "people", 0);
    let many = (PEOPLE_PER_M * plan.options.people * (BEHIND - plan.end) * 2.0) as usize;
    let shapes: Vec<_> = (0..many.min(16))
        .map(|k| {
            let walks = chance.happens(0.8);
            let model = person::pedestrian(glb, &mut chance, walks);
            glb.shape(&format!("pedestrian {k}"), &model)
        })
        .collect();
    if shapes.is_empty() {
        return;
    }
    for k in 0..many {
        let side = if chance.happens(0.5) { 1.0 } else { -1.0 };
        let x = side * chance.between(ROAD + 1.3, FRONT - 0.5);
        let z = chance.between(plan.end + 3.0, BEHIND - 15.0);
        let heading = if chance.happens(0.5) { 0.0 } else { 180.0 } + chance.between(-12.0, 12.0);
        if plan.off_crossing(z, -3.0) {
            glb.node(&format!("person_{k:02}"), "person", shapes[k % shapes.len()], at(x, KERB, z, heading));
        }
    }
    for (k, x) in [(0, -1.5f32), (1, 2.9)] {
        let z = plan.crossing - FRONT + 1.2;
        let place = at(x, 0.0, z, if k == 0 { 90.0 } else { -90.0 });
        glb.node(&format!("person_crossing_{k}"), "person", shapes[k % shapes.len()], place);
    }
}
