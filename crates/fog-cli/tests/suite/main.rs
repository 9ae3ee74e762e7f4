//! The program as its users run it: real command lines, real files.

mod cache;
mod commands;
mod common;
mod compare;
mod data_set;
mod determinism;
mod droplets;
mod failures;
mod figures;
mod fit;
mod groups;
mod lamps;
mod mie;
mod mistakes;
mod model_files;
mod noise;
mod optics;
mod phases;
mod pipes;
mod records;
mod replay;
mod skies;
mod visibility;
mod visibility_laws;
