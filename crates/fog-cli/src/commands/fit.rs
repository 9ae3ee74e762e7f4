//! `fogbank fit`: a fog model from measured droplet counts, and counts from a fog model.

use super::figures;
use crate::args::{FigureFormat, FitArgs, FitCommand, SyntheticArgs};
use crate::print;
use anyhow::{Context, Result, bail, ensure};
use fogbank::figures::fit_report;
use fogbank::optics::advection::AdvectionModel;
use fogbank::optics::fit::{self, Fit, FitSettings, synthetic};
use indicatif::{ProgressBar, ProgressStyle};
use std::fs;
use std::path::Path;
use std::process::ExitCode;
use std::time::{Duration, Instant};

/// A fit that takes longer shows its progress on a terminal.
const PATIENCE: Duration = Duration::from_secs(1);

pub(crate) fn run(args: &FitArgs) -> Result<ExitCode> {
    if let Some(FitCommand::Synthetic(args)) = &args.command {
        return write_synthetic(args);
    }
    let (Some(data), Some(out)) = (&args.data, &args.out) else {
        bail!("name DATA.csv and --out MODEL.yaml")
    };
    ensure!(!same_file(data, out), "--out {} would overwrite the measurements", out.display());
    let text = read(data)?;
    let measurements = fit::parse(&text, &data.display().to_string())?;
    let range = match args.diameter_range_um.as_deref() {
        None => None,
        Some(&[low, high]) => Some([low, high]),
        Some(_) => bail!("--diameter-range-um needs LOW,HIGH"),
    };
    let settings = FitSettings {
        diameter_range_um: range,
        outlier_mads: args.outlier_mads,
        refine: !args.staged,
        ..FitSettings::default()
    };
    let found = with_progress(|progress| fit::fit(&measurements, &settings, progress))?;

    write(out, &found.model_yaml)?;
    if let Some(dir) = &args.report {
        write_report(&found, dir)?;
    }
    if !args.quiet {
        print::news(found.summary().trim_end());
        print::news(format_args!("model: {}", out.display()));
        if let Some(dir) = &args.report {
            print::news(format_args!("report: {}", dir.join("report.md").display()));
        }
    }
    warn(&found);
    Ok(ExitCode::SUCCESS)
}

/// Report, tables and figures of a fit, in a folder that is made if it is not there.
fn write_report(found: &Fit, dir: &Path) -> Result<()> {
    fs::create_dir_all(dir).with_context(|| format!("cannot make the folder {}", dir.display()))?;
    let mut report = found.report_markdown();
    report.push_str("\n## Figures\n");
    for figure in fit_report(found)? {
        figures::write(&figure, FigureFormat::Svg, dir)?;
        figures::write(&figure, FigureFormat::Png, dir)?;
        report.push_str(&format!("\n![{}]({}.png)\n", figure.title, figure.name));
    }
    write(&dir.join("report.md"), &report)?;
    write(&dir.join("fits.csv"), &found.fits_csv())?;
    write(&dir.join("parameters.csv"), &found.parameters_csv())?;
    write(&dir.join("spectra.csv"), &found.spectra_csv())
}

fn write_synthetic(args: &SyntheticArgs) -> Result<ExitCode> {
    let model = match args.model.as_str() {
        "arcata" => AdvectionModel::arcata()?,
        path => AdvectionModel::from_yaml(&read(path.as_ref())?).with_context(|| path.to_owned())?,
    };
    let defaults = synthetic::FlightSettings::arcata();
    let [low, high, width] = args.bins_um[..] else { bail!("--bins needs LOW,HIGH,WIDTH") };
    let bins = ((high - low) / width).round();
    ensure!(
        width > 0.0 && (1.0..=1000.0).contains(&bins) && (low + bins * width - high).abs() < 1e-6,
        "--bins {low},{high},{width}: expected a width that divides the distance from LOW to HIGH into 1 to 1000 bins"
    );
    let settings = synthetic::FlightSettings {
        heights_m: args.heights_m.clone(),
        altitude_step_m: args.altitude_step_m,
        // Edges without the rounding of repeated addition.
        bin_edges_um: (0..=bins as u32).map(|i| (1e6 * (low + width * f64::from(i))).round() / 1e6).collect(),
        sample_volume_m3: args.sample_volume_cm3.map_or(defaults.sample_volume_m3, |v| v * 1e-6),
        approaches: args.approaches,
        seed: args.seed,
    };
    let text = synthetic::csv(&model, &settings, &args.model)?;
    write(&args.out, &text)?;
    let rows = text.lines().filter(|line| line.starts_with(|c: char| c.is_ascii_digit())).count();
    print::news(format_args!("{}: {rows} rows of counts", args.out.display()));
    Ok(ExitCode::SUCCESS)
}

/// Runs the work with a bar on a terminal if it takes a while.
fn with_progress<T>(work: impl FnOnce(&(dyn Fn(f64) + Sync)) -> T) -> T {
    let bar = ProgressBar::new(1000);
    let style = ProgressStyle::with_template("  {bar:40} {percent:>3} %  fitting");
    bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
    let started = Instant::now();
    let result = work(&|done| {
        if started.elapsed() > PATIENCE {
            bar.set_position((1000.0 * done) as u64);
        }
    });
    bar.finish_and_clear();
    result
}

fn warn(found: &Fit) {
    for warning in &found.warnings {
        print::news(format_args!("warning: {warning}"));
    }
}

fn same_file(a: &Path, b: &Path) -> bool {
    matches!((fs::canonicalize(a), fs::canonicalize(b)), (Ok(a), Ok(b)) if a == b)
}

fn read(path: &Path) -> Result<String> {
    fs::read_to_string(path).with_context(|| format!("cannot read {}", path.display()))
}

fn write(path: &Path, text: &str) -> Result<()> {
    fs::write(path, text).with_context(|| format!("cannot write {}", path.display()))
}
