//! One worker: its process and pipes, seen from both sides.

use super::messages::{Lines, line};
use crate::error::Error;
use crate::resources::Resources;
use crate::work::{Job, Report};
use nix::sys::signal::{Signal, kill};
use nix::sys::wait::{WaitStatus, waitpid};
use nix::unistd::{ForkResult, Pid, fork, pipe};
use std::fs::File;
use std::io::{Read, Write};
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

/// A worker as the parent sees it.
#[derive(Debug)]
pub(super) struct Child {
    pid: Pid,
    tasks: File,
    events: File,
    lines: Lines,
    /// The set at work, and when it was begun.
    at_work: Option<(usize, Instant)>,
}

impl Child {
    /// A new process that runs `work` with its ends of the two pipes.
    ///
    /// # Errors
    /// If the system has no process or pipe left.
    #[allow(unsafe_code)]
    pub(super) fn fork(work: impl FnOnce(File, File)) -> nix::Result<Self> {
        let (task_reader, task_writer) = pipe()?;
        let (event_reader, event_writer) = pipe()?;
        // SAFETY: the child of a process with threads may hold locks that nobody will release. The caller has none left (`sweep`
        // makes tables and scenes on a scoped pool), and the child starts a pool of its own.
        match unsafe { fork() }? {
            ForkResult::Child => {
                drop((task_writer, event_reader));
                die_with_parent();
                // Panics are caught and reported as the failure of a frame; the parent's terminal is not ours.
                std::panic::set_hook(Box::new(|_| {}));
                work(File::from(task_reader), File::from(event_writer));
                std::process::exit(0)
            }
            ForkResult::Parent { child } => Ok(Self {
                pid: child,
                tasks: File::from(task_writer),
                events: File::from(event_reader),
                lines: Lines::default(),
                at_work: None,
            }),
        }
    }

    /// Where its reports come from.
    pub(super) fn events(&self) -> &File {
        &self.events
    }

    /// The set that it is at.
    pub(super) fn set(&self) -> Option<usize> {
        self.at_work.map(|(set, _)| set)
    }

    /// Time since it was given its set.
    pub(super) fn time(&self) -> Option<Duration> {
        self.at_work.map(|(_, begun)| begun.elapsed())
    }

    /// Gives it a set. That it cannot be given shows when its reports end.
    pub(super) fn begin(&mut self, set: usize) {
        self.at_work = Some((set, Instant::now()));
        drop(self.tasks.write_all(&(set as u64).to_le_bytes()));
    }

    /// Its set is through.
    pub(super) fn end(&mut self) {
        self.at_work = None;
    }

    /// What it has reported, and whether more may come.
    pub(super) fn read(&mut self) -> (Vec<Report<'static>>, bool) {
        let mut bytes = [0; 1 << 16];
        match self.events.read(&mut bytes) {
            Ok(0) => (Vec::new(), false),
            Ok(n) => (self.lines.take(&bytes[..n]), true),
            Err(e) => (Vec::new(), e.kind() == std::io::ErrorKind::Interrupted),
        }
    }

    /// Nothing is left to do: it ends by itself when its tasks end.
    pub(super) fn dismiss(self) {
        drop(self.tasks);
        let _ = waitpid(self.pid, None);
    }

    /// Ends it at once, if it has not ended; says how it ended.
    pub(super) fn kill(self) -> String {
        // One that has ended keeps its own end.
        let _ = kill(self.pid, Signal::SIGKILL);
        match waitpid(self.pid, None) {
            Ok(WaitStatus::Exited(_, code)) => format!("ended with status {code}"),
            Ok(WaitStatus::Signaled(_, Signal::SIGKILL, _)) => {
                "was killed (SIGKILL: perhaps memory ran out)".to_owned()
            }
            Ok(WaitStatus::Signaled(_, signal, _)) => format!("died of {signal}"),
            _ => "is gone".to_owned(),
        }
    }
}

/// Asks the system to end this process when its parent ends, where that can be had; else it notices by its pipes.
fn die_with_parent() {
    #[cfg(target_os = "linux")]
    let _ = nix::sys::prctl::set_pdeathsig(Signal::SIGKILL);
}

/// The life of a worker: sets from `tasks` until they end, reports to `events`.
pub(super) fn work(job: &Job, resources: &Resources, threads: usize, mut tasks: File, events: File) {
    let Ok(pool) = rayon::ThreadPoolBuilder::new().num_threads(threads).build() else { return };
    let events = Mutex::new(events);
    // A parent that does not listen any more is dead.
    let report = |report: Report<'_>| {
        let mut events = events.lock().unwrap_or_else(PoisonError::into_inner);
        events.write_all(&line(&report)).is_ok()
    };
    let mut set = [0; 8];
    while tasks.read_exact(&mut set).is_ok() {
        let set = u64::from_le_bytes(set) as usize;
        match pool.install(|| job.work(set, resources, &report)) {
            Ok(()) if report(Report::Through) => {}
            Ok(()) | Err(Error::Cancelled) => return,
            Err(e) => {
                report(Report::Broken(e.to_string().into()));
                return;
            }
        }
    }
}
