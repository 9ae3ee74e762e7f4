//! A quantity over relative altitude: weighted polynomials, their degree by cross-validation, outliers by a stated rule.

use super::basis::{bernstein, change_variable, to_powers};
use super::linear::{Linear, dot, median, robust_scale, solve};

/// A measured value at a place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Point {
    /// Relative altitude.
    pub(super) zeta: f64,
    /// Fog height in m.
    pub(super) height_m: f64,
    pub(super) value: f64,
    /// Standard error.
    pub(super) error: f64,
}

/// Degrees of a polynomial over ζ and over the fog height.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Degrees {
    /// Over ζ.
    pub zeta: usize,
    /// Over the fog height.
    pub height: usize,
}

impl Degrees {
    /// Number of coefficients.
    #[must_use]
    pub fn coefficients(self) -> usize {
        (self.zeta + 1) * (self.height + 1)
    }
}

/// How well a degree predicts altitudes that it was not fitted to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CrossValidation {
    /// The degrees.
    pub degrees: Degrees,
    /// Mean squared error of the held-out values, each in units of its own variance.
    pub score: f64,
    /// Score less the best degree's.
    pub excess: f64,
    /// Standard error of the excess, from the differences of the altitudes' errors.
    pub error: f64,
    /// False if the polynomial would not be positive where it must be.
    pub valid: bool,
    /// True for the degree that was chosen.
    pub chosen: bool,
}

/// Space that polynomials run over: ζ from 0 to 1 and the measured heights.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Domain {
    /// Least and greatest fog height in m.
    pub(super) heights_m: [f64; 2],
    /// True if values must be above 0 on it.
    pub(super) positive: bool,
}

impl Domain {
    /// Values of the products of Bernstein polynomials of ζ and of the height.
    pub(super) fn row(&self, degrees: Degrees, zeta: f64, height_m: f64) -> Vec<f64> {
        let [low, high] = self.heights_m;
        let t = if high > low { (height_m - low) / (high - low) } else { 0.0 };
        let heights = bernstein(degrees.height, t);
        bernstein(degrees.zeta, zeta).iter().flat_map(|a| heights.iter().map(move |b| a * b)).collect()
    }

    /// Coefficients c_ij of ζⁱ Hʲ.
    pub(super) fn powers(&self, degrees: Degrees, coefficients: &[f64]) -> Vec<Vec<f64>> {
        let n = degrees.height + 1;
        let [low, high] = self.heights_m;
        // Over ζ for each Bernstein polynomial of the height, then over the height for each power of ζ.
        let columns: Vec<Vec<f64>> = (0..n)
            .map(|j| to_powers(&(0..=degrees.zeta).map(|i| coefficients[i * n + j]).collect::<Vec<_>>()))
            .collect();
        (0..=degrees.zeta)
            .map(|i| {
                let row: Vec<f64> = columns.iter().map(|column| column[i]).collect();
                if n == 1 { row } else { change_variable(&to_powers(&row), low, high) }
            })
            .collect()
    }

    fn holds(&self, degrees: Degrees, fit: &Linear) -> bool {
        let [low, high] = self.heights_m;
        let at = |i: u32, h: u32| {
            let row = self.row(degrees, f64::from(i) / 32.0, low + (high - low) * f64::from(h) / 4.0);
            dot(&row, &fit.values)
        };
        !self.positive || (0..=32).all(|i| (0..=4).all(|h| at(i, h) > 0.0))
    }
}

/// A polynomial fitted to points.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Trend {
    pub(super) degrees: Degrees,
    pub(super) fit: Linear,
    /// Standard deviation of the values around the polynomial beyond their standard errors.
    pub(super) scatter: f64,
    pub(super) table: Vec<CrossValidation>,
    /// Points set aside, by index, with their deviation in robust standard deviations.
    pub(super) outliers: Vec<(usize, f64)>,
}

/// How trends are fitted.
#[derive(Clone, Copy, Debug)]
pub(super) struct TrendSettings {
    pub(super) most: Degrees,
    pub(super) folds: usize,
    pub(super) outlier_mads: f64,
    /// Weigh by the relative errors at the fitted value: for counts, whose errors grow with them.
    pub(super) relative: bool,
}

/// Fits a polynomial to the points: outliers are set aside, the degree is chosen by cross-validation among those up to the
/// greatest allowed whose polynomial is positive where it must be. `None` if there are too few points for any degree.
pub(super) fn fit(points: &[Point], domain: &Domain, settings: &TrendSettings) -> Option<Trend> {
    let outliers = outliers(points, domain, settings)?;
    let kept: Vec<Point> = (points.iter().enumerate())
        .filter(|(i, _)| outliers.iter().all(|(outlier, _)| outlier != i))
        .map(|(_, point)| *point)
        .collect();
    let table = cross_validate(&kept, domain, settings);
    let chosen = table.iter().find(|entry| entry.chosen)?.degrees;
    let (fit, scatter) = weighted(&kept, domain, chosen, settings.relative)?;
    Some(Trend { degrees: chosen, fit, scatter, table, outliers })
}

/// The degrees that are considered, the simplest first.
fn candidates(points: usize, distinct_zeta: usize, most: Degrees) -> Vec<Degrees> {
    let mut all: Vec<Degrees> = (0..=most.zeta)
        .flat_map(|zeta| (0..=most.height).map(move |height| Degrees { zeta, height }))
        // Leave at least two points per coefficient, and two altitudes per coefficient over ζ.
        .filter(|d| {
            d.coefficients() == 1 || (2 * d.coefficients() <= points && 2 * (d.zeta + 1) <= distinct_zeta)
        })
        .collect();
    all.sort_by_key(|d| (d.coefficients(), d.height));
    all
}

fn distinct_zeta(points: &[Point]) -> usize {
    let mut zeta: Vec<f64> = points.iter().map(|p| p.zeta).collect();
    zeta.sort_by(f64::total_cmp);
    zeta.dedup();
    zeta.len()
}

/// Weighted least squares with the scatter beyond the standard errors that makes Σ w r² equal to the degrees of freedom
/// (Paule & Mandel 1982).
fn weighted(points: &[Point], domain: &Domain, degrees: Degrees, relative: bool) -> Option<(Linear, f64)> {
    let rows: Vec<Vec<f64>> = points.iter().map(|p| domain.row(degrees, p.zeta, p.height_m)).collect();
    let values: Vec<f64> = points.iter().map(|p| p.value).collect();
    // Errors in units of the value's scale: 1, or the fitted value.
    let mut scale: Vec<f64> = points.iter().map(|p| if relative { p.value.abs() } else { 1.0 }).collect();
    let mut result = None;
    for _ in 0..if relative { 4 } else { 1 } {
        let solve_with = |scatter: f64| {
            let weight = |(p, s): (&Point, &f64)| {
                let extra = scatter * s;
                let error = if relative { p.error / p.value.abs() * s } else { p.error };
                1.0 / (error * error + extra * extra)
            };
            let weights: Vec<f64> = points.iter().zip(&scale).map(weight).collect();
            let fit = solve(&rows, &values, &weights)?;
            let residual = |i: usize| values[i] - dot(&rows[i], &fit.values);
            let sum: f64 = (0..points.len()).map(|i| weights[i] * residual(i) * residual(i)).sum();
            Some((fit, sum))
        };
        let freedom = points.len() as f64 - degrees.coefficients() as f64;
        let scatter = scatter(|s| solve_with(s).map_or(0.0, |(_, sum)| sum), freedom, &values, &scale);
        let (fit, _) = solve_with(scatter)?;
        if relative {
            let floor = 0.02 * median(&values).abs();
            scale = rows.iter().map(|row| dot(row, &fit.values).max(floor)).collect();
        }
        result = Some((fit, scatter));
    }
    result
}

/// The scatter at which `sum` falls to `freedom`; 0 if it is there already.
fn scatter(sum: impl Fn(f64) -> f64, freedom: f64, values: &[f64], scale: &[f64]) -> f64 {
    if freedom <= 0.0 || sum(0.0) <= freedom {
        return 0.0;
    }
    let spread = values.iter().zip(scale).map(|(v, s)| (v / s).abs()).fold(0.0, f64::max);
    let (mut low, mut high) = (0.0, 10.0 * (spread + 1.0));
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if sum(middle) > freedom {
            low = middle;
        } else {
            high = middle;
        }
    }
    high
}

/// Points that deviate by more than the allowed number of robust standard deviations (1.4826 MAD of the standardised
/// residuals, at least 1) from a polynomial that outliers hardly pull.
fn outliers(points: &[Point], domain: &Domain, settings: &TrendSettings) -> Option<Vec<(usize, f64)>> {
    let most = Degrees { zeta: settings.most.zeta.min(4), height: settings.most.height.min(1) };
    let degrees = *candidates(points.len(), distinct_zeta(points), most).last()?;
    let rows: Vec<Vec<f64>> = points.iter().map(|p| domain.row(degrees, p.zeta, p.height_m)).collect();
    let values: Vec<f64> = points.iter().map(|p| p.value).collect();
    let centre = median(&values);
    let typical = median(&points.iter().map(|p| p.error).collect::<Vec<_>>());
    // Iteratively reweighted least squares with Cauchy's weights.
    let mut residuals: Vec<f64> = values.iter().map(|v| v - centre).collect();
    for _ in 0..20 {
        let spread = robust_scale(residuals.iter().copied());
        let extra = (spread * spread - typical * typical).max(0.0);
        let weight = |i: usize| {
            let variance = points[i].error * points[i].error + extra;
            1.0 / (variance + residuals[i] * residuals[i] / 4.0)
        };
        let weights: Vec<f64> = (0..points.len()).map(weight).collect();
        let fit = solve(&rows, &values, &weights)?;
        residuals = (0..points.len()).map(|i| values[i] - dot(&rows[i], &fit.values)).collect();
    }
    let spread = robust_scale(residuals.iter().copied());
    let extra = (spread * spread - typical * typical).max(0.0);
    let standard: Vec<f64> = (0..points.len())
        .map(|i| residuals[i] / (points[i].error * points[i].error + extra).sqrt())
        .collect();
    let unit = robust_scale(standard.iter().copied()).max(1.0);
    let deviation = standard.iter().map(|z| z / unit).enumerate();
    Some(deviation.filter(|(_, z)| z.abs() > settings.outlier_mads).collect())
}

/// Cross-validation: the points sorted by ζ are dealt in turn to the folds; each fold is predicted from the others.
fn cross_validate(points: &[Point], domain: &Domain, settings: &TrendSettings) -> Vec<CrossValidation> {
    let candidates = candidates(points.len(), distinct_zeta(points), settings.most);
    let mut order: Vec<usize> = (0..points.len()).collect();
    order.sort_by(|&a, &b| {
        (points[a].zeta.total_cmp(&points[b].zeta)).then(points[a].height_m.total_cmp(&points[b].height_m))
    });
    let folds = settings.folds.min(points.len());
    // One scatter for all degrees, that of the most flexible.
    let most_flexible = candidates.last().and_then(|d| weighted(points, domain, *d, settings.relative));
    let scatter = most_flexible.map_or(0.0, |(_, scatter)| scatter);
    let variance = |p: &Point| {
        let extra = if settings.relative { scatter * p.value } else { scatter };
        p.error * p.error + extra * extra
    };
    // Squared error of each held-out point over its variance, in the order of ζ.
    let errors = |degrees: Degrees| {
        let mut errors = vec![0.0; points.len()];
        for fold in 0..folds {
            let (held, train): (Vec<usize>, Vec<usize>) = (0..order.len()).partition(|k| k % folds == fold);
            let train: Vec<Point> = train.iter().map(|&k| points[order[k]]).collect();
            let rows: Vec<Vec<f64>> = train.iter().map(|p| domain.row(degrees, p.zeta, p.height_m)).collect();
            let values: Vec<f64> = train.iter().map(|p| p.value).collect();
            let weights: Vec<f64> = train.iter().map(|p| 1.0 / variance(p)).collect();
            let fit = solve(&rows, &values, &weights)?;
            for k in held {
                let p = &points[order[k]];
                let error = p.value - dot(&domain.row(degrees, p.zeta, p.height_m), &fit.values);
                errors[k] = error * error / variance(p);
            }
        }
        let valid = weighted(points, domain, degrees, settings.relative)
            .is_some_and(|(fit, _)| domain.holds(degrees, &fit));
        Some((degrees, errors, valid))
    };
    let all: Vec<(Degrees, Vec<f64>, bool)> = candidates.into_iter().filter_map(errors).collect();
    table(&all)
}

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

/// Scores of degrees from the held-out errors of each point.
///
/// The best valid degree has the least mean; the simplest one is chosen whose mean exceeds it by no more than one standard
/// error of that difference, point by point (the rule of Breiman et al. 1984, with paired errors).
fn table(all: &[(Degrees, Vec<f64>, bool)]) -> Vec<CrossValidation> {
    let valid = all.iter().filter(|(_, _, valid)| *valid);
    let Some((_, best, _)) =
        valid.reduce(|best, entry| if mean(&entry.1) < mean(&best.1) { entry } else { best })
    else {
        return Vec::new();
    };
    let mut found = false;
    let entry = |(degrees, errors, valid): &(Degrees, Vec<f64>, bool)| {
        let differences: Vec<f64> = errors.iter().zip(best).map(|(e, b)| e - b).collect();
        let excess = mean(&differences);
        let n = differences.len() as f64;
        let spread =
            differences.iter().map(|d| (d - excess) * (d - excess)).sum::<f64>() / (n - 1.0).max(1.0);
        let error = (spread / n).sqrt();
        let chosen = *valid && !found && excess <= error;
        found |= chosen;
        CrossValidation { degrees: *degrees, score: mean(errors), excess, error, valid: *valid, chosen }
    };
    all.iter().map(entry).collect()
}
