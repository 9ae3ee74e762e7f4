//! Number plates.

use crate::error::WorldError;
use crate::font;
use crate::glb::{Glb, Sampling, Shape};
use crate::mesh::Model;
use crate::noise::Chance;
use crate::paint::Paint;
use crate::picture::{Area, Picture};
use crate::shapes::block;
use crate::signs::Style;
use fog_core::Vec3;

/// Width and height of a plate in metres: 520 × 110 mm (ISO 7591), 12 × 6 in (SAE J686).
fn size(style: Style) -> [f32; 2] {
    match style {
        Style::Vienna => [0.52, 0.11],
        Style::Mutcd => [0.305, 0.152],
    }
}

/// A plate with letters and digits by chance; it faces −Z, its middle is the origin.
pub(crate) fn plate(glb: &mut Glb, chance: &mut Chance, style: Style) -> Result<Shape, WorldError> {
    let [w, h] = size(style);
    let letter = |chance: &mut Chance| char::from(b'A' + chance.below(26) as u8);
    let letters: String = (0..3).map(|_| letter(chance)).collect();
    let digits = 100 + chance.below(900);
    let text = format!("{letters} {digits}");
    let mut picture = Picture::new(w, h, 400.0, [0.72, 0.72, 0.70]);
    let scale = (0.68 * h / 7.0).min(0.84 * w / font::width(&text, 7.0));
    let (lines, half) = font::centred(&text, [0.5 * w, 0.5 * h], 7.0 * scale);
    picture.fill(&Area::Lines(lines, half), [0.01; 3]);
    let name = format!("plate {text}");
    let texture = glb.texture(&name, &picture, Sampling::Smooth)?;
    let face = glb.material(&Paint::new(&name, [1.0; 3]).smooth(0.4).textured(texture));
    let edge = glb.material(&Paint::new("black plastic", [0.02, 0.02, 0.021]).smooth(0.6));
    let mut model = Model::default();
    let (x, y) = (Vec3::X * w, Vec3::Y * h);
    let corner = -0.5 * (x + y);
    model.part(face).quad(corner + x + Vec3::NEG_Z * 0.002, -x, y);
    model.add(
        edge,
        &block(corner - Vec3::new(0.006, 0.006, 0.0), corner + x + y + Vec3::new(0.006, 0.006, 0.015)),
    );
    Ok(glb.shape(&name, &model))
}
