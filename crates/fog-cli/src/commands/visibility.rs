//! `fogbank visibility`: how far one sees in a fog, by every law.

mod air;
mod facts;
mod laws;
mod section;

use crate::args::VisibilityArgs;
use crate::rows::Form;
use air::Air;
use anyhow::Result;
use laws::Laws;
use section::Section;
use std::io::Write;
use std::process::ExitCode;

/// Altitude in m if none is asked for: about that of a driver's eyes, and of instruments beside a runway.
const DEFAULT_ALTITUDE_M: f64 = 2.0;

pub(crate) fn run(args: &VisibilityArgs) -> Result<ExitCode> {
    let altitudes = match args.fog.altitude[..] {
        [] => vec![DEFAULT_ALTITUDE_M],
        _ => args.fog.altitude.clone(),
    };
    let air = Air::new(args, altitudes[0])?;
    let laws = Laws::new(args)?;
    let mut reports = Vec::new();
    for &altitude in &altitudes {
        reports.push((altitude, laws.report(args, &air, altitude)?));
    }

    let mut out = std::io::BufWriter::new(std::io::stdout().lock());
    match args.form.form() {
        Form::Table => {
            writeln!(out, "{}", air.description)?;
            for (_, sections) in &reports {
                sections.iter().try_for_each(|s| s.print(&mut out))?;
            }
        }
        Form::Json => {
            for (_, sections) in &reports {
                writeln!(out, "{}", section::json(&air.description, sections))?;
            }
        }
        Form::Csv => section::print_csv(&reports, &mut out)?,
    }
    out.flush()?;
    Ok(ExitCode::SUCCESS)
}

/// What is known at an altitude, in the order in which it is printed.
type Report = Vec<Section>;
