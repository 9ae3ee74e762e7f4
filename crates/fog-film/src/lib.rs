//! From samples to a frame: sums per pixel in f64, then the finished picture with its truth channels.
//!
//! A pixel's radiance is kept in two parts, `direct` (surface or sky light that came straight through the fog) and
//! `airlight` (scattered in the fog at least once); the image is their sum. No file access, clock or printing
//! (DESIGN invariant 1).

mod error;
mod frame;
mod pixel;

pub use error::FrameError;
pub use frame::{Channels, Frame, Truth};
pub use pixel::PixelFilm;
