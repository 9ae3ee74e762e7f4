//! Averages of Mie scattering over droplet spectra.

use crate::distribution::DiameterGrid;
use crate::error::OpticsError;
use crate::mie::{
    BLOCK, GROUP, GroupTerms, KernelTerm, LANES, MieSeries, group_terms, mixture_block, orders,
};
use crate::water;
use fog_core::math::PI;
use fog_core::optics_table::OpticsTableParts;
use fog_core::phase_grid::{self, NODES};
use rayon::prelude::*;

/// Droplet spectra by row (relative altitude) over one grid of diameters.
#[derive(Clone, Debug, PartialEq)]
pub struct DropletSpectra {
    zeta: Vec<f64>,
    diameters: DiameterGrid,
    /// \[row\]\[diameter\], padded with zeros to a multiple of `GROUP`: droplets per droplet in the diameter's cell.
    shares: Vec<f64>,
}

impl DropletSpectra {
    /// Spectra at the rows `zeta` from a density per droplet in µm⁻¹, `density_1_um(row's ζ, diameter in µm)`.
    ///
    /// # Errors
    /// If a density is negative or not finite, or a row is empty of droplets.
    pub fn new(
        zeta: &[f64],
        diameters: &DiameterGrid,
        density_1_um: impl Fn(f64, f64) -> f64,
    ) -> Result<Self, OpticsError> {
        let mut shares = Vec::new();
        for &z in zeta {
            let start = shares.len();
            shares.extend(
                (0..diameters.count())
                    .map(|i| diameters.weight_um(i) * density_1_um(z, diameters.diameter_um(i))),
            );
            let row = &shares[start..];
            if row.iter().any(|w| !(w.is_finite() && *w >= 0.0)) || row.iter().sum::<f64>() <= 0.0 {
                let problem = format!("droplet spectrum at zeta {z} is negative, not finite or empty");
                return Err(OpticsError::Settings(problem));
            }
            shares.resize(start + diameters.count().next_multiple_of(GROUP), 0.0);
        }
        Ok(Self { zeta: zeta.to_vec(), diameters: *diameters, shares })
    }

    fn padded(&self) -> usize {
        self.diameters.count().next_multiple_of(GROUP)
    }
}

/// One group of neighbouring diameters at one wavelength.
struct Group {
    terms: GroupTerms,
    c_ext_m2: [f64; GROUP],
    c_sca_m2: [f64; GROUP],
    g: [f64; GROUP],
}

/// Cross sections, mean cosines and phase functions of water droplets, for every row and wavelength.
///
/// With n̂ the density per droplet (not renormalised over the grid) and sums by the trapezoidal rule,
/// C_ext(ζ, λ) = ∫ n̂ Q_ext π d²/4 dd in m², likewise C_sca; g = ∫ n̂ C_sca g dd / C_sca; and the phase function in 1/sr
/// at the angles of [`phase_grid`] is ∫ n̂ (|S1|² + |S2|²) dd / (2 k₀² C_sca), which integrates to 1 as far as the grid of
/// angles resolves it. `wavelengths_nm`: ascending, within [`water::WAVELENGTH_RANGE_NM`]. `progress` is told the share
/// that is done, after each wavelength, by the calling thread.
///
/// Runs on rayon's threads; every sum has a fixed order, so that the result does not depend on their number. Memory: about
/// 10 kB per diameter beside the result.
///
/// # Errors
/// If a wavelength is outside the table of water, or a droplet outside the range of [`crate::mie`].
pub fn average(
    spectra: &DropletSpectra,
    wavelengths_nm: &[f64],
    progress: &(dyn Fn(f64) + Sync),
) -> Result<OpticsTableParts, OpticsError> {
    let (rows, w) = (spectra.zeta.len(), wavelengths_nm.len());
    let mut parts = OpticsTableParts {
        zeta: spectra.zeta.clone(),
        wavelengths_nm: wavelengths_nm.to_vec(),
        c_ext_m2: vec![0.0; rows * w],
        c_sca_m2: vec![0.0; rows * w],
        g: vec![0.0; rows * w],
        phase: vec![0.0; rows * w * NODES],
    };
    let blocks = angle_blocks();
    for (l, &wavelength_nm) in wavelengths_nm.iter().enumerate() {
        let groups = mie_groups(&spectra.diameters, wavelength_nm)?;

        // Cross sections: one sum over diameters per row.
        for row in 0..rows {
            let shares = &spectra.shares[row * spectra.padded()..][..spectra.padded()];
            let (mut ext, mut sca, mut cosine) = (0.0, 0.0, 0.0);
            for (group, share) in groups.iter().zip(shares.chunks_exact(GROUP)) {
                for d in 0..GROUP {
                    ext += share[d] * group.c_ext_m2[d];
                    sca += share[d] * group.c_sca_m2[d];
                    cosine += share[d] * group.c_sca_m2[d] * group.g[d];
                }
            }
            let cell = row * w + l;
            (parts.c_ext_m2[cell], parts.c_sca_m2[cell], parts.g[cell]) = (ext, sca, cosine / sca);
        }

        // Intensities: blocks of angles are independent of each other.
        let orders = orders(groups.iter().map(|g| g.terms.len()).max().unwrap_or(0));
        let terms: Vec<&[[KernelTerm; GROUP]]> = groups.iter().map(|g| &g.terms[..]).collect();
        let sums: Vec<Vec<[[f64; LANES]; BLOCK]>> = (blocks.par_iter())
            .map(|mu| {
                let mut out = vec![[[0.0; LANES]; BLOCK]; rows];
                mixture_block(mu, &terms, &orders, &spectra.shares, &mut out);
                out
            })
            .collect();
        let k0 = 2.0 * PI / (wavelength_nm * 1e-9);
        for row in 0..rows {
            let cell = row * w + l;
            let scale = 1.0 / (2.0 * k0 * k0 * parts.c_sca_m2[cell]);
            let phase = &mut parts.phase[cell * NODES..(cell + 1) * NODES];
            for (chunk, block) in phase.chunks_mut(LANES * BLOCK).zip(&sums) {
                for (p, sum) in chunk.iter_mut().zip(block[row].as_flattened()) {
                    *p = sum * scale;
                }
            }
        }
        progress((l + 1) as f64 / w as f64);
    }
    Ok(parts)
}

/// Cosines of the phase grid in blocks; the last one is filled up with forward angles.
fn angle_blocks() -> Vec<[[f64; LANES]; BLOCK]> {
    (phase_grid::cosines().chunks(LANES * BLOCK))
        .map(|chunk| {
            let mut block = [[1.0; LANES]; BLOCK];
            for (slot, cosine) in block.as_flattened_mut().iter_mut().zip(chunk) {
                *slot = *cosine;
            }
            block
        })
        .collect()
}

/// Mie series of every diameter at one wavelength.
fn mie_groups(diameters: &DiameterGrid, wavelength_nm: f64) -> Result<Vec<Group>, OpticsError> {
    let m = water::refractive_index(wavelength_nm)?;
    let count = diameters.count();
    (0..count.div_ceil(GROUP))
        .into_par_iter()
        .map(|g| {
            let mut group =
                Group { terms: Vec::new(), c_ext_m2: [0.0; GROUP], c_sca_m2: [0.0; GROUP], g: [0.0; GROUP] };
            let mut all = Vec::with_capacity(GROUP);
            for d in 0..GROUP.min(count - g * GROUP) {
                let d_um = diameters.diameter_um(g * GROUP + d);
                let series = MieSeries::new(m, PI * d_um * 1e3 / wavelength_nm)?;
                let q = series.efficiencies();
                let area_m2 = 0.25 * PI * d_um * d_um * 1e-12;
                group.c_ext_m2[d] = q.q_ext * area_m2;
                group.c_sca_m2[d] = q.q_sca * area_m2;
                group.g[d] = q.g;
                all.push(series);
            }
            group.terms = group_terms(&all);
            Ok(group)
        })
        .collect()
}
