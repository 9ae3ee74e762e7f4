//! Vehicles of a scene: each kind, colour and state is one shape, plates are shared among them.

use super::car::{self, KINDS, Kind};
use super::plate::plate;
use super::truck;
use super::vehicle::{COLOURS, Vehicle};
use crate::error::WorldError;
use crate::glb::{Glb, Shape};
use crate::noise::Chance;
use crate::place::Place;
use crate::signs::Style;
use std::collections::BTreeMap;

/// Number of different plates.
const PLATES: usize = 10;

/// What has been made so far.
pub(crate) struct Fleet {
    cars: BTreeMap<(Kind, usize, bool), Vehicle>,
    trucks: BTreeMap<usize, Vehicle>,
    buses: BTreeMap<usize, Vehicle>,
    plates: Vec<Shape>,
    count: usize,
}

impl Fleet {
    pub(crate) fn new(glb: &mut Glb, seed: u64, style: Style) -> Result<Self, WorldError> {
        let mut chance = Chance::new(seed, "plates", 0);
        let plates = (0..PLATES).map(|_| plate(glb, &mut chance, style)).collect::<Result<_, _>>()?;
        let (cars, trucks, buses) = (BTreeMap::new(), BTreeMap::new(), BTreeMap::new());
        Ok(Self { cars, trucks, buses, plates, count: 0 })
    }

    /// A car of a kind and colour by chance: saloons and hatchbacks are the most frequent.
    pub(crate) fn car(&mut self, glb: &mut Glb, chance: &mut Chance, lit: bool) -> Vehicle {
        let kind = KINDS[*chance.pick(&[0, 0, 1, 1, 1, 2, 2, 3])];
        let colour = chance.below(COLOURS.len());
        self.cars.entry((kind, colour, lit)).or_insert_with(|| car::car(glb, kind, colour, lit)).clone()
    }

    pub(crate) fn truck(&mut self, glb: &mut Glb, chance: &mut Chance) -> Vehicle {
        let colour = *chance.pick(&[0, 4, 5, 6]);
        self.trucks.entry(colour).or_insert_with(|| truck::truck(glb, colour, true)).clone()
    }

    pub(crate) fn bus(&mut self, glb: &mut Glb, chance: &mut Chance) -> Vehicle {
        let colour = *chance.pick(&[4, 5]);
        self.buses.entry(colour).or_insert_with(|| truck::bus(glb, colour, true)).clone()
    }

    /// Puts a vehicle into the scene, with its plates and lamps.
    pub(crate) fn put(&mut self, glb: &mut Glb, vehicle: &Vehicle, place: Place) {
        let name = format!("{}_{:02}", vehicle.class, self.count);
        vehicle.put(glb, &name, place);
        let plate = self.plates[self.count % self.plates.len()];
        self.count += 1;
        for (end, at, turned) in [("front", vehicle.plates[0], false), ("rear", vehicle.plates[1], true)] {
            let world = place.point(at);
            let [x, y, z, w] = place.rotation;
            // The rear plate is turned around: the rotation times half a turn about Y.
            let rotation = if turned { [-z, w, x, -y] } else { [x, y, z, w] };
            let at = Place { at: world, rotation };
            glb.part(&format!("{name}_plate_{end}"), "license plate", &name, plate, at);
        }
    }
}
