//! The paper's scattering coefficient (Kolářová, Lachiver & Wilkie 2024, Sec. 5.3, Eq. 4) beside the physical one.
//!
//! Extinction is the integral σ(z, λ) = ∫ n(d, z) C(d, λ) dd over the droplets' diameters: what [`crate::layer::droplets`]
//! gives. The paper instead samples a diameter and takes σ_s = N·σ(d), with N "the number density for a particle of
//! diameter d": the density n(d, z) in m⁻³ µm⁻¹ at that diameter, read as if it were a number in m⁻³. That is the number of
//! droplets in an interval of 1 µm, and its mean over sampled diameters is smaller than the integral by about the width of
//! the spectrum over 1 µm: 15 times at the top of the fog, 29 times at its base. It is offered under its own name, for
//! comparison with the paper's pictures.

use crate::distribution::DiameterGrid;
use crate::droplets::DropletLayer;
use crate::error::OpticsError;
use crate::layer::FogLayer;
use crate::mie::{Complex64, efficiencies};
use crate::vertical::NODES;
use crate::water;
use fog_core::math::PI;
use rayon::prelude::*;

/// Interval of diameters in µm that turns a density into the number which the paper's equation takes.
pub const INTERVAL_UM: f64 = 1.0;

/// N·σ(d) in 1/m: scattering by the droplets of one diameter (µm), with N = n(d, z) · 1 µm, at relative altitude ζ of
/// `fog`, at a wavelength in nm (Eq. 4). 0 where there are no such droplets.
///
/// # Errors
/// If the wavelength is outside the table of water or the diameter outside the range of [`crate::mie`].
pub fn per_diameter_1_m(
    fog: &DropletLayer,
    diameter_um: f64,
    zeta: f64,
    wavelength_nm: f64,
) -> Result<f64, OpticsError> {
    let m = water::refractive_index(wavelength_nm)?;
    let [_, c_sca_m2] = cross_sections(m, diameter_um, wavelength_nm)?;
    let density = fog.number_density_1_m3(zeta) * fog.spectra().distribution(zeta).density_1_um(diameter_um);
    Ok(density * INTERVAL_UM * c_sca_m2)
}

/// A fog of droplets in the paper's convention: its coefficient at an altitude is the mean of N·σ(d) over diameters that
/// are sampled by number,
///
/// σ(z, λ) = 1 µm · ∫ n̂(d) n(d, z) C(d, λ) dd, with n̂ = n / ∫n,
///
/// by the trapezoidal rule over the spectrum's diameters; σ_t has C_ext and the albedo is the same mean of C_sca over it.
/// Altitudes and wavelengths (nm, ascending) are as in [`crate::layer::droplets`].
///
/// # Errors
/// If a wavelength is outside the table of water, or there is none.
pub fn paper_layer(fog: &DropletLayer, wavelengths_nm: &[f64]) -> Result<FogLayer, OpticsError> {
    let w = wavelengths_nm.len();
    if w == 0 {
        return Err(OpticsError::Settings("wavelengths_nm needs a value".to_owned()));
    }
    let grid = *fog.spectra().distribution(0.0).grid();
    let cross = cross_section_table(&grid, wavelengths_nm)?;
    let last = NODES - 1;
    let rows: Vec<(f64, Vec<[f64; 2]>)> = (0..=last)
        .into_par_iter()
        .map(|i| {
            let zeta = i as f64 / last as f64;
            let spectrum = fog.spectra().distribution(zeta);
            let (mut number, mut sums) = (0.0, vec![[0.0; 2]; w]);
            for (d, cross) in cross.chunks_exact(w).enumerate() {
                let density = spectrum.density_1_um(grid.diameter_um(d));
                let weight = grid.weight_um(d) * density;
                number += weight;
                for (sum, c) in sums.iter_mut().zip(cross) {
                    sum[0] += weight * density * c[0];
                    sum[1] += weight * density * c[1];
                }
            }
            (fog.number_density_1_m3(zeta) * INTERVAL_UM / number, sums)
        })
        .collect();
    let altitude_m = (0..=last).map(|i| fog.height_m() * (i as f64 / last as f64)).collect();
    let sigma_t = rows.iter().flat_map(|(n, sums)| sums.iter().map(move |s| n * s[0])).collect();
    let albedo =
        rows.iter().flat_map(|(_, sums)| sums.iter().map(|s| (s[1] / s[0]).clamp(0.0, 1.0))).collect();
    FogLayer::new(altitude_m, wavelengths_nm.to_vec(), sigma_t, albedo)
}

/// [C_ext, C_sca] in m² by \[diameter\]\[wavelength\].
fn cross_section_table(grid: &DiameterGrid, wavelengths_nm: &[f64]) -> Result<Vec<[f64; 2]>, OpticsError> {
    let water =
        wavelengths_nm.iter().map(|&nm| water::refractive_index(nm)).collect::<Result<Vec<_>, _>>()?;
    let by_diameter: Vec<Vec<[f64; 2]>> = (0..grid.count())
        .into_par_iter()
        .map(|i| {
            let columns = water.iter().zip(wavelengths_nm);
            columns.map(|(&m, &nm)| cross_sections(m, grid.diameter_um(i), nm)).collect()
        })
        .collect::<Result<_, _>>()?;
    Ok(by_diameter.concat())
}

/// [C_ext, C_sca] in m² of one droplet.
fn cross_sections(m: Complex64, d_um: f64, wavelength_nm: f64) -> Result<[f64; 2], OpticsError> {
    let q = efficiencies(m, PI * d_um * 1e3 / wavelength_nm)?;
    let area_m2 = 0.25 * PI * d_um * d_um * 1e-12;
    Ok([q.q_ext * area_m2, q.q_sca * area_m2])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::advection::AdvectionModel;
    use crate::droplets::Spectra;
    use crate::layer;
    use crate::size::SizeDistribution;
    use crate::table::{TableSettings, build};
    use crate::vertical::VerticalProfile;

    fn advection(height_m: f64) -> DropletLayer {
        DropletLayer::advection(&AdvectionModel::arcata().unwrap(), height_m).unwrap()
    }

    #[test]
    fn the_layer_is_the_mean_over_sampled_diameters() {
        let gamma = Spectra::Same(SizeDistribution::gamma(5.0, 0.1).unwrap());
        let gamma = DropletLayer::new(gamma, VerticalProfile::uniform(), 1e8, 60.0).unwrap();
        for fog in [advection(180.0).scaled(2.0).unwrap(), gamma] {
            let layer = paper_layer(&fog, &[550.0]).unwrap();
            for zeta in [0.0, 0.25, 1.0] {
                let spectrum = fog.spectra().distribution(zeta);
                let (mut number, mut sum) = (0.0, 0.0);
                for i in 0..spectrum.grid().count() {
                    let d = spectrum.grid().diameter_um(i);
                    let share = spectrum.grid().weight_um(i) * spectrum.density_1_um(d);
                    number += share;
                    sum += share * per_diameter_1_m(&fog, d, zeta, 550.0).unwrap();
                }
                let z = zeta * fog.height_m();
                let got = layer.sigma_t_at(z) * layer.albedo_at(z).unwrap();
                assert!((got * number / sum - 1.0).abs() < 1e-9, "{zeta}: {got} for {}", sum / number);
            }
        }
    }

    #[test]
    fn it_is_an_order_of_magnitude_below_the_integral() {
        let fog = advection(180.0);
        let settings =
            TableSettings { wavelengths_nm: vec![550.0], ..TableSettings::visible_of(fog.spectra()) };
        let table = build(fog.spectra(), &settings, &|_| ()).unwrap();
        let (paper, integral) = (paper_layer(&fog, &[550.0]).unwrap(), layer::droplets(&table, &fog));
        for z in [0.0, 45.0, 90.0, 135.0, 180.0] {
            let ratio = integral.sigma_t_at(z) / paper.sigma_t_at(z);
            assert!((15.0..30.0).contains(&ratio), "{z} m: {ratio}");
        }
    }

    #[test]
    fn inputs_are_checked() {
        let fog = advection(100.0);
        assert!(
            per_diameter_1_m(&fog, 5.0, 0.5, 100.0).is_err()
                && per_diameter_1_m(&fog, -5.0, 0.5, 550.0).is_err()
        );
        assert_eq!(per_diameter_1_m(&fog, 70.0, 0.5, 550.0), Ok(0.0));
        assert!(paper_layer(&fog, &[100.0]).is_err() && paper_layer(&fog, &[]).is_err());
    }
}
