//! Polynomials in Bernstein's basis.
//!
//! A polynomial with coefficients b₀ … b_n there stays between the least and the greatest of them on [0, 1]: bounds on a
//! quantity become bounds on its coefficients. It is also far better conditioned than powers.

/// Values of the n + 1 Bernstein polynomials of degree n at t: C(n, k) tᵏ (1 − t)ⁿ⁻ᵏ.
pub(super) fn bernstein(degree: usize, t: f64) -> Vec<f64> {
    let mut values = vec![1.0];
    for n in 1..=degree {
        // De Casteljau: each is a mixture of its two neighbours of one degree less.
        let mut next = vec![0.0; n + 1];
        for (k, value) in values.iter().enumerate() {
            next[k] += (1.0 - t) * value;
            next[k + 1] += t * value;
        }
        values = next;
    }
    values
}

/// Coefficients over powers of t of the polynomial with these Bernstein coefficients.
pub(super) fn to_powers(coefficients: &[f64]) -> Vec<f64> {
    let n = coefficients.len() - 1;
    // c_i = C(n, i) Δ^i b_0, with forward differences Δ.
    let mut differences = coefficients.to_vec();
    let mut powers = Vec::with_capacity(n + 1);
    let mut binomial = 1.0;
    for i in 0..=n {
        powers.push(binomial * differences[0]);
        for k in 0..n - i {
            differences[k] = differences[k + 1] - differences[k];
        }
        binomial = binomial * (n - i) as f64 / (i + 1) as f64;
    }
    powers
}

/// Coefficients over powers of x of Σ c_i tⁱ with t = (x − low)/(high − low).
pub(super) fn change_variable(powers: &[f64], low: f64, high: f64) -> Vec<f64> {
    let (slope, shift) = (1.0 / (high - low), -low / (high - low));
    // Horner: result = result · (slope x + shift) + c_i.
    let mut result = vec![0.0; powers.len()];
    for c in powers.iter().rev() {
        for k in (0..result.len()).rev() {
            let below = if k > 0 { result[k - 1] } else { 0.0 };
            result[k] = result[k] * shift + below * slope;
        }
        result[0] += c;
    }
    result
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::advection::polynomial;
    use crate::fit::linear::dot;

    #[test]
    fn bases_are_the_same_polynomial() {
        let b = [2.0, -1.0, 0.5, 3.0, 7.0];
        let powers = to_powers(&b);
        let shifted = change_variable(&powers, 100.0, 260.0);
        for i in 0..=10 {
            let t = f64::from(i) / 10.0;
            let value = dot(&b, &bernstein(4, t));
            assert!((value - polynomial(&powers, t)).abs() < 1e-12);
            assert!((value - polynomial(&shifted, 100.0 + 160.0 * t)).abs() < 1e-10);
            assert!((bernstein(4, t).iter().sum::<f64>() - 1.0).abs() < 1e-14);
        }
        assert_eq!(to_powers(&[5.0]), [5.0]);
    }
}
