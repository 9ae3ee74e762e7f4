//! Phase functions of the fog: how a scattering turns light.
//!
//! All take m = 1 − cos θ, with θ the angle between the directions of travel before and after: m = 0 is straight on.
//! Values are in 1/sr and normalised over the sphere.

use fog_core::math::INV_PI_F32;
use fog_core::optics_table::{OpticsTable, OpticsView};
use fog_core::phase_grid;
use fog_core::spectrum::{LaneWeights, Spectrum, Wavelengths};

/// A phase function, owned by the scene.
#[derive(Clone, Debug)]
pub enum Phase {
    /// Henyey & Greenstein (1941) with mean cosine `g` in (−1, 1), the same everywhere.
    HenyeyGreenstein {
        /// Mean cosine.
        g: f32,
    },
    /// Tabulated by altitude and wavelength: linear in both and in m between the nodes.
    Table(OpticsTable),
}

/// Nodes of the tabulated phase functions in both precisions.
#[derive(Clone, Debug)]
pub struct PhaseNodes {
    single: Vec<f32>,
    double: Vec<f64>,
}

impl Default for PhaseNodes {
    fn default() -> Self {
        let double = phase_grid::nodes();
        Self { single: double.iter().map(|&m| m as f32).collect(), double }
    }
}

/// [`Phase`] with its tables resolved to slices, for a loop over paths.
#[derive(Clone, Copy, Debug)]
pub enum PhaseView<'a> {
    /// See [`Phase::HenyeyGreenstein`].
    HenyeyGreenstein {
        /// Mean cosine.
        g: f32,
    },
    /// See [`Phase::Table`].
    Table {
        /// The table.
        view: OpticsView<'a>,
        /// Its nodes.
        nodes: &'a PhaseNodes,
    },
}

impl Phase {
    /// Resolves the tables.
    #[must_use]
    pub fn view<'a>(&'a self, nodes: &'a PhaseNodes) -> PhaseView<'a> {
        match self {
            Self::HenyeyGreenstein { g } => PhaseView::HenyeyGreenstein { g: *g },
            Self::Table(table) => PhaseView::Table { view: table.view(), nodes },
        }
    }
}

/// Henyey–Greenstein in 1/sr; the denominator is written in m, which keeps its precision near forward.
#[inline(always)]
fn henyey_greenstein(g: f32, m: f32) -> f32 {
    let d = (1.0 - g) * (1.0 - g) + 2.0 * g * m;
    (1.0 - g * g) * 0.25 * INV_PI_F32 / (d * d.sqrt())
}

impl PhaseView<'_> {
    /// Weights of the lanes between the table's wavelengths.
    #[must_use]
    pub fn lanes(&self, wavelengths: &Wavelengths) -> LaneWeights {
        match self {
            Self::HenyeyGreenstein { .. } => LaneWeights::new(&[550.0], wavelengths),
            Self::Table { view, .. } => LaneWeights::new(view.wavelengths_nm, wavelengths),
        }
    }

    /// True if all lanes have the same value.
    #[inline]
    #[must_use]
    pub fn is_grey(&self) -> bool {
        match self {
            Self::HenyeyGreenstein { .. } => true,
            Self::Table { view, .. } => view.wavelengths_nm.len() == 1,
        }
    }

    /// The table's row for a scattering at relative altitude `zeta`; `u` uniform in [0, 1).
    #[inline]
    #[must_use]
    pub fn row(&self, zeta: f32, u: f32) -> usize {
        match self {
            Self::HenyeyGreenstein { .. } => 0,
            Self::Table { view, .. } => view.phase_row(zeta, u),
        }
    }

    /// Value in 1/sr at all lanes.
    #[inline]
    #[must_use]
    pub fn eval(&self, row: usize, m: f32, lanes: &LaneWeights) -> Spectrum {
        match self {
            Self::HenyeyGreenstein { g } => Spectrum::splat(henyey_greenstein(*g, m)),
            Self::Table { view, nodes } => view.phase(row, m, &nodes.single, lanes),
        }
    }

    /// Samples m with density 2π · (value at lane 0), for `u` uniform in [0, 1) and `pick` uniform, which chooses between
    /// the hero's two neighbouring wavelengths of the table.
    #[inline]
    #[must_use]
    pub fn sample(&self, row: usize, lanes: &LaneWeights, u: f64, pick: f32) -> f32 {
        match self {
            Self::HenyeyGreenstein { g } => {
                let g = f64::from(*g);
                if g.abs() < 1e-6 {
                    // First order in g, where the closed form loses its digits.
                    return (2.0 * u - 6.0 * g * u * (1.0 - u)).clamp(0.0, 2.0) as f32;
                }
                // Mirrored in u, so that u = 0 is forward as in the tables.
                let s = (1.0 - g * g) / (1.0 + g - 2.0 * g * u);
                (1.0 - (1.0 + g * g - s * s) / (2.0 * g)).clamp(0.0, 2.0) as f32
            }
            Self::Table { view, nodes } => {
                let lower = lanes.index[0] as usize;
                let column = if pick < lanes.weight[0] { lower + 1 } else { lower };
                view.sample_m(row, column.min(view.wavelengths_nm.len() - 1), u, &nodes.double)
            }
        }
    }
}
