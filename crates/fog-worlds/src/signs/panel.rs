//! The sheet of a sign.

use crate::error::WorldError;
use crate::font;
use crate::glb::{Glb, Sampling};
use crate::mesh::{Mesh, Model};
use crate::paint::Paint;
use crate::picture::{Area, Picture};
use crate::place::sin_cos;
use fog_core::{Vec2, Vec3};

/// Thickness of the sheet in metres.
const THICKNESS: f32 = 0.004;
/// Pixels along the longer edge of a picture.
const PIXELS: f32 = 256.0;

/// A sheet of some outline with a drawing; measures in metres, the origin of the drawing at its lower left.
#[derive(Clone, Debug)]
pub(crate) struct Panel {
    pub(crate) name: String,
    pub(crate) width: f32,
    pub(crate) height: f32,
    outline: Vec<[f32; 2]>,
    picture: Picture,
}

impl Panel {
    /// A sheet of a convex outline, counterclockwise, of one colour; `sharp` times as many pixels as usual.
    pub(crate) fn new(
        name: String,
        size: [f32; 2],
        outline: Vec<[f32; 2]>,
        colour: [f32; 3],
        sharp: f32,
    ) -> Self {
        let [width, height] = size;
        let picture = Picture::new(width, height, sharp * PIXELS / width.max(height), colour);
        Self { name, width, height, outline, picture }
    }

    /// A rectangle with round corners.
    pub(crate) fn rectangle(name: String, [w, h]: [f32; 2], radius: f32, colour: [f32; 3]) -> Self {
        Self::new(name, [w, h], rounded([w, h], 0.0, radius), colour, 1.0)
    }

    /// A regular polygon of `n` corners inscribed in a circle, the first corner at an angle.
    pub(crate) fn regular(name: String, diameter: f32, n: usize, first_deg: f32, colour: [f32; 3]) -> Self {
        Self::new(name, [diameter; 2], regular(0.5 * diameter, 0.5 * diameter, n, first_deg), colour, 1.0)
    }

    /// Covers an area.
    pub(crate) fn fill(mut self, area: &Area, colour: [f32; 3]) -> Self {
        self.picture.fill(area, colour);
        self
    }

    /// Writes a line of text whose letters are `height` high about a point.
    pub(crate) fn write(self, text: &str, centre: [f32; 2], height: f32, colour: [f32; 3]) -> Self {
        let (lines, half) = font::centred(text, centre, height);
        self.fill(&Area::Lines(lines, half), colour)
    }

    /// The sheet: its face towards −Z, its back grey.
    pub(crate) fn model(&self, glb: &mut Glb) -> Result<Model, WorldError> {
        let name = format!("sign {}", self.name);
        let texture = glb.texture(&name, &self.picture, Sampling::Smooth)?;
        let face = glb.material(&Paint::new(&name, [1.0; 3]).smooth(0.5).textured(texture));
        let back = glb.material(&Paint::new("sign back", [0.35, 0.35, 0.35]).metal(0.6));
        // Seen from its front, x runs to the left.
        let corner = |&[u, v]: &[f32; 2], z: f32| Vec3::new(0.5 * self.width - u, v - 0.5 * self.height, z);
        let uv = |&[u, v]: &[f32; 2]| Vec2::new(u / self.width, 1.0 - v / self.height);
        let mut model = Model::default();
        let front: Vec<_> = self.outline.iter().map(|p| (corner(p, 0.0), uv(p))).collect();
        model.part(face).polygon(&front);
        let mut rest = Mesh::default();
        let behind: Vec<_> = self.outline.iter().rev().map(|p| (corner(p, THICKNESS), Vec2::ZERO)).collect();
        rest.polygon(&behind);
        for (i, a) in self.outline.iter().enumerate() {
            let b = &self.outline[(i + 1) % self.outline.len()];
            let edge = [corner(a, 0.0), corner(a, THICKNESS), corner(b, THICKNESS), corner(b, 0.0)];
            rest.polygon(&edge.map(|p| (p, Vec2::ZERO)));
        }
        model.add(back, &rest);
        Ok(model)
    }
}

/// Corners of a regular polygon.
pub(super) fn regular(centre: f32, radius: f32, n: usize, first_deg: f32) -> Vec<[f32; 2]> {
    let corner = |k: usize| {
        let (s, c) = sin_cos(first_deg + 360.0 * k as f32 / n as f32);
        [centre + radius * c, centre + radius * s]
    };
    (0..n).map(corner).collect()
}

/// Outline of a rectangle inset by `inset` with round corners.
pub(super) fn rounded([w, h]: [f32; 2], inset: f32, radius: f32) -> Vec<[f32; 2]> {
    round_polygon(&[[inset, inset], [w - inset, inset], [w - inset, h - inset], [inset, h - inset]], radius)
}

/// A convex polygon, counterclockwise, with round corners.
pub(super) fn round_polygon(corners: &[[f32; 2]], radius: f32) -> Vec<[f32; 2]> {
    let n = corners.len();
    let at = |k: usize| Vec2::from(corners[k % n]);
    let mut out = Vec::new();
    for k in 0..n {
        let (before, here, after) = (at(k + n - 1), at(k), at(k + 1));
        let (a, b) = ((before - here).normalize(), (after - here).normalize());
        let bisector = (a + b).normalize();
        // Half the angle between the edges: the arc's centre lies radius / sin of it along the bisector.
        let sin = a.perp_dot(bisector).abs();
        let centre = here + bisector * (radius / sin);
        let foot = |e: Vec2| here + e * (centre - here).dot(e);
        let (from, to) = (foot(a) - centre, foot(b) - centre);
        for i in 0..=4 {
            let t = i as f32 / 4.0;
            let p = centre + (from * (1.0 - t) + to * t).normalize_or_zero() * radius;
            out.push([p.x, p.y]);
        }
    }
    out
}
