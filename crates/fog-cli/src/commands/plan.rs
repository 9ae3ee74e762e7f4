//! `fogbank plan`: the frames of a configuration.

use crate::args::PlanArgs;
use crate::report;
use anyhow::Result;
use std::io::Write;
use std::process::ExitCode;

pub(crate) fn run(args: &PlanArgs) -> Result<ExitCode> {
    let plan = fogbank::plan::load(&args.config.config, &args.config.sets).map_err(fogbank::Error::from)?;
    let mut out = std::io::BufWriter::new(std::io::stdout().lock());
    if !args.json {
        let threads = std::thread::available_parallelism().map_or(1, usize::from);
        report::print_plan(&plan, threads, &mut out)?;
        writeln!(out)?;
    }
    for frame in plan.frames() {
        let frame = frame.map_err(fogbank::Error::from)?;
        if args.json {
            serde_json::to_writer(&mut out, &frame).map_err(std::io::Error::from)?;
            writeln!(out)?;
        } else {
            writeln!(out, "{:>6}  {}", frame.index, frame.id)?;
        }
    }
    out.flush()?;
    Ok(ExitCode::SUCCESS)
}
