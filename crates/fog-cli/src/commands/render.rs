//! `fogbank render`: one frame of a configuration.

use crate::args::RenderArgs;
use anyhow::Result;
use fogbank::{Error, Selection};
use std::process::ExitCode;

pub(crate) fn run(args: &RenderArgs) -> Result<ExitCode> {
    let plan = fogbank::plan::load(&args.config.config, &args.config.sets).map_err(Error::from)?;
    let selection = match &args.frame {
        Some(wanted) => Selection::One(wanted.clone()),
        None if plan.len() == 1 => Selection::All,
        None => {
            let (name, count) = (plan.name().to_owned(), plan.len());
            return Err(Error::NotOneFrame { name, count }.into());
        }
    };
    super::sweep::render(&plan, &selection, &args.work)
}
