//! What all vehicles have: paint, wheels, lamps.

use super::body::Skin;
use super::low_beam::low_beam;
use super::wheel::WheelSkin;
use crate::glb::{Glb, Shape};
use crate::lamp::colour;
use crate::mesh::Mat;
use crate::paint::Paint;
use crate::place::Place;
use fog_core::Vec3;

/// A vehicle's shape, and where its lamps and plates are.
#[derive(Clone, Debug)]
pub(crate) struct Vehicle {
    pub(crate) class: &'static str,
    pub(crate) shape: Shape,
    pub(crate) length: f32,
    /// The right head lamp's lens, in the vehicle's own axes; the left one mirrors it.
    pub(crate) head_lamp: Vec3,
    /// Middles of the plates at front and rear.
    pub(crate) plates: [Vec3; 2],
    pub(crate) lit: bool,
}

/// Colours of cars in linear sRGB with metallic flakes or without: about the shares seen on roads.
pub(crate) const COLOURS: [(&str, [f32; 3], f32); 8] = [
    ("white", [0.72, 0.72, 0.70], 0.0),
    ("black", [0.012, 0.012, 0.014], 0.0),
    ("grey", [0.18, 0.185, 0.19], 0.6),
    ("silver", [0.50, 0.51, 0.52], 0.7),
    ("blue", [0.02, 0.06, 0.22], 0.4),
    ("red", [0.42, 0.015, 0.015], 0.0),
    ("green", [0.03, 0.10, 0.06], 0.3),
    ("beige", [0.42, 0.36, 0.27], 0.4),
];

/// Luminous intensity of a tail lamp in cd (UN Regulation 7: 4 to 17 cd) and its area in m².
const TAIL_CANDELA: f32 = 10.0;
const TAIL_AREA: f32 = 0.03;

/// Materials of vehicles.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Finish {
    pub(crate) skin: Skin,
    pub(crate) wheels: WheelSkin,
    pub(crate) head: Mat,
    pub(crate) tail: Mat,
    pub(crate) amber: Mat,
    pub(crate) chrome: Mat,
}

/// The materials of a vehicle of a colour, its lamps lit or not.
pub(crate) fn finish(glb: &mut Glb, colour_index: usize, lit: bool) -> Finish {
    let (name, rgb, metallic) = COLOURS[colour_index % COLOURS.len()];
    let lacquer =
        Paint { metallic, coat: 1.0, ..Paint::new(&format!("car paint, {name}"), rgb).smooth(0.45) };
    let skin = Skin {
        paint: glb.material(&lacquer),
        glass: glb.material(&Paint::new("car glass", [0.012, 0.016, 0.018]).smooth(0.02)),
        trim: glb.material(&Paint::new("black plastic", [0.02, 0.02, 0.021]).smooth(0.6)),
    };
    let wheels = WheelSkin {
        tyre: glb.material(&Paint::new("tyre", [0.018, 0.018, 0.019])),
        rim: glb.material(&Paint::new("alloy", [0.55, 0.56, 0.57]).metal(0.3)),
        dark: skin.trim,
    };
    let head = Paint::new("head lamp", [0.62, 0.64, 0.66]).smooth(0.08);
    let tail = Paint::new("tail lamp", [0.35, 0.008, 0.008]).smooth(0.15);
    let tail = if lit {
        let (red, strongest) = colour::split(colour::RED);
        let rear = strongest * TAIL_CANDELA / TAIL_AREA;
        Paint { name: "tail lamp, lit".to_owned(), ..tail }.shining(red, rear)
    } else {
        tail
    };
    Finish {
        skin,
        wheels,
        head: glb.material(&head),
        tail: glb.material(&tail),
        amber: glb.material(&Paint::new("turn indicator", [0.6, 0.2, 0.01]).smooth(0.15)),
        chrome: glb.material(&Paint::new("chrome", [0.6, 0.6, 0.6]).metal(0.12)),
    }
}

impl Vehicle {
    /// Puts the vehicle into the scene, with its lamps if they are lit.
    pub(crate) fn put(&self, glb: &mut Glb, name: &str, place: Place) {
        glb.node(name, self.class, self.shape, place);
        if !self.lit {
            return;
        }
        for (side, x) in [("left", -1.0), ("right", 1.0)] {
            let lens = self.head_lamp * Vec3::new(x, 1.0, 1.0) + Vec3::NEG_Z * 0.02;
            let at = place.point(lens);
            let axis = place.point(Vec3::NEG_Z) - place.at;
            let aim = Place::at(at.x, at.y, at.z).aimed(axis);
            glb.lamp(&format!("{name}_{side}_low_beam"), self.class, name, &low_beam(), aim);
        }
    }
}
