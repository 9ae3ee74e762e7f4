//! The optics table: where `fog-optics` and `fog-scene` meet.
//!
//! Cross sections per droplet and phase functions by relative altitude ζ and wavelength. The shape of the droplet spectrum
//! depends on ζ alone, so one table serves every fog height and every number density: σ(z, λ) = N(z) · C(ζ, λ).
//! The layout is one block of plain numbers that can be written to a file and mapped back by many processes.

use crate::math::PI;
use crate::phase_grid::{self, NODES};
use crate::phase_lookup::{eval_lanes, interpolating_row, invert_linear, rows_around};
pub use crate::shared_words::SharedBytes;
use crate::shared_words::{self, SharedWords};
use crate::spectrum::{LaneWeights, Spectrum};
use std::sync::Arc;

/// Entries of the guide table that starts a phase function's inversion.
pub const GUIDE: usize = 256;
/// Most wavelengths of a table.
pub const MAX_COLUMNS: usize = 64;
const MAGIC: u64 = u64::from_le_bytes(*b"fogoptic");
const VERSION: u64 = 1;
const HEADER: usize = 8;

/// What is wrong with a block of bytes that should be an optics table, or with the values for one.
#[derive(Debug, thiserror::Error, PartialEq, Eq)]
pub enum OpticsTableError {
    /// The bytes do not start with the magic number and version of this code.
    #[error("not an optics table of version {VERSION}")]
    Format,
    /// The block is shorter or longer than its header says, or not aligned to 8 bytes.
    #[error("optics table is truncated or misaligned: {found} bytes, expected {expected}")]
    Size {
        /// Bytes found.
        found: usize,
        /// Bytes that the header asks for.
        expected: usize,
    },
    /// Axes must be ascending and values finite and non-negative.
    #[error("optics table: {0}")]
    Value(String),
}

/// Cross sections and phase functions by (ζ, λ); cheap to clone.
#[derive(Clone)]
pub struct OpticsTable {
    storage: SharedWords,
    layout: Layout,
}

impl core::fmt::Debug for OpticsTable {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        write!(f, "OpticsTable({} altitudes × {} wavelengths)", self.layout.zetas, self.layout.wavelengths)
    }
}

/// Values for a new table; row-major with ζ outermost.
#[derive(Clone, Debug, PartialEq)]
pub struct OpticsTableParts {
    /// Relative altitudes z/H in [0, 1], ascending; one row is valid at all altitudes.
    pub zeta: Vec<f64>,
    /// Wavelengths in nm, ascending; one is valid for all.
    pub wavelengths_nm: Vec<f64>,
    /// Mean extinction cross section per droplet in m², \[ζ\]\[λ\].
    pub c_ext_m2: Vec<f64>,
    /// Mean scattering cross section per droplet in m², \[ζ\]\[λ\].
    pub c_sca_m2: Vec<f64>,
    /// Mean cosine from the Mie series, \[ζ\]\[λ\].
    pub g: Vec<f64>,
    /// Phase function in 1/sr at [`phase_grid::nodes`], \[ζ\]\[λ\]\[node\]; normalised by this type.
    pub phase: Vec<f64>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct Layout {
    zetas: usize,
    wavelengths: usize,
}

impl Layout {
    fn cells(self) -> usize {
        self.zetas * self.wavelengths
    }

    /// Number of 8-byte words of each section, in order: axes and cross sections, cdf, phase (f32), guide (u16).
    fn sections(self) -> [usize; 4] {
        let cells = self.cells();
        [
            self.zetas + self.wavelengths + 3 * cells,
            cells * NODES,
            (cells * NODES).div_ceil(2),
            (cells * GUIDE).div_ceil(4),
        ]
    }

    fn words(self) -> usize {
        HEADER + self.sections().iter().sum::<usize>()
    }
}

impl OpticsTable {
    /// Builds the table: normalises the phase functions over the sphere and prepares their inversion.
    ///
    /// # Errors
    /// If a length does not fit the axes, an axis does not ascend, or a value is negative or not finite.
    pub fn new(parts: &OpticsTableParts) -> Result<Self, OpticsTableError> {
        let layout = Layout { zetas: parts.zeta.len(), wavelengths: parts.wavelengths_nm.len() };
        let cells = layout.cells();
        check(parts, cells)?;

        let mut words = Vec::with_capacity(layout.words());
        words.extend([MAGIC, VERSION, layout.zetas as u64, layout.wavelengths as u64, NODES as u64]);
        words.extend([GUIDE as u64, 0, 0]);
        for section in [&parts.zeta, &parts.wavelengths_nm, &parts.c_ext_m2, &parts.c_sca_m2, &parts.g] {
            words.extend(section.iter().map(|x| x.to_bits()));
        }

        // Normalise in f64, round to the f32 that will be looked up, and integrate what was rounded.
        let nodes = phase_grid::nodes();
        let mut phase = vec![0.0f32; (cells * NODES).next_multiple_of(2)];
        let mut guide = vec![0u16; (cells * GUIDE).next_multiple_of(4)];
        for cell in 0..cells {
            let p = &parts.phase[cell * NODES..(cell + 1) * NODES];
            let norm = phase_grid::integral(&nodes, |i| p[i]);
            if norm.is_nan() || norm <= 0.0 {
                return Err(OpticsTableError::Value(format!("phase function {cell} has integral {norm}")));
            }
            let (z, l) = (cell / layout.wavelengths, cell % layout.wavelengths);
            let rounded: Vec<f32> = p.iter().map(|x| (x / norm) as f32).collect();
            for (i, &x) in rounded.iter().enumerate() {
                phase[(z * NODES + i) * layout.wavelengths + l] = x;
            }
            let cdf = cumulative(&nodes, &rounded);
            fill_guide(&cdf, &mut guide[cell * GUIDE..(cell + 1) * GUIDE]);
            words.extend(cdf.iter().map(|x| x.to_bits()));
        }
        words.extend(
            bytemuck::cast_slice::<f32, [f32; 2]>(&phase).iter().map(|&w| bytemuck::cast::<_, u64>(w)),
        );
        words.extend(
            bytemuck::cast_slice::<u16, [u16; 4]>(&guide).iter().map(|&w| bytemuck::cast::<_, u64>(w)),
        );
        debug_assert_eq!(words.len(), layout.words());
        Ok(Self { storage: SharedWords::Owned(Arc::new(words)), layout })
    }

    /// Opens a table in bytes written by [`OpticsTable::as_bytes`] that start at `offset`.
    ///
    /// # Errors
    /// If the bytes are no table of this version, are cut short, or are not aligned to 8 bytes.
    pub fn from_bytes(bytes: SharedBytes, offset: usize) -> Result<Self, OpticsTableError> {
        let all: &[u8] = (*bytes).as_ref();
        let data = all.get(offset..).unwrap_or(&[]);
        let size = |expected| OpticsTableError::Size { found: data.len(), expected };
        let word: [u64; HEADER] = shared_words::header(data).ok_or(size(HEADER * 8))?;
        if [word[0], word[1], word[4], word[5]] != [MAGIC, VERSION, NODES as u64, GUIDE as u64] {
            return Err(OpticsTableError::Format);
        }
        let (zetas, wavelengths) = (word[2] as usize, word[3] as usize);
        if !(1..=4096).contains(&zetas) || !(1..=MAX_COLUMNS).contains(&wavelengths) {
            return Err(OpticsTableError::Format);
        }
        let layout = Layout { zetas, wavelengths };
        let expected = layout.words() * 8;
        if data.len() != expected || !shared_words::aligned(data) {
            return Err(size(expected));
        }
        Ok(Self { storage: SharedWords::Shared { bytes, offset }, layout })
    }

    fn words(&self) -> &[u64] {
        self.storage.get()
    }

    /// The whole table as bytes (native endianness; the cache's file name says which).
    #[must_use]
    pub fn as_bytes(&self) -> &[u8] {
        bytemuck::cast_slice(self.words())
    }

    /// The sections as slices: take it once before a loop.
    #[must_use]
    pub fn view(&self) -> OpticsView<'_> {
        let cells = self.layout.cells();
        let (head, rest) = self.words()[HEADER..].split_at(self.layout.sections()[0]);
        let (cdf, rest) = rest.split_at(self.layout.sections()[1]);
        let (phase, guide) = rest.split_at(self.layout.sections()[2]);
        let head: &[f64] = bytemuck::cast_slice(head);
        let (zeta, head) = head.split_at(self.layout.zetas);
        let (wavelengths_nm, head) = head.split_at(self.layout.wavelengths);
        OpticsView {
            zeta,
            wavelengths_nm,
            c_ext_m2: &head[..cells],
            c_sca_m2: &head[cells..2 * cells],
            g: &head[2 * cells..],
            cdf: bytemuck::cast_slice(cdf),
            phase: &bytemuck::cast_slice(phase)[..cells * NODES],
            guide: &bytemuck::cast_slice(guide)[..cells * GUIDE],
        }
    }
}

fn check(parts: &OpticsTableParts, cells: usize) -> Result<(), OpticsTableError> {
    let fail = |what: &str| Err(OpticsTableError::Value(what.to_owned()));
    for (name, axis) in [("zeta", &parts.zeta), ("wavelengths_nm", &parts.wavelengths_nm)] {
        if axis.is_empty() || axis.windows(2).any(|w| w[0].is_nan() || w[0] >= w[1]) {
            return fail(&format!("{name} must have ascending values"));
        }
    }
    if parts.wavelengths_nm.len() > MAX_COLUMNS {
        return fail(&format!("more than {MAX_COLUMNS} wavelengths"));
    }
    for (name, values, len) in [
        ("c_ext_m2", &parts.c_ext_m2, cells),
        ("c_sca_m2", &parts.c_sca_m2, cells),
        ("g", &parts.g, cells),
        ("phase", &parts.phase, cells * NODES),
    ] {
        if values.len() != len {
            return fail(&format!("{name} has {} values instead of {len}", values.len()));
        }
        let low = if name == "g" { -1.0 } else { 0.0 };
        if values.iter().any(|x| !x.is_finite() || *x < low) {
            return fail(&format!("{name} has a value that is negative or not finite"));
        }
    }
    Ok(())
}

/// Cumulative distribution at the nodes, ending in exactly 1.
fn cumulative(nodes: &[f64], p: &[f32]) -> Vec<f64> {
    let mut sum = 0.0;
    let mut cdf = vec![0.0; NODES];
    for i in 0..NODES - 1 {
        sum += PI * (f64::from(p[i]) + f64::from(p[i + 1])) * (nodes[i + 1] - nodes[i]);
        cdf[i + 1] = sum;
    }
    for x in &mut cdf {
        *x /= sum;
    }
    cdf
}

/// guide\[k\] = last node whose cumulative value is at most k / GUIDE.
fn fill_guide(cdf: &[f64], guide: &mut [u16]) {
    let mut node = 0;
    for (k, slot) in guide.iter_mut().enumerate() {
        let u = k as f64 / GUIDE as f64;
        while node + 2 < NODES && cdf[node + 1] <= u {
            node += 1;
        }
        *slot = node as u16;
    }
}

/// Borrowed sections of an [`OpticsTable`].
#[derive(Clone, Copy, Debug)]
pub struct OpticsView<'a> {
    /// Relative altitudes z/H, ascending.
    pub zeta: &'a [f64],
    /// Wavelengths in nm, ascending.
    pub wavelengths_nm: &'a [f64],
    /// Extinction cross section per droplet in m², \[ζ\]\[λ\].
    pub c_ext_m2: &'a [f64],
    /// Scattering cross section per droplet in m², \[ζ\]\[λ\].
    pub c_sca_m2: &'a [f64],
    /// Mean cosine from the Mie series, \[ζ\]\[λ\].
    pub g: &'a [f64],
    cdf: &'a [f64],
    phase: &'a [f32],
    guide: &'a [u16],
}

impl OpticsView<'_> {
    /// The ζ row whose phase function a scattering at `zeta` has, for `u` uniform in [0, 1): the lower row with the
    /// weight of linear interpolation, else the upper. Over many scatterings this *is* linear interpolation in ζ.
    #[inline]
    #[must_use]
    pub fn phase_row(&self, zeta: f32, u: f32) -> usize {
        interpolating_row(self.zeta, zeta, u)
    }

    /// The ζ row below `zeta`, and the weight of the next one in the linear interpolation between both.
    #[inline]
    #[must_use]
    pub fn phase_rows(&self, zeta: f32) -> (usize, f32) {
        rows_around(self.zeta, zeta)
    }

    /// Phase function of row `row` in 1/sr at all lanes, for m = 1 − cos θ.
    #[inline]
    #[must_use]
    pub fn phase(&self, row: usize, m: f32, nodes: &[f32], lanes: &LaneWeights) -> Spectrum {
        eval_lanes(self.phase, self.wavelengths_nm.len(), row, m, nodes, lanes)
    }

    /// Value at node `node` of the phase function of (ζ row, λ row), in 1/sr.
    #[must_use]
    pub fn phase_node(&self, zeta_row: usize, wavelength_row: usize, node: usize) -> f32 {
        self.phase[(zeta_row * NODES + node) * self.wavelengths_nm.len() + wavelength_row]
    }

    /// Samples m = 1 − cos θ from the phase function of (ζ row, λ row) for uniform `u` in [0, 1), by inversion in f64.
    #[inline]
    #[must_use]
    pub fn sample_m(&self, zeta_row: usize, wavelength_row: usize, u: f64, nodes: &[f64]) -> f32 {
        let w = self.wavelengths_nm.len();
        let cell = zeta_row * w + wavelength_row;
        let cdf = &self.cdf[cell * NODES..(cell + 1) * NODES];
        let mut i = usize::from(self.guide[cell * GUIDE + ((u * GUIDE as f64) as usize).min(GUIDE - 1)]);
        while i + 2 < NODES && cdf[i + 1] <= u {
            i += 1;
        }
        let p0 = f64::from(self.phase_node(zeta_row, wavelength_row, i));
        let p1 = f64::from(self.phase_node(zeta_row, wavelength_row, i + 1));
        let mass = cdf[i + 1] - cdf[i];
        let fraction = if mass > 0.0 { ((u - cdf[i]) / mass).clamp(0.0, 1.0) } else { 0.0 };
        let t = invert_linear(p0, p1, fraction);
        (nodes[i] + t * (nodes[i + 1] - nodes[i])) as f32
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spectrum::Wavelengths;

    fn hg(g: f64, m: f64) -> f64 {
        let d = 1.0 + g * g - 2.0 * g * (1.0 - m);
        (1.0 - g * g) / (4.0 * PI * d * d.sqrt())
    }

    fn table() -> OpticsTable {
        let nodes = phase_grid::nodes();
        let (zeta, wavelengths_nm) = (vec![0.0, 1.0], vec![400.0, 500.0, 600.0]);
        let mut phase = Vec::new();
        for z in 0..2 {
            for l in 0..3 {
                phase.extend(nodes.iter().map(|&m| 3.0 * hg(0.5 + 0.2 * z as f64 + 0.1 * l as f64, m)));
            }
        }
        let cells = vec![1e-10; 6];
        OpticsTable::new(&OpticsTableParts {
            zeta,
            wavelengths_nm,
            c_ext_m2: cells.clone(),
            c_sca_m2: cells.clone(),
            g: cells,
            phase,
        })
        .unwrap()
    }

    #[test]
    fn bytes_round_trip_and_damage_is_seen() {
        let table = table();
        let words: Vec<u64> = bytemuck::cast_slice(table.as_bytes()).to_vec();
        struct Aligned(Vec<u64>);
        impl AsRef<[u8]> for Aligned {
            fn as_ref(&self) -> &[u8] {
                bytemuck::cast_slice(&self.0)
            }
        }
        let open = |w: Vec<u64>| OpticsTable::from_bytes(Arc::new(Aligned(w)), 0);
        let again = open(words.clone()).unwrap();
        assert_eq!(again.as_bytes(), table.as_bytes());
        assert!(matches!(open(words[..words.len() - 1].to_vec()), Err(OpticsTableError::Size { .. })));
        assert_eq!(open(vec![0; 64]).unwrap_err(), OpticsTableError::Format);
        assert!(open(vec![]).is_err());
    }

    #[test]
    fn samples_follow_the_table() {
        // Mean cosine of stratified samples = mean cosine of the interpolated table, for every cell.
        let table = table();
        let (view, nodes) = (table.view(), phase_grid::nodes());
        for z in 0..2 {
            for l in 0..3 {
                let exact = phase_grid::mean_cosine(&nodes, |i| f64::from(view.phase_node(z, l, i)));
                let n = 200_000;
                let sum: f64 = (0..n)
                    .map(|k| 1.0 - f64::from(view.sample_m(z, l, (k as f64 + 0.5) / n as f64, &nodes)))
                    .sum();
                assert!((sum / n as f64 - exact).abs() < 1e-5, "{z} {l}: {} {exact}", sum / n as f64);
            }
        }
    }

    #[test]
    fn lanes_see_the_mixture_of_wavelengths() {
        let table = table();
        let view = table.view();
        let nodes: Vec<f32> = phase_grid::nodes().iter().map(|&m| m as f32).collect();
        let lanes = LaneWeights::new(view.wavelengths_nm, &Wavelengths::monochromatic(450.0));
        for m in [0.0, 1e-4, 0.3, 1.0, 1.9, 2.0] {
            let got = view.phase(1, m, &nodes, &lanes)[0];
            let want = 0.5 * (hg(0.7, f64::from(m)) + hg(0.8, f64::from(m)));
            assert!((f64::from(got) / want - 1.0).abs() < 1e-3, "m {m}: {got} {want}");
        }
    }
}
