//! The scenes as files: read back by the loader, and measured.

mod common;
mod files;
mod road;
mod runway;
mod street;
mod targets;
