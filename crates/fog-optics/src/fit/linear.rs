//! Weighted linear least squares for a few parameters.

/// Solution of a weighted linear least-squares problem.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Linear {
    /// The parameters.
    pub(super) values: Vec<f64>,
    /// Their covariance if the weights are inverse variances, row by row.
    pub(super) covariance: Vec<Vec<f64>>,
}

impl Linear {
    /// Standard error of Σ row[i]·values[i].
    pub(super) fn standard_error(&self, row: &[f64]) -> f64 {
        let variance: f64 = (self.covariance.iter().zip(row)).map(|(c, r)| r * dot(c, row)).sum();
        variance.max(0.0).sqrt()
    }
}

pub(super) fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// Minimises Σ w (y − row·x)² by normal equations; `None` if the rows do not determine every parameter.
///
/// The bases used here (Bernstein polynomials of degree up to 8) keep the condition of the normal equations below 1e8.
pub(super) fn solve(rows: &[Vec<f64>], y: &[f64], weights: &[f64]) -> Option<Linear> {
    let n = rows.first()?.len();
    let mut matrix = vec![vec![0.0; n]; n];
    let mut right = vec![0.0; n];
    for ((row, y), w) in rows.iter().zip(y).zip(weights) {
        for i in 0..n {
            right[i] += w * row[i] * y;
            for j in 0..n {
                matrix[i][j] += w * row[i] * row[j];
            }
        }
    }
    let covariance = inverse(&matrix)?;
    let values = covariance.iter().map(|row| dot(row, &right)).collect();
    Some(Linear { values, covariance })
}

/// Inverse of a symmetric positive definite matrix by Cholesky's factors, its diagonal first scaled to 1; `None` if it is
/// singular to 1e-13.
pub(super) fn inverse(matrix: &[Vec<f64>]) -> Option<Vec<Vec<f64>>> {
    let n = matrix.len();
    let scale: Vec<f64> = (0..n).map(|i| 1.0 / matrix[i][i].sqrt()).collect();
    if scale.iter().any(|s| !s.is_finite()) {
        return None;
    }
    // matrix = factor · factorᵀ
    let mut factor = vec![vec![0.0; n]; n];
    for i in 0..n {
        for j in 0..=i {
            let rest = matrix[i][j] * scale[i] * scale[j] - dot(&factor[i][..j], &factor[j][..j]);
            if i == j {
                if rest.is_nan() || rest <= 1e-13 {
                    return None;
                }
                factor[i][i] = rest.sqrt();
            } else {
                factor[i][j] = rest / factor[j][j];
            }
        }
    }
    // Columns of the inverse: factor · factorᵀ · x = unit vector.
    let mut result = vec![vec![0.0; n]; n];
    for column in 0..n {
        let mut x = vec![0.0; n];
        for i in 0..n {
            let unit = if i == column { 1.0 } else { 0.0 };
            x[i] = (unit - dot(&factor[i][..i], &x[..i])) / factor[i][i];
        }
        for i in (0..n).rev() {
            let above: f64 = (i + 1..n).map(|k| factor[k][i] * x[k]).sum();
            x[i] = (x[i] - above) / factor[i][i];
        }
        for i in 0..n {
            result[i][column] = x[i] * scale[i] * scale[column];
        }
    }
    Some(result)
}

/// Middle value, or mean of the two in the middle; 0 of nothing.
pub(super) fn median(values: &[f64]) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    let n = sorted.len();
    match n {
        0 => 0.0,
        _ => 0.5 * (sorted[(n - 1) / 2] + sorted[n / 2]),
    }
}

/// Standard deviation as the median of the absolute values tells it, for values around 0 (1.4826 times it, for a Gaussian).
pub(super) fn robust_scale(values: impl Iterator<Item = f64>) -> f64 {
    1.4826 * median(&values.map(f64::abs).collect::<Vec<_>>())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn weighted_line_has_its_textbook_solution() {
        let rows: Vec<Vec<f64>> = [0.0, 1.0, 2.0, 5.0].iter().map(|&x| vec![1.0, x]).collect();
        let exact: Vec<f64> = rows.iter().map(|row| 3.0 - 0.5 * row[1]).collect();
        let fit = solve(&rows, &exact, &[1.0, 2.0, 4.0, 0.5]).unwrap();
        assert!((fit.values[0] - 3.0).abs() < 1e-12 && (fit.values[1] + 0.5).abs() < 1e-12);

        // A mean of values with variances 1/w has the variance 1/Σw.
        let fit = solve(&vec![vec![1.0]; 3], &[1.0, 2.0, 6.0], &[1.0, 1.0, 2.0]).unwrap();
        assert!((fit.values[0] - 3.75).abs() < 1e-12);
        assert!((fit.standard_error(&[1.0]) - 0.5).abs() < 1e-12);
        assert!((fit.standard_error(&[-2.0]) - 1.0).abs() < 1e-12);
    }

    #[test]
    fn undetermined_problems_are_seen() {
        let twice = vec![vec![1.0, 2.0], vec![2.0, 4.0]];
        assert_eq!(solve(&twice, &[1.0, 2.0], &[1.0, 1.0]), None);
        assert_eq!(solve(&[], &[], &[]), None);
        assert_eq!(solve(&[vec![0.0]], &[1.0], &[1.0]), None);
    }

    #[test]
    fn medians_ignore_outliers() {
        assert_eq!(median(&[3.0, 1.0, 1000.0]), 3.0);
        assert_eq!(median(&[4.0, 1.0, 2.0, 9.0]), 3.0);
        assert_eq!(median(&[]), 0.0);
        assert!((robust_scale([-1.0, 1.0, 1e9].into_iter()) - 1.4826).abs() < 1e-12);
    }
}
