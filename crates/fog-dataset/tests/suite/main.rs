//! Whole data sets in temporary folders.

mod common;
mod concurrent;
mod folder;
mod pictures;
mod resume;
mod round_trip;
mod sizes;
