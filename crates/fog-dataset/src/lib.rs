//! Frames and their records to files, and back: layout, markers, resume and verification. Also single pictures, ours and
//! those of others, to compare ([`read_picture`]).
//!
//! A data set is a folder:
//!
//! | file | content |
//! |---|---|
//! | `dataset.json` | format, digests, hashes of the next two, and what the caller tells; claims the folder |
//! | `config.resolved.yaml` | the configuration with every default written out |
//! | `classes.json` | the classes by number, where frames have any |
//! | `plan.jsonl` | one line per frame of the plan ([`PlanFrame`]) |
//! | `<id>.rgb.png` | 8-bit sRGB, exposure in the record (output `image`); of a frame with a sensor developed from its raw picture |
//! | `<id>.raw.png` | 16-bit grey: the numbers of the sensor's pixels (`raw`) |
//! | `<id>.clear.exr`, `.clear.rgb.png` | the same view in clear air at the same exposure (`pair`): `R`, `G`, `B`, and its sRGB picture |
//! | `<id>.hdr.exr` | f32 linear `R`, `G`, `B` (`hdr`), `direct.*`, `airlight.*`, `standard_error.Y`, `samples.Y`, `group.NAME.*`; mono frames `Y` |
//! | `<id>.gt.exr` | f32 `depth.Z`, `distance.Z` (metres, +inf for sky), `transmittance.R/G/B` (mono `.Y`), `tau.Y`; `N.X/Y/Z` (`normals`), `P.X/Y/Z` (`position`), `albedo.R/G/B`, `flow.X/Y` and `flow_valid.Y` where asked for; `CryptoObject00.R/G/B/A` (`instance`) |
//! | `<id>.semantic.png`, `<id>.instance.png` | class (8 bits) and instance (16 bits) of each pixel |
//! | `<id>.objects.json` | records of the things in the picture |
//! | `<id>.json` | the frame's record |
//! | `<id>.denoised.exr`, `.denoised.png` | a guess at the radiance without its noise (`denoised`), and its sRGB picture |
//! | `<id>.denoised.json` | what guessed it, and the hashes of these two |
//! | `<id>.timing.json` | seconds |
//! | `<id>.done` | marker: size and BLAKE3 hash of the frame's files; written last |
//! | `<id>.failed.json` | why the frame failed; gone when it later succeeds |
//! | `index.csv` | one line per frame of the plan, written by [`DataSet::finish`] |
//!
//! Every file is written aside, synced and renamed, so that it appears only when whole. Several processes may work in
//! one folder: a frame's bytes depend on the frame alone, so it does not matter which of two writers wins. All bytes but
//! the timings are reproducible, those of `denoised` with the same library on the same kind of processor only; nothing here reads the clock but the age check of abandoned temporary files on
//! file systems without locks.

mod atomic;
mod cryptomatte;
mod data_set;
mod denoised;
mod encode;
mod error;
mod estimate;
mod exr_file;
mod exr_header;
mod frame_files;
mod header;
mod index;
mod layers;
mod marker;
mod merge;
mod names;
mod opening;
mod outputs;
mod picture_file;
mod plan;
mod rasters;
mod read;
mod reader;
mod verify;

pub use data_set::{Counts, DataSet, DataSetInfo, FrameState};
pub use error::{Error, Result};
pub use estimate::estimate_bytes;
pub use exr_file::{Attribute, Channel, read_exr_channels};
pub use frame_files::{CameraPicture, ClearPicture, DenoisedPicture, FrameFiles, View};
pub use header::{FORMAT, FORMAT_VERSION, Header};
pub use marker::{FileEntry, Marker};
pub use merge::{Merged, merge};
pub use names::Kind as FileKind;
pub use opening::Opening;
pub use outputs::OutputSet;
pub use picture_file::{read_picture, write_png};
pub use plan::PlanFrame;
pub use rasters::{Raster, Values, file_of_raster, raster_names};
pub use read::{StoredFrame, picture_path, read_frame, read_header, read_plan, read_record};
pub use reader::{Mask, Reader};
pub use verify::{Problem, Report, verify};
