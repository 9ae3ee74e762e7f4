//! `fogbank sweep`: every frame of a configuration.

use crate::args::{LogArg, SweepArgs, WorkArgs};
use crate::json_log::JsonLog;
use crate::listener::Listener;
use crate::print;
use crate::report::{self, Reporter};
use anyhow::{Context, Result};
use fogbank::plan::Plan;
use fogbank::{Resources, Selection, SweepOptions, TableCache, Workers};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

pub(crate) fn run(args: &SweepArgs) -> Result<ExitCode> {
    let plan = fogbank::plan::load(&args.config.config, &args.config.sets).map_err(fogbank::Error::from)?;
    // A timeout needs a process to end.
    let count = args.workers.map(usize::from).or(args.frame_timeout.map(|_| 1));
    let share = |count: usize| (available_threads() / count).max(1);
    let workers = count.map(|count| Workers {
        count,
        threads: args.work.threads.map_or_else(|| share(count), usize::from),
        timeout: args.frame_timeout,
    });
    if !args.work.quiet && args.work.log == LogArg::Text {
        let mut summary = Vec::new();
        let threads = workers.map_or_else(|| threads(&args.work), |w| w.count * w.threads);
        report::print_plan(&plan, threads, &mut summary)?;
        print::news(String::from_utf8_lossy(&summary).trim_end());
    }
    let options = SweepOptions {
        selection: Selection {
            only: args.only.clone(),
            filter: args.filter.clone(),
            shard: args.shard.unwrap_or_default(),
        },
        opening: args.mode.into(),
        retry_failed: args.retry_failed,
        recheck: args.recheck,
        workers,
    };
    render(&plan, &options, &args.work)
}

/// Renders the selected frames; exit code 1 if one of them failed.
pub(crate) fn render(plan: &Plan, options: &SweepOptions, work: &WorkArgs) -> Result<ExitCode> {
    let cache = TableCache::new(cache_dir(work.cache_dir.as_deref())?);
    let mut resources = Resources::new(cache).with_denoiser(denoiser(work.oidn.as_deref()));
    let reporter = Reporter::new(work.quiet);
    let json = JsonLog::new();
    let listener = Listener::new(match work.log {
        LogArg::Text => &reporter,
        LogArg::Json => &json,
    })?;
    let mut sweep = || fogbank::sweep(plan, options, &work.out, &mut resources, &listener);
    let result = match options.workers {
        None => rayon::ThreadPoolBuilder::new().num_threads(threads(work)).build()?.install(sweep),
        Some(_) => sweep(),
    };
    reporter.close();
    result?;
    Ok(ExitCode::from(u8::from(listener.failures() > 0)))
}

fn available_threads() -> usize {
    std::thread::available_parallelism().map_or(1, usize::from)
}

pub(crate) fn threads(work: &WorkArgs) -> usize {
    work.threads.map_or_else(available_threads, usize::from)
}

/// The library asked for, or the one that the environment names.
fn denoiser(asked: Option<&Path>) -> Option<PathBuf> {
    let named = || std::env::var_os("FOGBANK_OIDN").filter(|v| !v.is_empty()).map(PathBuf::from);
    asked.map(Path::to_owned).or_else(named)
}

/// The folder asked for, or [`fogbank::default_cache_dir`].
pub(crate) fn cache_dir(asked: Option<&Path>) -> Result<PathBuf> {
    let dir = asked.map(Path::to_owned).or_else(fogbank::default_cache_dir);
    dir.context("no cache folder is known on this machine: name one with --cache-dir DIR")
}
