//! Droplets → optics → visibility: refractive index of water, Mie series, droplet-size distributions, polydisperse
//! averages, optics tables, phase functions, fog layers by altitude and visibility laws.
//!
//! No file access, clock, environment, printing or global state (DESIGN invariant 1): texts come in as arguments, source
//! tables are compiled in. Lengths are in metres unless a name says `_um` (diameters) or `_nm` (wavelengths).
//!
//! From a fog model to what a renderer needs:
//!
//! ```no_run
//! use fog_optics::{advection::AdvectionModel, layer, table};
//! let model = AdvectionModel::arcata()?;
//! let optics = table::build_table(&model, &table::TableSettings::visible(&model), &|_done| ())?;
//! let fog = layer::advection(&optics, &model, 180.0, 1.0)?;
//! let profile = fog.profile(0.0)?;
//! # Ok::<(), fog_optics::error::OpticsError>(())
//! ```

pub mod advection;
pub mod catalogue;
pub mod coefficient;
mod csv;
pub mod distribution;
pub mod droplet_table;
pub mod droplets;
pub mod error;
pub mod fit;
pub mod intensities;
pub mod jendersie_deon;
pub mod layer;
pub mod layer_csv;
pub mod lidar;
pub mod mean_cosine;
pub mod mean_diameter;
pub mod mie;
pub mod parcel;
pub mod phase_function;
pub mod phenomena;
pub mod polydisperse;
pub mod size;
pub mod spectrum_csv;
pub mod state;
pub mod table;
pub mod vertical;
pub mod visibility;
pub mod water;

pub use fog_core::patchiness;

/// The guide's example is compiled and run with the tests.
#[cfg(doctest)]
#[doc = include_str!("../../../docs/optics.md")]
struct Guide;
