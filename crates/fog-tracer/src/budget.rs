//! A fixed number of paths, shared out over the pixels of a frame so that the mean relative squared error is least.
//!
//! With n samples a pixel of spread s and value m is off by s² / (n m²) in the mean of squares, and the sum over the pixels is
//! least for a given sum of n where n goes with s / m. Both are told from two pilot rounds of all pixels: their difference
//! knows what the stratification of a pixel's samples takes away from the spread.
//!
//! A pixel is judged by its neighbours alone, never by its own samples. Samples of different pixels are independent, so what a
//! pixel gets does not depend on what it has seen, and its mean has no bias; only the frame's sums, to which it adds one part in
//! all pixels, tie them together.

use crate::rounds::Round;
use crate::settings::MOST_OF_BUDGET;
use fog_film::PixelFilm;

/// Share of the samples that each pilot round takes.
const PILOT_SHARE: u64 = 8;
/// Neighbours on each side that a pixel is judged by.
const REACH: usize = 1;
/// Share of the frame's mean square that is added to the square of each pixel's value: as in `fogbank compare`.
const FLOOR: f64 = 0.01;

/// Samples of each pixel in each of the two pilot rounds; `None` if there are too few samples to share out.
pub(crate) fn pilot(samples: u64) -> Option<u64> {
    let half = (samples / PILOT_SHARE).max(2);
    (2 * half < samples).then_some(half)
}

/// Mean radiance of each pixel.
pub(crate) fn means(films: &[PixelFilm]) -> Vec<[f32; 3]> {
    let total = |film: &PixelFilm| {
        let (direct, airlight) = (film.direct(), film.airlight());
        std::array::from_fn(|c| direct[c] + airlight[c])
    };
    films.iter().map(total).collect()
}

/// Squared relative difference of the pilot rounds for each pixel, of its neighbours without itself: `first` are the means
/// after the first round, `films` are those after both.
pub(crate) fn spread(first: &[[f32; 3]], films: &[PixelFilm], width: usize) -> Vec<f64> {
    let both = means(films);
    let square = |v: [f32; 3]| v.iter().map(|&v| f64::from(v) * f64::from(v)).sum::<f64>();
    let apart: Vec<f64> =
        first.iter().zip(&both).map(|(a, b)| square(std::array::from_fn(|c| a[c] - b[c]))).collect();
    let values: Vec<f64> = both.iter().map(|&v| square(v)).collect();
    let floor = FLOOR * values.iter().sum::<f64>() / values.len().max(1) as f64;
    let (apart, values) = (around(&apart, width), around(&values, width));
    let relative = |(apart, value): (f64, f64)| if apart > 0.0 { apart / (value + floor) } else { 0.0 };
    apart.into_iter().zip(values).map(relative).collect()
}

/// Means over the neighbours of each pixel without itself; 0 where it has none.
fn around(values: &[f64], width: usize) -> Vec<f64> {
    let height = values.len() / width.max(1);
    let near = |at: usize, length: usize| at.saturating_sub(REACH)..(at + REACH + 1).min(length);
    let mean = |i: usize| {
        let (columns, rows) = (near(i % width, width), near(i / width, height));
        let others = columns.len() * rows.len() - 1;
        let sum: f64 = rows.map(|y| columns.clone().map(|x| values[y * width + x]).sum::<f64>()).sum();
        if others == 0 { 0.0 } else { ((sum - values[i]) / others as f64).max(0.0) }
    };
    (0..values.len()).map(mean).collect()
}

/// Shares out what is left of `samples` times the pixels after `done` samples of each, by the root of their `spread`.
pub(crate) fn share_out(spread: &[f64], samples: u64, done: u64) -> Round {
    let weights: Vec<f64> = spread.iter().map(|s| s.sqrt()).collect();
    let (least, most) = (done as f64, (samples * MOST_OF_BUDGET) as f64);
    let budget = samples as f64 * spread.len() as f64;
    let wanted = |scale: f64, weight: f64| (scale * weight).clamp(least, most);
    let total = |scale: f64| weights.iter().map(|&w| wanted(scale, w)).sum::<f64>();
    // The sum grows with the scale: halving the interval 60 times finds where it meets the budget.
    let largest = weights.iter().copied().fold(0.0, f64::max);
    let positive = weights.iter().copied().filter(|&w| w > 0.0).fold(f64::INFINITY, f64::min);
    let (mut low, mut high) = if largest > 0.0 { (0.0, most / positive) } else { (0.0, 0.0) };
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if total(middle) > budget {
            high = middle;
        } else {
            low = middle;
        }
    }
    // Fractions go on to the next pixel, so that the sum stays.
    let (mut round, mut carried) = (Round::default(), 0.0);
    for (i, &weight) in weights.iter().enumerate() {
        let exact = wanted(low, weight) + carried;
        let until = (exact as u64).max(done);
        carried = exact - until as f64;
        if until > done {
            round.pixels.push((i, until));
            round.expected += until - done;
        }
    }
    round
}

#[cfg(test)]
mod tests {
    use super::*;
    use fog_core::moments::Moments;
    use fog_core::random::PathRng;

    #[test]
    fn the_budget_is_spent_by_spread() {
        // Four kinds of pixels: no spread, little, ten times as much, far too much.
        let spread: Vec<f64> =
            (0..4000).map(|i| [0.0, 1e-4, 1e-2, 1e4][i % 4] * f64::from(u8::from(i % 400 != 3))).collect();
        let round = share_out(&spread, 64, 16);
        let mut got = vec![16u64; spread.len()];
        round.pixels.iter().for_each(|&(i, until)| got[i] = until);
        let total: u64 = got.iter().sum();
        assert_eq!(round.expected, total - 16 * 4000);
        assert!(total <= 64 * 4000 && total + 2 >= 64 * 4000, "{total}");
        assert_eq!((got[0], got[3]), (16, 16));
        assert!((200..=210).contains(&got[7]), "{}", got[7]);
        let all_even = share_out(&[0.25; 100], 64, 16);
        assert!(all_even.pixels.iter().all(|&(_, until)| (63..=65).contains(&until)));
        // Nothing to go by: the pilot is all.
        assert_eq!(share_out(&[0.0; 9], 64, 16), Round::default());
        assert_eq!([pilot(3), pilot(4), pilot(5), pilot(64)], [None, None, Some(2), Some(8)]);
    }

    #[test]
    fn a_pixel_does_not_judge_itself() {
        let mut films = vec![PixelFilm::default(); 49];
        films.iter_mut().for_each(|film| film.add_mono(1.0, 0.0));
        let mut first = means(&films);
        first[24] = [3.0, 0.0, 0.0];
        let spread = spread(&first, &films, 7);
        assert_eq!(spread[24], 0.0);
        assert!(spread[25] > 0.0 && spread[0] == 0.0);
        assert_eq!(around(&[5.0], 1), [0.0]);
    }

    #[test]
    fn means_have_no_bias() {
        // One path in 30 brings light: whoever judges a pixel by its own pilot is off by percents.
        const SIDE: usize = 96;
        let sample = |rng: &mut PathRng| if rng.uniform() < 1.0 / 30.0 { 29.0 } else { 1.0f32 / 29.0 };
        let want = 29.0 / 30.0 + 1.0 / 30.0;
        let run = |own: bool| {
            let mut films = vec![PixelFilm::default(); SIDE * SIDE];
            let add = |films: &mut [PixelFilm], i: usize, until: u64| {
                for s in films[i].samples()..until {
                    films[i].add_mono(sample(&mut PathRng::new(8, i as u64, s)), 0.0);
                }
            };
            (0..films.len()).for_each(|i| add(&mut films, i, 8));
            let first = means(&films);
            (0..films.len()).for_each(|i| add(&mut films, i, 16));
            let of_own = || {
                let square = |(a, b): (&[f32; 3], &[f32; 3])| f64::from((a[0] - b[0]).powi(2) / b[0].powi(2));
                first.iter().zip(&means(&films)).map(square).collect()
            };
            let spread = if own { of_own() } else { spread(&first, &films, SIDE) };
            for (i, until) in share_out(&spread, 64, 16).pixels {
                add(&mut films, i, until);
            }
            let mut mean = Moments::default();
            films.iter().for_each(|f| mean.add(f.luminance().mean()));
            (mean.mean() - want, mean.standard_error())
        };
        let (off, error) = run(false);
        assert!(error < 0.01 && off.abs() < 4.0 * error, "{off} ± {error}");
        let (off, error) = run(true);
        assert!(off.abs() > 8.0 * error, "the test cannot tell: {off} ± {error}");
    }
}
