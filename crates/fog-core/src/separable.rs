//! A table over altitude and wavelength as a short sum of products.
//!
//! Spectra of fog at different altitudes are so alike that a few of a table's columns span all others. With
//! v(z, λ) = Σ_k c_k(λ) b_k(z) a look-up for all wavelengths of a path costs a few interpolations in altitude and some
//! multiplications, instead of as many interpolations as there are wavelengths.

use crate::spectrum::{LANES, LaneWeights, Wavelengths};

/// Largest number of products.
pub(crate) const MAX_RANK: usize = 4;

/// Largest error that is left, as a fraction of the largest value of the table, unless [`MAX_RANK`] products are reached.
const TOLERANCE: f64 = 1e-7;

/// Coefficients c_k of the lanes of a path; zero beyond the rank.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LaneCoefficients(pub(crate) [[f64; LANES]; MAX_RANK]);

/// Columns of a table that span it, and the coefficients of every column.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Separable {
    wavelengths_nm: Vec<f64>,
    /// Number of products, 1 to [`MAX_RANK`].
    pub(crate) rank: usize,
    /// b_k at each row of the table, zero beyond the rank.
    pub(crate) basis: Vec<[f64; MAX_RANK]>,
    /// c_k at each wavelength.
    coefficients: Vec<[f64; MAX_RANK]>,
}

impl Separable {
    /// Decomposes `values`, \[row\]\[wavelength\], by Gram–Schmidt with pivoting: the basis are columns of the table.
    pub(crate) fn new(wavelengths_nm: &[f64], values: &[f64]) -> Self {
        let w = wavelengths_nm.len();
        let rows = values.len() / w;
        let mut residual: Vec<Vec<f64>> =
            (0..w).map(|l| (0..rows).map(|z| values[z * w + l]).collect()).collect();
        let largest = values.iter().fold(0.0f64, |a, v| a.max(v.abs()));
        let mut coefficients = vec![[0.0; MAX_RANK]; w];
        let mut basis = vec![[0.0; MAX_RANK]; rows];
        let mut rank = 0;
        while rank < MAX_RANK.min(w) {
            let worst = |column: &Vec<f64>| column.iter().fold(0.0f64, |a, v| a.max(v.abs()));
            let Some(pivot) = (0..w).max_by(|&a, &b| worst(&residual[a]).total_cmp(&worst(&residual[b])))
            else {
                break;
            };
            if rank > 0 && worst(&residual[pivot]) <= TOLERANCE * largest {
                break;
            }
            // Scale to the largest value 1: what is left of the other columns then is small against it.
            let scale = worst(&residual[pivot]).max(f64::MIN_POSITIVE);
            let direction: Vec<f64> = residual[pivot].iter().map(|v| v / scale).collect();
            let norm: f64 = direction.iter().map(|v| v * v).sum::<f64>().max(f64::MIN_POSITIVE);
            for (l, column) in residual.iter_mut().enumerate() {
                let c = column.iter().zip(&direction).map(|(a, b)| a * b).sum::<f64>() / norm;
                coefficients[l][rank] = c;
                for (v, d) in column.iter_mut().zip(&direction) {
                    *v -= c * d;
                }
            }
            for (row, d) in basis.iter_mut().zip(&direction) {
                row[rank] = *d;
            }
            rank += 1;
        }
        Self { wavelengths_nm: wavelengths_nm.to_vec(), rank, basis, coefficients }
    }

    /// Coefficients at the wavelengths of a path, linear between the table's.
    pub(crate) fn lanes(&self, wavelengths: &Wavelengths) -> LaneCoefficients {
        let at = LaneWeights::new(&self.wavelengths_nm, wavelengths);
        let mut out = [[0.0; LANES]; MAX_RANK];
        for lane in 0..LANES {
            let low = at.index[lane] as usize;
            let high = (low + 1).min(self.coefficients.len() - 1);
            let t = f64::from(at.weight[lane]);
            for (k, out) in out.iter_mut().enumerate() {
                let (a, b) = (self.coefficients[low][k], self.coefficients[high][k]);
                out[lane] = a + (b - a) * t;
            }
        }
        LaneCoefficients(out)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn smooth_tables_need_few_products() {
        // Wavelengths in which every row is a quadratic: three products are exact.
        let nm: Vec<f64> = (0..18).map(|l| 375.0 + 25.0 * f64::from(l)).collect();
        let mut values = Vec::new();
        for z in 0..200 {
            let z = f64::from(z) / 199.0;
            values.extend(nm.iter().map(|l| {
                let x = (l - 550.0) / 200.0;
                0.01 + z * (1.2 - z) + 0.1 * z * x + 0.02 * z * z * x * x
            }));
        }
        let s = Separable::new(&nm, &values);
        assert!(s.rank <= 4);
        for (z, row) in s.basis.iter().enumerate() {
            for (l, c) in s.coefficients.iter().enumerate() {
                let got: f64 = (0..MAX_RANK).map(|k| row[k] * c[k]).sum();
                assert!((got - values[z * nm.len() + l]).abs() < 1e-6, "{z} {l}");
            }
        }
        let grey = Separable::new(&[550.0], &[0.5, 0.0, 2.0]);
        assert_eq!((grey.rank, grey.basis[0][0] * grey.coefficients[0][0]), (1, 0.5));
        assert_eq!(Separable::new(&[550.0], &[0.0, 0.0]).rank, 1);
    }
}
