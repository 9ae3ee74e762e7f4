//! How many paths a sweep will take, while it goes on: frames that are sampled until their noise is low do not tell.

use crate::sweep::path_count;
use fog_plan::FrameSpec;
use std::sync::atomic::{AtomicU64, Ordering::Relaxed};

/// Counts paths, and guesses those to come: frames not begun that go by noise take as many times their first samples as
/// those that were begun.
#[derive(Debug, Default)]
pub(crate) struct Forecast {
    /// Paths of all frames so far, and of the one at work.
    traced: AtomicU64,
    frame: AtomicU64,
    /// First samples of the frame at work if it goes by noise.
    first: Option<u64>,
    /// Of the finished frames that went by noise: first samples, and all paths.
    finished: (u64, u64),
    /// Of the frames not begun: paths of those with a fixed number, and first samples of the others.
    rest: (u64, u64),
}

impl Forecast {
    /// Before all these frames.
    pub(crate) fn new(todo: &[&FrameSpec]) -> Self {
        let mut forecast = Self::default();
        todo.iter().for_each(|spec| *forecast.rest_of(spec) += path_count(spec));
        forecast
    }

    fn rest_of(&mut self, spec: &FrameSpec) -> &mut u64 {
        if spec.render.stop.is_some() { &mut self.rest.1 } else { &mut self.rest.0 }
    }

    /// Frames begin that are rendered together.
    pub(crate) fn begin(&mut self, set: &[&FrameSpec]) {
        let paths = set.iter().map(|spec| path_count(spec)).sum();
        set.iter().for_each(|spec| *self.rest_of(spec) -= path_count(spec));
        self.first = set.iter().any(|spec| spec.render.stop.is_some()).then_some(paths);
        self.frame = AtomicU64::new(0);
    }

    /// Paths of the frame were traced.
    pub(crate) fn count(&self, paths: u64) {
        self.traced.fetch_add(paths, Relaxed);
        self.frame.fetch_add(paths, Relaxed);
    }

    /// Paths of the whole sweep, traced and to come, when the frame still needs `left`.
    pub(crate) fn total(&self, left: u64) -> u64 {
        let frame = self.frame.load(Relaxed) + left;
        let (first, all) = self.finished;
        let (first, all) = self.first.map_or((first, all), |own| (first + own, all + frame));
        let factor = if first > 0 { (all as f64 / first as f64).max(1.0) } else { 1.0 };
        self.traced.load(Relaxed) + left + self.rest.0 + (self.rest.1 as f64 * factor) as u64
    }

    /// The frame is done.
    pub(crate) fn end(&mut self) {
        if let Some(first) = self.first.take() {
            self.finished.0 += first;
            self.finished.1 += self.frame.load(Relaxed);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frames_to_come_are_like_those_begun() {
        let yaml = "version: 1\nname: t\nscene: none\nfog: none\nlighting: day\ncamera: {altitude_m: 1}\n\
                    sensor: {width_px: 10, height_px: 10}\nrender: {samples: 16, noise: 0.1}\n\
                    sweep: {axes: {camera.altitude_m: [1, 2, 3]}}\n";
        let plan = fog_plan::parse(yaml, "t.yaml", &[]).expect("valid plan");
        let frames: Vec<FrameSpec> = plan.frames().map(|f| f.expect("frame")).collect();
        let mut forecast = Forecast::new(&frames.iter().collect::<Vec<_>>());
        assert_eq!(forecast.total(0), 4800);
        forecast.begin(&[&frames[0]]);
        forecast.count(1600);
        // Four times the first samples in this frame, and in the two others as well.
        assert_eq!(forecast.total(4800), 3 * 6400);
        forecast.count(4800);
        forecast.end();
        forecast.begin(&[&frames[1]]);
        forecast.count(1600);
        // Half of that in the second: three times in the mean.
        assert_eq!(forecast.total(1600), 6400 + 3200 + 4800);
    }
}
