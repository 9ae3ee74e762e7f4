//! Bounded non-linear least squares: Levenberg–Marquardt (Moré 1978, MINPACK) with limits on parameters, by `rmpfit`.

use rmpfit::{MPConfig, MPError, MPFitter, MPMaxFev, MPPar, MPResult, MPSide, MPSuccess};

/// Residuals of a model to be made small, with their derivatives.
pub(super) trait Residuals {
    /// Number of residuals.
    fn count(&self) -> usize;

    /// Fills `residuals`, and `columns[p][i]` with the derivative of residual i by parameter p if columns are asked for.
    fn evaluate(&self, parameters: &[f64], residuals: &mut [f64], columns: Option<&mut [Vec<f64>]>);
}

/// When to stop.
#[derive(Clone, Copy, Debug)]
pub(super) struct Effort {
    /// Relative change of the sum, or of the parameters, that is too small to go on for.
    pub(super) tolerance: f64,
    pub(super) iterations: usize,
}

/// To the last digit that matters.
pub(super) const THOROUGH: Effort = Effort { tolerance: 1e-10, iterations: 100 };
/// To a thousandth of what counting noise makes of a sum of a thousand residuals.
pub(super) const QUICK: Effort = Effort { tolerance: 1e-6, iterations: 30 };

/// Where the sum of squares is least.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Minimum {
    /// The parameters.
    pub(super) parameters: Vec<f64>,
    /// Sum of the squares of the residuals.
    pub(super) sum: f64,
    /// Whether the method came to rest.
    pub(super) converged: bool,
}

struct Problem<'a> {
    residuals: &'a dyn Residuals,
    config: MPConfig,
    parameters: Vec<MPPar>,
}

impl MPFitter for Problem<'_> {
    fn eval(&mut self, parameters: &[f64], deviates: &mut [f64]) -> MPResult<()> {
        self.residuals.evaluate(parameters, deviates, None);
        // The method takes a trial step that is no number for a good one.
        if deviates.iter().all(|d| d.is_finite()) { Ok(()) } else { Err(MPError::Nan) }
    }

    fn number_of_points(&self) -> usize {
        self.residuals.count()
    }

    fn config(&self) -> &MPConfig {
        &self.config
    }

    fn parameters(&self) -> &[MPPar] {
        &self.parameters
    }

    fn jacobian(
        &mut self,
        parameters: &[f64],
        deviates: &mut [f64],
        derivatives: &mut [Option<Vec<f64>>],
    ) -> MPResult<()> {
        let mut columns = vec![vec![0.0; deviates.len()]; parameters.len()];
        self.residuals.evaluate(parameters, deviates, Some(&mut columns));
        for (target, column) in derivatives.iter_mut().zip(columns) {
            if let Some(target) = target {
                *target = column;
            }
        }
        Ok(())
    }
}

/// Minimises the sum of squares from `start` (moved into the bounds) within `bounds`; `None` if there are fewer residuals
/// than parameters, or the residuals are no numbers.
pub(super) fn minimise(
    residuals: &dyn Residuals,
    start: &[f64],
    bounds: &[[f64; 2]],
    effort: Effort,
) -> Option<Minimum> {
    let limit = |&[low, high]: &[f64; 2]| MPPar {
        limited_low: true,
        limited_up: true,
        limit_low: low,
        limit_up: high,
        side: MPSide::User,
        ..MPPar::new()
    };
    let config = MPConfig {
        ftol: effort.tolerance,
        xtol: effort.tolerance,
        max_iter: effort.iterations,
        max_fev: MPMaxFev::Limited(10 * effort.iterations),
        step_factor: 1.0,
        ..MPConfig::new()
    };
    let mut problem = Problem { residuals, config, parameters: bounds.iter().map(limit).collect() };
    let mut parameters: Vec<f64> =
        start.iter().zip(bounds).map(|(x, [low, high])| x.clamp(*low, *high)).collect();
    let status = problem.mpfit(&mut parameters).ok()?;
    let sum = status.best_norm;
    (sum.is_finite()).then(|| Minimum { parameters, sum, converged: status.success != MPSuccess::MaxIter })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Rosenbrock's valley: 10 (y − x²), 1 − x.
    struct Valley;

    impl Residuals for Valley {
        fn count(&self) -> usize {
            2
        }

        fn evaluate(&self, p: &[f64], r: &mut [f64], columns: Option<&mut [Vec<f64>]>) {
            r[0] = 10.0 * (p[1] - p[0] * p[0]);
            r[1] = 1.0 - p[0];
            if let Some(columns) = columns {
                columns[0].copy_from_slice(&[-20.0 * p[0], -1.0]);
                columns[1].copy_from_slice(&[10.0, 0.0]);
            }
        }
    }

    #[test]
    fn valley_is_walked_to_its_end_or_to_the_bound() {
        let free = minimise(&Valley, &[-1.2, 1.0], &[[-5.0, 5.0], [-5.0, 5.0]], THOROUGH).unwrap();
        assert!(free.converged && free.sum < 1e-16, "{free:?}");
        assert!((free.parameters[0] - 1.0).abs() < 1e-8);
        // x at most 0.5: the best point of the bound is (0.5, 0.25).
        let bound = minimise(&Valley, &[-1.2, 9.0], &[[-5.0, 0.5], [-5.0, 5.0]], THOROUGH).unwrap();
        assert_eq!(bound.parameters[0], 0.5);
        assert!((bound.parameters[1] - 0.25).abs() < 1e-6 && (bound.sum - 0.25).abs() < 1e-9, "{bound:?}");
        let again = minimise(&Valley, &[-1.2, 9.0], &[[-5.0, 0.5], [-5.0, 5.0]], THOROUGH).unwrap();
        assert_eq!(bound, again);
    }

    #[test]
    fn what_cannot_be_minimised_is_refused() {
        struct NoNumbers;
        impl Residuals for NoNumbers {
            fn count(&self) -> usize {
                2
            }
            fn evaluate(&self, _: &[f64], r: &mut [f64], _: Option<&mut [Vec<f64>]>) {
                r.fill(f64::NAN);
            }
        }
        assert_eq!(minimise(&NoNumbers, &[0.0], &[[-1.0, 1.0]], THOROUGH), None);
        let bounds = [[-5.0, 5.0]; 3];
        assert_eq!(
            minimise(&Valley, &[0.0; 3], &bounds, THOROUGH),
            None,
            "three parameters of two residuals"
        );
    }
}
