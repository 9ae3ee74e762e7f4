//! Stop by noise: which pixels of a frame need how many more samples.
//!
//! Sampling goes in rounds over the whole frame, and between two rounds all pixels are judged by all samples so far. So the
//! number of samples of a pixel is a function of the frame alone, whoever traced which pixel and when.
//!
//! A pixel is judged by its relative variance per sample, and by that of its neighbourhood, whichever is greater. A stopped
//! pixel is judged again with every round: if its neighbours find light that it has missed so far, it is sampled on.
//!
//! Whoever stops when the error looks small stops too early where the samples so far happen to agree, and these miss rare
//! bright paths: such means are too dark (the variance of a skewed distribution goes with its mean). The neighbourhood
//! keeps this bias small, because its variance is that of several times as many samples, of which the pixel's own are a
//! seventh; the first round keeps single pixels from stopping on next to nothing. `stopping_biases_little` measures what
//! is left.

use crate::settings::NoiseTarget;
use fog_core::moments::Moments;
use fog_film::{PixelFilm, noise_floor, relative_error};
use std::collections::BTreeMap;

/// Weights of the neighbourhood along rows and along columns. The own pixel has (6/16)² of the weight; independent pixels
/// of equal variance count as 13.
const WEIGHTS: [f64; 5] = [1.0, 4.0, 6.0, 4.0, 1.0];
const REACH: usize = WEIGHTS.len() / 2;

/// What is to be traced next.
#[derive(Debug, Default, PartialEq)]
pub(crate) struct Round {
    /// Pixels (row-major, ascending) and the number of samples that each is to have after the round. Empty: all is done.
    pub(crate) pixels: Vec<(usize, u64)>,
    /// Samples that are probably still to be taken, this round and later ones together.
    pub(crate) expected: u64,
}

impl Round {
    /// All of so many pixels, which have `done` samples.
    pub(crate) fn of_all(count: usize, done: u64, until: u64) -> Self {
        let pixels = (0..count).map(|i| (i, until)).collect();
        Self { pixels, expected: (until - done) * count as u64 }
    }

    /// What is to be traced for two frames that share their samples: each pixel until both are served.
    pub(crate) fn union(self, other: Self) -> Self {
        let mut pixels: BTreeMap<usize, u64> = self.pixels.into_iter().collect();
        for (i, until) in other.pixels {
            let most = pixels.entry(i).or_insert(until);
            *most = until.max(*most);
        }
        let expected = self.expected.max(other.expected);
        Self { pixels: pixels.into_iter().collect(), expected }
    }
}

/// Judges the pixels of a frame. Counts grow by a quarter at least and to their double at most, since an estimate from n
/// samples is not worth following much further than that.
pub(crate) fn next_round(films: &[PixelFilm], width: usize, stop: &NoiseTarget) -> Round {
    let mean = films.iter().map(|f| f.luminance().mean()).sum::<f64>() / films.len().max(1) as f64;
    let floor = noise_floor(mean);
    let own: Vec<f64> = films.iter().map(|f| relative_variance(f.luminance(), floor)).collect();
    let around = smooth(&own, width);
    let mut round = Round::default();
    for (i, film) in films.iter().enumerate() {
        let n = film.samples();
        // A cast of f64 saturates: any variance gives a valid count.
        let wanted =
            ((own[i].max(around[i]) / (stop.noise * stop.noise)).ceil() as u64).min(stop.max_samples);
        if wanted > n {
            round.expected += wanted - n;
            round.pixels.push((i, wanted.clamp(n + n.div_ceil(4), 2 * n).min(stop.max_samples)));
        }
    }
    round
}

/// Variance of one sample of a pixel, relative to its luminance or the floor.
fn relative_variance(luminance: &Moments, floor: f64) -> f64 {
    relative_error(luminance.variance().sqrt(), luminance.mean(), floor).powi(2)
}

/// Weighted means over the neighbourhood of each pixel; at the frame's border, over the part inside.
fn smooth(values: &[f64], width: usize) -> Vec<f64> {
    let height = values.len() / width.max(1);
    let rows: Vec<f64> =
        (0..values.len()).map(|i| line(i % width, width, |x| values[i - i % width + x])).collect();
    (0..values.len()).map(|i| line(i / width, height, |y| rows[y * width + i % width])).collect()
}

/// Weighted mean around position `at` of a line of `length` values.
fn line(at: usize, length: usize, value: impl Fn(usize) -> f64) -> f64 {
    let (mut sum, mut weights) = (0.0, 0.0);
    for x in at.saturating_sub(REACH)..(at + REACH + 1).min(length) {
        let weight = WEIGHTS[x + REACH - at];
        sum += weight * value(x);
        weights += weight;
    }
    sum / weights
}

#[cfg(test)]
mod tests {
    use super::*;
    use fog_core::math;
    use fog_core::random::PathRng;

    const WIDTH: usize = 64;
    const PIXELS: usize = WIDTH * 64;

    /// Runs all rounds on pixels whose samples come from `sample`.
    fn run(first: u64, stop: &NoiseTarget, sample: impl Fn(usize, &mut PathRng) -> f32) -> Vec<PixelFilm> {
        let mut films = vec![PixelFilm::default(); PIXELS];
        let mut round = Round { pixels: (0..PIXELS).map(|i| (i, first)).collect(), expected: 0 };
        while !round.pixels.is_empty() {
            for &(i, until) in &round.pixels {
                for s in films[i].samples()..until {
                    films[i].add_mono(sample(i, &mut PathRng::new(5, i as u64, s)), 0.0);
                }
            }
            round = next_round(&films, WIDTH, stop);
        }
        films
    }

    /// Mean and its standard error over the pixels.
    fn mean(films: &[PixelFilm]) -> (f64, f64) {
        let mut all = Moments::default();
        films.iter().for_each(|f| all.add(f.luminance().mean()));
        (all.mean(), all.standard_error())
    }

    #[test]
    fn every_pixel_reaches_the_target_or_the_limit() {
        // Noise from pixel to pixel up to 100 times apart, one sharp edge, and black.
        let spread =
            |i: usize| if i % WIDTH < 20 { 0.0 } else { 0.1 + 0.9 * ((i / WIDTH) % 10) as f32 / 9.0 };
        let sample = |i: usize, rng: &mut PathRng| {
            let base = if i % WIDTH < 20 { 0.0 } else { 1.0 };
            base + spread(i) * (2.0 * rng.uniform() - 1.0)
        };
        let stop = NoiseTarget { noise: 0.02, max_samples: 500 };
        let films = run(16, &stop, sample);
        for (i, film) in films.iter().enumerate() {
            let (m, n) = (film.luminance(), film.samples());
            let noise = relative_error(m.standard_error(), m.mean(), 0.0);
            assert!(noise <= 0.02 || n == 500, "pixel {i}: {noise} after {n}");
        }
        // Pixels of the greatest spread want 1/3 / 0.02² = 833 samples, those of the least 8.
        let at = |x: usize, y: usize| films[y * WIDTH + x].samples();
        assert_eq!(at(40, 9), 500);
        assert_eq!(at(5, 30), 16);
        assert!((60..300).contains(&at(40, 23)), "{}", at(40, 23));
    }

    #[test]
    fn stopping_biases_little() {
        // Mostly 0.5, and one path in 50 brings exponentially distributed light of mean 25: mean 1, variance of a sample
        // 24.5, skewness 11. The error of a pixel is 10 %.
        let sample = |_: usize, rng: &mut PathRng| {
            let u = rng.uniform_f64();
            if u < 0.02 { 0.5 - 25.0 * math::f64::ln(1.0 - rng.uniform_f64()) as f32 } else { 0.5 }
        };
        let films = run(64, &NoiseTarget { noise: 0.1, max_samples: 1 << 20 }, sample);
        let (got, error) = mean(&films);
        println!("mean {got} ± {error} for 1");
        assert!(error < 0.002, "too few to tell: {error}");
        assert!((got - 1.0).abs() < 0.01 + 3.0 * error, "{got}");
        // Each pixel for itself, as one would naively do, is off by far more: the test can tell.
        let naive: Vec<PixelFilm> = (0..PIXELS)
            .map(|i| {
                let mut film = PixelFilm::default();
                for s in 0..u64::MAX {
                    film.add_mono(sample(i, &mut PathRng::new(5, i as u64, s)), 0.0);
                    let m = film.luminance();
                    if film.samples() >= 64 && m.standard_error() <= 0.1 * m.mean() {
                        break;
                    }
                }
                film
            })
            .collect();
        let (naive, error) = mean(&naive);
        println!("each for itself {naive} ± {error}");
        assert!(naive < 0.95, "{naive}");
    }

    #[test]
    fn a_pixel_that_missed_what_its_neighbours_found_goes_on() {
        let mut films = vec![PixelFilm::default(); 25];
        for (i, film) in films.iter_mut().enumerate() {
            for s in 0..64 {
                film.add_mono(if i != 12 && s == 0 { 64.0 } else { 1.0 }, 0.0);
            }
        }
        let round = next_round(&films, 5, &NoiseTarget { noise: 0.1, max_samples: 1000 });
        assert!(round.pixels.contains(&(12, 128)), "{round:?}");
        assert!(round.expected > 25 * 64, "{round:?}");
    }

    #[test]
    fn frames_that_share_samples_are_both_served() {
        let round = |pixels: &[(usize, u64)], expected| Round { pixels: pixels.to_vec(), expected };
        let both = round(&[(1, 20), (3, 40)], 7).union(round(&[(0, 30), (3, 50)], 5));
        assert_eq!(both, round(&[(0, 30), (1, 20), (3, 50)], 7));
    }

    #[test]
    fn a_frame_smaller_than_the_neighbourhood() {
        assert_eq!(smooth(&[3.0], 1), [3.0]);
        let s = smooth(&[1.0, 2.0], 2);
        assert!((s[0] - 1.4).abs() < 1e-12 && (s[1] - 1.6).abs() < 1e-12, "{s:?}");
        assert_eq!(smooth(&[], 0), [0.0; 0]);
    }
}
