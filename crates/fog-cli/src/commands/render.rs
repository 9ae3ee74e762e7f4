//! `fogbank render`: one frame of a configuration.

use crate::args::RenderArgs;
use anyhow::Result;
use fogbank::{Error, Selection, SweepOptions};
use std::process::ExitCode;

pub(crate) fn run(args: &RenderArgs) -> Result<ExitCode> {
    let plan = fogbank::plan::load(&args.config.config, &args.config.sets).map_err(Error::from)?;
    let selection = match &args.frame {
        Some(wanted) => Selection::one(wanted.clone()),
        None if plan.len() == 1 => Selection::default(),
        None => {
            let (name, count) = (plan.name().to_owned(), plan.len());
            return Err(Error::NotOneFrame { name, count }.into());
        }
    };
    // Who asks for one frame by name wants it tried.
    let options = SweepOptions { selection, retry_failed: true, ..SweepOptions::default() };
    super::sweep::render(&plan, &options, &args.work)
}
