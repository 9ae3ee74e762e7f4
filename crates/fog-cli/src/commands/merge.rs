//! `fogbank merge`: parts of a data set into one folder.

use crate::args::MergeArgs;
use crate::print;
use anyhow::Result;
use std::process::ExitCode;

pub(crate) fn run(args: &MergeArgs) -> Result<ExitCode> {
    let merged = fogbank::dataset::merge(&args.out, &args.parts).map_err(fogbank::Error::from)?;
    for problem in &merged.problems {
        print::complaint(format_args!("{}: {}", problem.file, problem.reason));
    }
    for (part, taken) in args.parts.iter().zip(&merged.taken) {
        print::news(format_args!("{}: {taken} frames taken", part.display()));
    }
    let counts = merged.counts;
    print::news(format_args!("{}: {counts}", args.out.display()));
    let complete = counts.failed == 0 && counts.missing == 0;
    Ok(ExitCode::from(u8::from(!complete)))
}
