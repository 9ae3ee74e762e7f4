//! The droplet table: cross sections and phase functions of single droplets by diameter and wavelength.
//!
//! Beside the [optics table](crate::optics_table), whose rows are mixtures, this one serves renderings that draw the very
//! droplet that scatters. It belongs to no fog: every spectrum over the same diameters can use it. Hundreds of diameters
//! make it large, so values are single precision and the cumulative functions keep every eighth node: 60 MB for 596
//! diameters and 18 wavelengths. The layout is one block of plain numbers that many processes can map.

use crate::math::PI;
use crate::optics_table::{MAX_COLUMNS, OpticsTableError};
use crate::phase_grid::{self, NODES};
use crate::phase_lookup::{eval_lanes, invert_linear};
use crate::shared_words::{self, SharedBytes, SharedWords};
use crate::spectrum::{LaneWeights, Spectrum};
use std::sync::Arc;

/// Intervals of the angular grid between two stored values of a cumulative function.
const STRIDE: usize = 8;
/// Stored values of a cumulative function, with both ends.
const SUMS: usize = (NODES - 1) / STRIDE + 1;
/// Most diameters of a table.
const MAX_DIAMETERS: usize = 65_536;
const MAGIC: u64 = u64::from_le_bytes(*b"fogdrops");
const VERSION: u64 = 1;
const HEADER: usize = 8;

/// What droplets of every diameter do at one wavelength.
#[derive(Clone, Debug, PartialEq)]
pub struct DropletColumn {
    /// Extinction cross section in m² by diameter.
    pub c_ext_m2: Vec<f64>,
    /// Scattering cross section in m² by diameter.
    pub c_sca_m2: Vec<f64>,
    /// Mean cosine from the Mie series by diameter.
    pub g: Vec<f64>,
    /// Phase function at [`phase_grid::nodes`] in any unit, \[diameter\]\[node\]; normalised by the table.
    pub phase: Vec<f64>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct Layout {
    diameters: usize,
    wavelengths: usize,
}

impl Layout {
    fn cells(self) -> usize {
        self.diameters * self.wavelengths
    }

    /// Words of each section, in order: axes and per-droplet numbers, sums over angles, phase (f32).
    fn sections(self) -> [usize; 3] {
        let cells = self.cells();
        [self.diameters + self.wavelengths + 3 * cells, cells * SUMS, (cells * NODES).div_ceil(2)]
    }

    fn words(self) -> usize {
        HEADER + self.sections().iter().sum::<usize>()
    }
}

/// Single droplets by (diameter, wavelength); cheap to clone.
#[derive(Clone)]
pub struct DropletTable {
    storage: SharedWords,
    layout: Layout,
}

impl core::fmt::Debug for DropletTable {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        write!(
            f,
            "DropletTable({} diameters × {} wavelengths)",
            self.layout.diameters, self.layout.wavelengths
        )
    }
}

impl DropletTable {
    /// Builds the table wavelength by wavelength, so that no more than one column in full precision is held at a time.
    /// `diameters_um` and `wavelengths_nm` ascend; `column(l)` gives the numbers at wavelength `l`.
    ///
    /// # Errors
    /// Those of `column`; or if an axis does not ascend, a length does not fit, or a value is negative or not finite.
    pub fn new<E: From<OpticsTableError>>(
        diameters_um: &[f64],
        wavelengths_nm: &[f64],
        mut column: impl FnMut(usize) -> Result<DropletColumn, E>,
    ) -> Result<Self, E> {
        let (d, w) = (diameters_um.len(), wavelengths_nm.len());
        check_axis("diameters_um", diameters_um, MAX_DIAMETERS)?;
        check_axis("wavelengths_nm", wavelengths_nm, MAX_COLUMNS)?;
        let layout = Layout { diameters: d, wavelengths: w };
        let mut words = vec![0u64; layout.words()];
        words[..6].copy_from_slice(&[MAGIC, VERSION, d as u64, w as u64, NODES as u64, STRIDE as u64]);
        let nodes = phase_grid::nodes();
        for l in 0..w {
            let values = column(l)?;
            check_column(&values, d)?;
            let [head, sums, phase] = sections_mut(&mut words, layout);
            head[..d].copy_from_slice(diameters_um);
            head[d..d + w].copy_from_slice(wavelengths_nm);
            for (k, section) in [&values.c_ext_m2, &values.c_sca_m2, &values.g].into_iter().enumerate() {
                for i in 0..d {
                    head[d + w + k * d * w + i * w + l] = section[i];
                }
            }
            let phase: &mut [f32] = bytemuck::cast_slice_mut(phase);
            for i in 0..d {
                let p = &values.phase[i * NODES..(i + 1) * NODES];
                let sums: &mut [f64] = &mut sums[(i * w + l) * SUMS..][..SUMS];
                fill_cell(&nodes, p, sums, |node, x| phase[(i * NODES + node) * w + l] = x)?;
            }
        }
        Ok(Self { storage: SharedWords::Owned(Arc::new(words)), layout })
    }

    /// Opens a table in bytes written by [`DropletTable::as_bytes`] that start at `offset`.
    ///
    /// # Errors
    /// If the bytes are no table of this version, are cut short, or are not aligned to 8 bytes.
    pub fn from_bytes(bytes: SharedBytes, offset: usize) -> Result<Self, OpticsTableError> {
        let all: &[u8] = (*bytes).as_ref();
        let data = all.get(offset..).unwrap_or(&[]);
        let size = |expected| OpticsTableError::Size { found: data.len(), expected };
        let word: [u64; HEADER] = shared_words::header(data).ok_or(size(HEADER * 8))?;
        let (diameters, wavelengths) = (word[2] as usize, word[3] as usize);
        if [word[0], word[1], word[4], word[5]] != [MAGIC, VERSION, NODES as u64, STRIDE as u64]
            || !(1..=MAX_DIAMETERS).contains(&diameters)
            || !(1..=MAX_COLUMNS).contains(&wavelengths)
        {
            return Err(OpticsTableError::Format);
        }
        let layout = Layout { diameters, wavelengths };
        let expected = layout.words() * 8;
        if data.len() != expected || !shared_words::aligned(data) {
            return Err(size(expected));
        }
        Ok(Self { storage: SharedWords::Shared { bytes, offset }, layout })
    }

    /// The whole table as bytes (native endianness; the cache's file name says which).
    #[must_use]
    pub fn as_bytes(&self) -> &[u8] {
        bytemuck::cast_slice(self.storage.get())
    }

    /// The sections as slices: take it once before a loop.
    #[must_use]
    pub fn view(&self) -> DropletView<'_> {
        let (d, w, cells) = (self.layout.diameters, self.layout.wavelengths, self.layout.cells());
        let [head, sums, _] = self.layout.sections();
        let (head, rest) = self.storage.get()[HEADER..].split_at(head);
        let (sums, phase) = rest.split_at(sums);
        let (diameters_um, head) = bytemuck::cast_slice::<u64, f64>(head).split_at(d);
        let (wavelengths_nm, head) = head.split_at(w);
        DropletView {
            diameters_um,
            wavelengths_nm,
            c_ext_m2: &head[..cells],
            c_sca_m2: &head[cells..2 * cells],
            g: &head[2 * cells..],
            sums: bytemuck::cast_slice(sums),
            phase: &bytemuck::cast_slice(phase)[..cells * NODES],
        }
    }
}

/// The sections of a new table, all as f64 words.
fn sections_mut(words: &mut [u64], layout: Layout) -> [&mut [f64]; 3] {
    let [head, sums, _] = layout.sections();
    let (head, rest) = words[HEADER..].split_at_mut(head);
    let (sums, phase) = rest.split_at_mut(sums);
    [head, sums, phase].map(bytemuck::cast_slice_mut)
}

/// Normalises in f64, rounds to the f32 that will be looked up, and sums what was rounded.
fn fill_cell(
    nodes: &[f64],
    p: &[f64],
    sums: &mut [f64],
    mut store: impl FnMut(usize, f32),
) -> Result<(), OpticsTableError> {
    let norm = phase_grid::integral(nodes, |i| p[i]);
    if norm.is_nan() || norm <= 0.0 {
        return Err(OpticsTableError::Value(format!("a droplet's phase function has integral {norm}")));
    }
    let (mut sum, mut below) = (0.0, 0.0);
    for i in 0..NODES {
        let x = (p[i] / norm) as f32;
        if i > 0 {
            sum += mass(nodes, i - 1, below, f64::from(x));
        }
        if i.is_multiple_of(STRIDE) {
            sums[i / STRIDE] = sum;
        }
        store(i, x);
        below = f64::from(x);
    }
    Ok(())
}

/// Share of the light in interval `i` of the grid, over which the phase function runs linearly from `a` to `b`.
#[inline(always)]
fn mass(nodes: &[f64], i: usize, a: f64, b: f64) -> f64 {
    PI * (a + b) * (nodes[i + 1] - nodes[i])
}

fn check_axis(name: &str, axis: &[f64], most: usize) -> Result<(), OpticsTableError> {
    if axis.is_empty() || axis.len() > most || axis.windows(2).any(|w| w[0].is_nan() || w[0] >= w[1]) {
        return Err(OpticsTableError::Value(format!("{name} must have 1 to {most} ascending values")));
    }
    Ok(())
}

fn check_column(column: &DropletColumn, d: usize) -> Result<(), OpticsTableError> {
    for (name, values, len, low) in [
        ("c_ext_m2", &column.c_ext_m2, d, 0.0),
        ("c_sca_m2", &column.c_sca_m2, d, 0.0),
        ("g", &column.g, d, -1.0),
        ("phase", &column.phase, d * NODES, 0.0),
    ] {
        if values.len() != len {
            let problem = format!("{name} has {} values instead of {len}", values.len());
            return Err(OpticsTableError::Value(problem));
        }
        if values.iter().any(|x| !x.is_finite() || *x < low) {
            return Err(OpticsTableError::Value(format!(
                "{name} has a value that is negative or not finite"
            )));
        }
    }
    Ok(())
}

/// Borrowed sections of a [`DropletTable`].
#[derive(Clone, Copy, Debug)]
pub struct DropletView<'a> {
    /// Diameters in µm, ascending.
    pub diameters_um: &'a [f64],
    /// Wavelengths in nm, ascending.
    pub wavelengths_nm: &'a [f64],
    /// Extinction cross section in m², \[diameter\]\[λ\].
    pub c_ext_m2: &'a [f64],
    /// Scattering cross section in m², \[diameter\]\[λ\].
    pub c_sca_m2: &'a [f64],
    /// Mean cosine from the Mie series, \[diameter\]\[λ\].
    pub g: &'a [f64],
    /// Light scattered up to every eighth node, \[diameter\]\[λ\]\[sum\].
    sums: &'a [f64],
    /// \[diameter\]\[node\]\[λ\].
    phase: &'a [f32],
}

impl DropletView<'_> {
    /// Phase function of diameter row `row` in 1/sr at all lanes, for m = 1 − cos θ.
    #[inline]
    #[must_use]
    pub fn phase(&self, row: usize, m: f32, nodes: &[f32], lanes: &LaneWeights) -> Spectrum {
        eval_lanes(self.phase, self.wavelengths_nm.len(), row, m, nodes, lanes)
    }

    /// Value at node `node` of the phase function of (diameter row, λ row), in 1/sr.
    #[inline]
    #[must_use]
    pub fn phase_node(&self, row: usize, wavelength_row: usize, node: usize) -> f32 {
        self.phase[(row * NODES + node) * self.wavelengths_nm.len() + wavelength_row]
    }

    /// Samples m = 1 − cos θ from the phase function of (diameter row, λ row) for uniform `u` in [0, 1), by inversion in
    /// f64: the stored sums find eight intervals, adding up finds one of them.
    #[inline]
    #[must_use]
    pub fn sample_m(&self, row: usize, wavelength_row: usize, u: f64, nodes: &[f64]) -> f32 {
        let cell = row * self.wavelengths_nm.len() + wavelength_row;
        let sums = &self.sums[cell * SUMS..(cell + 1) * SUMS];
        let target = u * sums[SUMS - 1];
        let block = sums.partition_point(|&s| s <= target).clamp(1, SUMS - 1) - 1;
        let (mut i, last) = (block * STRIDE, (block + 1) * STRIDE - 1);
        let mut rest = target - sums[block];
        let mut p0 = f64::from(self.phase_node(row, wavelength_row, i));
        loop {
            let p1 = f64::from(self.phase_node(row, wavelength_row, i + 1));
            let here = mass(nodes, i, p0, p1);
            if rest < here || i == last {
                let fraction = if here > 0.0 { (rest / here).clamp(0.0, 1.0) } else { 0.0 };
                let t = invert_linear(p0, p1, fraction);
                return (nodes[i] + t * (nodes[i + 1] - nodes[i])) as f32;
            }
            rest -= here;
            p0 = p1;
            i += 1;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::phase::HenyeyGreenstein;

    const G: [[f64; 2]; 3] = [[0.1, 0.3], [0.6, 0.8], [0.9, 0.97]];

    fn table() -> DropletTable {
        let nodes = phase_grid::nodes();
        let new = DropletTable::new(&[1.0, 5.0, 20.0], &[400.0, 700.0], |l| {
            let hg = |i: usize| HenyeyGreenstein::new(G[i][l]).unwrap();
            Ok::<_, OpticsTableError>(DropletColumn {
                c_ext_m2: vec![1.0, 2.0, 3.0],
                c_sca_m2: vec![1.0, 2.0, 3.0 - l as f64],
                g: (0..3).map(|i| G[i][l]).collect(),
                phase: (0..3).flat_map(|i| nodes.iter().map(move |&m| 7.0 * hg(i).eval(m))).collect(),
            })
        });
        new.unwrap()
    }

    #[test]
    fn bytes_round_trip_and_damage_is_seen() {
        struct Aligned(Vec<u64>);
        impl AsRef<[u8]> for Aligned {
            fn as_ref(&self) -> &[u8] {
                bytemuck::cast_slice(&self.0)
            }
        }
        let table = table();
        let words: Vec<u64> = bytemuck::cast_slice(table.as_bytes()).to_vec();
        let open = |w: Vec<u64>| DropletTable::from_bytes(Arc::new(Aligned(w)), 0);
        assert_eq!(open(words.clone()).unwrap().as_bytes(), table.as_bytes());
        assert!(matches!(open(words[1..].to_vec()), Err(OpticsTableError::Format)));
        assert!(matches!(open(words[..words.len() - 1].to_vec()), Err(OpticsTableError::Size { .. })));
        assert!(open(vec![]).is_err());
    }

    #[test]
    fn values_and_samples_are_those_of_the_droplets() {
        let table = table();
        let (view, nodes) = (table.view(), phase_grid::nodes());
        assert_eq!((view.c_sca_m2[5], view.g[4], view.diameters_um[2]), (2.0, 0.9, 20.0));
        for (d, row) in G.iter().enumerate() {
            for (l, &g) in row.iter().enumerate() {
                let hg = HenyeyGreenstein::new(g).unwrap();
                for node in [0, 100, 700, NODES - 1] {
                    let ratio = f64::from(view.phase_node(d, l, node)) / hg.eval(nodes[node]);
                    assert!((ratio - 1.0).abs() < 1e-4, "{d} {l} {node}: {ratio}");
                }
                let n = 100_000;
                let m = |k: i32| f64::from(view.sample_m(d, l, (f64::from(k) + 0.5) / f64::from(n), &nodes));
                let exact = phase_grid::mean_cosine(&nodes, |i| f64::from(view.phase_node(d, l, i)));
                let mean = (0..n).map(|k| 1.0 - m(k)).sum::<f64>() / f64::from(n);
                assert!((mean - exact).abs() < 1e-5, "{d} {l}: {mean} {exact}");
                assert!((1..n).all(|k| m(k) >= m(k - 1)), "monotone");
            }
        }
    }

    #[test]
    fn bad_columns_are_refused() {
        let column =
            DropletColumn { c_ext_m2: vec![1.0], c_sca_m2: vec![1.0], g: vec![0.5], phase: vec![1.0; NODES] };
        let build = |d: &[f64], c: &DropletColumn| {
            DropletTable::new(d, &[550.0], |_| Ok::<_, OpticsTableError>(c.clone())).map(|_| ())
        };
        assert_eq!(build(&[1.0], &column), Ok(()));
        assert!(build(&[], &column).is_err() && build(&[2.0, 1.0], &column).is_err());
        assert!(build(&[1.0, 2.0], &column).is_err(), "too few values");
        for bad in [
            DropletColumn { c_sca_m2: vec![-1.0], ..column.clone() },
            DropletColumn { phase: vec![f64::NAN; NODES], ..column.clone() },
            DropletColumn { phase: vec![0.0; NODES], ..column },
        ] {
            assert!(build(&[1.0], &bad).is_err());
        }
    }
}
