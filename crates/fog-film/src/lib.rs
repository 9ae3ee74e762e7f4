//! From samples to a frame: sums per pixel in f64, then the finished picture with its truth channels.
//!
//! A pixel's radiance is kept in two parts, `direct` (surface or sky light that came straight through the fog) and
//! `airlight` (scattered in the fog at least once); the image is their sum, and that of the layers of light groups if there are
//! any. Pictures, rendered here or elsewhere, are compared
//! by [`compare`]. No file access, clock or printing (DESIGN invariant 1).

mod colour_map;
mod compare;
mod difference_map;
mod error;
mod films;
mod frame;
mod noise;
mod picture;
mod pixel;
mod surface_truth;

pub use colour_map::magma;
pub use compare::{CompareError, Comparison, DeltaE, ZScores, compare, psnr_db};
pub use difference_map::Srgb8Picture;
pub use error::FrameError;
pub use films::Films;
pub use frame::{Channels, Frame, GroupLayer, PointLight, Truth};
pub use noise::{PixelNoise, noise_floor, relative_error};
pub use picture::{Picture, Scale, srgb8};
pub use pixel::PixelFilm;
pub use surface_truth::SurfaceTruth;
