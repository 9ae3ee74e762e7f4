//! Integrators and the tile scheduler: (scene, settings, seed) to film.
//!
//! [`render::render`] is the way in; [`path`] is the integrator, `analog` the short one it is tested against.
//! No file access, clock, printing or global state (DESIGN invariant 1).

mod analog;
mod budget;
mod equiangular;
pub mod features;
pub mod flow;
mod groups;
mod layer_light;
mod lights;
mod lobe;
pub mod objects;
pub mod path;
pub mod render;
pub mod render_shared;
pub mod replay;
mod rounds;
pub mod seen_lamps;
pub mod settings;
mod shared;
pub mod surface_truth;
pub mod truth;
pub mod watch;

#[cfg(test)]
mod truth_tests;
