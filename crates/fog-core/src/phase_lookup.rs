//! Looking things up in tabulated phase functions: what the kinds of tables share.

use crate::optics_table::MAX_COLUMNS;
use crate::phase_grid::{self, NODES};
use crate::spectrum::{LaneWeights, Spectrum};

/// The row of `zeta` that a scattering at `at` has, for `u` uniform in [0, 1): the lower row with the weight of linear
/// interpolation, else the upper. Over many scatterings this *is* linear interpolation.
#[inline(always)]
pub(crate) fn interpolating_row(zeta: &[f64], at: f32, u: f32) -> usize {
    let (lower, t) = row_below(zeta, at);
    if f64::from(u) < t { lower + 1 } else { lower }
}

/// The row below `at`, and the weight of the next one in the linear interpolation between both.
#[inline(always)]
pub(crate) fn rows_around(zeta: &[f64], at: f32) -> (usize, f32) {
    let (lower, t) = row_below(zeta, at);
    (lower, t.clamp(0.0, 1.0) as f32)
}

/// The row below `at`, or the first or the last but one, and how far the way to the next one is gone; 0 where there is but one.
#[inline(always)]
fn row_below(zeta: &[f64], at: f32) -> (usize, f64) {
    let n = zeta.len();
    if n == 1 {
        return (0, 0.0);
    }
    let at = f64::from(at);
    let upper = zeta.partition_point(|&z| z <= at).clamp(1, n - 1);
    (upper - 1, (at - zeta[upper - 1]) / (zeta[upper] - zeta[upper - 1]))
}

/// Value of row `row` at all lanes for m = 1 − cos θ; `phase` is \[row\]\[node\]\[wavelength\] with `w` wavelengths.
#[inline(always)]
pub(crate) fn eval_lanes(
    phase: &[f32],
    w: usize,
    row: usize,
    m: f32,
    nodes: &[f32],
    lanes: &LaneWeights,
) -> Spectrum {
    let i = phase_grid::interval(m);
    let t = ((m - nodes[i]) / (nodes[i + 1] - nodes[i])).clamp(0.0, 1.0);
    let at = (row * NODES + i) * w;
    let (low, high) = phase[at..at + 2 * w].split_at(w);
    if w == 1 {
        return Spectrum::splat(low[0] + (high[0] - low[0]) * t);
    }
    // First between angles at all wavelengths of the table, which lie side by side, then between wavelengths.
    let mut column = [0.0f32; MAX_COLUMNS];
    for ((c, l), h) in column.iter_mut().zip(low).zip(high) {
        *c = l + (h - l) * t;
    }
    lanes.gather(&column)
}

/// Fraction t of an interval over which a density runs linearly from `p0` to `p1`, such that `fraction` of the interval's
/// mass lies below: solves p0 t + (p1 − p0) t²/2 = fraction · (p0 + p1)/2.
#[inline(always)]
pub(crate) fn invert_linear(p0: f64, p1: f64, fraction: f64) -> f64 {
    let share = fraction * 0.5 * (p0 + p1);
    let root = (p0 * p0 + 2.0 * (p1 - p0) * share).max(0.0).sqrt();
    if p0 + root > 0.0 { (2.0 * share / (p0 + root)).min(1.0) } else { 0.0 }
}
