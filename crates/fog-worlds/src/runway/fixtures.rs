//! Bodies of the lights and putting them in place.

use super::Runway;
use super::beams::{Hue, Kind};
use crate::glb::{Glb, Shape};
use crate::lamp::{Lamp, colour};
use crate::mesh::{Mat, Model};
use crate::paint::Paint;
use crate::place::{Place, shift, sin_cos};
use crate::shapes::{ball, ball_part, block, cylinder, lathe};
use fog_core::Vec3;
use glam::Affine3A;
use std::collections::BTreeMap;

/// Radius of the lens of a PAR-56 lamp: 7 in across.
const LENS_RADIUS: f32 = 0.089;
/// Radius of the dome of an elevated light; and of a disc of an inset light's window's area, 80 mm by 14 mm.
const DOME_RADIUS: f32 = 0.06;
const WINDOW_RADIUS: f32 = 0.019;
/// Radius of a small lamp that shines all around.
pub(super) const SMALL_RADIUS: f32 = 0.05;
/// Height of elevated lights over the ground.
const STEM: f32 = 0.35;
/// A light's point stands this far before its lens.
const BEFORE: f32 = 0.02;

/// Lights of the file.
pub(super) struct Fixtures<'a> {
    pub(super) glb: &'a mut Glb,
    pub(super) percent: f32,
    housing: Mat,
    shapes: BTreeMap<String, Shape>,
    count: BTreeMap<&'static str, usize>,
}

/// One of the two directions of a light, its heading and elevation in degrees.
#[derive(Clone, Copy, Debug)]
pub(super) struct Beam {
    pub(super) kind: Kind,
    pub(super) hue: Hue,
    pub(super) heading_deg: f32,
    pub(super) elevation_deg: f32,
}

impl<'a> Fixtures<'a> {
    pub(super) fn new(glb: &'a mut Glb, options: &Runway) -> Self {
        let housing = glb.material(&Paint::new("light housing", [0.85, 0.55, 0.05]).smooth(0.5));
        let (shapes, count) = (BTreeMap::new(), BTreeMap::new());
        Self { glb, percent: options.lights_percent, housing, shapes, count }
    }

    /// The glass of a lens: its lamp's light is seen in the lamp's place.
    fn lens(&mut self, lamp: &Lamp) -> Mat {
        let (rgb, _) = colour::split(lamp.color);
        let paint = Paint::new(&format!("{} lens", lamp.name), rgb.map(|c| 0.2 + 0.3 * c)).smooth(0.1);
        self.glb.material(&paint)
    }

    /// Name of the next light of a group.
    fn next(&mut self, group: &'static str) -> String {
        let n = self.count.entry(group).or_insert(0);
        *n += 1;
        format!("{}_{:03}", group.replace(' ', "_"), *n - 1)
    }

    fn shape(&mut self, name: String, make: impl FnOnce(&mut Self) -> Model) -> Shape {
        if let Some(&known) = self.shapes.get(&name) {
            return known;
        }
        let model = make(self);
        let shape = self.glb.shape(&name, &model);
        self.shapes.insert(name, shape);
        shape
    }

    /// A lamp on a stem with one lens: approach lights.
    pub(super) fn spotlight(&mut self, group: &'static str, at: Vec3, beam: Beam) {
        let lamp = beam.kind.lamp(beam.hue, self.percent, LENS_RADIUS);
        let shape = self.shape(format!("spotlight, {}", lamp.name), |this| {
            let lens = this.lens(&lamp);
            let mut model = Model::default();
            let front = Vec3::new(0.0, STEM, -0.06);
            model.add(this.housing, &cylinder(front.with_z(0.1), front, 0.05, 0.1, 16));
            model.add(this.housing, &cylinder(Vec3::ZERO, Vec3::Y * STEM, 0.025, 0.025, 8));
            let disc = lathe(&[[LENS_RADIUS, 0.0], [0.0, 0.012]], 16);
            model.add(lens, &disc.placed(shift(front.x, front.y, front.z - 0.002) * lying()));
            model
        });
        let name = self.next(group);
        let place = Place::at(at.x, at.y, at.z).facing(beam.heading_deg);
        self.glb.node(&name, class(beam.kind), shape, place);
        self.shine(&name, &lamp, beam, place.point(Vec3::new(0.0, STEM, -0.075 - BEFORE)));
    }

    /// An elevated light with two beams, each half of its dome of one colour.
    pub(super) fn dome(&mut self, group: &'static str, at: Vec3, heading_deg: f32, beams: [Beam; 2]) {
        let lamps = beams.map(|b| b.kind.lamp(b.hue, self.percent, DOME_RADIUS));
        let shape = self.shape(format!("dome, {} and {}", lamps[0].name, lamps[1].name), |this| {
            let mut model = Model::default();
            model.add(this.housing, &cylinder(Vec3::ZERO, Vec3::Y * (STEM - 0.08), 0.025, 0.04, 8));
            for (k, lamp) in lamps.iter().enumerate() {
                let lens = this.lens(lamp);
                let half = ball_part(Vec3::ZERO, Vec3::new(0.06, 0.06, 0.08), 12, 0.0, 90.0);
                let turned = if k == 0 { lying() } else { lying_back() };
                model.add(lens, &half.placed(shift(0.0, STEM, 0.0) * turned));
            }
            model
        });
        let name = self.next(group);
        let place = Place::at(at.x, at.y, at.z).facing(heading_deg);
        self.glb.node(&name, class(beams[0].kind), shape, place);
        for (lamp, beam) in lamps.iter().zip(beams) {
            let (s, c) = sin_cos(beam.heading_deg);
            let offset = (0.08 + BEFORE) * Vec3::new(s, 0.0, -c);
            self.shine(&name, lamp, beam, at + Vec3::Y * STEM + offset);
        }
    }

    /// A light in the pavement with a window for each beam.
    pub(super) fn inset(&mut self, group: &'static str, at: Vec3, beams: &[Beam]) {
        let lamps: Vec<Lamp> =
            beams.iter().map(|b| b.kind.lamp(b.hue, self.percent, WINDOW_RADIUS)).collect();
        let names: Vec<&str> = lamps.iter().map(|l| l.name.as_str()).collect();
        let shape = self.shape(format!("inset, {}", names.join(" and ")), |this| {
            let mut model = Model::default();
            model.add(this.housing, &lathe(&[[0.15, 0.0], [0.12, 0.012], [0.0, 0.0125]], 16));
            for (k, lamp) in lamps.iter().enumerate() {
                let lens = this.lens(lamp);
                let side = if k == 0 { -1.0 } else { 1.0 };
                let window = block(Vec3::new(-0.04, 0.0, 0.12), Vec3::new(0.04, 0.014, 0.135));
                model.add(lens, &window.placed(Affine3A::from_scale(Vec3::new(1.0, 1.0, side))));
            }
            model
        });
        let name = self.next(group);
        let heading = beams[0].heading_deg;
        let facing = if (heading - 180.0).abs() < 90.0 { 180.0 } else { 0.0 };
        self.glb.node(&name, class(beams[0].kind), shape, Place::at(at.x, at.y, at.z).facing(facing));
        for (lamp, beam) in lamps.iter().zip(beams) {
            let (s, c) = sin_cos(beam.heading_deg);
            self.shine(&name, lamp, *beam, at + Vec3::new(0.16 * s, 0.02, -0.16 * c));
        }
    }

    /// A small lamp that shines all around.
    pub(super) fn omnidirectional(&mut self, group: &'static str, at: Vec3, lamp: &Lamp) {
        let shape = self.shape(format!("omnidirectional, {}", lamp.name), |this| {
            let lens = this.lens(lamp);
            let mut model = Model::default();
            model.add(this.housing, &cylinder(Vec3::ZERO, Vec3::Y * (STEM - 0.05), 0.025, 0.035, 8));
            model.add(lens, &ball(Vec3::Y * STEM, Vec3::splat(0.05), 12));
            model
        });
        let name = self.next(group);
        self.glb.node(&name, "taxiway light", shape, Place::at(at.x, at.y, at.z));
        // Over the lens: inside, it would light the lens alone.
        let above = at + Vec3::Y * (STEM + 0.05 + BEFORE);
        self.glb.lamp(
            &format!("{name}_lamp"),
            "taxiway light",
            &name,
            lamp,
            Place::at(above.x, above.y, above.z),
        );
    }

    fn shine(&mut self, name: &str, lamp: &Lamp, beam: Beam, at: Vec3) {
        let (s, c) = sin_cos(beam.heading_deg);
        let (up, level) = sin_cos(beam.elevation_deg);
        let axis = Vec3::new(level * s, up, -level * c);
        let place = Place::at(at.x, at.y, at.z).aimed(axis);
        let towards = if axis.z > 0.0 { "approach" } else { "far_end" };
        self.glb.lamp(
            &format!("{name}_{}_to_{towards}", beam.hue.name()),
            class(beam.kind),
            name,
            lamp,
            place,
        );
    }
}

fn class(kind: Kind) -> &'static str {
    match kind {
        Kind::Approach | Kind::SideRow | Kind::Flasher => "approach light",
        _ => "runway light",
    }
}

/// Turns a body that looks up so that it looks along −Z.
fn lying() -> Affine3A {
    crate::place::turn_x(-90.0)
}

/// Turns a body that looks up so that it looks along +Z.
fn lying_back() -> Affine3A {
    crate::place::turn_x(90.0)
}
