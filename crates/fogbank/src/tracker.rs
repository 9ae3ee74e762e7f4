//! From what happens to sets at work to what the caller hears.

use crate::forecast::Forecast;
use crate::progress::{Event, Progress};
use crate::work::{Job, Report};
use std::sync::{Mutex, PoisonError};

/// Tells a caller of all sets at work, each in a lane of its own.
pub(crate) struct Tracker<'a> {
    job: &'a Job,
    progress: &'a dyn Progress,
    forecast: Mutex<Forecast>,
}

impl<'a> Tracker<'a> {
    pub(crate) fn new(job: &'a Job, lanes: usize, progress: &'a dyn Progress) -> Self {
        let frames = job.todo.iter().flatten().map(|&i| &job.frames[i]);
        Self { job, progress, forecast: Mutex::new(Forecast::new(frames, lanes)) }
    }

    fn forecast<T>(&self, change: impl FnOnce(&mut Forecast) -> T) -> T {
        change(&mut self.forecast.lock().unwrap_or_else(PoisonError::into_inner))
    }

    /// A set begins; false asks to stop.
    pub(crate) fn begin(&self, lane: usize, set: usize) -> bool {
        self.forecast(|f| f.begin(lane, &self.job.specs(set)));
        self.progress.event(Event::FrameStarted { id: self.job.name(set) })
    }

    /// Something happened to the set in a lane; false asks to stop.
    pub(crate) fn report(&self, lane: usize, report: Report<'_>) -> bool {
        match report {
            Report::Traced(n) => {
                self.forecast(|f| f.count(lane, n));
                self.progress.event(Event::Paths(n))
            }
            Report::Left(n) => {
                let total = self.forecast(|f| {
                    f.expect(lane, n);
                    f.total()
                });
                self.progress.event(Event::Expected(total))
            }
            Report::Done { frame, seconds, noise } => {
                self.progress.event(Event::FrameDone { id: &self.job.frames[frame].id, seconds, noise })
            }
            Report::Failed { frame, reason } => {
                self.progress.event(Event::FrameFailed { id: &self.job.frames[frame].id, reason: &reason })
            }
            Report::Through => {
                self.forecast(|f| f.end(lane));
                true
            }
            Report::Broken(_) => true,
        }
    }

    /// The set in a lane was given up and will be begun again; false asks to stop.
    pub(crate) fn give_up(&self, lane: usize, set: usize) -> bool {
        let total = self.forecast(|f| {
            f.give_up(lane, &self.job.specs(set));
            f.total()
        });
        self.progress.event(Event::Expected(total))
    }

    /// A set will not be begun again.
    pub(crate) fn skip(&self, set: usize) {
        self.forecast(|f| f.skip(&self.job.specs(set)));
    }

    /// Tells the caller that work goes on though nothing happened; false asks to stop.
    pub(crate) fn wait(&self) -> bool {
        self.progress.event(Event::Waiting)
    }
}
