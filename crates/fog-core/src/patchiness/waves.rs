//! Sums of plane waves of a band of wavenumbers.

use super::{Area, ln_bessel_i0};
use crate::math::f64::{cos, pow, sin};
use crate::math::{PI, cos_turns};
use crate::random::PathRng;

/// Waves that are summed side by side.
pub(super) const LANES: usize = 8;

pub(super) type Lanes = [f64; LANES];

/// Waves amplitude · cos 2π(u x + v z + phase), u and v in cycles per m.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Octave {
    pub(super) u: Lanes,
    pub(super) v: Lanes,
    pub(super) phase: Lanes,
    pub(super) amplitude: Lanes,
}

/// A sum of plane waves, [`LANES`] for each octave of its band.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Waves {
    pub(super) octaves: Vec<Octave>,
}

impl Waves {
    /// Waves from `lowest_1_m` cycles per m on, over so many octaves, with variance 1.
    ///
    /// In each octave wavenumbers (in their logarithm) and directions are stratified: one wave in each eighth.
    pub(super) fn new(lowest_1_m: f64, octaves: usize, rng: &mut PathRng) -> Self {
        let mut octaves: Vec<Octave> = (0..octaves)
            .map(|octave| {
                let turn = (rng.next_u64() % LANES as u64) as usize;
                let mut out =
                    Octave { u: [0.0; LANES], v: [0.0; LANES], phase: [0.0; LANES], amplitude: [0.0; LANES] };
                for i in 0..LANES {
                    // 3 and 8 have no common factor: every wavenumber meets its own direction.
                    let eighth = (3 * i + turn) % LANES;
                    let up = octave as f64 + (i as f64 + rng.uniform_f64()) / LANES as f64;
                    let angle = PI * (eighth as f64 + rng.uniform_f64()) / LANES as f64;
                    let wavenumber = lowest_1_m * pow(2.0, up);
                    (out.u[i], out.v[i]) = (wavenumber * cos(angle), wavenumber * sin(angle));
                    out.phase[i] = rng.uniform_f64();
                    // Variance per logarithm of the wavenumber k, k · k^(−5/3).
                    out.amplitude[i] = pow(2.0, -up / 3.0);
                }
                out
            })
            .collect();
        let variance: f64 = octaves.iter().flat_map(|o| o.amplitude).map(|a| 0.5 * a * a).sum();
        let norm = 1.0 / variance.sqrt();
        octaves.iter_mut().flat_map(|o| &mut o.amplitude).for_each(|a| *a *= norm);
        Self { octaves }
    }

    /// The same waves with all amplitudes multiplied.
    pub(super) fn scaled(&self, factor: f64) -> Self {
        let mut out = self.clone();
        out.octaves.iter_mut().flat_map(|o| &mut o.amplitude).for_each(|a| *a *= factor);
        out
    }

    /// All amplitudes, none negative.
    pub(super) fn amplitudes(&self) -> impl Iterator<Item = f64> {
        self.octaves.iter().flat_map(|o| o.amplitude)
    }

    /// The sum at a point in m.
    #[inline]
    pub(super) fn at(&self, x: f64, z: f64) -> f64 {
        let mut sum = [0.0; LANES];
        for o in &self.octaves {
            for i in 0..LANES {
                sum[i] += o.amplitude[i] * cos_turns(o.u[i] * x + o.v[i] * z + o.phase[i]);
            }
        }
        ((sum[0] + sum[4]) + (sum[2] + sum[6])) + ((sum[1] + sum[5]) + (sum[3] + sum[7]))
    }

    /// Least and greatest value that the sum of the waves' own extremes takes over an area.
    pub(super) fn bounds(&self, area: &Area) -> [f64; 2] {
        let mut out = [0.0; 2];
        for o in &self.octaves {
            for i in 0..LANES {
                let [low, high] =
                    cosine_range(phases(o.u[i], area.x_m), phases(o.v[i], area.z_m), o.phase[i]);
                out[0] += o.amplitude[i] * low;
                out[1] += o.amplitude[i] * high;
            }
        }
        out
    }

    /// Mean over the plane of the product of two values that far apart: Σ a²/2 cos δ.
    pub(super) fn covariance(&self, dx: f64, dz: f64) -> f64 {
        let wave = |o: &Octave, i: usize| {
            0.5 * o.amplitude[i] * o.amplitude[i] * cos_turns(o.u[i] * dx + o.v[i] * dz)
        };
        self.octaves.iter().map(|o| (0..LANES).map(|i| wave(o, i)).sum::<f64>()).sum()
    }

    /// ln of the mean over the plane of exp(value + value that far away): Σ ln I₀(2 a cos(δ/2)).
    pub(super) fn ln_product(&self, dx: f64, dz: f64) -> f64 {
        let wave = |o: &Octave, i: usize| {
            ln_bessel_i0(2.0 * o.amplitude[i] * cos_turns(0.5 * (o.u[i] * dx + o.v[i] * dz)))
        };
        self.octaves.iter().map(|o| (0..LANES).map(|i| wave(o, i)).sum::<f64>()).sum()
    }
}

/// Range of one part of a phase in turns: the whole circle for an unbounded interval, unless the wave does not vary there.
fn phases(wavenumber: f64, ends: [f64; 2]) -> [f64; 2] {
    if wavenumber == 0.0 {
        return [0.0, 0.0];
    }
    let (a, b) = (wavenumber * ends[0], wavenumber * ends[1]);
    [a.min(b), a.max(b)]
}

/// Least and greatest cosine of the phases (in turns) that two ranges and a constant add up to.
fn cosine_range(x: [f64; 2], z: [f64; 2], phase: f64) -> [f64; 2] {
    let (first, last) = (x[0] + z[0] + phase, x[1] + z[1] + phase);
    let turns = last - first;
    if turns >= 1.0 || turns.is_nan() {
        return [-1.0, 1.0];
    }
    let ends = [cos_turns(first), cos_turns(last)];
    // An integer between the ends is a crest, a half-integer a trough.
    let crest = first.ceil() <= last;
    let trough = (first - 0.5).ceil() <= last - 0.5;
    [if trough { -1.0 } else { ends[0].min(ends[1]) }, if crest { 1.0 } else { ends[0].max(ends[1]) }]
}
