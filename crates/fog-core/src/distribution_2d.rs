//! Cells of a grid drawn in proportion to their weights.

/// Probabilities of the cells of a grid: a row is drawn, then a column in it, both by inversion.
#[derive(Clone, Debug)]
pub struct Distribution2d {
    columns: usize,
    /// Probability of the rows before, of all rows and the end.
    rows_before: Vec<f64>,
    /// Probability of the columns before, given the row: `columns + 1` values of each row.
    columns_before: Vec<f64>,
}

/// A drawn cell, and where in it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CellSample {
    /// Row and column.
    pub cell: [usize; 2],
    /// Uniform in [0, 1)², along row and column.
    pub inside: [f64; 2],
}

impl Distribution2d {
    /// Cells of these weights (finite, 0 or more), row by row; `None` if they are all 0 or do not fill whole rows.
    #[must_use]
    pub fn new(columns: usize, weights: &[f64]) -> Option<Self> {
        if columns == 0 || weights.is_empty() || !weights.len().is_multiple_of(columns) {
            return None;
        }
        let mut columns_before = Vec::with_capacity((columns + 1) * weights.len() / columns);
        let mut row_weights = Vec::with_capacity(weights.len() / columns);
        for row in weights.chunks_exact(columns) {
            row_weights.push(row.iter().sum());
            columns_before.extend(cumulative(row));
        }
        let total: f64 = row_weights.iter().sum();
        (total > 0.0 && total.is_finite()).then(|| Self {
            columns,
            rows_before: cumulative(&row_weights),
            columns_before,
        })
    }

    /// Draws a cell from two uniform numbers.
    #[inline]
    #[must_use]
    pub fn sample(&self, u: [f64; 2]) -> CellSample {
        let (row, v) = invert(&self.rows_before, u[0]);
        let (column, w) = invert(self.columns_of(row), u[1]);
        CellSample { cell: [row, column], inside: [v, w] }
    }

    /// Probability of a cell.
    #[inline]
    #[must_use]
    pub fn probability(&self, [row, column]: [usize; 2]) -> f64 {
        let columns = self.columns_of(row);
        (self.rows_before[row + 1] - self.rows_before[row]) * (columns[column + 1] - columns[column])
    }

    fn columns_of(&self, row: usize) -> &[f64] {
        let stride = self.columns + 1;
        &self.columns_before[row * stride..(row + 1) * stride]
    }
}

/// Share of the weight before each element, and 1; even where there is no weight.
fn cumulative(weights: &[f64]) -> Vec<f64> {
    let total: f64 = weights.iter().sum();
    let mut sum = 0.0;
    let mut before = Vec::with_capacity(weights.len() + 1);
    for (i, w) in weights.iter().enumerate() {
        before.push(if total > 0.0 { sum / total } else { i as f64 / weights.len() as f64 });
        sum += w;
    }
    before.push(1.0);
    before
}

/// The element whose share of [0, 1) has `u` in it, and where in it.
#[inline]
fn invert(before: &[f64], u: f64) -> (usize, f64) {
    let i = before.partition_point(|&b| b <= u).clamp(1, before.len() - 1) - 1;
    let width = before[i + 1] - before[i];
    let inside = if width > 0.0 { (u - before[i]) / width } else { 0.0 };
    (i, inside.clamp(0.0, 1.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_are_drawn_by_their_weights() {
        let weights = [0.0, 1.0, 3.0, 0.0, 0.0, 0.0, 2.0, 0.0, 2.0];
        let d = Distribution2d::new(3, &weights).unwrap();
        let n = 400;
        let mut counts = [0.0; 9];
        for i in 0..n * n {
            let u = [(f64::from(i / n) + 0.5) / f64::from(n), (f64::from(i % n) + 0.5) / f64::from(n)];
            let CellSample { cell: [r, c], inside } = d.sample(u);
            assert!(inside.iter().all(|x| (0.0..1.0).contains(x)));
            counts[3 * r + c] += 1.0 / f64::from(n * n);
        }
        for (cell, w) in weights.iter().enumerate() {
            assert!((d.probability([cell / 3, cell % 3]) - w / 8.0).abs() < 1e-12);
            assert!((counts[cell] - w / 8.0).abs() < 2e-3, "cell {cell}: {}", counts[cell]);
        }
    }

    #[test]
    fn no_weight_is_no_distribution() {
        assert!(Distribution2d::new(2, &[0.0, 0.0]).is_none());
        assert!(Distribution2d::new(2, &[1.0, 0.0, 1.0]).is_none());
        assert!(Distribution2d::new(0, &[]).is_none());
    }
}
