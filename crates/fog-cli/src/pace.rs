//! How far work is: a bar on a terminal, elsewhere now and then a line.

use indicatif::{HumanDuration, ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::io::IsTerminal;
use std::time::{Duration, Instant};

/// Seconds between progress lines where no terminal shows a bar.
const LINE_SECONDS: u64 = 10;

/// A bar on a terminal that is not to be quiet; elsewhere one that nobody sees.
pub(crate) fn bar(quiet: bool) -> ProgressBar {
    let visible = !quiet && std::io::stderr().is_terminal();
    let target = if visible { ProgressDrawTarget::stderr() } else { ProgressDrawTarget::hidden() };
    ProgressBar::with_draw_target(None, target)
}

/// What a bar shows, in indicatif's words.
pub(crate) fn style(template: &str) -> ProgressStyle {
    ProgressStyle::with_template(template).unwrap_or_else(|_| ProgressStyle::default_bar())
}

/// When the next line is due.
pub(crate) struct Pace {
    started: Instant,
    printed: Instant,
}

impl Pace {
    /// Of work that begins now.
    pub(crate) fn new() -> Self {
        let now = Instant::now();
        Self { started: now, printed: now }
    }

    /// The time left when this share of the work, above 0, is done, if a line is due; then the next is due later.
    pub(crate) fn line(&mut self, share: f64) -> Option<HumanDuration> {
        if share >= 1.0 || self.printed.elapsed().as_secs() < LINE_SECONDS {
            return None;
        }
        self.printed = Instant::now();
        let left = self.started.elapsed().as_secs_f64() * (1.0 - share) / share;
        Some(HumanDuration(Duration::from_secs_f64(left.max(1.0))))
    }
}
