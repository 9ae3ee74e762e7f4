//! Round and square bodies as meshes. Centred on the origin or along the axis that is named; sizes in metres.

mod boxes;
mod grid;
mod round;

pub(crate) use boxes::{block, rounded_box};
pub(crate) use grid::{Grid, lathe};
pub(crate) use round::{ball, ball_part, cylinder, limb, ring, rod, tube};
