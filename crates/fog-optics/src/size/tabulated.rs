//! Spectra given by numbers: density at diameters, or counts in bins.

use super::refused;
use crate::distribution::DiameterGrid;
use crate::error::OpticsError;

/// Diameters of a table, least and greatest, in µm.
pub(crate) const RANGE_UM: [f64; 2] = [1e-3, 5e3];
/// Widest step in µm of the grid that sums run over.
const STEP_UM: f64 = 0.1;
/// Fewest steps, and most, of that grid.
const STEPS: [f64; 2] = [300.0, 2000.0];

/// A density over diameters that ascend.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Tabulated {
    /// Linear between (diameter in µm, density).
    Linear(Vec<(f64, f64)>),
    /// (Upper edge in µm, density below it): even from the edge before; the first density is not used.
    Steps(Vec<(f64, f64)>),
}

impl Tabulated {
    pub(super) fn linear(rows: &[(f64, f64)]) -> Result<Self, OpticsError> {
        check(rows)?;
        Ok(Self::Linear(rows.to_vec()))
    }

    pub(super) fn steps(edges_um: &[f64], counts: &[f64]) -> Result<Self, OpticsError> {
        if edges_um.len() != counts.len() + 1 {
            let (edges, bins) = (edges_um.len(), counts.len());
            return Err(refused(format!("{edges} edges for {bins} bins; valid: one more edge than bins")));
        }
        let mut rows = vec![(edges_um[0], 0.0)];
        for (edges, count) in edges_um.windows(2).zip(counts) {
            rows.push((edges[1], count / (edges[1] - edges[0])));
        }
        check(&rows)?;
        Ok(Self::Steps(rows))
    }

    /// Density within the table, in its own unit; at an edge between two bins the mean of both.
    pub(super) fn density_1_um(&self, d_um: f64) -> f64 {
        match self {
            Self::Linear(rows) => {
                let i = rows.partition_point(|r| r.0 <= d_um).clamp(1, rows.len() - 1);
                let ((d0, n0), (d1, n1)) = (rows[i - 1], rows[i]);
                n0 + (n1 - n0) * ((d_um - d0) / (d1 - d0)).clamp(0.0, 1.0)
            }
            Self::Steps(rows) => {
                let i = rows.partition_point(|r| r.0 < d_um).clamp(1, rows.len() - 1);
                let (edge, density) = rows[i];
                if edge == d_um && i + 1 < rows.len() { 0.5 * (density + rows[i + 1].1) } else { density }
            }
        }
    }

    pub(super) fn scaled(self, factor: f64) -> Self {
        let scale = |rows: Vec<(f64, f64)>| rows.iter().map(|&(d, n)| (d, n * factor)).collect();
        match self {
            Self::Linear(rows) => Self::Linear(scale(rows)),
            Self::Steps(rows) => Self::Steps(scale(rows)),
        }
    }

    /// Steps of at most 0.1 µm, at least 300 and at most 2000 of them; equal ratios where that is too few steps.
    pub(super) fn grid(&self) -> Result<DiameterGrid, OpticsError> {
        let (Self::Linear(rows) | Self::Steps(rows)) = self;
        let (low, high) = (rows[0].0, rows[rows.len() - 1].0);
        let step = STEP_UM.min((high - low) / STEPS[0]);
        if (high - low) / step <= STEPS[1] {
            DiameterGrid::covering(low, high, step)
        } else {
            DiameterGrid::geometric(low, high, STEPS[1] as usize + 1)
        }
    }
}

fn check(rows: &[(f64, f64)]) -> Result<(), OpticsError> {
    if rows.len() < 2 {
        return Err(refused(format!("{} diameters; valid: at least 2", rows.len())));
    }
    for (i, &(d, n)) in rows.iter().enumerate() {
        if !(RANGE_UM[0]..=RANGE_UM[1]).contains(&d) {
            let [low, high] = RANGE_UM;
            return Err(refused(format!("diameter {d} µm; valid: {low} to {high} µm")));
        }
        if i > 0 && d <= rows[i - 1].0 {
            return Err(refused(format!("diameter {d} µm follows {} µm; valid: ascending", rows[i - 1].0)));
        }
        if !(n.is_finite() && n >= 0.0) {
            return Err(refused(format!("density {n} at {d} µm; valid: 0 or more, finite")));
        }
    }
    Ok(())
}
