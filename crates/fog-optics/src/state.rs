//! What the fog is at one altitude: the numbers that a data set records with a frame.

use crate::advection::AdvectionModel;
use crate::droplets::DropletLayer;
use crate::error::OpticsError;
use crate::layer::{FogLayer, REFERENCE_NM, cross_sections_at};
use crate::visibility::mor_m;
use fog_core::optics_table::OpticsTable;

/// Fog at one altitude, optical quantities at 550 nm. What is not defined is none: everything but σ_t = 0 in clear air,
/// the droplets of a grey layer.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FogState {
    /// Extinction coefficient in 1/m.
    pub sigma_t_550_1_m: f64,
    /// Single-scattering albedo.
    pub albedo: Option<f64>,
    /// Mean cosine of the scattering angle.
    pub g: Option<f64>,
    /// Meteorological optical range −ln 0.05 / σ_t in m; none where σ_t is 0 (it is infinite there).
    pub mor_m: Option<f64>,
    /// Liquid water content in g/m³.
    pub liquid_water_content_g_m3: Option<f64>,
    /// Number of droplets per m³ whose diameters lie in the model's range.
    pub number_density_1_m3: Option<f64>,
    /// Effective radius ½ ∫n d³ / ∫n d² in µm.
    pub effective_radius_um: Option<f64>,
    /// Number-mean diameter in µm.
    pub mean_diameter_um: Option<f64>,
}

impl FogState {
    /// The fog of [`crate::layer::droplets`] at an altitude in m over its base.
    #[must_use]
    pub fn droplets(table: &OpticsTable, fog: &DropletLayer, altitude_m: f64) -> Self {
        let zeta = altitude_m / fog.height_m();
        let n = fog.number_density_1_m3(zeta);
        if n.is_nan() || n <= 0.0 {
            return Self::default();
        }
        // Linear in wavelength between the table's columns, as the layer is.
        let cross = cross_sections_at(&table.view(), zeta, REFERENCE_NM);
        let moments = fog.spectra().distribution(zeta).moments();
        Self {
            sigma_t_550_1_m: n * cross.c_ext_m2,
            albedo: Some((cross.c_sca_m2 / cross.c_ext_m2).clamp(0.0, 1.0)),
            g: Some(cross.g),
            mor_m: Some(mor_m(n * cross.c_ext_m2)),
            liquid_water_content_g_m3: Some(n * moments.mass_g),
            number_density_1_m3: Some(n * moments.share_in_range),
            effective_radius_um: Some(moments.effective_radius_um),
            mean_diameter_um: Some(moments.mean_diameter_um),
        }
    }

    /// The advection fog of [`crate::layer::advection`] at an altitude in m over its base.
    ///
    /// # Errors
    /// If the height is outside [`crate::advection::HEIGHT_RANGE_M`], or the scale is not in 0 to 1e6.
    pub fn advection(
        table: &OpticsTable,
        model: &AdvectionModel,
        height_m: f64,
        number_density_scale: f64,
        altitude_m: f64,
    ) -> Result<Self, OpticsError> {
        let fog = DropletLayer::advection(model, height_m)?.scaled(number_density_scale)?;
        Ok(Self::droplets(table, &fog, altitude_m))
    }

    /// A layer without droplets in mind, at an altitude in m over its datum; `g` of its phase function, where it has one.
    #[must_use]
    pub fn grey(layer: &FogLayer, g: Option<f64>, altitude_m: f64) -> Self {
        let sigma_t = layer.sigma_t_at(altitude_m);
        if sigma_t <= 0.0 {
            return Self::default();
        }
        Self {
            sigma_t_550_1_m: sigma_t,
            albedo: layer.albedo_at(altitude_m),
            g,
            mor_m: Some(mor_m(sigma_t)),
            ..Self::default()
        }
    }
}
