//! Every phase function of this crate behind one type: value, density, samples and mean cosine.

use crate::advection::AdvectionModel;
use crate::error::{OpticsError, check_range};
use crate::{jendersie_deon, mean_diameter};
use fog_core::optics_table::OpticsTable;
use fog_core::phase::{HenyeyGreenstein, HgDraine};
use fog_core::phase_grid::{self, NODES};
use std::sync::Arc;

/// A phase function at one altitude and wavelength. All kinds take m = 1 − cos θ in [0, 2], with θ the angle by which
/// light is turned; values are in 1/sr and integrate to 1 over the sphere.
///
/// ```
/// use fog_optics::phase_function::PhaseFunction;
/// let p = PhaseFunction::jendersie_deon(12.0)?;
/// let m = p.sample(0.3, 0.8);
/// assert!(p.eval(m) > 0.0 && p.pdf(m) == p.eval(m));
/// assert!((p.mean_cosine() - 0.869).abs() < 1e-3);
/// # Ok::<(), fog_optics::error::OpticsError>(())
/// ```
#[derive(Clone, Debug)]
pub enum PhaseFunction {
    /// Henyey & Greenstein 1941.
    HenyeyGreenstein(HenyeyGreenstein),
    /// Mie scattering: a row of an optics table.
    MieTable(MieTable),
    /// Henyey–Greenstein and Draine's function, such as Jendersie & d'Eon's fit.
    HgDraine(HgDraine),
}

/// One altitude's row of an optics table, between its wavelengths.
#[derive(Clone, Debug)]
pub struct MieTable {
    table: OpticsTable,
    row: usize,
    /// Wavelength rows below and above, and the weight of the upper.
    columns: [usize; 2],
    upper_weight: f64,
    nodes: Arc<[f64]>,
}

impl PhaseFunction {
    /// Henyey–Greenstein with mean cosine `g`.
    ///
    /// # Errors
    /// Unless −1 < g < 1.
    pub fn henyey_greenstein(g: f64) -> Result<Self, OpticsError> {
        Ok(Self::HenyeyGreenstein(HenyeyGreenstein::new(g)?))
    }

    /// Row `row` of `table` at a wavelength in nm: polydisperse Mie of the table's altitude `row`, or whatever its rows
    /// are. Linear in m between the angles of [`phase_grid`] and linear in the wavelength, as the renderer sees it. A table
    /// of one wavelength serves every wavelength.
    ///
    /// # Errors
    /// If there is no such row, or the wavelength is outside the table.
    pub fn mie(table: &OpticsTable, row: usize, wavelength_nm: f64) -> Result<Self, OpticsError> {
        let view = table.view();
        let (rows, w) = (view.zeta.len(), view.wavelengths_nm);
        check_range("row of the optics table", row as f64, 0.0, (rows - 1) as f64)?;
        let (mut columns, mut upper_weight) = ([0, 0], 0.0);
        if w.len() > 1 {
            check_range("wavelength_nm", wavelength_nm, w[0], w[w.len() - 1])?;
            let upper = w.partition_point(|&nm| nm <= wavelength_nm).clamp(1, w.len() - 1);
            columns = [upper - 1, upper];
            upper_weight = (wavelength_nm - w[upper - 1]) / (w[upper] - w[upper - 1]);
        }
        let nodes = phase_grid::nodes().into();
        Ok(Self::MieTable(MieTable { table: table.clone(), row, columns, upper_weight, nodes }))
    }

    /// The paper's: Mie at the mean diameter of `model`'s droplets, tabulated at whole degrees
    /// ([`mean_diameter::mean_diameter_table`]).
    ///
    /// # Errors
    /// If the wavelength (nm) is outside the table of water.
    pub fn mean_diameter(model: &AdvectionModel, wavelength_nm: f64) -> Result<Self, OpticsError> {
        Self::mie(&mean_diameter::mean_diameter_table(model, wavelength_nm)?, 0, wavelength_nm)
    }

    /// Jendersie & d'Eon's fit for droplets of a diameter in µm.
    ///
    /// # Errors
    /// Unless 0 < `diameter_um` ≤ 50.
    pub fn jendersie_deon(diameter_um: f64) -> Result<Self, OpticsError> {
        Ok(Self::HgDraine(jendersie_deon::phase_function(diameter_um)?))
    }

    /// Value in 1/sr.
    #[must_use]
    pub fn eval(&self, m: f64) -> f64 {
        match self {
            Self::HenyeyGreenstein(p) => p.eval(m),
            Self::MieTable(p) => p.eval(m),
            Self::HgDraine(p) => p.eval(m),
        }
    }

    /// Density of [`PhaseFunction::sample`] in 1/sr: the value itself.
    #[must_use]
    pub fn pdf(&self, m: f64) -> f64 {
        self.eval(m)
    }

    /// Samples m for `u` and `pick`, uniform in [0, 1): `u` is inverted; `pick` chooses between the parts of a mixture or
    /// the neighbouring wavelengths of a table, and is not used by the others.
    #[must_use]
    pub fn sample(&self, u: f64, pick: f64) -> f64 {
        match self {
            Self::HenyeyGreenstein(p) => p.sample(u),
            Self::MieTable(p) => p.sample(u, pick),
            Self::HgDraine(p) => p.sample(u, pick),
        }
    }

    /// Mean cosine of the scattering angle; of a table, that of what is tabulated (its `g` is that of the Mie series).
    #[must_use]
    pub fn mean_cosine(&self) -> f64 {
        match self {
            Self::HenyeyGreenstein(p) => p.mean_cosine(),
            Self::MieTable(p) => p.mix(|column| {
                let view = p.table.view();
                phase_grid::mean_cosine(&p.nodes, |i| f64::from(view.phase_node(p.row, column, i)))
            }),
            Self::HgDraine(p) => p.mean_cosine(),
        }
    }
}

impl MieTable {
    /// Interpolates between the two wavelengths.
    fn mix(&self, f: impl Fn(usize) -> f64) -> f64 {
        let [low, high] = self.columns.map(f);
        low + (high - low) * self.upper_weight
    }

    fn eval(&self, m: f64) -> f64 {
        let m = m.clamp(0.0, 2.0);
        let i = self.nodes.partition_point(|&x| x <= m).clamp(1, NODES - 1) - 1;
        let t = (m - self.nodes[i]) / (self.nodes[i + 1] - self.nodes[i]);
        let view = self.table.view();
        self.mix(|column| {
            let [a, b] = [i, i + 1].map(|node| f64::from(view.phase_node(self.row, column, node)));
            a + (b - a) * t
        })
    }

    fn sample(&self, u: f64, pick: f64) -> f64 {
        let column = self.columns[usize::from(pick < self.upper_weight)];
        f64::from(self.table.view().sample_m(self.row, column, u, &self.nodes))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::table::{TableSettings, build_table};

    #[test]
    fn rows_and_wavelengths_are_checked() {
        let model = AdvectionModel::arcata().unwrap();
        let settings = TableSettings {
            zeta: vec![0.2, 0.8],
            wavelengths_nm: vec![500.0, 600.0],
            diameters: crate::distribution::DiameterGrid::new(1.0, 3.0, 0.5).unwrap(),
        };
        let table = build_table(&model, &settings, &|_| ()).unwrap();
        assert!(PhaseFunction::mie(&table, 2, 550.0).is_err());
        assert!(
            PhaseFunction::mie(&table, 0, 499.0).is_err() && PhaseFunction::mie(&table, 0, f64::NAN).is_err()
        );
        assert!(
            PhaseFunction::henyey_greenstein(1.0).is_err() && PhaseFunction::jendersie_deon(60.0).is_err()
        );
        // Halfway between two wavelengths is the mean of both.
        let p = |nm: f64| PhaseFunction::mie(&table, 1, nm).unwrap();
        for m in [0.0, 1e-3, 0.5, 2.0] {
            let want = 0.5 * (p(500.0).eval(m) + p(600.0).eval(m));
            assert!((p(550.0).eval(m) / want - 1.0).abs() < 1e-12, "{m}");
        }
        let mean = 0.5 * (p(500.0).mean_cosine() + p(600.0).mean_cosine());
        assert!((p(550.0).mean_cosine() - mean).abs() < 1e-12);
    }
}
