//! `fogbank sweep`: every frame of a configuration.

use crate::args::{SweepArgs, WorkArgs};
use crate::print;
use crate::report::{self, Reporter};
use anyhow::{Context, Result};
use fogbank::plan::Plan;
use fogbank::{Resources, Selection, TableCache};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

pub(crate) fn run(args: &SweepArgs) -> Result<ExitCode> {
    let plan = fogbank::plan::load(&args.config.config, &args.config.sets).map_err(fogbank::Error::from)?;
    if !args.work.quiet {
        let mut summary = Vec::new();
        report::print_plan(&plan, threads(&args.work), &mut summary)?;
        print::news(String::from_utf8_lossy(&summary).trim_end());
    }
    render(&plan, &Selection::All, &args.work)
}

/// Renders the selected frames; exit code 1 if one of the selected frames failed.
pub(crate) fn render(plan: &Plan, selection: &Selection, work: &WorkArgs) -> Result<ExitCode> {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads(work)).build()?;
    let cache = TableCache::new(cache_dir(work.cache_dir.as_deref())?);
    let mut resources = Resources::new(cache).with_denoiser(denoiser(work.oidn.as_deref()));
    let reporter = Reporter::new(work.quiet);
    let result = pool.install(|| fogbank::sweep(plan, selection, &work.out, &mut resources, &reporter));
    reporter.close();
    result?;
    Ok(ExitCode::from(u8::from(reporter.failures() > 0)))
}

pub(crate) fn threads(work: &WorkArgs) -> usize {
    work.threads.map_or_else(|| std::thread::available_parallelism().map_or(1, usize::from), usize::from)
}

/// The library asked for, or the one that the environment names.
fn denoiser(asked: Option<&Path>) -> Option<PathBuf> {
    let named = || std::env::var_os("FOGBANK_OIDN").filter(|v| !v.is_empty()).map(PathBuf::from);
    asked.map(Path::to_owned).or_else(named)
}

/// The folder asked for; in a checkout of Fogbank its `tables/cache`; else the user's cache folder.
pub(crate) fn cache_dir(asked: Option<&Path>) -> Result<PathBuf> {
    if let Some(dir) = asked {
        return Ok(dir.to_owned());
    }
    if Path::new("tables/advection/arcata.yaml").is_file() {
        return Ok(PathBuf::from("tables/cache"));
    }
    let from = |key: &str, below: &str| {
        std::env::var_os(key).filter(|v| !v.is_empty()).map(|v| Path::new(&v).join(below))
    };
    let base = if cfg!(target_os = "windows") {
        from("LOCALAPPDATA", "")
    } else if cfg!(target_os = "macos") {
        from("HOME", "Library/Caches")
    } else {
        from("XDG_CACHE_HOME", "").or_else(|| from("HOME", ".cache"))
    };
    let base = base.context("no cache folder is known on this machine: name one with --cache-dir DIR")?;
    Ok(base.join("fogbank"))
}
