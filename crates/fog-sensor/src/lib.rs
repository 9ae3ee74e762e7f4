//! Image sensors: from radiance to the raw picture of a camera, and from that to one to look at.
//!
//! The chain: factor on the radiance ([`exposure`]) → the lens ([`vignetting`], [`psf`]) → electrons, noise, full well and
//! converter behind a mosaic of filters ([`raw`], [`noise`], [`bayer`]) → levels, [`mod@demosaic`], white balance and colour matrix
//!
//! Pure functions of their arguments: no file access, clock, environment, printing or global state. The same inputs give the
//! same bits on every machine and for any number of threads.

pub mod bayer;
pub mod curves;
pub mod demosaic;
pub mod develop;
pub mod exposure;
pub mod noise;
pub mod psf;
pub mod raw;
pub mod vignetting;
