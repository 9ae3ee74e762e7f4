//! Data sets in the formats of others, from what a data set's folder holds: nothing is rendered again.
//!
//! [`export()`] goes through the frames of the plan in order and gives each that is done to the format's writer, so that memory
//! does not depend on their number. It fills a folder beside the wanted one, which gets its name when it is whole: a killed
//! export leaves nothing that looks like a finished one. What the format cannot hold is counted and reported ([`Loss`]).
//!
//! A format is one module: a type that implements `Writer`, entered in [`Format`]. `docs/export.md` tells what becomes of what.

mod camera;
mod cityscapes;
mod classes;
mod coco;
mod error;
mod folder;
mod format;
mod frame;
mod huggingface;
mod job;
mod kitti;
mod lard;
mod mcap_file;
mod nuscenes;
mod png;
mod run;
mod summary;
mod track;
mod webdataset;

pub use error::{Error, Result};
pub use format::Format;
pub use job::{Options, SHARD_SIZE_MIB};
pub use run::{Progress, export};
pub use summary::{Loss, Summary};
