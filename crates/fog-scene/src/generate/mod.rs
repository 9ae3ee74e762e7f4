//! Scenes made by formula, as glTF files: the street of the paper's Sec. 6.1 and an airfield.

mod airfield;
mod glb;
mod quads;
mod street;

/// Names that [`generate`] knows.
pub const NAMES: [&str; 2] = ["street", "airfield"];

/// The bytes of a generated scene (GLB), always the same; `None` for a name not in [`NAMES`].
#[must_use]
pub fn generate(name: &str) -> Option<Vec<u8>> {
    match name {
        "street" => Some(street::street()),
        "airfield" => Some(airfield::airfield()),
        _ => None,
    }
}
