//! The program as its users run it: real command lines, real files.

mod cache;
mod commands;
mod common;
mod data_set;
mod determinism;
mod droplets;
mod failures;
mod mistakes;
mod phases;
mod pipes;
mod records;
mod visibility;
