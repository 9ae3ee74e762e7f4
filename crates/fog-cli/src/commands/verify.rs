//! `fogbank verify`: is a data set what it says it is?

use crate::args::VerifyArgs;
use crate::print;
use anyhow::Result;
use std::process::ExitCode;

pub(crate) fn run(args: &VerifyArgs) -> Result<ExitCode> {
    let report = fogbank::dataset::verify(&args.dir).map_err(fogbank::Error::from)?;
    for problem in &report.problems {
        print::news(format_args!("{}: {}", problem.file, problem.reason));
    }
    print::news(format_args!("{}: {}", args.dir.display(), report.counts));
    Ok(ExitCode::from(u8::from(!report.is_complete())))
}
