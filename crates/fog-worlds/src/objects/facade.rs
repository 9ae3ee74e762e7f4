//! Buildings with windows.

use crate::error::WorldError;
use crate::glb::{Glb, Sampling, Shape};
use crate::mesh::{Mat, Mesh, Model};
use crate::noise::{self, Chance};
use crate::paint::Paint;
use crate::place::turn_y;
use crate::shapes::block;
use fog_core::{Vec2, Vec3};
use glam::Affine3A;

/// Height of a storey and of the ground floor in metres, depth of the windows' reveals.
const STOREY: f32 = 3.1;
const GROUND: f32 = 3.9;
const REVEAL: f32 = 0.16;
/// Width of a bay, about.
const BAY: f32 = 2.7;
/// Edge of the walls' texture.
const TILE: f32 = 4.0;
/// Luminance of lit windows in cd/m², and how many are lit.
const WINDOW_CD_M2: f32 = 120.0;
const LIT: f32 = 0.3;

/// Wall colours: plaster and brick.
const WALLS: [(&str, [f32; 3]); 7] = [
    ("ochre plaster", [0.52, 0.38, 0.20]),
    ("grey plaster", [0.42, 0.42, 0.41]),
    ("white plaster", [0.68, 0.67, 0.63]),
    ("pink plaster", [0.54, 0.36, 0.29]),
    ("brick", [0.28, 0.10, 0.065]),
    ("dark brick", [0.17, 0.08, 0.055]),
    ("green plaster", [0.33, 0.38, 0.29]),
];

/// Materials of all buildings.
#[derive(Clone, Debug)]
pub(crate) struct Facades {
    walls: Vec<Mat>,
    stone: Mat,
    frame: Mat,
    dark_frame: Mat,
    glass: Mat,
    lit: Mat,
    roof: Mat,
    door: Mat,
}

/// Which sides of a building have windows: front, right, back, left as seen from above with the front at −Z.
pub(crate) type Sides = [bool; 4];

impl Facades {
    pub(crate) fn new(glb: &mut Glb, seed: u64) -> Result<Self, WorldError> {
        let grain = noise::picture(seed ^ 7, 64, 8, 3, [0.86; 3], [1.0; 3]);
        let grain = glb.texture("plaster grain", &grain, Sampling::Repeated)?;
        let walls = WALLS.map(|(name, rgb)| glb.material(&Paint::new(name, rgb).textured(grain)));
        let lit = Paint::new("lit window", [0.3, 0.28, 0.22])
            .smooth(0.1)
            .shining([1.0, 0.72, 0.42], WINDOW_CD_M2 / 0.76);
        Ok(Self {
            walls: walls.to_vec(),
            stone: glb.material(&Paint::new("cornice stone", [0.5, 0.48, 0.44])),
            frame: glb.material(&Paint::new("window frame", [0.7, 0.7, 0.68]).smooth(0.4)),
            dark_frame: glb.material(&Paint::new("shop frame", [0.04, 0.042, 0.045]).smooth(0.4)),
            glass: glb.material(&Paint::new("window glass", [0.02, 0.025, 0.03]).smooth(0.03)),
            lit: glb.material(&lit),
            roof: glb.material(&Paint::new("roof tiles", [0.18, 0.075, 0.05])),
            door: glb.material(&Paint::new("door", [0.10, 0.05, 0.025]).smooth(0.4)),
        })
    }

    /// A building whose front stands in the plane z = 0 with its middle at the origin, towards −Z.
    pub(crate) fn building(
        &self,
        glb: &mut Glb,
        chance: &mut Chance,
        name: &str,
        [width, depth]: [f32; 2],
        storeys: usize,
        sides: Sides,
    ) -> Shape {
        let wall = *chance.pick(&self.walls);
        let height = GROUND + STOREY * (storeys - 1) as f32;
        let mut model = Model::default();
        for (k, windows) in sides.into_iter().enumerate() {
            let (span, out) = if k % 2 == 0 { (width, depth) } else { (depth, width) };
            // Each side is made like the front and turned about the building's middle.
            let middle = Affine3A::from_translation(Vec3::new(0.0, 0.0, 0.5 * depth));
            let frame = middle
                * turn_y(-90.0 * k as f32)
                * Affine3A::from_translation(Vec3::new(0.0, 0.0, -0.5 * out));
            let mut side = Model::default();
            if windows {
                self.windowed(&mut side, chance, wall, span, storeys, k == 0);
            } else {
                wall_quad(side.part(wall), [-0.5 * span, 0.0], [0.5 * span, height], 0.0);
            }
            model.join(&side, frame);
        }
        let pitched = chance.happens(0.5);
        self.roof(&mut model, wall, [width, depth], height, pitched);
        glb.shape(name, &model)
    }

    /// The front: bays of windows, on the ground floor shops and a door.
    fn windowed(
        &self,
        model: &mut Model,
        chance: &mut Chance,
        wall: Mat,
        span: f32,
        storeys: usize,
        front: bool,
    ) {
        let bays = ((span / BAY).round() as usize).max(1);
        let bay = span / bays as f32;
        let door = chance.below(bays);
        for storey in 0..storeys {
            let (low, height) =
                if storey == 0 { (0.0, GROUND) } else { (GROUND + STOREY * (storey - 1) as f32, STOREY) };
            for k in 0..bays {
                let left = -0.5 * span + bay * k as f32;
                let cell = Cell { left, low, width: bay, height };
                if storey == 0 && front {
                    self.shop(model, chance, wall, cell, k == door);
                } else {
                    let (w, h) = (0.5 * bay.min(2.6), 0.56 * height);
                    let glass = if chance.happens(LIT) { self.lit } else { self.glass };
                    let opening = [0.5 * (bay - w), 0.27 * height, w, h];
                    self.window(model, wall, cell, opening, (glass, self.frame));
                }
            }
        }
        // Bands of stone over the ground floor and under the roof.
        let top = GROUND + STOREY * (storeys - 1) as f32;
        for (y, out) in [(GROUND - 0.12, 0.07), (top - 0.25, 0.22)] {
            let (a, b) = (Vec3::new(-0.5 * span, y, -out), Vec3::new(0.5 * span, y + 0.25, 0.02));
            model.add(self.stone, &block(a, b));
        }
    }

    fn shop(&self, model: &mut Model, chance: &mut Chance, wall: Mat, cell: Cell, door: bool) {
        if door {
            let opening = [0.5 * (cell.width - 1.15), 0.0, 1.15, 2.5];
            self.window(model, wall, cell, opening, (self.door, self.stone));
        } else {
            let glass = if chance.happens(LIT) { self.lit } else { self.glass };
            let opening = [0.2, 0.45, cell.width - 0.4, 2.5];
            self.window(model, wall, cell, opening, (glass, self.dark_frame));
        }
    }

    /// A cell of wall with an opening [x, y, width, height] in it, its pane and frame set back.
    fn window(
        &self,
        model: &mut Model,
        wall: Mat,
        cell: Cell,
        [x, y, w, h]: [f32; 4],
        (glass, frame): (Mat, Mat),
    ) {
        let Cell { left, low, width, height } = cell;
        let (x0, x1, y0, y1) = (left + x, left + x + w, low + y, low + y + h);
        let mesh = model.part(wall);
        wall_quad(mesh, [left, low], [x0, low + height], 0.0);
        wall_quad(mesh, [x1, low], [left + width, low + height], 0.0);
        wall_quad(mesh, [x0, low], [x1, y0], 0.0);
        wall_quad(mesh, [x0, y1], [x1, low + height], 0.0);
        // Reveals: sides, lintel, sill.
        let (corner, back) = (|x: f32, y: f32| Vec3::new(x, y, 0.0), Vec3::Z * REVEAL);
        let reveals = model.part(self.stone);
        reveals.quad(corner(x0, y0), Vec3::Y * h, back);
        reveals.quad(corner(x1, y0), back, Vec3::Y * h);
        reveals.quad(corner(x0, y0), back, Vec3::X * w);
        reveals.quad(corner(x0, y1), Vec3::X * w, back);
        wall_quad(model.part(glass), [x0, y0], [x1, y1], REVEAL);
        // Frame: a rim and a bar in the middle, 6 cm wide.
        let bars = model.part(frame);
        let f = 0.06f32;
        let middle = 0.5 * (x0 + x1);
        for [a, b, c, d] in [
            [x0, y0, x0 + f, y1],
            [x1 - f, y0, x1, y1],
            [x0, y0, x1, y0 + f],
            [x0, y1 - f, x1, y1],
            [middle - 0.5 * f, y0, middle + 0.5 * f, y1],
        ] {
            wall_quad(bars, [a, b], [c, d], REVEAL - 0.03);
        }
        // A sill that juts out under windows of the upper floors.
        if y > 0.0 {
            model.add(
                self.stone,
                &block(Vec3::new(x0 - 0.08, y0 - 0.08, -0.09), Vec3::new(x1 + 0.08, y0, 0.0)),
            );
        }
    }

    fn roof(&self, model: &mut Model, wall: Mat, [width, depth]: [f32; 2], top: f32, pitched: bool) {
        let (w, d) = (0.5 * width, depth);
        if pitched {
            let (rise, out) = (0.32 * d.min(14.0), 0.35);
            let ridge = |x: f32| Vec3::new(x, top + rise, 0.5 * d);
            let eave = |x: f32, z: f32| Vec3::new(x, top - 0.02, z);
            let tiles = model.part(self.roof);
            for corners in [
                [eave(w, -out), eave(-w, -out), ridge(-w), ridge(w)],
                [eave(-w, d + out), eave(w, d + out), ridge(w), ridge(-w)],
            ] {
                tiles.polygon(&corners.map(|p| (p, Vec2::ZERO)));
            }
            let gables = model.part(wall);
            gables.polygon(&[eave(-w, 0.0), eave(-w, d), ridge(-w)].map(|p| (p, Vec2::new(p.z, p.y) / TILE)));
            gables.polygon(&[eave(w, d), eave(w, 0.0), ridge(w)].map(|p| (p, Vec2::new(p.z, p.y) / TILE)));
        } else {
            model.add(self.stone, &block(Vec3::new(-w, top - 0.1, 0.0), Vec3::new(w, top, d)));
            for (a, b) in [
                ([-w, 0.0], [w, 0.3]),
                ([-w, d - 0.3], [w, d]),
                ([-w, 0.3], [-w + 0.3, d - 0.3]),
                ([w - 0.3, 0.3], [w, d - 0.3]),
            ] {
                model.add(wall, &block(Vec3::new(a[0], top, a[1]), Vec3::new(b[0], top + 0.8, b[1])));
            }
        }
    }
}

/// Part of a wall.
#[derive(Clone, Copy, Debug)]
struct Cell {
    left: f32,
    low: f32,
    width: f32,
    height: f32,
}

/// An upright rectangle between two corners (x, y), set back by z, towards −Z.
fn wall_quad(mesh: &mut Mesh, [x0, y0]: [f32; 2], [x1, y1]: [f32; 2], z: f32) {
    let corner = |x: f32, y: f32| (Vec3::new(x, y, z), Vec2::new(-x, -y) / TILE);
    mesh.polygon(&[corner(x1, y0), corner(x0, y0), corner(x0, y1), corner(x1, y1)]);
}
