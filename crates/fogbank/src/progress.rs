//! What the main path tells its caller while it works.

use crate::table_cache::TableOrigin;
use fog_dataset::Counts;
use std::path::Path;

/// Something that happened, in the order in which it happens.
#[derive(Debug)]
pub enum Event<'a> {
    /// The optics table is being built; fraction done in [0, 1].
    TableProgress(f64),
    /// A table was found or built.
    Table {
        /// Which one.
        name: &'a str,
        /// How.
        origin: &'a TableOrigin,
        /// Seconds that it took.
        seconds: f64,
    },
    /// A scene was loaded or made.
    Scene {
        /// Its file, or its formula and seed.
        name: &'a str,
        /// Number of triangles.
        triangles: usize,
        /// What was passed over in it.
        warnings: &'a [String],
        /// Seconds that it took.
        seconds: f64,
    },
    /// The denoiser was loaded.
    Denoiser {
        /// Its file, as it was named.
        path: &'a Path,
        /// Its version, as `2.5.1`.
        version: &'a str,
    },
    /// Something that the user should know, though the work goes on.
    Warning(String),
    /// All is ready: so many of the plan's frames are finished already and so many are to be rendered.
    Ready {
        /// Frames found done.
        done: usize,
        /// Frames found failed that are not tried again.
        failed: usize,
        /// Paths to trace in all frames to come; of frames that are sampled by noise, the first ones.
        paths: u64,
        /// Frames to be rendered.
        todo: usize,
    },
    /// A frame begins.
    FrameStarted {
        /// Its id.
        id: &'a str,
    },
    /// So many more paths were traced.
    Paths(u64),
    /// So many paths are now expected in all frames together, those already traced among them; heard where sampling goes
    /// by noise, so that their number shows only on the way.
    Expected(u64),
    /// Nothing happened for a while; heard while other processes work.
    Waiting,
    /// A frame is stored.
    FrameDone {
        /// Its id.
        id: &'a str,
        /// Seconds of rendering and writing.
        seconds: f64,
        /// Relative noise of the frame.
        noise: f64,
    },
    /// A frame failed; the others go on.
    FrameFailed {
        /// Its id.
        id: &'a str,
        /// Why.
        reason: &'a str,
    },
    /// The index is written.
    Finished {
        /// States of the plan's frames.
        counts: Counts,
    },
}

/// Receiver of [`Event`]s; called from any thread.
pub trait Progress: Sync {
    /// Takes an event; `false` asks to stop.
    fn event(&self, event: Event<'_>) -> bool;
}

/// Listens to nothing.
#[derive(Clone, Copy, Debug, Default)]
pub struct Silent;

impl Progress for Silent {
    fn event(&self, _: Event<'_>) -> bool {
        true
    }
}
