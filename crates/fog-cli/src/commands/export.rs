//! `fogbank export`: a data set in a format of others.

use crate::args::ExportArgs;
use crate::listener::stop_on_request;
use crate::pace::{self, Pace};
use crate::print;
use anyhow::Result;
use fog_export::{Options, Progress};
use indicatif::ProgressBar;
use std::process::ExitCode;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex};

pub(crate) fn run(args: &ExportArgs) -> Result<ExitCode> {
    let options = Options {
        classes: args.classes.clone(),
        shard_size_mib: args.format.is_sharded().then_some(args.shard_size),
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

/// Where the user sees how far it is, and can stop it.
struct Shown {
    quiet: bool,
    bar: ProgressBar,
    stop: Arc<AtomicBool>,
    pace: Mutex<Pace>,
}

impl Shown {
    fn new(quiet: bool, stop: Arc<AtomicBool>) -> Self {
        Self { quiet, bar: pace::bar(quiet), stop, pace: Mutex::new(Pace::new()) }
    }

    fn goes_on(&self) -> bool {
        !self.stop.load(Ordering::Relaxed)
    }
}

impl Progress for Shown {
    fn begin(&self, frames: u64) -> bool {
        self.bar.set_style(pace::style("  {bar:40} {pos}/{len} {msg} ETA {eta}"));
        self.bar.set_length(frames);
        if let Ok(mut pace) = self.pace.lock() {
            *pace = Pace::new();
        }
        self.goes_on()
    }

    fn frame(&self, id: &str) -> bool {
        self.bar.set_message(id.to_owned());
        self.bar.inc(1);
        let (done, all) = (self.bar.position(), self.bar.length().unwrap_or_default());
        if !self.quiet
            && self.bar.is_hidden()
            && let Ok(mut pace) = self.pace.lock()
            && let Some(left) = pace.line(done as f64 / all as f64)
        {
            print::news(format_args!("  {done} of {all} frames, about {left} left"));
        }
        self.goes_on()
    }
}
