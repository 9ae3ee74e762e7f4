//! Road signs: after the Vienna Convention on Road Signs and Signals (1968, in the sizes usual in Germany) and after the
//! Manual on Uniform Traffic Control Devices (FHWA 2009). Shapes, colours and words are theirs; every drawing is our own.
//!
//! Retroreflection is not modelled: the faces are dull paint.

mod mutcd;
mod panel;
mod symbols;
mod vienna;

use crate::error::WorldError;
use crate::glb::{Glb, Shape};
use crate::mesh::Model;
use crate::paint::Paint;
use crate::place::shift;
use crate::shapes::cylinder;
use fog_core::Vec3;
pub(crate) use panel::Panel;

/// Whose signs and markings are used.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Style {
    /// The Vienna Convention.
    Vienna,
    /// The Manual on Uniform Traffic Control Devices.
    Mutcd,
}

impl Style {
    /// The usual speed limit on the signs of a town: 30 km/h, or 25 mph with MUTCD.
    #[must_use]
    pub fn town_limit(self) -> u32 {
        match self {
            Self::Vienna => 30,
            Self::Mutcd => 25,
        }
    }
}

/// Meaning of a sign.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Sign {
    Stop,
    Yield,
    Priority,
    /// Speed limit in km/h, or in mph after MUTCD.
    Limit(u32),
    NoEntry,
    Crossing,
    Parking,
    /// Name of a street.
    Name(&'static str),
    /// Two directions over a motorway's lanes: words and number of the exit.
    Destination(&'static [&'static str]),
}

/// Colours of signs in linear sRGB.
pub(crate) mod colours {
    pub(crate) const WHITE: [f32; 3] = [0.75, 0.75, 0.74];
    pub(crate) const BLACK: [f32; 3] = [0.012, 0.012, 0.012];
    pub(crate) const RED: [f32; 3] = [0.48, 0.008, 0.012];
    pub(crate) const BLUE: [f32; 3] = [0.003, 0.055, 0.30];
    pub(crate) const YELLOW: [f32; 3] = [0.80, 0.42, 0.0];
    pub(crate) const GREEN: [f32; 3] = [0.0, 0.12, 0.06];
}

/// The panel of a sign; it faces −Z, its middle is the origin.
pub(crate) fn panel(sign: &Sign, style: Style) -> Panel {
    match style {
        Style::Vienna => vienna::draw(sign),
        Style::Mutcd => mutcd::draw(sign),
    }
}

/// A sign on a post; the panel's lower edge is `clear` metres over the ground.
pub(crate) fn on_post(glb: &mut Glb, sign: &Sign, style: Style, clear: f32) -> Result<Shape, WorldError> {
    let panel = panel(sign, style);
    let mut model = Model::default();
    let middle = clear + 0.5 * panel.height;
    model.join(&panel.model(glb)?, shift(0.0, middle, -0.04));
    let steel = glb.material(&Paint::new("galvanised steel", [0.45, 0.46, 0.46]).metal(0.5));
    let top = middle + 0.4 * panel.height;
    model.add(steel, &cylinder(Vec3::ZERO, Vec3::Y * top, 0.03, 0.03, 12));
    Ok(glb.shape(&format!("sign {}", panel.name), &model))
}

/// A large panel over lanes: rows of words, arrows down to the lanes.
fn panel_of_rows(rows: &[&str], colour: [f32; 3]) -> Panel {
    /// Height of the letters: what is read from 100 m and more.
    const LETTERS: f32 = 0.4;
    let widest = rows.iter().map(|row| crate::font::width(row, LETTERS)).fold(0.0, f32::max);
    let size = [widest + 0.9, 0.75 * rows.len() as f32 + 0.45];
    let outline = panel::rounded(size, 0.0, 0.15);
    let inner = |inset: f32| crate::picture::Area::Polygon(panel::rounded(size, inset, 0.13));
    let mut drawn = Panel::new(rows.join(" "), size, outline, colour, 3.0)
        .fill(&inner(0.05), colours::WHITE)
        .fill(&inner(0.1), colour);
    for (k, row) in rows.iter().enumerate() {
        let y = size[1] - 0.6 - 0.75 * k as f32;
        drawn = drawn.write(row, [0.5 * size[0], y], LETTERS, colours::WHITE);
    }
    drawn
}
