//! What a sweep has to do, and doing one piece of it: frames that share paths, rendered and stored.

use crate::error::Error;
use crate::frame::{Rendered, render_frame};
use crate::resources::Resources;
use crate::shared::render_set;
use crate::sweep::store;
use fog_dataset::DataSet;
use fog_plan::FrameSpec;
use fog_tracer::render::Work;
use serde::{Deserialize, Serialize};
use std::borrow::Cow;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::time::Instant;

/// The frames of a sweep and where they go.
pub(crate) struct Job {
    pub(crate) frames: Vec<FrameSpec>,
    /// By frame: whether it is to be stored. A frame takes its whole set to be rendered.
    pub(crate) wanted: Vec<bool>,
    /// Sets of frames that share paths, in which some frame is wanted.
    pub(crate) todo: Vec<Vec<usize>>,
    pub(crate) data_set: DataSet,
    pub(crate) config_digest: String,
}

/// What happens to a set at work, in words that cross processes.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub(crate) enum Report<'a> {
    /// So many paths were traced.
    Traced(u64),
    /// So many paths are still to come.
    Left(u64),
    /// A frame is stored.
    Done { frame: usize, seconds: f64, noise: f64 },
    /// A frame failed.
    Failed { frame: usize, reason: Cow<'a, str> },
    /// The set is through.
    Through,
    /// The data set cannot be written any more.
    Broken(Cow<'a, str>),
}

impl Job {
    /// Specifications of a set's frames.
    pub(crate) fn specs(&self, set: usize) -> Vec<&FrameSpec> {
        self.todo[set].iter().map(|&i| &self.frames[i]).collect()
    }

    /// The first frame of a set that is wanted, to name the set by.
    pub(crate) fn name(&self, set: usize) -> &str {
        let set = &self.todo[set];
        &self.frames[set.iter().copied().find(|&i| self.wanted[i]).unwrap_or(set[0])].id
    }

    /// Renders a set on the current rayon pool and stores what is wanted of it. `report` returns false to stop.
    ///
    /// # Errors
    /// If `report` asked to stop, or if a failure cannot be recorded: the folder is of no use any more.
    pub(crate) fn work(
        &self,
        set: usize,
        resources: &Resources,
        report: &(dyn Fn(Report<'_>) -> bool + Sync),
    ) -> Result<(), Error> {
        let started = Instant::now();
        let specs = self.specs(set);
        let on_work = |work: Work| match work {
            Work::Traced(n) => report(Report::Traced(n)),
            Work::Left(n) => report(Report::Left(n)),
        };
        let rendered = guarded(|| match specs[..] {
            [spec] => {
                render_frame(spec, resources, &self.config_digest, &on_work).map(|frame| vec![Ok(frame)])
            }
            _ => render_set(&specs, resources, &self.config_digest, &on_work),
        });
        let rendered: Vec<Result<Rendered, String>> = match rendered {
            Err(Error::Cancelled) => return Err(Error::Cancelled),
            Ok(frames) => frames.into_iter().map(|frame| frame.map_err(|e| e.to_string())).collect(),
            Err(e) => vec![Err(e.to_string()); specs.len()],
        };
        // What the set took, by frame.
        let seconds = started.elapsed().as_secs_f64() / specs.len() as f64;
        for (&frame, rendered) in self.todo[set].iter().zip(rendered) {
            if !self.wanted[frame] {
                continue;
            }
            let begun = Instant::now();
            let stored = rendered.and_then(|r| {
                let seconds = seconds + begun.elapsed().as_secs_f64();
                let stored = store(&self.data_set, &self.frames[frame], &r, seconds);
                stored.map(|()| r.frame.noise_estimate()).map_err(|e| e.to_string())
            });
            match stored {
                Ok(noise) => {
                    let seconds = seconds + begun.elapsed().as_secs_f64();
                    report(Report::Done { frame, seconds, noise });
                }
                Err(reason) => {
                    report(Report::Failed { frame, reason: Cow::Borrowed(&reason) });
                    self.data_set.record_failure(&self.frames[frame].id, &reason)?;
                }
            }
        }
        Ok(())
    }
}

/// Runs the renderer so that a panic in it costs one frame and not the sweep.
fn guarded<T>(f: impl FnOnce() -> Result<T, Error>) -> Result<T, Error> {
    catch_unwind(AssertUnwindSafe(f)).unwrap_or_else(|payload| {
        let text = payload
            .downcast_ref::<String>()
            .cloned()
            .or_else(|| payload.downcast_ref::<&str>().map(|s| (*s).to_owned()));
        Err(Error::Panic(text.unwrap_or_else(|| "unknown panic".to_owned())))
    })
}
