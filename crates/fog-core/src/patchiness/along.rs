//! A sum of waves at evenly spaced points of a ray.

use super::waves::{LANES, Lanes, Waves};
use crate::math::{TAU, cos_turns};

/// Octaves that a band has at most.
const MAX_OCTAVES: usize = 8;

/// Waves of an octave at one point: amplitude · cos and sin of their phases, which a step turns on.
#[derive(Clone, Copy, Debug)]
struct Turning {
    cos: Lanes,
    sin: Lanes,
    step_cos: Lanes,
    step_sin: Lanes,
    /// Change of the phase per step, in radians.
    rate: Lanes,
}

/// A sum of waves at a point that moves along a ray by equal steps.
///
/// Phases are linear along a ray, so a step turns each wave by a constant angle: four multiplications instead of a cosine.
/// In f64 the rounding of 1e5 steps stays below 1e-10.
#[derive(Clone, Debug)]
pub(super) struct Along {
    octaves: [Turning; MAX_OCTAVES],
    count: usize,
}

impl Along {
    /// From the point (x, z), by steps of (dx, dz), all in m. Waves without amplitude are left out.
    pub(super) fn new(waves: &Waves, [x, z]: [f64; 2], [dx, dz]: [f64; 2]) -> Self {
        const ZERO: Lanes = [0.0; LANES];
        let still = Turning { cos: ZERO, sin: ZERO, step_cos: ZERO, step_sin: ZERO, rate: ZERO };
        let mut out = Self { octaves: [still; MAX_OCTAVES], count: 0 };
        for o in waves.octaves.iter().filter(|o| o.amplitude[0] > 0.0) {
            let turning = &mut out.octaves[out.count];
            out.count += 1;
            for i in 0..LANES {
                let turns = o.u[i] * x + o.v[i] * z + o.phase[i];
                turning.cos[i] = o.amplitude[i] * cos_turns(turns);
                turning.sin[i] = o.amplitude[i] * cos_turns(turns - 0.25);
                let step = o.u[i] * dx + o.v[i] * dz;
                turning.step_cos[i] = cos_turns(step);
                turning.step_sin[i] = cos_turns(step - 0.25);
                turning.rate[i] = TAU * step;
            }
        }
        out
    }

    /// The sum, and its slope per step.
    #[inline]
    pub(super) fn value(&self) -> [f64; 2] {
        let (mut sum, mut slope) = ([0.0; LANES], [0.0; LANES]);
        for o in &self.octaves[..self.count] {
            for i in 0..LANES {
                sum[i] += o.cos[i];
                slope[i] -= o.rate[i] * o.sin[i];
            }
        }
        [sum, slope].map(|s| ((s[0] + s[4]) + (s[2] + s[6])) + ((s[1] + s[5]) + (s[3] + s[7])))
    }

    /// Moves on by a step.
    #[inline]
    pub(super) fn advance(&mut self) {
        for o in &mut self.octaves[..self.count] {
            for i in 0..LANES {
                let cos = o.cos[i] * o.step_cos[i] - o.sin[i] * o.step_sin[i];
                o.sin[i] = o.sin[i] * o.step_cos[i] + o.cos[i] * o.step_sin[i];
                o.cos[i] = cos;
            }
        }
    }
}
