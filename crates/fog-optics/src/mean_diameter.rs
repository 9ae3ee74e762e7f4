//! The single phase function of the paper: Mie at the mean diameter, tabulated at whole degrees (Sec. 5.4).

use crate::advection::AdvectionModel;
use crate::error::OpticsError;
use crate::mie::MieSeries;
use crate::table::Fingerprint;
use crate::water;
use fog_core::math::PI;
use fog_core::math::f64::{asin, cos};
use fog_core::optics_table::{OpticsTable, OpticsTableParts};
use fog_core::phase_grid;

/// Wavelength in nm at which the renderer takes this phase function.
pub const WAVELENGTH_NM: f64 = 550.0;

/// Mean diameter in µm of the layer's distributions: the number-mean diameter of each spectrum, averaged over altitude
/// with equal weights (trapezoidal rule over ζ = 0, 1/64, … 1). The paper does not say how it averages.
#[must_use]
pub fn layer_mean_diameter_um(model: &AdvectionModel) -> f64 {
    let steps = 64;
    let sum: f64 = (0..=steps)
        .map(|i| {
            let weight = if i == 0 || i == steps { 0.5 } else { 1.0 };
            weight * model.moments(f64::from(i) / f64::from(steps)).mean_diameter_um
        })
        .sum();
    sum / f64::from(steps)
}

/// [`diameter_table`] of [`layer_mean_diameter_um`].
///
/// # Errors
/// As there.
pub fn mean_diameter_table(model: &AdvectionModel, wavelength_nm: f64) -> Result<OpticsTable, OpticsError> {
    diameter_table(layer_mean_diameter_um(model), wavelength_nm)
}

/// Table with one row and one wavelength: the Mie phase function of one diameter in µm, computed at 0°, 1°, … 180° and
/// linear in the angle between them, as the paper tabulates it (so its forward peak is blunt and its normalisation is that
/// of the interpolation). Cross sections and g are those of that one diameter, from the series.
///
/// # Errors
/// If the wavelength (nm) is outside [`water::WAVELENGTH_RANGE_NM`], or the droplet outside the range of [`crate::mie`].
pub fn diameter_table(d_um: f64, wavelength_nm: f64) -> Result<OpticsTable, OpticsError> {
    let series = MieSeries::new(water::refractive_index(wavelength_nm)?, PI * d_um * 1e3 / wavelength_nm)?;
    let q = series.efficiencies();
    let area_m2 = 0.25 * PI * d_um * d_um * 1e-12;

    let cosines: Vec<f64> = (0..=180).map(|deg| cos(f64::from(deg) * PI / 180.0)).collect();
    let by_degree: Vec<f64> =
        series.amplitudes(&cosines).iter().map(|s| s.s1.norm_sqr() + s.s2.norm_sqr()).collect();
    let phase = (phase_grid::nodes().iter())
        .map(|m| {
            let deg = 2.0 * asin((0.5 * m).sqrt().min(1.0)) * 180.0 / PI;
            let i = (deg as usize).min(179);
            by_degree[i] + (by_degree[i + 1] - by_degree[i]) * (deg - i as f64)
        })
        .collect();
    Ok(OpticsTable::new(&OpticsTableParts {
        zeta: vec![0.0],
        wavelengths_nm: vec![wavelength_nm],
        c_ext_m2: vec![q.q_ext * area_m2],
        c_sca_m2: vec![q.q_sca * area_m2],
        g: vec![q.g],
        phase,
    })?)
}

/// Everything that [`mean_diameter_table`] depends on, as bytes to be hashed for the name of a cached file.
#[must_use]
pub fn mean_diameter_fingerprint_bytes(model: &AdvectionModel, wavelength_nm: f64) -> Vec<u8> {
    let mut fingerprint = Fingerprint::new("mean diameter table");
    fingerprint.numbers(&[wavelength_nm]);
    fingerprint.numbers(&model.diameters().bounds_um());
    for coefficients in model.shape_coefficients() {
        fingerprint.numbers(coefficients);
    }
    fingerprint.bytes
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn table_holds_the_degrees() {
        let model = AdvectionModel::arcata().unwrap();
        let d = layer_mean_diameter_um(&model);
        assert!(d > 8.0 && d < 12.0, "{d}");
        let table = mean_diameter_table(&model, 550.0).unwrap();
        let view = table.view();
        assert_eq!((view.zeta, view.wavelengths_nm), (&[0.0][..], &[550.0][..]));
        assert!(view.g[0] > 0.8 && view.g[0] < 0.9);
        // Ratios between directions survive the normalisation.
        let series = MieSeries::new(water::refractive_index(550.0).unwrap(), PI * d / 0.55).unwrap();
        let ends: Vec<f64> = series.amplitudes(&[1.0, -1.0]).iter().map(|s| s.s1.norm_sqr()).collect();
        let ratio = view.phase_node(0, 0, 0) / view.phase_node(0, 0, phase_grid::NODES - 1);
        assert!((f64::from(ratio) / (ends[0] / ends[1]) - 1.0).abs() < 1e-6);
        assert!(mean_diameter_table(&model, 100.0).is_err());
    }
}
