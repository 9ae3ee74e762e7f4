//! The parent of the workers: hands out sets, listens, replaces.

use super::Workers;
use super::child::{self, Child};
use crate::error::Error;
use crate::resources::Resources;
use crate::tracker::Tracker;
use crate::work::{Job, Report};
use nix::poll::{PollFd, PollFlags, PollTimeout, poll};
use std::collections::{BTreeMap, VecDeque};
use std::os::fd::AsFd;

/// Times that a set is begun before it counts as failed.
const ATTEMPTS: usize = 2;

/// How often the caller is asked whether to go on, and timeouts are looked at.
const TICK_MS: u16 = 100;

pub(super) struct Pool<'a> {
    job: &'a Job,
    resources: &'a Resources,
    workers: Workers,
    tracker: &'a Tracker<'a>,
    queue: VecDeque<usize>,
    /// Times that each set was begun.
    attempts: BTreeMap<usize, usize>,
    /// The worker of each lane; none where nothing is left to do.
    lanes: Vec<Option<Child>>,
}

impl<'a> Pool<'a> {
    pub(super) fn new(
        job: &'a Job,
        resources: &'a Resources,
        workers: Workers,
        tracker: &'a Tracker<'a>,
    ) -> Self {
        let count = workers.count.min(job.todo.len());
        let (queue, lanes) = ((0..job.todo.len()).collect(), (0..count).map(|_| None).collect());
        Self { job, resources, workers, tracker, queue, attempts: BTreeMap::new(), lanes }
    }

    /// Works until every set is through.
    pub(super) fn run(&mut self) -> Result<(), Error> {
        loop {
            for lane in 0..self.lanes.len() {
                self.feed(lane)?;
            }
            if self.lanes.iter().all(Option::is_none) {
                return Ok(());
            }
            for lane in self.ready()? {
                self.hear(lane)?;
            }
            self.replace_the_late()?;
            if !self.tracker.wait() {
                return Err(Error::Cancelled);
            }
        }
    }

    /// Ends every worker at once.
    pub(super) fn end(self) {
        self.lanes.into_iter().flatten().for_each(|child| drop(child.kill()));
    }

    /// Gives the lane's worker a set if it has none, and a worker to the lane; dismisses it when nothing is left.
    fn feed(&mut self, lane: usize) -> Result<(), Error> {
        if self.lanes[lane].as_ref().is_some_and(|child| child.set().is_some()) {
            return Ok(());
        }
        let Some(set) = self.queue.pop_front() else {
            if let Some(child) = self.lanes[lane].take() {
                child.dismiss();
            }
            return Ok(());
        };
        *self.attempts.entry(set).or_default() += 1;
        let go_on = self.tracker.begin(lane, set);
        if self.lanes[lane].is_none() {
            self.lanes[lane] = Some(self.fork()?);
        }
        if let Some(child) = &mut self.lanes[lane] {
            child.begin(set);
        }
        if go_on { Ok(()) } else { Err(Error::Cancelled) }
    }

    /// A new worker.
    fn fork(&mut self) -> Result<Child, Error> {
        let (job, resources, threads) = (self.job, self.resources, self.workers.threads);
        let lanes = &mut self.lanes;
        let work = |tasks, events| {
            // Only the parent may hold the ends of the other workers' pipes, or they would not notice its death.
            lanes.clear();
            child::work(job, resources, threads, tasks, events);
        };
        Child::fork(work).map_err(|e| Error::Workers(e.to_string()))
    }

    /// Lanes whose workers have something to say, or have died.
    fn ready(&self) -> Result<Vec<usize>, Error> {
        let lanes: Vec<(usize, &Child)> =
            self.lanes.iter().enumerate().filter_map(|(i, child)| Some((i, child.as_ref()?))).collect();
        let mut fds: Vec<PollFd<'_>> =
            lanes.iter().map(|(_, child)| PollFd::new(child.events().as_fd(), PollFlags::POLLIN)).collect();
        match poll(&mut fds, PollTimeout::from(TICK_MS)) {
            Ok(_) | Err(nix::Error::EINTR) => {}
            Err(e) => return Err(Error::Workers(e.to_string())),
        }
        let spoken = |fd: &PollFd<'_>| fd.any().unwrap_or(true);
        Ok(lanes.iter().zip(&fds).filter(|(_, fd)| spoken(fd)).map(|((i, _), _)| *i).collect())
    }

    /// Passes on what a lane's worker says, and notices its death.
    fn hear(&mut self, lane: usize) -> Result<(), Error> {
        let Some(child) = self.lanes[lane].as_mut() else { return Ok(()) };
        let (reports, open) = child.read();
        for report in reports {
            if let Report::Broken(reason) = &report {
                return Err(Error::Workers(reason.clone().into_owned()));
            }
            if report == Report::Through {
                child.end();
            }
            if !self.tracker.report(lane, report) {
                return Err(Error::Cancelled);
            }
        }
        if !open && let Some(child) = self.lanes[lane].take() {
            let set = child.set();
            let end = child.kill();
            self.lost(lane, set, &format!("its worker {end}"))?;
        }
        Ok(())
    }

    fn replace_the_late(&mut self) -> Result<(), Error> {
        let Some(timeout) = self.workers.timeout else { return Ok(()) };
        for lane in 0..self.lanes.len() {
            let late = |child: &mut Child| child.time().is_some_and(|time| time > timeout);
            if let Some(child) = self.lanes[lane].take_if(late) {
                let set = child.set();
                child.kill();
                self.lost(lane, set, &format!("not done within {} s", timeout.as_secs_f64()))?;
            }
        }
        Ok(())
    }

    /// A worker was lost with its set, if it had one: once more, or a failure.
    fn lost(&mut self, lane: usize, set: Option<usize>, reason: &str) -> Result<(), Error> {
        let Some(set) = set else { return Ok(()) };
        let mut go_on = self.tracker.give_up(lane, set);
        if self.attempts.get(&set).copied().unwrap_or(0) < ATTEMPTS {
            self.queue.push_front(set);
        } else {
            self.tracker.skip(set);
            let reason = format!("{reason}, {ATTEMPTS} times");
            for &frame in self.job.todo[set].iter().filter(|&&frame| self.job.wanted[frame]) {
                let id = &self.job.frames[frame].id;
                if !self.job.data_set.is_done(id) {
                    self.job.data_set.record_failure(id, &reason)?;
                    go_on &= self.tracker.report(lane, Report::Failed { frame, reason: (&reason).into() });
                }
            }
        }
        if go_on { Ok(()) } else { Err(Error::Cancelled) }
    }
}
