//! Fogbank: from one YAML file to a foggy data set.
//!
//! The main path, top to bottom:
//!
//! 1. [`plan`] reads a configuration into a [`Plan`](fog_plan::Plan) of frames (`fog-plan`);
//! 2. [`Resources`] reads fog models, builds or maps the optics tables (`fog-optics`, [`TableCache`]) and loads the scenes
//!    (`fog-scene`);
//! 3. [`render_frame`] puts a frame's scene, fog and lights together and traces it (`fog-tracer`) onto films (`fog-film`);
//! 4. [`sweep`] does so for every frame that is missing and stores it with its record (`fog-dataset`).
//!
//! ```no_run
//! use fogbank::{Resources, Silent, SweepOptions, TableCache};
//! let plan = fogbank::plan::load("configs/quickstart.yaml".as_ref(), &[])?;
//! let mut resources = Resources::new(TableCache::new("tables/cache"));
//! let counts = fogbank::sweep(&plan, &SweepOptions::default(), "out".as_ref(), &mut resources, &Silent)?;
//! assert_eq!(counts.failed, 0);
//! # Ok::<(), fogbank::Error>(())
//! ```

pub mod aviation;
mod cache_dir;
mod camera_record;
mod changed_files;
mod clear_air;
mod compare;
mod denoise;
mod droplets;
mod error;
mod exposure;
mod fog;
mod fog_numbers;
mod forecast;
mod frame;
mod labels;
mod lighting;
mod objects;
mod phase;
mod progress;
mod record;
mod reference;
mod replay;
mod resources;
mod scenes;
mod selection;
mod sensor;
mod shared;
mod skies;
mod sources;
mod surroundings;
mod sweep;
mod table_cache;
mod tables;
mod text_files;
mod tracker;
mod work;
mod workers;

pub use cache_dir::default_cache_dir;
pub use compare::{
    Compared, FramePair, LeftOut, MatchedFrames, Matching, Means, compare_pictures, match_frames,
};
pub use error::Error;
pub use fog::Fog;
pub use fog_dataset as dataset;
pub use fog_figures as figures;
pub use fog_film as film;
pub use fog_numbers::FogNumbers;
pub use fog_optics as optics;
pub use fog_plan as plan;
pub use fog_tracer::render::Work;
pub use fog_worlds as worlds;
pub use frame::{Rendered, camera, next_camera, next_scene_time_s, render_frame, scene};
pub use progress::{Event, Progress, Silent};
pub use reference::Reference;
pub use replay::{Replayed, replay};
pub use resources::Resources;
pub use selection::{Selection, Shard, one_frame};
pub use shared::share_sets;
pub use sources::load_model;
pub use sweep::{SweepOptions, most_paths, output_set, path_count, sweep};
pub use table_cache::{Stored, TableCache, TableOrigin};
pub use workers::Workers;

/// Digest of the sources, dependencies and tables that this program was built from: frames of equal specification and
/// equal digest have equal bytes.
pub const CODE_DIGEST: &str = env!("FOGBANK_CODE_DIGEST");
