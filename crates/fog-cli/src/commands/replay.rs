//! `fogbank replay`: one path of a frame in words.

use super::sweep::cache_dir;
use crate::args::ReplayArgs;
use anyhow::Result;
use fogbank::{Error, Resources, Silent, TableCache};
use std::io::Write;
use std::process::ExitCode;

pub(crate) fn run(args: &ReplayArgs) -> Result<ExitCode> {
    let plan = fogbank::plan::load(&args.config.config, &args.config.sets).map_err(Error::from)?;
    let mut resources = Resources::new(TableCache::new(cache_dir(args.cache_dir.as_deref())?));
    let replayed =
        fogbank::replay(&plan, args.frame.as_deref(), args.pixel, args.sample, &mut resources, &Silent)?;
    let mut out = std::io::BufWriter::new(std::io::stdout().lock());
    if args.json {
        writeln!(out, "{:#}", replayed.json())?;
    } else {
        write!(out, "{replayed}")?;
    }
    out.flush()?;
    Ok(ExitCode::SUCCESS)
}
