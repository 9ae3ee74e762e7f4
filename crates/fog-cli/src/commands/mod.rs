//! The subcommands, one file each.

pub(crate) mod compare;
pub(crate) mod emit;
pub(crate) mod export;
pub(crate) mod figures;
pub(crate) mod fit;
mod fog_source;
pub(crate) mod merge;
pub(crate) mod mie;
pub(crate) mod optics;
pub(crate) mod plan;
pub(crate) mod render;
pub(crate) mod replay;
pub(crate) mod scene;
pub(crate) mod schema;
mod spectrum;
pub(crate) mod sweep;
pub(crate) mod verify;
pub(crate) mod visibility;
