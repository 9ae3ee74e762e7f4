//! What the user sees while the work goes on: the plan, a progress bar with ETA on a terminal, lines elsewhere.

use crate::pace::{self, Pace};
use crate::print;
use anyhow::Result;
use fogbank::plan::Plan;
use fogbank::{Event, Progress, TableOrigin};
use indicatif::{HumanBytes, HumanDuration, ProgressBar};
use std::io::Write;
use std::sync::Mutex;
use std::time::Duration;

/// Paths per second and thread that an estimate before rendering counts with: the quickstart's mean where it was measured
/// (README). The bar's ETA takes over once paths are traced.
const NOMINAL_PATHS_PER_SECOND: f64 = 70_000.0;

/// Longest plan whose every frame is looked at for its size; of longer ones as many, evenly spread.
const LOOKED_AT: usize = 2000;

/// Prints name, axes, size and estimates of a plan.
pub(crate) fn print_plan(plan: &Plan, threads: usize, out: &mut dyn Write) -> Result<()> {
    let (mut paths, mut most, mut bytes) = (0u64, 0u64, 0u64);
    let count = plan.len().min(LOOKED_AT);
    let frames = (0..count)
        .map(|i| plan.frame((i as u128 * plan.len() as u128 / count as u128) as usize))
        .collect::<Result<Vec<_>, _>>()
        .map_err(fogbank::Error::from)?;
    for frame in &frames {
        paths += fogbank::path_count(frame);
        most += fogbank::most_paths(frame);
        let sensor = &frame.sensor;
        // The rest is a group too.
        let groups = frame.lighting.groups.len() + 1;
        let outputs = fogbank::output_set(frame);
        bytes += fogbank::dataset::estimate_bytes(sensor.width_px, sensor.height_px, outputs, groups);
    }
    let all = |sum: u64| (sum as u128 * plan.len() as u128 / count as u128) as u64;
    let (paths, most, bytes) = (all(paths), all(most), all(bytes));
    let mode = plan.mode().map(|m| format!(" ({m})")).unwrap_or_default();
    writeln!(out, "{}: {} frame{}{mode}", plan.name(), plan.len(), if plan.len() == 1 { "" } else { "s" })?;
    for axis in plan.axes() {
        let more = axis.len.is_some_and(|n| n > axis.values.len());
        writeln!(out, "  {:<20} {}{}", axis.path, axis.values.join(", "), if more { ", …" } else { "" })?;
    }
    let passes = fogbank::share_sets(&frames).len();
    if passes < frames.len() && frames.len() == plan.len() {
        let word = if passes == 1 { "pass" } else { "passes" };
        writeln!(out, "  {passes} {word}: frames share paths (render.share)")?;
    }
    let seconds = paths as f64 / (NOMINAL_PATHS_PER_SECOND * threads as f64);
    writeln!(
        out,
        "  {} {} on {threads} thread{} for {:.1} million paths{}, about {} on disk",
        if most > paths { "at least" } else { "about" },
        HumanDuration(Duration::from_secs_f64(seconds.max(1.0))),
        if threads == 1 { "" } else { "s" },
        paths as f64 / 1e6,
        if most > paths {
            format!(" (at most {:.1} million, until the noise is low)", most as f64 / 1e6)
        } else {
            String::new()
        },
        HumanBytes(bytes),
    )?;
    Ok(())
}

/// Prints the main path's events.
pub(crate) struct Reporter {
    quiet: bool,
    bar: ProgressBar,
    line: Mutex<Line>,
}

/// State of the lines that stand in for the bar.
struct Line {
    pace: Pace,
    paths: u64,
    total: u64,
    frames: usize,
    todo: usize,
}

impl Reporter {
    pub(crate) fn new(quiet: bool) -> Self {
        let line = Line { pace: Pace::new(), paths: 0, total: 0, frames: 0, todo: 0 };
        Self { quiet, bar: pace::bar(quiet), line: Mutex::new(line) }
    }

    /// Takes the bar off the screen.
    pub(crate) fn close(&self) {
        self.bar.finish_and_clear();
    }

    fn say(&self, text: &str) {
        if !self.quiet {
            self.bar.suspend(|| print::news(text));
        }
    }

    /// Counts paths; where there is no bar, now and then a line with the share done and the time left.
    fn count(&self, paths: u64) {
        self.bar.inc(paths);
        let Ok(mut line) = self.line.lock() else { return };
        line.paths += paths;
        let share = line.paths as f64 / line.total as f64;
        if self.bar.is_hidden()
            && let Some(left) = line.pace.line(share)
        {
            self.say(&format!(
                "  {:.0} %, {} of {} frames, about {left} left",
                100.0 * share,
                line.frames,
                line.todo
            ));
        }
    }

    fn begin(&self, paths: u64, todo: usize) {
        self.bar.reset();
        self.bar.set_style(pace::style("  {bar:40} {percent:>3} % {msg} ETA {eta}"));
        self.bar.set_length(paths);
        if let Ok(mut line) = self.line.lock() {
            *line = Line { pace: Pace::new(), paths: 0, total: paths, frames: 0, todo };
        }
    }

    /// Number of this frame among those to be rendered.
    fn next_frame(&self) -> String {
        self.line.lock().map_or_else(
            |_| String::new(),
            |mut line| {
                line.frames += 1;
                format!("{}/{}", line.frames, line.todo)
            },
        )
    }
}

impl Progress for Reporter {
    fn event(&self, event: Event<'_>) -> bool {
        match event {
            Event::TableProgress(fraction) => {
                self.bar.set_message(format!("optics table {:.0} %", 100.0 * fraction));
                self.bar.tick();
            }
            Event::Table { name, origin, seconds } => self.say(&match origin {
                TableOrigin::Found(path) => format!("optics table ({name}): {}", path.display()),
                TableOrigin::Built { path, replaced } => {
                    let why = replaced.as_ref().map(|r| format!("; the old file was damaged: {r}"));
                    let why = why.unwrap_or_default();
                    format!("optics table ({name}): built in {seconds:.1} s, {}{why}", path.display())
                }
                TableOrigin::Unstored { reason } => {
                    format!("optics table ({name}): built in {seconds:.1} s, but not kept: {reason}")
                }
            }),
            Event::Scene { name, triangles, warnings, seconds } => {
                self.say(&format!("scene {name}: {triangles} triangles, {seconds:.2} s"));
                for warning in warnings {
                    self.say(&format!("  warning: {warning}"));
                }
            }
            Event::Denoiser { path, version } => {
                self.say(&format!("Open Image Denoise {version}: {}", path.display()));
            }
            Event::Warning(text) => self.say(&format!("warning: {text}")),
            Event::Ready { done, failed, paths, todo } => {
                if done > 0 {
                    self.say(&format!("{done} frames are done already, {todo} to go"));
                }
                if failed > 0 {
                    let what = "failed before and are not tried again without --retry-failed";
                    self.bar.suspend(|| print::complaint(format_args!("{failed} frames {what}")));
                }
                self.begin(paths, todo);
            }
            Event::FrameStarted { id } => self.bar.set_message(id.to_owned()),
            Event::Paths(n) => self.count(n),
            Event::Waiting => self.bar.tick(),
            Event::Expected(paths) => {
                self.bar.set_length(paths);
                if let Ok(mut line) = self.line.lock() {
                    line.total = paths;
                }
            }
            Event::FrameDone { id, seconds, noise } => {
                let n = self.next_frame();
                self.say(&format!("{n:>7}  {id}  {seconds:.1} s, noise {:.1} %", 100.0 * noise));
            }
            Event::FrameFailed { id, reason } => {
                let n = self.next_frame();
                self.bar.suspend(|| print::complaint(format_args!("{n:>7}  {id}  FAILED: {reason}")));
            }
            Event::Finished { counts } => {
                let (failed, missing) = (counts.failed, counts.missing);
                self.say(&format!("{} frames done, {failed} failed, {missing} missing", counts.done));
            }
        }
        true
    }
}
