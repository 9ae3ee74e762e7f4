//! The subcommands, one file each.

pub(crate) mod fit;
pub(crate) mod plan;
pub(crate) mod render;
pub(crate) mod scene;
pub(crate) mod schema;
pub(crate) mod sweep;
pub(crate) mod verify;
