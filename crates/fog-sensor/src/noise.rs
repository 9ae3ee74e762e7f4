//! Random numbers of a pixel: electrons that are counted, and the noise of reading them.

use fog_core::math::{self, f64 as m};
use fog_core::random::PathRng;

/// Means below this are inverted by adding up probabilities.
const SMALL: f64 = 30.0;

/// A Poisson-distributed count with this mean, which must be finite; 0 for means of 0 and below.
///
/// Small means by inversion, others by transformed rejection with squeeze (PTRS of Hörmann 1993, "The transformed rejection
/// method for generating Poisson random variables", Insurance: Mathematics and Economics 12): both exact but for rounding.
#[must_use]
pub fn poisson(mean: f64, rng: &mut PathRng) -> f64 {
    if mean <= 0.0 {
        return 0.0;
    }
    if mean < SMALL { inverted(mean, rng.uniform_f64()) } else { rejected(mean, rng) }
}

/// The count whose cumulative probability first exceeds `u`.
fn inverted(mean: f64, u: f64) -> f64 {
    let mut probability = m::exp(-mean);
    let mut below = probability;
    let mut k = 0.0;
    // Beyond this count nothing is left that a number of 53 bits could select.
    let most = mean + 20.0 * mean.sqrt() + 40.0;
    while u >= below && k < most {
        k += 1.0;
        probability *= mean / k;
        below += probability;
    }
    k
}

fn rejected(mean: f64, rng: &mut PathRng) -> f64 {
    let b = 0.931 + 2.53 * mean.sqrt();
    let a = -0.059 + 0.024_83 * b;
    let inverse_alpha = 1.1239 + 1.1328 / (b - 3.4);
    let squeeze = 0.9277 - 3.6224 / (b - 2.0);
    loop {
        let u = rng.uniform_f64() - 0.5;
        let v = rng.uniform_f64();
        let edge = 0.5 - u.abs();
        let k = ((2.0 * a / edge + b) * u + mean + 0.43).floor();
        if edge >= 0.07 && v <= squeeze {
            return k;
        }
        if k < 0.0 || (edge < 0.013 && v > edge) {
            continue;
        }
        let height = m::ln(v * inverse_alpha / (a / (edge * edge) + b));
        if height <= k * m::ln(mean) - mean - m::ln_gamma(k + 1.0) {
            return k;
        }
    }
}

/// A normally distributed number with mean 0 and standard deviation 1 (Box & Muller 1958).
#[must_use]
pub fn normal(rng: &mut PathRng) -> f64 {
    let radius = (-2.0 * m::ln(1.0 - rng.uniform_f64())).sqrt();
    radius * math::cos_turns(rng.uniform_f64())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Probability of each count.
    fn probability(mean: f64, k: f64) -> f64 {
        m::exp(k * m::ln(mean) - mean - m::ln_gamma(k + 1.0))
    }

    #[test]
    fn counts_are_poisson() {
        for (case, mean) in [0.05, 1.0, 7.3, 29.9, 30.1, 250.0].into_iter().enumerate() {
            let n = 60_000u64;
            let most = (mean + 12.0 * f64::sqrt(mean) + 12.0) as usize;
            let mut counts = vec![0u64; most + 1];
            let (mut sum, mut squares) = (0.0, 0.0);
            for i in 0..n {
                let k = poisson(mean, &mut PathRng::new(5, i, case as u64));
                counts[k as usize] += 1;
                sum += k;
                squares += (k - mean).powi(2);
            }
            // Mean, and variance about it, whose own variance is µ + 2µ² over n.
            let (average, variance) = (sum / n as f64, squares / n as f64);
            let sigma = (mean / n as f64).sqrt();
            assert!((average - mean).abs() < 4.5 * sigma, "{mean}: mean {average}");
            let sigma = ((mean + 2.0 * mean * mean) / n as f64).sqrt();
            assert!((variance - mean).abs() < 4.5 * sigma, "{mean}: variance {variance}");
            // Chi-square over counts pooled until at least 20 are expected.
            let (mut chi, mut cells, mut expected, mut found) = (0.0, 0.0, 0.0, 0.0);
            let mut left = n as f64;
            for (k, &count) in counts.iter().enumerate() {
                let p = n as f64 * probability(mean, k as f64);
                (expected, found) = (expected + p, found + count as f64);
                if expected >= 20.0 && left - expected >= 20.0 {
                    chi += (found - expected).powi(2) / expected;
                    left -= expected;
                    (expected, found, cells) = (0.0, 0.0, cells + 1.0);
                }
            }
            chi += (found - left).powi(2) / left;
            // One degree of freedom fewer than cells: the total is given.
            let bound = cells + 4.5 * f64::sqrt(2.0 * cells) + 9.0;
            assert!(chi < bound, "{mean}: chi-square {chi} with {cells} degrees of freedom");
        }
    }

    #[test]
    fn nothing_gives_nothing() {
        let mut rng = PathRng::new(1, 2, 3);
        assert_eq!((poisson(0.0, &mut rng), poisson(-3.0, &mut rng)), (0.0, 0.0));
        assert_eq!(inverted(2.0, 0.0), 0.0);
        assert!(inverted(29.0, 1.0 - f64::EPSILON / 2.0).is_finite());
    }

    #[test]
    fn normal_numbers_have_their_moments() {
        let n = 100_000u64;
        let (mut sum, mut squares, mut fourth) = (0.0, 0.0, 0.0);
        for i in 0..n {
            let x = normal(&mut PathRng::new(9, i, 0));
            sum += x;
            squares += x * x;
            fourth += x.powi(4);
        }
        let n = n as f64;
        assert!((sum / n).abs() < 4.5 / n.sqrt());
        assert!((squares / n - 1.0).abs() < 4.5 * (2.0 / n).sqrt());
        assert!((fourth / n - 3.0).abs() < 4.5 * (96.0 / n).sqrt());
    }
}
