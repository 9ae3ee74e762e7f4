//! `fogbank plan`: the frames of a configuration.

use crate::args::PlanArgs;
use crate::report;
use anyhow::Result;
use std::io::Write;
use std::process::ExitCode;

/// Frames that are listed without being asked for.
const LISTED: usize = 1000;

pub(crate) fn run(args: &PlanArgs) -> Result<ExitCode> {
    let plan = fogbank::plan::load(&args.config.config, &args.config.sets).map_err(fogbank::Error::from)?;
    let mut out = std::io::BufWriter::new(std::io::stdout().lock());
    if !args.json {
        let threads = std::thread::available_parallelism().map_or(1, usize::from);
        report::print_plan(&plan, threads, &mut out)?;
        writeln!(out)?;
    }
    let listed = if args.json || args.all { plan.len() } else { plan.len().min(LISTED) };
    for index in 0..listed {
        let frame = plan.frame(index).map_err(fogbank::Error::from)?;
        if args.json {
            serde_json::to_writer(&mut out, &frame).map_err(std::io::Error::from)?;
            writeln!(out)?;
        } else {
            writeln!(out, "{:>6}  {}", frame.index, frame.id)?;
        }
    }
    if listed < plan.len() {
        writeln!(out, "        … and {} more; --all lists them", plan.len() - listed)?;
    }
    out.flush()?;
    Ok(ExitCode::SUCCESS)
}
