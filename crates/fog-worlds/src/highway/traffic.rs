//! Vehicles on all lanes.

use super::{BEHIND, Highway, at, lane_middle};
use crate::error::WorldError;
use crate::glb::Glb;
use crate::noise::Chance;
use crate::objects::fleet::Fleet;

/// Gaps between vehicles in an empty and in a full lane, by lane: faster traffic keeps more.
const EMPTY: f32 = 400.0;
const FULL: [f32; 3] = [45.0, 38.0, 30.0];
/// Share of trucks and buses by lane.
const HEAVY: [f32; 3] = [0.0, 0.1, 0.45];
/// Clear space around the origin in the right lane, where a camera stands.
const CAMERA: f32 = 14.0;

pub(super) fn traffic(glb: &mut Glb, options: &Highway, seed: u64) -> Result<(), WorldError> {
    let mut fleet = Fleet::new(glb, seed, options.style)?;
    if options.traffic == 0.0 {
        return Ok(());
    }
    for (direction, side) in [(0u64, 1.0f32), (1, -1.0)] {
        for lane in 0..3 {
            let mut chance = Chance::new(seed, "lane", 3 * direction + lane as u64);
            let mean = EMPTY + (FULL[lane] - EMPTY) * options.traffic.sqrt();
            let mut z = BEHIND - chance.between(0.0, mean);
            while z > -options.length_m + 10.0 {
                let vehicle = if chance.happens(HEAVY[lane]) {
                    if chance.happens(0.85) {
                        fleet.truck(glb, &mut chance)
                    } else {
                        fleet.bus(glb, &mut chance)
                    }
                } else {
                    fleet.car(glb, &mut chance, true)
                };
                let middle = z - 0.5 * vehicle.length;
                let here = side > 0.0 && lane == 2 && middle.abs() < CAMERA;
                if !here {
                    let aside = chance.between(-0.25, 0.25);
                    let heading = if side > 0.0 { 0.0 } else { 180.0 };
                    fleet.put(glb, &vehicle, at(side * (lane_middle(lane) + aside), 0.0, middle, heading));
                }
                z -= vehicle.length + mean * chance.between(0.5, 1.5);
            }
        }
    }
    Ok(())
}
