//! `fogbank figures`: a fog model in pictures.

use crate::args::{FigureFormat, FiguresArgs};
use crate::print;
use anyhow::{Context, Result};
use fogbank::figures::{Figure, NAMES, Sources};
use fogbank::optics::advection::{ARCATA, AdvectionModel};
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::io::IsTerminal;
use std::path::Path;
use std::process::ExitCode;
use std::time::{Duration, Instant};

pub(crate) fn run(args: &FiguresArgs) -> Result<ExitCode> {
    let model = model(args.model.as_deref())?;
    let sources = Sources::new(&model, &args.heights)?;
    let names: Vec<&str> =
        (NAMES.into_iter()).filter(|n| args.only.is_empty() || args.only.iter().any(|o| o == n)).collect();
    let bar = bar(names.len() as u64, args.quiet);
    let say = |text: String| {
        if !args.quiet {
            bar.suspend(|| print::news(text));
        }
    };
    let measured = model.measured_heights_m();
    for height in args.heights.iter().filter(|&&h| model.extrapolates(h)) {
        let (least, most) = (measured[0], measured[measured.len() - 1]);
        say(format!("warning: fog of {height} m extrapolates the model, measured from {least} to {most} m"));
    }
    std::fs::create_dir_all(&args.out).with_context(|| format!("cannot make {}", args.out.display()))?;
    for name in names {
        bar.set_message(name);
        let started = Instant::now();
        let figure = sources.draw(name)?;
        let mut formats = args.format.clone();
        formats.dedup();
        for &format in &formats {
            write(&figure, format, &args.out)?;
        }
        let seconds = started.elapsed().as_secs_f64();
        bar.inc(1);
        say(format!("{name:<12} {}  ({seconds:.1} s)", figure.title));
    }
    bar.finish_and_clear();
    Ok(ExitCode::SUCCESS)
}

/// Shows on a terminal what is being drawn: the phenomena take some seconds.
fn bar(figures: u64, quiet: bool) -> ProgressBar {
    let visible = !quiet && std::io::stderr().is_terminal();
    let target = if visible { ProgressDrawTarget::stderr() } else { ProgressDrawTarget::hidden() };
    let bar = ProgressBar::with_draw_target(Some(figures), target);
    let style = ProgressStyle::with_template("  {spinner} {pos}/{len} drawing {msg} …");
    bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_spinner()));
    bar.enable_steady_tick(Duration::from_millis(200));
    bar
}

/// The model in a file, or the shipped one.
fn model(file: Option<&Path>) -> Result<AdvectionModel> {
    let Some(file) = file else { return Ok(AdvectionModel::from_yaml(ARCATA)?) };
    let text = std::fs::read_to_string(file).with_context(|| format!("cannot read {}", file.display()))?;
    AdvectionModel::from_yaml(&text).with_context(|| file.display().to_string())
}

/// Writes one form of a figure into a folder, under the figure's name.
pub(super) fn write(figure: &Figure, format: FigureFormat, dir: &Path) -> Result<()> {
    let path = dir.join(format!("{}.{}", figure.name, format.extension()));
    let written = match format {
        FigureFormat::Svg => std::fs::write(&path, &figure.svg),
        FigureFormat::Csv => std::fs::write(&path, &figure.csv),
        FigureFormat::Png => std::fs::write(&path, figure.png()?),
    };
    written.with_context(|| format!("cannot write {}", path.display()))
}
