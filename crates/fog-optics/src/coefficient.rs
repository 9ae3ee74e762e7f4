//! The paper's scattering coefficient (Kolářová, Lachiver & Wilkie 2024, Sec. 5.3, Eq. 4) beside the physical one.
//!
//! Extinction is the integral σ(z, λ) = ∫ n(d, z) C(d, λ) dd over the droplets' diameters: what [`crate::layer::advection`]
//! gives. The paper instead samples a diameter and takes σ_s = N·σ(d), with N "the number density for a particle of
//! diameter d": the density n(d, z) in m⁻³ µm⁻¹ at that diameter, read as if it were a number in m⁻³. That is the number of
//! droplets in an interval of 1 µm, and its mean over sampled diameters is smaller than the integral by about the width of
//! the spectrum over 1 µm: 15 times at the top of the fog, 29 times at its base. It is offered under its own name, for
//! comparison with the paper's pictures.

use crate::advection::AdvectionModel;
use crate::error::{OpticsError, check_range};
use crate::layer::{ADVECTION_NODES, FogLayer};
use crate::mie::{MieSeries, efficiencies};
use crate::water;
use fog_core::math::PI;
use rayon::prelude::*;

/// Interval of diameters in µm that turns a density into the number which the paper's equation takes.
pub const INTERVAL_UM: f64 = 1.0;

/// N·σ(d) in 1/m: scattering by the droplets of one diameter (µm), with N = n(d, z) · 1 µm, at relative altitude ζ in
/// [0, 1] of the advection fog of height `height_m`, at a wavelength in nm (Eq. 4).
///
/// # Errors
/// If the diameter is outside the model's range, ζ outside [0, 1], the height outside
/// [`crate::advection::HEIGHT_RANGE_M`] or the wavelength outside the table of water.
pub fn per_diameter_1_m(
    model: &AdvectionModel,
    diameter_um: f64,
    zeta: f64,
    height_m: f64,
    wavelength_nm: f64,
) -> Result<f64, OpticsError> {
    model.check_height(height_m)?;
    let [first, last, _] = model.diameters().bounds_um();
    check_range("diameter_um", diameter_um, first, last)?;
    check_range("zeta", zeta, 0.0, 1.0)?;
    let m = water::refractive_index(wavelength_nm)?;
    let q = efficiencies(m, PI * diameter_um * 1e3 / wavelength_nm)?;
    let c_sca_m2 = q.q_sca * 0.25 * PI * diameter_um * diameter_um * 1e-12;
    Ok(model.density_1_m3_um(diameter_um, zeta, height_m) * INTERVAL_UM * c_sca_m2)
}

/// The advection fog of `model` in the paper's convention: its coefficient at an altitude is the mean of N·σ(d) over
/// diameters that are sampled by number,
///
/// σ(z, λ) = 1 µm · ∫ n̂(d) n(d, z) C(d, λ) dd, with n̂ = n / ∫n,
///
/// by the trapezoidal rule over the model's diameters; σ_t has C_ext and the albedo is the same mean of C_sca over it.
/// Altitudes, wavelengths (nm, ascending) and `number_density_scale` are as in [`crate::layer::advection`].
///
/// # Errors
/// As there, or if a wavelength is outside the table of water.
pub fn paper_layer(
    model: &AdvectionModel,
    wavelengths_nm: &[f64],
    height_m: f64,
    number_density_scale: f64,
) -> Result<FogLayer, OpticsError> {
    model.check_height(height_m)?;
    check_range("number_density_scale", number_density_scale, 0.0, 1e6)?;
    let (grid, w) = (model.diameters(), wavelengths_nm.len());
    let cross = cross_sections(model, wavelengths_nm)?;
    let last = ADVECTION_NODES - 1;
    let rows: Vec<(f64, Vec<[f64; 2]>)> = (0..=last)
        .into_par_iter()
        .map(|i| {
            let zeta = i as f64 / last as f64;
            let shape = model.shape(zeta);
            let (mut number, mut sums) = (0.0, vec![[0.0; 2]; w]);
            for (d, cross) in cross.chunks_exact(w).enumerate() {
                let density = shape.density_1_um(grid.diameter_um(d));
                let weight = grid.weight_um(d) * density;
                number += weight;
                for (sum, c) in sums.iter_mut().zip(cross) {
                    sum[0] += weight * density * c[0];
                    sum[1] += weight * density * c[1];
                }
            }
            let n = number_density_scale * model.number_density_1_m3(zeta, height_m);
            (n * INTERVAL_UM / number, sums)
        })
        .collect();
    let altitude_m = (0..=last).map(|i| height_m * (i as f64 / last as f64)).collect();
    let sigma_t = rows.iter().flat_map(|(n, sums)| sums.iter().map(move |s| n * s[0])).collect();
    let albedo =
        rows.iter().flat_map(|(_, sums)| sums.iter().map(|s| (s[1] / s[0]).clamp(0.0, 1.0))).collect();
    FogLayer::new(altitude_m, wavelengths_nm.to_vec(), sigma_t, albedo)
}

/// [C_ext, C_sca] in m² by \[diameter\]\[wavelength\].
fn cross_sections(model: &AdvectionModel, wavelengths_nm: &[f64]) -> Result<Vec<[f64; 2]>, OpticsError> {
    let grid = model.diameters();
    let water =
        wavelengths_nm.iter().map(|&nm| water::refractive_index(nm)).collect::<Result<Vec<_>, _>>()?;
    let by_diameter: Vec<Vec<[f64; 2]>> = (0..grid.count())
        .into_par_iter()
        .map(|i| {
            let d_um = grid.diameter_um(i);
            let area_m2 = 0.25 * PI * d_um * d_um * 1e-12;
            (water.iter().zip(wavelengths_nm))
                .map(|(&m, nm)| {
                    let q = MieSeries::new(m, PI * d_um * 1e3 / nm)?.efficiencies();
                    Ok([q.q_ext * area_m2, q.q_sca * area_m2])
                })
                .collect::<Result<Vec<_>, OpticsError>>()
        })
        .collect::<Result<_, _>>()?;
    Ok(by_diameter.concat())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::layer;
    use crate::table::{TableSettings, build_table};

    #[test]
    fn the_layer_is_the_mean_over_sampled_diameters() {
        let model = AdvectionModel::arcata().unwrap();
        let (grid, height) = (model.diameters(), 180.0);
        let fog = paper_layer(&model, &[550.0], height, 2.0).unwrap();
        for zeta in [0.0, 0.25, 1.0] {
            let shape = model.shape(zeta);
            let number = grid.integrate(|d| shape.density_1_um(d));
            let mean = grid.integrate(|d| {
                let sigma = per_diameter_1_m(&model, d.min(60.0), zeta, height, 550.0).unwrap();
                shape.density_1_um(d) / number * sigma
            });
            let z = zeta * height;
            let got = fog.sigma_t_at(z) * fog.albedo_at(z).unwrap() / 2.0;
            assert!((got / mean - 1.0).abs() < 1e-9, "{zeta}: {got} for {mean}");
        }
    }

    #[test]
    fn it_is_an_order_of_magnitude_below_the_integral() {
        let model = AdvectionModel::arcata().unwrap();
        let settings = TableSettings { wavelengths_nm: vec![550.0], ..TableSettings::visible(&model) };
        let table = build_table(&model, &settings, &|_| ()).unwrap();
        let (paper, integral) = (
            paper_layer(&model, &[550.0], 180.0, 1.0).unwrap(),
            layer::advection(&table, &model, 180.0, 1.0).unwrap(),
        );
        for z in [0.0, 45.0, 90.0, 135.0, 180.0] {
            let ratio = integral.sigma_t_at(z) / paper.sigma_t_at(z);
            assert!((15.0..30.0).contains(&ratio), "{z} m: {ratio}");
        }
    }

    #[test]
    fn inputs_are_checked() {
        let model = AdvectionModel::arcata().unwrap();
        for (d, zeta, h, nm) in [
            (0.4, 0.5, 100.0, 550.0),
            (5.0, 1.1, 100.0, 550.0),
            (5.0, 0.5, 0.0, 550.0),
            (5.0, 0.5, 100.0, 1.0),
        ] {
            assert!(per_diameter_1_m(&model, d, zeta, h, nm).is_err(), "{d} {zeta} {h} {nm}");
        }
        assert!(paper_layer(&model, &[550.0], 0.0, 1.0).is_err());
        assert!(paper_layer(&model, &[100.0], 100.0, 1.0).is_err());
        assert!(paper_layer(&model, &[550.0], 100.0, -1.0).is_err());
    }
}
