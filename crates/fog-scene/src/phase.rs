//! Phase functions of the fog: how a scattering turns light.
//!
//! All take m = 1 − cos θ, with θ the angle between the directions of travel before and after: m = 0 is straight on.
//! Values are in 1/sr and normalised over the sphere.

use fog_core::diameter_choice::DiameterChoice;
use fog_core::droplet_table::{DropletTable, DropletView};
use fog_core::optics_table::{OpticsTable, OpticsTableParts, OpticsView};
use fog_core::phase::{HenyeyGreenstein, HgDraine};
use fog_core::phase_grid;
use fog_core::random::PathRng;
use fog_core::spectrum::{LaneWeights, Spectrum, Wavelengths};

/// A phase function, owned by the scene.
#[derive(Clone, Debug)]
pub enum Phase {
    /// The same everywhere.
    HenyeyGreenstein(HenyeyGreenstein),
    /// The same everywhere.
    HgDraine(HgDraine),
    /// Tabulated by altitude and wavelength: linear in both and in m between the nodes.
    Table(OpticsTable),
    /// Each scattering draws a droplet, which scatters by its own function.
    Droplets {
        /// Single droplets.
        table: DropletTable,
        /// Which of them scatters, over the same diameters and wavelengths.
        choice: DiameterChoice,
    },
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
    HenyeyGreenstein(HenyeyGreenstein),
    /// See [`Phase::HgDraine`].
    HgDraine(&'a HgDraine),
    /// See [`Phase::Table`].
    Table {
        /// The table.
        view: OpticsView<'a>,
        /// Its nodes.
        nodes: &'a PhaseNodes,
    },
    /// See [`Phase::Droplets`].
    Droplets {
        /// The table.
        view: DropletView<'a>,
        /// The choice among its rows.
        choice: &'a DiameterChoice,
        /// Nodes of the table.
        nodes: &'a PhaseNodes,
    },
}

/// What one scattering in the fog is by: the row of a table, and how the path's wavelengths see it.
#[derive(Clone, Copy, Debug)]
pub struct Scatterer {
    /// Row of the table; 0 where there is none.
    pub row: usize,
    /// Where the lanes fall between the wavelengths of the table.
    pub lanes: LaneWeights,
    /// Probability at each lane of meeting this scatterer rather than another, over that at the hero. A path's throughput
    /// and densities are to be multiplied by it.
    pub probability_ratio: Spectrum,
}

/// Mean cosines of a phase function by relative altitude and wavelength, linear in both.
#[derive(Clone, Debug, PartialEq)]
pub struct MeanCosines {
    zeta: Vec<f64>,
    nm: Vec<f64>,
    g: Vec<f64>,
}

impl MeanCosines {
    /// Wavelengths between which the mean cosine is linear, in nm, ascending.
    #[must_use]
    pub fn wavelengths_nm(&self) -> &[f64] {
        &self.nm
    }

    /// Mean cosine of a scattering at relative altitude `zeta`, clamped to the table.
    #[must_use]
    pub fn at(&self, zeta: f64, nm: f64) -> f64 {
        let ((z0, z1, tz), (l0, l1, tl)) = (between(&self.zeta, zeta), between(&self.nm, nm));
        let g = |z: usize, l: usize| self.g[z * self.nm.len() + l];
        let row = |z: usize| g(z, l0) + (g(z, l1) - g(z, l0)) * tl;
        row(z0) + (row(z1) - row(z0)) * tz
    }
}

/// Neighbours of `at` on an ascending axis, and the weight of the upper one, clamped to [0, 1].
fn between(axis: &[f64], at: f64) -> (usize, usize, f64) {
    if axis.len() == 1 {
        return (0, 0, 0.0);
    }
    let upper = axis.partition_point(|&x| x <= at).clamp(1, axis.len() - 1);
    let (a, b) = (axis[upper - 1], axis[upper]);
    (upper - 1, upper, ((at - a) / (b - a)).clamp(0.0, 1.0))
}

/// Rows of a table between which a scattering draws its own.
#[derive(Clone, Copy, Debug, Default)]
pub struct PhaseRows {
    /// Drawn with probability 1 − t.
    pub lower: usize,
    /// Drawn with probability t.
    pub upper: usize,
    /// In [0, 1].
    pub t: f32,
}

impl Phase {
    /// True if the phase function is linear interpolation between rows ([`PhaseView::rows`]).
    #[must_use]
    pub fn has_rows(&self) -> bool {
        !matches!(self, Self::Droplets { .. })
    }

    /// Resolves the tables.
    #[must_use]
    pub fn view<'a>(&'a self, nodes: &'a PhaseNodes) -> PhaseView<'a> {
        match self {
            Self::HenyeyGreenstein(hg) => PhaseView::HenyeyGreenstein(*hg),
            Self::HgDraine(mixture) => PhaseView::HgDraine(mixture),
            Self::Table(table) => PhaseView::Table { view: table.view(), nodes },
            Self::Droplets { table, choice } => PhaseView::Droplets { view: table.view(), choice, nodes },
        }
    }
}

impl Phase {
    /// Henyey–Greenstein functions of the mean cosine that is left at each altitude and wavelength when a share `straight` of
    /// the scatterings is taken for none, (g − f) / (1 − f): with extinction 1 − f as much, light spreads alike. `None` for
    /// single droplets, and where more than the share of g would go straight on.
    ///
    /// The scaling is that of Joseph, Wiscombe & Weinman, "The delta-Eddington approximation for radiative flux transfer",
    /// J. Atmos. Sci. 33, 1976.
    #[must_use]
    pub fn truncated(&self, straight: f64) -> Option<Self> {
        let left = |g: f64| {
            let rest = (g - straight) / (1.0 - straight);
            HenyeyGreenstein::new(rest).ok().filter(|_| rest >= 0.0)
        };
        let Self::Table(table) = self else {
            let cosines = self.view(&PhaseNodes::default()).mean_cosines()?;
            return left(cosines.at(0.0, 550.0)).map(Self::HenyeyGreenstein);
        };
        let nodes = PhaseNodes::default();
        let g = self.view(&nodes).mean_cosines()?.g;
        let functions: Vec<HenyeyGreenstein> = g.iter().map(|&g| left(g)).collect::<Option<_>>()?;
        let view = table.view();
        let parts = OpticsTableParts {
            zeta: view.zeta.to_vec(),
            wavelengths_nm: view.wavelengths_nm.to_vec(),
            c_ext_m2: view.c_ext_m2.to_vec(),
            c_sca_m2: view.c_sca_m2.to_vec(),
            g: functions.iter().map(|hg| hg.mean_cosine()).collect(),
            phase: functions.iter().flat_map(|hg| nodes.double.iter().map(|&m| hg.eval(m))).collect(),
        };
        OpticsTable::new(&parts).ok().map(Self::Table)
    }
}

impl PhaseView<'_> {
    /// Mean cosines by altitude and wavelength; `None` where single droplets scatter.
    #[must_use]
    pub fn mean_cosines(&self) -> Option<MeanCosines> {
        let same = |g: f64| MeanCosines { zeta: vec![0.0], nm: vec![550.0], g: vec![g] };
        match self {
            Self::HenyeyGreenstein(hg) => Some(same(hg.mean_cosine())),
            Self::HgDraine(mixture) => Some(same(mixture.mean_cosine())),
            Self::Table { view, nodes } => {
                let cell = |row: usize, column: usize| {
                    let p = |i: usize| f64::from(view.phase_node(row, column, i));
                    phase_grid::mean_cosine(&nodes.double, p) / phase_grid::integral(&nodes.double, p)
                };
                let (rows, columns) = (view.zeta.len(), view.wavelengths_nm.len());
                let g = (0..rows * columns).map(|k| cell(k / columns, k % columns)).collect();
                Some(MeanCosines { zeta: view.zeta.to_vec(), nm: view.wavelengths_nm.to_vec(), g })
            }
            Self::Droplets { .. } => None,
        }
    }

    /// Wavelengths of the table, in nm; one where nothing depends on the wavelength.
    fn wavelengths_nm(&self) -> &[f64] {
        match self {
            Self::HenyeyGreenstein(_) | Self::HgDraine(_) => &[550.0],
            Self::Table { view, .. } => view.wavelengths_nm,
            Self::Droplets { view, .. } => view.wavelengths_nm,
        }
    }

    /// Number of rows ([`Scatterer::row`]); one where there is no table.
    #[must_use]
    pub fn row_count(&self) -> usize {
        match self {
            Self::HenyeyGreenstein(_) | Self::HgDraine(_) => 1,
            Self::Table { view, .. } => view.zeta.len(),
            Self::Droplets { view, .. } => view.diameters_um.len(),
        }
    }

    /// Weights of the lanes between the table's wavelengths.
    #[must_use]
    pub fn lanes(&self, wavelengths: &Wavelengths) -> LaneWeights {
        LaneWeights::new(self.wavelengths_nm(), wavelengths)
    }

    /// True if all lanes have the same value.
    #[inline]
    #[must_use]
    pub fn is_grey(&self) -> bool {
        self.wavelengths_nm().len() == 1
    }

    /// What a scattering at relative altitude `zeta` is by, where `lanes` is where the path's wavelengths fall.
    #[inline]
    #[must_use]
    pub fn scatterer(&self, zeta: f32, lanes: &LaneWeights, rng: &mut PathRng) -> Scatterer {
        // Drawn whether or not there are altitudes to choose from: the same numbers follow with every phase function.
        let u = rng.uniform();
        let row = match self {
            Self::HenyeyGreenstein(_) | Self::HgDraine(_) => 0,
            Self::Table { view, .. } => view.phase_row(zeta, u),
            Self::Droplets { choice, .. } => {
                let (altitude, u, pick) = (choice.row(zeta, u), rng.uniform_f64(), rng.uniform());
                let drawn = choice.sample(altitude, lanes, u, pick);
                let (lanes, probability_ratio) = (drawn.lanes, drawn.probability_ratio);
                return Scatterer { row: drawn.row, lanes, probability_ratio };
            }
        };
        Scatterer { row, lanes: *lanes, probability_ratio: Spectrum::ONE }
    }

    /// Rows around relative altitude `zeta`; of single droplets none that are of use ([`Phase::has_rows`]).
    #[inline]
    #[must_use]
    pub fn rows(&self, zeta: f32) -> PhaseRows {
        match self {
            Self::Table { view, .. } => {
                let (lower, t) = view.phase_rows(zeta);
                PhaseRows { lower, upper: if t > 0.0 { lower + 1 } else { lower }, t }
            }
            _ => PhaseRows::default(),
        }
    }

    /// Value in 1/sr at all lanes between two rows: that of a scattering whichever row it draws.
    #[inline]
    #[must_use]
    pub fn eval_between(&self, rows: PhaseRows, m: f32, lanes: &LaneWeights) -> Spectrum {
        let lower = self.eval(rows.lower, m, lanes);
        if rows.t == 0.0 {
            return lower;
        }
        lower + (self.eval(rows.upper, m, lanes) - lower) * rows.t
    }

    /// Value in 1/sr at all lanes, of row `row` of the table (see [`Scatterer`]).
    #[inline]
    #[must_use]
    pub fn eval(&self, row: usize, m: f32, lanes: &LaneWeights) -> Spectrum {
        match self {
            Self::HenyeyGreenstein(hg) => Spectrum::splat(hg.eval_single(m)),
            Self::HgDraine(mixture) => Spectrum::splat(mixture.eval(f64::from(m)) as f32),
            Self::Table { view, nodes } => view.phase(row, m, &nodes.single, lanes),
            Self::Droplets { view, nodes, .. } => view.phase(row, m, &nodes.single, lanes),
        }
    }

    /// Samples m with density 2π · (value at lane 0), for `u` uniform in [0, 1) and `pick` uniform, which chooses between
    /// the hero's two neighbouring wavelengths of the table, or between the parts of a mixture.
    #[inline]
    #[must_use]
    pub fn sample(&self, row: usize, lanes: &LaneWeights, u: f64, pick: f32) -> f32 {
        let column = || {
            let lower = lanes.index[0] as usize;
            let column = if pick < lanes.weight[0] { lower + 1 } else { lower };
            column.min(self.wavelengths_nm().len() - 1)
        };
        match self {
            Self::HenyeyGreenstein(hg) => hg.sample(u) as f32,
            Self::HgDraine(mixture) => mixture.sample(u, f64::from(pick)) as f32,
            Self::Table { view, nodes } => view.sample_m(row, column(), u, &nodes.double),
            Self::Droplets { view, nodes, .. } => view.sample_m(row, column(), u, &nodes.double),
        }
    }
}
