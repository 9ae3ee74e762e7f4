//! Random counts.

use fog_core::math::f64::{exp, ln, ln_gamma};
use fog_core::random::PathRng;

/// A Poisson count of the given mean, exact up to the rounding of `f64`.
///
/// Below a mean of 10 the distribution is inverted term by term; above, the transformed rejection PTRS of Hörmann, "The
/// transformed rejection method for generating Poisson random variables" (Insurance: Mathematics and Economics 12, 1993).
pub(super) fn poisson(mean: f64, random: &mut PathRng) -> f64 {
    if mean < 10.0 { by_inversion(mean, random) } else { by_rejection(mean, random) }
}

fn by_inversion(mean: f64, random: &mut PathRng) -> f64 {
    let mut left = random.uniform_f64();
    let mut term = exp(-mean);
    let mut n = 0.0;
    // Terms vanish long before n = 200 for a mean below 10.
    while left >= term && n < 200.0 {
        left -= term;
        n += 1.0;
        term *= mean / n;
    }
    n
}

fn by_rejection(mean: f64, random: &mut PathRng) -> f64 {
    let b = 0.931 + 2.53 * mean.sqrt();
    let a = -0.059 + 0.024_83 * b;
    let inverse_alpha = 1.1239 + 1.1328 / (b - 3.4);
    let surely = 0.9277 - 3.6224 / (b - 2.0);
    let ln_mean = ln(mean);
    loop {
        let u = random.uniform_f64() - 0.5;
        let v = random.uniform_f64();
        let us = 0.5 - u.abs();
        let n = ((2.0 * a / us + b) * u + mean + 0.43).floor();
        if us >= 0.07 && v <= surely {
            return n;
        }
        if n < 0.0 || (us < 0.013 && v > us) {
            continue;
        }
        if ln(v * inverse_alpha / (a / (us * us) + b)) <= n * ln_mean - mean - ln_gamma(n + 1.0) {
            return n;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Pearson's chi-square of counts against the distribution, cells of at least 20 expected, with its degrees of freedom.
    fn chi_square(mean: f64, samples: usize) -> (f64, f64) {
        let mut random = PathRng::new(11, mean.to_bits(), 0);
        let top = (mean + 12.0 * mean.sqrt() + 20.0) as usize;
        let mut seen = vec![0.0; top + 1];
        for _ in 0..samples {
            seen[(poisson(mean, &mut random) as usize).min(top)] += 1.0;
        }
        let (mut sum, mut cells, mut pool) = (0.0, 0.0, [0.0; 2]);
        for (n, seen) in seen.iter().enumerate() {
            let n = n as f64;
            pool[0] += seen;
            pool[1] += samples as f64 * exp(n * ln(mean) - mean - ln_gamma(n + 1.0));
            if pool[1] >= 20.0 {
                sum += (pool[0] - pool[1]) * (pool[0] - pool[1]) / pool[1];
                cells += 1.0;
                pool = [0.0; 2];
            }
        }
        (sum, cells - 1.0)
    }

    #[test]
    fn counts_follow_the_distribution() {
        for mean in [0.3, 4.0, 9.99, 10.0, 57.3, 3000.0] {
            let (sum, freedom) = chi_square(mean, 200_000);
            let deviation = (sum - freedom) / (2.0 * freedom).sqrt();
            assert!(deviation.abs() < 4.5, "mean {mean}: chi-square {sum} of {freedom}");
        }
    }

    #[test]
    fn large_means_have_their_mean_and_variance() {
        let mut random = PathRng::new(5, 0, 0);
        let (mean, n) = (2e8, 20_000);
        let (mut first, mut second) = (0.0, 0.0);
        for _ in 0..n {
            let deviation = poisson(mean, &mut random) - mean;
            first += deviation;
            second += deviation * deviation;
        }
        let n = f64::from(n);
        assert!((first / n).abs() < 5.0 * (mean / n).sqrt());
        assert!((second / n / mean - 1.0).abs() < 5.0 * (2.0 / n).sqrt());
        assert_eq!(poisson(0.0, &mut random), 0.0);
    }
}
