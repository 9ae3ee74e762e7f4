//! Single droplets for renderings that draw the very droplet which scatters (`sampling: diameter`).
//!
//! [`build`] computes the droplets, once for a grid of diameters; [`choice`] gives their odds in a fog, by relative
//! altitude. Together they equal the fog's [polydisperse table](crate::table) in the mean.

use crate::distribution::DiameterGrid;
use crate::droplets::Spectra;
use crate::error::OpticsError;
use crate::mie::MieSeries;
use crate::table::Fingerprint;
use crate::water;
use fog_core::diameter_choice::DiameterChoice;
use fog_core::droplet_table::{DropletColumn, DropletTable};
use fog_core::math::PI;
use fog_core::phase_grid::{self, NODES};
use rayon::prelude::*;

/// Cross sections, mean cosines and Mie phase functions of water droplets at every diameter of `diameters` and every
/// wavelength (nm, ascending, within [`water::WAVELENGTH_RANGE_NM`]). `progress` is told the share that is done, in (0, 1].
///
/// Runs on rayon's threads; the result does not depend on their number. Memory: the table, and 10 kB per diameter.
///
/// # Errors
/// If a wavelength is outside the table of water, does not ascend, or a droplet is outside the range of [`crate::mie`].
pub fn build(
    diameters: &DiameterGrid,
    wavelengths_nm: &[f64],
    progress: &(dyn Fn(f64) + Sync),
) -> Result<DropletTable, OpticsError> {
    let d_um: Vec<f64> = (0..diameters.count()).map(|i| diameters.diameter_um(i)).collect();
    let cosines = phase_grid::cosines();
    DropletTable::new(&d_um, wavelengths_nm, |l| {
        let nm = wavelengths_nm[l];
        let m = water::refractive_index(nm)?;
        let mut phase = vec![0.0; d_um.len() * NODES];
        let droplets: Vec<[f64; 3]> = (phase.par_chunks_mut(NODES).zip(&d_um))
            .map(|(phase, d_um)| {
                let series = MieSeries::new(m, PI * d_um * 1e3 / nm)?;
                for (p, s) in phase.iter_mut().zip(series.amplitudes(&cosines)) {
                    *p = s.s1.norm_sqr() + s.s2.norm_sqr();
                }
                let q = series.efficiencies();
                let area_m2 = 0.25 * PI * d_um * d_um * 1e-12;
                Ok([q.q_ext * area_m2, q.q_sca * area_m2, q.g])
            })
            .collect::<Result<_, OpticsError>>()?;
        let numbers = |k: usize| droplets.iter().map(|d| d[k]).collect();
        progress((l + 1) as f64 / wavelengths_nm.len() as f64);
        Ok(DropletColumn { c_ext_m2: numbers(0), c_sca_m2: numbers(1), g: numbers(2), phase })
    })
}

/// Odds of the droplets of `table` (built over `diameters`) in a fog of `spectra`: at each relative altitude of `zeta`,
/// ascending, a scattering is by a droplet of diameter d with probability ∝ n(d, ζ) C_sca(d, λ) w, with w the weight of d in
/// the trapezoidal rule.
///
/// # Errors
/// If the grid is not the table's, `zeta` does not ascend, or no droplet is at any of the diameters.
pub fn choice(
    table: &DropletTable,
    diameters: &DiameterGrid,
    zeta: &[f64],
    spectra: &Spectra,
) -> Result<DiameterChoice, OpticsError> {
    let view = table.view();
    let w = view.wavelengths_nm.len();
    let same = |(i, d): (usize, &f64)| diameters.diameter_um(i) == *d;
    if view.diameters_um.len() != diameters.count() || !view.diameters_um.iter().enumerate().all(same) {
        return Err(OpticsError::Settings("droplet table of other diameters".to_owned()));
    }
    let mut weights = Vec::with_capacity(zeta.len() * view.c_sca_m2.len());
    for &z in zeta {
        let spectrum = spectra.distribution(z);
        for (i, &d) in view.diameters_um.iter().enumerate() {
            // Cross sections in µm²: far from the smallest numbers.
            let share = 1e12 * diameters.weight_um(i) * spectrum.density_1_um(d);
            weights.extend(view.c_sca_m2[i * w..(i + 1) * w].iter().map(|c| share * c));
        }
    }
    DiameterChoice::new(zeta, w, &weights).map_err(OpticsError::Settings)
}

/// Everything that [`build`] depends on, as bytes to be hashed for the name of a cached file.
#[must_use]
pub fn fingerprint_bytes(diameters: &DiameterGrid, wavelengths_nm: &[f64]) -> Vec<u8> {
    let mut fingerprint = Fingerprint::new("single droplets");
    let d_um: Vec<f64> = (0..diameters.count()).map(|i| diameters.diameter_um(i)).collect();
    fingerprint.numbers(&d_um);
    fingerprint.numbers(wavelengths_nm);
    fingerprint.bytes
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::advection::AdvectionModel;
    use crate::size::SizeDistribution;
    use crate::table::{TableSettings, build_table};

    #[test]
    fn droplets_by_their_odds_are_the_polydisperse_table() {
        let model = AdvectionModel::arcata().unwrap();
        let settings = TableSettings {
            zeta: vec![0.0, 0.5, 1.0],
            wavelengths_nm: vec![450.0, 650.0],
            diameters: *model.diameters(),
        };
        let mixtures = build_table(&model, &settings, &|_| ()).unwrap();
        let droplets = build(&settings.diameters, &settings.wavelengths_nm, &|_| ()).unwrap();
        let spectra = Spectra::Advection(model.clone());
        let choice = choice(&droplets, &settings.diameters, &settings.zeta, &spectra).unwrap();
        let (mixture, droplet, nodes) = (mixtures.view(), droplets.view(), phase_grid::nodes());
        for row in 0..3 {
            for l in 0..2 {
                let odds = choice.probabilities(row, l);
                assert!((odds.iter().sum::<f64>() - 1.0).abs() < 1e-12);
                let g: f64 = odds.iter().enumerate().map(|(d, p)| p * droplet.g[d * 2 + l]).sum();
                assert!((g - mixture.g[row * 2 + l]).abs() < 1e-12, "{g}");
                let mean = |node: usize| -> f64 {
                    let p = |d| f64::from(droplet.phase_node(d, l, node));
                    odds.iter().enumerate().map(|(d, share)| share * p(d)).sum()
                };
                // Each droplet's function is normalised on the grid of angles by itself, the mixture's as a whole.
                let mut worst = 0.0f64;
                for node in 0..NODES {
                    let want = f64::from(mixture.phase_node(row, l, node));
                    worst = worst.max((mean(node) / want - 1.0).abs());
                }
                let moved = phase_grid::integral(&nodes, |i| {
                    0.5 * (mean(i) - f64::from(mixture.phase_node(row, l, i))).abs()
                });
                assert!(worst < 5e-4 && moved < 5e-5, "row {row}, wavelength {l}: {worst} {moved}");
            }
        }
    }

    #[test]
    fn other_diameters_are_refused_and_fingerprints_differ() {
        let grids = [0.5, 0.25].map(|step| DiameterGrid::new(1.0, 2.0, step).unwrap());
        let table = build(&grids[0], &[550.0], &|_| ()).unwrap();
        let fog = Spectra::Same(SizeDistribution::gamma(5.0, 0.1).unwrap());
        assert!(choice(&table, &grids[0], &[0.0], &fog).is_ok());
        assert!(choice(&table, &grids[1], &[0.0], &fog).is_err());
        assert!(choice(&table, &grids[0], &[0.5, 0.5], &fog).is_err());
        let prints = [
            fingerprint_bytes(&grids[0], &[550.0]),
            fingerprint_bytes(&grids[1], &[550.0]),
            fingerprint_bytes(&grids[0], &[551.0]),
        ];
        assert!(prints[0] != prints[1] && prints[0] != prints[2]);
    }
}
