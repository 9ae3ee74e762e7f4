//! What every other crate of Fogbank agrees on: units and conventions, wavelengths and spectra, colour, the optics
//! table, random streams, warps and moments.
//!
//! No file access, clock, environment, printing or global state (DESIGN invariant 1).
//!
//! Conventions: SI inside (metres, 1/m, W m⁻² sr⁻¹ nm⁻¹), wavelengths in nanometres where a name says `_nm`, angles in
//! radians unless a name says `_deg`. World: right-handed, +Y up; altitude is y over the fog's datum.

pub mod attitude;
pub mod bands;
pub mod colour;
pub mod daylight;
pub mod delta_e;
pub mod diameter_choice;
pub mod distribution_2d;
pub mod droplet_table;
pub mod lens;
pub mod math;
pub mod moments;
pub mod optics_table;
pub mod patchiness;
pub mod phase;
pub mod phase_grid;
mod phase_lookup;
pub mod profile;
pub mod random;
pub mod sensor_response;
mod separable;
mod shared_words;
pub mod spectrum;
pub mod warp;

pub use glam::{DMat3, DMat4, DQuat, DVec3, Mat4, Quat, Vec2, Vec3, Vec3A};
