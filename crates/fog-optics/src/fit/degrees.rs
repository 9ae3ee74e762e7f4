//! Degrees of the shape polynomials from all counts at once: steps up and down that held-out counts ask for.

use super::altitude::Bounds;
use super::basis::bernstein;
use super::bins::SHAPES;
use super::joint::{Layer, Polynomials, refine, shape_at};
use super::least_squares::{QUICK, THOROUGH};
use super::linear::solve;
use rayon::prelude::*;
use std::collections::BTreeMap;

/// Folds of the cross-validation: each costs a fit of all counts.
const FOLDS: usize = 5;
/// More rounds than any search has needed; a bound on the work.
const ROUNDS: usize = 12;

/// A step of one degree that was compared by the deviance of held-out altitudes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DegreeStep {
    /// Index of the shape parameter in [`SHAPE_KEYS`](super::SHAPE_KEYS).
    pub parameter: usize,
    /// Degree before.
    pub from: usize,
    /// Degree after; one more or one less.
    pub to: usize,
    /// By how much the step lowers the deviance of the held-out altitudes, summed over them.
    pub gain: f64,
    /// Standard error of the gain, from its differences between altitudes.
    pub error: f64,
    /// Whether the step was taken.
    pub taken: bool,
}

type Degrees = [usize; SHAPES];

struct Search<'a> {
    /// By ascending ζ.
    layers: Vec<Layer>,
    bounds: &'a Bounds,
    /// Deviance of each layer as predicted from other folds, by degrees.
    known: BTreeMap<Degrees, Option<Vec<f64>>>,
}

impl Search<'_> {
    /// Predicts every altitude of those degrees that are not known yet.
    fn learn(&mut self, candidates: &[Polynomials]) {
        let new: Vec<&Polynomials> =
            candidates.iter().filter(|c| !self.known.contains_key(&degrees_of(c))).collect();
        let jobs: Vec<(usize, usize)> =
            (0..new.len()).flat_map(|c| (0..FOLDS).map(move |fold| (c, fold))).collect();
        let predict = |&(c, fold): &(usize, usize)| -> Option<Vec<(usize, f64)>> {
            let held = |i: usize| i % FOLDS == fold;
            let train: Vec<Layer> =
                (0..self.layers.len()).filter(|&i| !held(i)).map(|i| self.layers[i].clone()).collect();
            let fit = refine(&train, new[c], self.bounds, QUICK)?;
            let deviance = |i: usize| {
                let shape = shape_at(&fit.polynomials, self.layers[i].zeta);
                let residuals = self.layers[i].residuals(&shape, self.layers[i].number(&shape));
                (i, residuals.iter().map(|r| r * r).sum::<f64>())
            };
            Some((0..self.layers.len()).filter(|&i| held(i)).map(deviance).collect())
        };
        let predicted: Vec<Option<Vec<(usize, f64)>>> = jobs.par_iter().map(predict).collect();
        for (c, folds) in new.iter().zip(predicted.chunks(FOLDS)) {
            let mut deviances = vec![0.0; self.layers.len()];
            let complete = folds.iter().all(Option::is_some);
            for &(i, deviance) in folds.iter().flatten().flatten() {
                deviances[i] = deviance;
            }
            self.known.insert(degrees_of(c), complete.then_some(deviances));
        }
    }

    /// Gain of a step and its standard error.
    fn compare(&self, from: &Degrees, to: &Degrees) -> Option<(f64, f64)> {
        let (from, to) = (self.known.get(from)?.as_ref()?, self.known.get(to)?.as_ref()?);
        let gains: Vec<f64> = from.iter().zip(to).map(|(from, to)| from - to).collect();
        let n = gains.len() as f64;
        let sum: f64 = gains.iter().sum();
        let variance: f64 =
            gains.iter().map(|g| (g - sum / n) * (g - sum / n)).sum::<f64>() / (n - 1.0).max(1.0);
        Some((sum, (n * variance).sqrt()))
    }
}

/// Polynomials of the degrees that held-out altitudes ask for, not yet refined, and the steps of the last round.
///
/// From the degrees of `start`: the step up with the greatest gain is taken if the gain exceeds its standard error; else the
/// step down with the least loss if the loss does not. Altitudes sorted by ζ are dealt in turn to five folds.
pub(super) fn search(
    layers: &[Layer],
    start: &Polynomials,
    bounds: &Bounds,
    max_degree: usize,
    progress: &dyn Fn(f64),
) -> (Polynomials, Vec<DegreeStep>) {
    let mut layers = layers.to_vec();
    layers.sort_by(|a, b| a.zeta.total_cmp(&b.zeta));
    let mut search = Search { layers, bounds, known: BTreeMap::new() };
    let mut base = start.clone();
    let mut steps = Vec::new();
    // The number of rounds is not known beforehand: each is told as a third of what is left.
    let mut left = 1.0;
    for _ in 0..ROUNDS {
        let neighbours: Vec<(usize, Polynomials)> = (0..SHAPES)
            .flat_map(|p| {
                let degree = base[p].len() - 1;
                let up = (degree < max_degree).then(|| (p, replaced(&base, p, elevated(&base[p]))));
                let down = (degree > 0).then(|| (p, replaced(&base, p, lowered(&base[p]))));
                [up, down]
            })
            .flatten()
            .collect();
        let mut candidates: Vec<Polynomials> =
            neighbours.iter().map(|(_, candidate)| candidate.clone()).collect();
        candidates.push(base.clone());
        search.learn(&candidates);
        left *= 2.0 / 3.0;
        progress(1.0 - left);
        let from = degrees_of(&base);
        let mut found = Vec::new();
        for (k, (p, candidate)) in neighbours.iter().enumerate() {
            if let Some((gain, error)) = search.compare(&from, &degrees_of(candidate)) {
                let (from, to) = (base[*p].len() - 1, candidate[*p].len() - 1);
                found.push((k, DegreeStep { parameter: *p, from, to, gain, error, taken: false }));
            }
        }
        let best = |up: bool| {
            let fitting = found.iter().filter(|(_, s)| (s.to > s.from) == up);
            let allowed = fitting.filter(|(_, s)| if up { s.gain > s.error } else { s.gain >= -s.error });
            allowed.reduce(|best, step| if step.1.gain > best.1.gain { step } else { best }).map(|(k, _)| *k)
        };
        let chosen = best(true).or_else(|| best(false));
        steps = found.iter().map(|(k, step)| DegreeStep { taken: chosen == Some(*k), ..*step }).collect();
        let Some(chosen) = chosen else { break };
        base = neighbours[chosen].1.clone();
        // Folds of the next round start from the best fit of these degrees.
        if let Some(joint) = refine(&search.layers, &base, bounds, THOROUGH) {
            base = joint.polynomials;
        }
    }
    (base, steps)
}

fn degrees_of(polynomials: &Polynomials) -> Degrees {
    std::array::from_fn(|p| polynomials[p].len() - 1)
}

fn replaced(base: &Polynomials, p: usize, polynomial: Vec<f64>) -> Polynomials {
    let mut new = base.clone();
    new[p] = polynomial;
    new
}

/// The same polynomial with one coefficient more.
fn elevated(coefficients: &[f64]) -> Vec<f64> {
    let n = coefficients.len();
    (0..=n)
        .map(|k| {
            let share = k as f64 / n as f64;
            let before = if k > 0 { coefficients[k - 1] } else { 0.0 };
            let at = if k < n { coefficients[k] } else { 0.0 };
            share * before + (1.0 - share) * at
        })
        .collect()
}

/// The nearest polynomial with one coefficient less, by least squares at 21 places.
fn lowered(coefficients: &[f64]) -> Vec<f64> {
    let n = coefficients.len();
    let places: Vec<f64> = (0..=20).map(|i| f64::from(i) / 20.0).collect();
    let rows: Vec<Vec<f64>> = places.iter().map(|t| bernstein(n - 2, *t)).collect();
    let values: Vec<f64> =
        places.iter().map(|t| super::linear::dot(coefficients, &bernstein(n - 1, *t))).collect();
    solve(&rows, &values, &[1.0; 21]).map_or_else(|| coefficients[..n - 1].to_vec(), |fit| fit.values)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn degrees_go_up_and_down_without_moving_the_polynomial() {
        let line = [3.0, 5.0];
        let parabola = elevated(&line);
        assert_eq!(parabola, [3.0, 4.0, 5.0]);
        let back = lowered(&parabola);
        assert!((back[0] - 3.0).abs() < 1e-9 && (back[1] - 5.0).abs() < 1e-9);
        assert!((lowered(&line)[0] - 4.0).abs() < 1e-9);
    }
}
