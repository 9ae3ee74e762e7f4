//! A sweep by several processes on one machine, each of which may die without harm to the others.
//!
//! Workers are forked when scenes and tables are loaded, so that all of them share that memory and each adds only what it
//! writes itself: films and stacks. They are given sets of frames over a pipe and report over another. A worker that dies or
//! takes too long is replaced and its set tried once more; what fails twice is recorded with its reason.

#[cfg(unix)]
mod child;
#[cfg(unix)]
mod messages;
#[cfg(unix)]
mod pool;

use crate::error::Error;
use crate::resources::Resources;
use crate::tracker::Tracker;
use crate::work::Job;
use std::time::Duration;

/// How many processes work, and how patiently.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Workers {
    /// Number of processes, at least 1.
    pub count: usize,
    /// Threads of each, at least 1.
    pub threads: usize,
    /// Longest time that frames which share paths may take together before their worker is replaced; none: any.
    pub timeout: Option<Duration>,
}

/// Renders all sets of a job.
///
/// Must be called by a process without other threads, for the children of a fork have none of them.
///
/// # Errors
/// If the tracker asks to stop, processes or pipes cannot be had, or a worker finds the folder broken.
#[cfg(unix)]
pub(crate) fn run(
    job: &Job,
    resources: &Resources,
    workers: Workers,
    tracker: &Tracker<'_>,
) -> Result<(), Error> {
    let mut pool = pool::Pool::new(job, resources, workers, tracker);
    let outcome = pool.run();
    pool.end();
    // What killed workers were about to write.
    job.data_set.clean()?;
    outcome
}

/// Renders nothing: this system has no `fork`.
///
/// # Errors
/// Always.
#[cfg(not(unix))]
pub(crate) fn run(_: &Job, _: &Resources, _: Workers, _: &Tracker<'_>) -> Result<(), Error> {
    Err(Error::Workers("several processes need a Unix system; leave --workers away".to_owned()))
}
