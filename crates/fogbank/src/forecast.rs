//! How many paths a sweep will take, while it goes on: frames that are sampled until their noise is low do not tell.

use crate::sweep::path_count;
use fog_plan::FrameSpec;

/// Counts paths, and guesses those to come: frames not begun that go by noise take as many times their first samples as
/// those that were begun.
#[derive(Debug, Default)]
pub(crate) struct Forecast {
    /// Paths of all frames so far.
    traced: u64,
    /// The frames at work, one in each lane.
    lanes: Vec<Lane>,
    /// Of the finished frames that went by noise: first samples, and all paths.
    finished: (u64, u64),
    /// Of the frames not begun: paths of those with a fixed number, and first samples of the others.
    rest: (u64, u64),
}

/// Frames that are rendered together.
#[derive(Clone, Copy, Debug, Default)]
struct Lane {
    traced: u64,
    /// Paths that they will have taken, as far as is known.
    expected: u64,
    /// First samples if they go by noise.
    first: Option<u64>,
}

impl Forecast {
    /// Before all these frames, of which so many lanes are worked on at the same time.
    pub(crate) fn new<'f>(todo: impl Iterator<Item = &'f FrameSpec>, lanes: usize) -> Self {
        let mut forecast = Self { lanes: vec![Lane::default(); lanes], ..Self::default() };
        todo.for_each(|spec| *forecast.rest_of(spec) += path_count(spec));
        forecast
    }

    fn rest_of(&mut self, spec: &FrameSpec) -> &mut u64 {
        if spec.render.stop.is_some() { &mut self.rest.1 } else { &mut self.rest.0 }
    }

    /// Frames begin that are rendered together.
    pub(crate) fn begin(&mut self, lane: usize, set: &[&FrameSpec]) {
        let paths = set.iter().map(|spec| path_count(spec)).sum();
        self.skip(set);
        let first = set.iter().any(|spec| spec.render.stop.is_some()).then_some(paths);
        self.lanes[lane] = Lane { traced: 0, expected: paths, first };
    }

    /// Paths of the lane's frames were traced.
    pub(crate) fn count(&mut self, lane: usize, paths: u64) {
        self.traced += paths;
        self.lanes[lane].traced += paths;
    }

    /// The lane's frames still need `left` paths.
    pub(crate) fn expect(&mut self, lane: usize, left: u64) {
        self.lanes[lane].expected = self.lanes[lane].traced + left;
    }

    /// Paths of the whole sweep, traced and to come.
    pub(crate) fn total(&self) -> u64 {
        let left: u64 = self.lanes.iter().map(|lane| lane.expected.saturating_sub(lane.traced)).sum();
        let (mut first, mut all) = self.finished;
        for lane in &self.lanes {
            if let Some(own) = lane.first {
                (first, all) = (first + own, all + lane.expected.max(lane.traced));
            }
        }
        let factor = if first > 0 { (all as f64 / first as f64).max(1.0) } else { 1.0 };
        self.traced + left + self.rest.0 + (self.rest.1 as f64 * factor) as u64
    }

    /// The lane's frames are done.
    pub(crate) fn end(&mut self, lane: usize) {
        let lane = std::mem::take(&mut self.lanes[lane]);
        if let Some(first) = lane.first {
            self.finished.0 += first;
            self.finished.1 += lane.traced;
        }
    }

    /// The lane's frames were given up and will be begun again; their paths were traced for nothing.
    pub(crate) fn give_up(&mut self, lane: usize, set: &[&FrameSpec]) {
        self.lanes[lane] = Lane::default();
        set.iter().for_each(|spec| *self.rest_of(spec) += path_count(spec));
    }

    /// Frames will not be begun.
    pub(crate) fn skip(&mut self, set: &[&FrameSpec]) {
        set.iter().for_each(|spec| *self.rest_of(spec) -= path_count(spec));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn frames() -> Vec<FrameSpec> {
        let yaml = "version: 1\nname: t\nscene: none\nfog: none\nlighting: day\ncamera: {altitude_m: 1}\n\
                    sensor: {width_px: 10, height_px: 10}\nrender: {samples: 16, noise: 0.1}\n\
                    sweep: {axes: {camera.altitude_m: [1, 2, 3]}}\n";
        let plan = fog_plan::parse(yaml, "t.yaml", &[]).expect("valid plan");
        plan.frames().map(|f| f.expect("frame")).collect()
    }

    #[test]
    fn frames_to_come_are_like_those_begun() {
        let frames = frames();
        let mut forecast = Forecast::new(frames.iter(), 1);
        assert_eq!(forecast.total(), 4800);
        forecast.begin(0, &[&frames[0]]);
        forecast.count(0, 1600);
        // Four times the first samples in this frame, and in the two others as well.
        forecast.expect(0, 4800);
        assert_eq!(forecast.total(), 3 * 6400);
        forecast.count(0, 4800);
        forecast.end(0);
        forecast.begin(0, &[&frames[1]]);
        forecast.count(0, 1600);
        // Half of that in the second: three times in the mean.
        forecast.expect(0, 1600);
        assert_eq!(forecast.total(), 6400 + 3200 + 4800);
    }

    #[test]
    fn frames_side_by_side_and_given_up() {
        let frames = frames();
        let mut forecast = Forecast::new(frames.iter(), 2);
        forecast.begin(0, &[&frames[0]]);
        forecast.begin(1, &[&frames[1]]);
        forecast.count(0, 1600);
        forecast.count(1, 800);
        assert_eq!(forecast.total(), 4800);
        forecast.expect(1, 2400);
        assert_eq!(forecast.total(), 1600 + 3200 + 2400);
        forecast.give_up(1, &[&frames[1]]);
        assert_eq!(forecast.total(), 2400 + 3200);
    }
}
