//! `fogbank scene`: a built-in scene as a file.

use crate::args::SceneArgs;
use crate::print;
use anyhow::{Context, Result};
use std::path::PathBuf;
use std::process::ExitCode;

pub(crate) fn run(args: &SceneArgs) -> Result<ExitCode> {
    let bytes = fogbank::generate::generate(&args.name).context("unknown scene")?;
    let path = args.out.clone().unwrap_or_else(|| PathBuf::from(format!("{}.glb", args.name)));
    std::fs::write(&path, &bytes).with_context(|| format!("cannot write {}", path.display()))?;
    print::news(format_args!("{}: {} bytes", path.display(), bytes.len()));
    Ok(ExitCode::SUCCESS)
}
