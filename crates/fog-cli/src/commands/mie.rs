//! `fogbank mie`: one sphere.

use crate::args::MieArgs;
use crate::rows::{self, Cell, Form};
use anyhow::Result;
use fogbank::optics::mie::{Complex64, MieSeries};
use fogbank::optics::{intensities, water};
use std::io::Write;
use std::process::ExitCode;

const SPHERE: [&str; 8] = ["n", "k", "size_parameter", "q_ext", "q_sca", "q_abs", "q_back", "g"];
const ANGLE: [&str; 4] = ["angle_deg", "abs_s1_sq", "abs_s2_sq", "phase_function_1_sr"];

pub(crate) fn run(args: &MieArgs) -> Result<ExitCode> {
    let m = index(args)?;
    let x = match (args.size_parameter, args.diameter_um, args.wavelength) {
        (Some(x), ..) => x,
        (None, Some(d_um), Some(nm)) => std::f64::consts::PI * d_um * 1e3 / nm,
        _ => anyhow::bail!("a sphere needs --size-parameter, or --diameter-um with --wavelength"),
    };
    let series = MieSeries::new(m, x)?;
    let q = series.efficiencies();
    let sphere: Vec<Cell> =
        [m.re, m.im, x, q.q_ext, q.q_sca, q.q_abs, q.q_back, q.g].map(Cell::from).to_vec();
    let degrees = args.angles.as_ref().map_or(&[][..], |angles| &angles.0);
    let angles: Vec<Vec<Cell>> = (intensities::at_degrees(&series, degrees)?.iter())
        .map(|i| [i.angle_deg, i.s1_sq, i.s2_sq, i.phase_function_1_sr].map(Cell::from).to_vec())
        .collect();

    let mut out = std::io::BufWriter::new(std::io::stdout().lock());
    match args.form.form() {
        form if degrees.is_empty() => rows::print(form, &SPHERE, &[sphere], &mut out)?,
        Form::Table => {
            rows::print(Form::Table, &SPHERE, &[sphere], &mut out)?;
            writeln!(out)?;
            rows::print(Form::Table, &ANGLE, &angles, &mut out)?;
        }
        Form::Json => {
            let mut object = rows::object(&SPHERE, &sphere);
            object["angles"] = angles.iter().map(|row| rows::object(&ANGLE, row)).collect();
            writeln!(out, "{object}")?;
        }
        Form::Csv => {
            let columns = [&SPHERE[..], &ANGLE[..]].concat();
            let rows: Vec<_> = angles.iter().map(|row| [&sphere[..], row].concat()).collect();
            rows::print(Form::Csv, &columns, &rows, &mut out)?;
        }
    }
    out.flush()?;
    Ok(ExitCode::SUCCESS)
}

fn index(args: &MieArgs) -> Result<Complex64> {
    match (args.index, args.wavelength) {
        (Some([n, k]), _) => Ok(Complex64::new(n, k)),
        (None, Some(nm)) => Ok(water::refractive_index(nm)?),
        (None, None) => anyhow::bail!("a sphere needs --index, or --wavelength for the index of water"),
    }
}
