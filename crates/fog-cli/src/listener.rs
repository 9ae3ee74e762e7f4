//! Between the main path and what is shown of it: counts failures, and asks to stop when the user does.

use anyhow::Result;
use fogbank::{Event, Progress};
use signal_hook::consts::{SIGINT, SIGTERM};
use signal_hook::flag;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};

/// Passes events on.
pub(crate) struct Listener<'a> {
    shown: &'a dyn Progress,
    failures: AtomicU64,
    stop: Arc<AtomicBool>,
}

impl<'a> Listener<'a> {
    /// Passes events on to `shown`. From now on the first SIGINT or SIGTERM asks the main path to stop and the second ends the
    /// program.
    pub(crate) fn new(shown: &'a dyn Progress) -> Result<Self> {
        Ok(Self { shown, failures: AtomicU64::new(0), stop: stop_on_request()? })
    }

    /// Frames that failed, or had failed before and were not tried again.
    pub(crate) fn failures(&self) -> u64 {
        self.failures.load(Ordering::Relaxed)
    }
}

/// A flag that the first SIGINT or SIGTERM sets; the second ends the program.
pub(crate) fn stop_on_request() -> Result<Arc<AtomicBool>> {
    let stop = Arc::new(AtomicBool::new(false));
    for signal in [SIGINT, SIGTERM] {
        // In this order: what ends the program looks at the flag before it is set.
        flag::register_conditional_shutdown(signal, 128 + signal, Arc::clone(&stop))?;
        flag::register(signal, Arc::clone(&stop))?;
    }
    Ok(stop)
}

impl Progress for Listener<'_> {
    fn event(&self, event: Event<'_>) -> bool {
        match event {
            Event::FrameFailed { .. } => self.failures.fetch_add(1, Ordering::Relaxed),
            Event::Ready { failed, .. } => self.failures.fetch_add(failed as u64, Ordering::Relaxed),
            _ => 0,
        };
        self.shown.event(event) && !self.stop.load(Ordering::Relaxed)
    }
}
