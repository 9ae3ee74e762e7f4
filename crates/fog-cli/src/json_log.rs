//! What happens, as lines of JSON for other programs (`--log json`).

use crate::print;
use fogbank::{Event, Progress, TableOrigin};
use serde_json::{Value, json};
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant, SystemTime};

/// Time between lines about progress.
const INTERVAL: Duration = Duration::from_secs(1);

/// Prints every event as a line; paths in sums, once a second.
pub(crate) struct JsonLog {
    started: Instant,
    state: Mutex<State>,
}

#[derive(Default)]
struct State {
    printed: Option<Instant>,
    rendering: Option<Instant>,
    paths: u64,
    expected: u64,
    frames: u64,
}

impl JsonLog {
    pub(crate) fn new() -> Self {
        Self { started: Instant::now(), state: Mutex::new(State::default()) }
    }

    fn line(&self, event: &str, mut fields: Value) {
        let unix = SystemTime::now().duration_since(SystemTime::UNIX_EPOCH).unwrap_or_default();
        let mut line = json!({
            "event": event,
            "unix_time_s": (unix.as_secs_f64() * 1e3).round() / 1e3,
            "elapsed_s": (self.started.elapsed().as_secs_f64() * 1e3).round() / 1e3,
        });
        if let (Some(line), Some(fields)) = (line.as_object_mut(), fields.as_object_mut()) {
            line.append(fields);
        }
        print::news(line);
    }

    /// Counts, and tells of it now and then.
    fn count(&self, change: impl FnOnce(&mut State)) {
        let mut state = self.state.lock().unwrap_or_else(PoisonError::into_inner);
        change(&mut state);
        if state.printed.is_some_and(|at| at.elapsed() < INTERVAL) {
            return;
        }
        state.printed = Some(Instant::now());
        let Some(begun) = state.rendering else { return };
        let seconds = begun.elapsed().as_secs_f64();
        let rate = state.paths as f64 / seconds.max(1e-9);
        let left = state.expected.saturating_sub(state.paths) as f64 / rate;
        self.line(
            "progress",
            json!({
                "paths": state.paths,
                "paths_expected": state.expected,
                "paths_per_s": rate,
                "frames": state.frames,
                "eta_s": left.is_finite().then_some(left),
            }),
        );
    }
}

impl Progress for JsonLog {
    fn event(&self, event: Event<'_>) -> bool {
        match event {
            Event::TableProgress(_) => {}
            Event::Table { name, origin, seconds } => {
                let (path, built, reason) = match origin {
                    TableOrigin::Found(path) => (Some(path), false, None),
                    TableOrigin::Built { path, replaced } => (Some(path), true, replaced.clone()),
                    TableOrigin::Unstored { reason } => (None, true, Some(reason.clone())),
                };
                let table = json!({ "name": name, "file": path, "built": built, "reason": reason, "seconds": seconds });
                self.line("table", table);
            }
            Event::Scene { name, triangles, warnings, seconds } => self.line(
                "scene",
                json!({ "name": name, "triangles": triangles, "warnings": warnings, "seconds": seconds }),
            ),
            Event::Denoiser { path, version } => {
                self.line("denoiser", json!({ "file": path, "version": version }));
            }
            Event::Warning(text) => self.line("warning", json!({ "text": text })),
            Event::Ready { done, failed, paths, todo } => {
                self.count(|s| (s.expected, s.rendering) = (paths, Some(Instant::now())));
                self.line("ready", json!({ "done": done, "failed": failed, "todo": todo, "paths": paths }));
            }
            Event::FrameStarted { id } => self.line("frame_started", json!({ "frame": id })),
            Event::Paths(n) => self.count(|s| s.paths += n),
            Event::Expected(n) => self.count(|s| s.expected = n),
            Event::Waiting => self.count(|_| ()),
            Event::FrameDone { id, seconds, noise } => {
                self.count(|s| s.frames += 1);
                self.line("frame_done", json!({ "frame": id, "seconds": seconds, "noise": noise }));
            }
            Event::FrameFailed { id, reason } => {
                self.line("frame_failed", json!({ "frame": id, "reason": reason }));
            }
            Event::Finished { counts } => {
                let seconds = self.started.elapsed().as_secs_f64();
                let frames = self.state.lock().unwrap_or_else(PoisonError::into_inner).frames;
                self.line(
                    "finished",
                    json!({
                        "done": counts.done,
                        "failed": counts.failed,
                        "missing": counts.missing,
                        "frames_per_s": frames as f64 / seconds.max(1e-9),
                    }),
                );
            }
        }
        true
    }
}
