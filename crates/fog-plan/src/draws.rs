//! Numbers by chance that are a function of what they are for.

use fog_core::random::mix64;

/// Uniform number in [0, 1) of a seed (with what tells streams apart in it), an index and a dimension.
pub(crate) fn uniform(seed: u64, index: usize, dimension: usize) -> f64 {
    let bits = mix64(mix64(mix64(seed) ^ index as u64) ^ dimension as u64);
    (bits >> 11) as f64 * (1.0 / 9_007_199_254_740_992.0)
}
