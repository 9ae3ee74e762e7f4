//! One mean cosine for a whole layer.

use crate::layer::{FogLayer, REFERENCE_NM, cross_sections_at};
use crate::vertical::NODES;
use fog_core::optics_table::OpticsTable;

/// The layer's own g at 550 nm (`phase: {hg: layer}`): the mean over altitude of the droplets' g, weighted by what the
/// layer scatters,
///
/// g = ∫ σ_s(z) g(ζ) dz / ∫ σ_s(z) dz,
///
/// with g(ζ) that of `table` at the relative altitude between the layer's base and top, and σ_s of `layer`; trapezoidal
/// rule over 1025 altitudes. Altitudes count alike where the layer scatters nothing at all. (The paper's 0.83, Sec. 5.4,
/// is an average over the altitude too; it does not say how it was weighted, and was made at other wavelengths.)
#[must_use]
pub fn layer_mean_cosine(layer: &FogLayer, table: &OpticsTable) -> f64 {
    let [base, top] = layer.extent_m();
    let (view, last) = (table.view(), NODES - 1);
    let (mut scattered, mut sum, mut plain) = (0.0, 0.0, 0.0);
    for i in 0..=last {
        let zeta = i as f64 / last as f64;
        let step = if i == 0 || i == last { 0.5 } else { 1.0 };
        let z = base + (top - base) * zeta;
        let sigma_s = layer.sigma_t_at(z) * layer.albedo_at(z).unwrap_or(0.0);
        let g = cross_sections_at(&view, zeta, REFERENCE_NM).g;
        scattered += step * sigma_s;
        sum += step * sigma_s * g;
        plain += step * g;
    }
    if scattered > 0.0 { sum / scattered } else { plain / last as f64 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::advection::AdvectionModel;
    use crate::layer;
    use crate::table::{TableSettings, build_table};

    #[test]
    fn weights_are_what_is_scattered() {
        let model = AdvectionModel::arcata().unwrap();
        let settings = TableSettings { wavelengths_nm: vec![525.0, 575.0], ..TableSettings::visible(&model) };
        let table = build_table(&model, &settings, &|_| ()).unwrap();
        let g_at = |zeta: f64| cross_sections_at(&table.view(), zeta, REFERENCE_NM).g;
        let fog = layer::advection(&table, &model, 180.0, 1.0).unwrap();
        let g = layer_mean_cosine(&fog, &table);
        assert!((0.84..0.87).contains(&g), "{g}");
        // The number of droplets does not matter, nor does a vanishing amount of fog.
        assert!((layer_mean_cosine(&fog.scaled(3.0).unwrap(), &table) - g).abs() < 1e-14);
        let even = layer_mean_cosine(&layer::homogeneous(50.0, 0.1, 1.0).unwrap(), &table);
        let none = layer_mean_cosine(&layer::homogeneous(50.0, 0.0, 1.0).unwrap(), &table);
        let plain = (0..1000).map(|i| g_at((f64::from(i) + 0.5) / 1000.0)).sum::<f64>() / 1000.0;
        assert!((even - plain).abs() < 1e-6 && (none - plain).abs() < 1e-6, "{even} {none} {plain}");
        // Fog near the top alone has the top's g.
        let rows = [(0.0, 0.0), (99.0, 0.0), (100.0, 0.5)];
        let top = layer_mean_cosine(&layer::layered(&rows, 0.9).unwrap(), &table);
        assert!((top - g_at(0.995)).abs() < 1e-3, "{top}");
    }
}
