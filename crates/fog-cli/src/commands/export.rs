//! `fogbank export`: a data set in a format of others.

use crate::args::ExportArgs;
use crate::listener::stop_on_request;
use crate::print;
use anyhow::Result;
use fog_export::{Format, Options, Progress};
use indicatif::{HumanDuration, ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::io::IsTerminal;
use std::process::ExitCode;
use std::sync::Arc;
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

/// Seconds between progress lines where no terminal shows a bar.
const LINE_SECONDS: u64 = 10;

pub(crate) fn run(args: &ExportArgs) -> Result<ExitCode> {
    let options = Options {
        classes: args.classes.clone(),
        shard_size_mib: takes_shards(args.format).then_some(args.shard_size),
        force: args.force,
    };
    let shown = Shown::new(args.quiet, stop_on_request()?);
    let result = fog_export::export(&args.dir, args.format, &args.out, &options, &shown);
    shown.bar.finish_and_clear();
    let summary = result?;
    if !args.quiet {
        let out = args.out.display();
        let word = if summary.was_there { "were exported already" } else { "exported" };
        print::news(format_args!("{out}: {} frames {word} as {}", summary.exported, args.format));
        for loss in &summary.losses {
            print::news(format_args!("  {}: {} {}", loss.name, loss.count, loss.what));
        }
    }
    let left_out = summary.failed + summary.missing;
    if left_out > 0 {
        let (failed, missing) = (summary.failed, summary.missing);
        let told =
            format_args!("{left_out} frames are not in the export: {failed} failed, {missing} missing");
        print::complaint(told);
    }
    Ok(ExitCode::from(u8::from(left_out > 0)))
}

/// Whether the size of files is of account to a format.
fn takes_shards(format: Format) -> bool {
    matches!(format, Format::WebDataset | Format::HuggingFace)
}

/// A bar with ETA on a terminal, now and then a line elsewhere.
struct Shown {
    quiet: bool,
    bar: ProgressBar,
    stop: Arc<AtomicBool>,
    lines: Mutex<Lines>,
}

struct Lines {
    started: Instant,
    printed: Instant,
}

impl Shown {
    fn new(quiet: bool, stop: Arc<AtomicBool>) -> Self {
        let visible = !quiet && std::io::stderr().is_terminal();
        let target = if visible { ProgressDrawTarget::stderr() } else { ProgressDrawTarget::hidden() };
        let now = Instant::now();
        let lines = Mutex::new(Lines { started: now, printed: now });
        Self { quiet, bar: ProgressBar::with_draw_target(None, target), stop, lines }
    }

    fn goes_on(&self) -> bool {
        !self.stop.load(Ordering::Relaxed)
    }
}

impl Progress for Shown {
    fn begin(&self, frames: u64) -> bool {
        let style = ProgressStyle::with_template("  {bar:40} {pos}/{len} {msg} ETA {eta}");
        self.bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
        self.bar.set_length(frames);
        if let Ok(mut lines) = self.lines.lock() {
            let now = Instant::now();
            *lines = Lines { started: now, printed: now };
        }
        self.goes_on()
    }

    fn frame(&self, id: &str) -> bool {
        self.bar.set_message(id.to_owned());
        self.bar.inc(1);
        let (done, all) = (self.bar.position(), self.bar.length().unwrap_or_default());
        if let Ok(mut lines) = self.lines.lock()
            && !self.quiet
            && self.bar.is_hidden()
            && done < all
            && lines.printed.elapsed().as_secs() >= LINE_SECONDS
        {
            lines.printed = Instant::now();
            let left = lines.started.elapsed().as_secs_f64() * (all - done) as f64 / done as f64;
            let left = HumanDuration(Duration::from_secs_f64(left.max(1.0)));
            print::news(format_args!("  {done} of {all} frames, about {left} left"));
        }
        self.goes_on()
    }
}
