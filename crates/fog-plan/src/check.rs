//! Checks a plan before anything is rendered.

use std::collections::HashMap;

use crate::{
    error::{PlanError, Problem, Problems},
    frame::FrameSpec,
    plan::Plan,
    schema::SweepMode,
    sweep::{Sweep, spread},
};

/// Plans up to this length are checked frame by frame when loaded: below a second.
const FULL_CHECK: usize = 10_000;

impl Plan {
    /// Makes every frame once and reports all problems (20 at most) and identical frames. `load` does this for plans of
    /// up to 10 000 frames; of longer ones it checks each value of each axis, or evenly spread frames.
    ///
    /// # Errors
    /// The problems found.
    pub fn check(&self) -> Result<(), PlanError> {
        let mut problems = Problems::default();
        self.check_frames(0..self.len(), &mut problems);
        problems.into_result()
    }

    /// The check of `load`.
    pub(crate) fn check_quickly(&self, problems: &mut Problems) {
        if self.len() <= FULL_CHECK {
            return self.check_frames(0..self.len(), problems);
        }
        let combinations = self.sweep.as_ref().map_or_else(|| vec![0], probes);
        let frames = combinations.into_iter().map(|combination| self.layout.first(combination));
        self.check_frames(frames.chain(spread(self.len(), FULL_CHECK)), problems);
    }

    fn check_frames(&self, indices: impl IntoIterator<Item = usize>, problems: &mut Problems) {
        let mut seen: HashMap<String, usize> = HashMap::new();
        for index in indices {
            if problems.is_full() {
                return;
            }
            match self.frame(index) {
                Ok(frame) => {
                    if let Some(first) = seen.insert(frame.digest.clone(), index)
                        && first != index
                    {
                        problems.add(self.identical(first, &frame));
                    }
                }
                Err(error) => problems.extend(error.problems().iter().cloned()),
            }
        }
    }

    fn identical(&self, first: usize, frame: &FrameSpec) -> Problem {
        let values: Vec<String> =
            frame.axes.iter().map(|(path, value)| format!("{path} = {value}")).collect();
        let message = format!(
            "frames {first} and {} are identical ({}); every frame must differ from all others",
            frame.index,
            values.join(", ")
        );
        let path = "sweep.axes";
        Problem::new(self.resolved.origin_of(path), path, message)
    }
}

/// Frames that show each value of each axis at least once, as far as `FULL_CHECK` allows.
fn probes(sweep: &Sweep) -> Vec<usize> {
    if sweep.mode != SweepMode::Grid {
        return spread(sweep.len, FULL_CHECK);
    }
    let limit = FULL_CHECK / sweep.axes.len();
    let mut stride = 1;
    let mut indices = Vec::new();
    for axis in sweep.axes.iter().rev() {
        indices.extend(axis.probes(limit.max(2)).iter().map(|index| index * stride));
        stride *= axis.values.len().unwrap_or(1);
    }
    indices
}
