//! Fog layers: extinction and albedo by altitude and wavelength, and what the paper derives from them.

use crate::advection::AdvectionModel;
use crate::droplets::DropletLayer;
use crate::error::{OpticsError, check_range};
use crate::vertical::NODES;
use crate::visibility::sigma_t_from_mor;
use fog_core::optics_table::{OpticsTable, OpticsView};
use fog_core::profile::ExtinctionProfile;

/// Wavelength in nm at which visibilities, means and extremes are taken.
pub const REFERENCE_NM: f64 = 550.0;

/// A horizontally even layer: σ_t and albedo at ascending altitudes over its datum, linear between them, nothing outside.
#[derive(Clone, Debug, PartialEq)]
pub struct FogLayer {
    altitude_m: Vec<f64>,
    wavelengths_nm: Vec<f64>,
    /// \[altitude\]\[wavelength\], 1/m.
    sigma_t: Vec<f64>,
    /// \[altitude\]\[wavelength\].
    albedo: Vec<f64>,
}

/// The layer of a fog of droplets, by the table of its spectra ([`crate::table::build`]).
///
/// σ_t(z, λ) = N(ζ) C_ext(ζ, λ) at 1025 altitudes, C from `table` by cubic interpolation in ζ. Wavelengths are those of the
/// table.
#[must_use]
pub fn droplets(table: &OpticsTable, fog: &DropletLayer) -> FogLayer {
    let view = table.view();
    let last = NODES - 1;
    let (mut altitude_m, mut sigma_t, mut albedo) = (Vec::new(), Vec::new(), Vec::new());
    for i in 0..=last {
        let zeta = i as f64 / last as f64;
        let n = fog.number_density_1_m3(zeta);
        altitude_m.push(fog.height_m() * zeta);
        for l in 0..view.wavelengths_nm.len() {
            let cross = cross_sections(&view, zeta, l);
            sigma_t.push(n * cross.c_ext_m2);
            albedo.push((cross.c_sca_m2 / cross.c_ext_m2).clamp(0.0, 1.0));
        }
    }
    FogLayer { altitude_m, wavelengths_nm: view.wavelengths_nm.to_vec(), sigma_t, albedo }
}

/// The advection fog of `model` with height `height_m`, its number of droplets multiplied by `number_density_scale`:
/// [`droplets`] of [`DropletLayer::advection`].
///
/// # Errors
/// If the height is outside [`crate::advection::HEIGHT_RANGE_M`], or the scale is not in 0 to 1e6.
pub fn advection(
    table: &OpticsTable,
    model: &AdvectionModel,
    height_m: f64,
    number_density_scale: f64,
) -> Result<FogLayer, OpticsError> {
    Ok(droplets(table, &DropletLayer::advection(model, height_m)?.scaled(number_density_scale)?))
}

/// A layer with the same `sigma_t_1_m` and single-scattering albedo from its base to `height_m`, at every wavelength.
///
/// # Errors
/// If a value is out of range (height 0 < H ≤ 100 000 m, σ_t 0 to 1e6 1/m, albedo 0 to 1).
pub fn homogeneous(height_m: f64, sigma_t_1_m: f64, albedo: f64) -> Result<FogLayer, OpticsError> {
    linear_gradient(height_m, sigma_t_1_m, sigma_t_1_m, albedo)
}

/// A grey layer whose σ_t is linear from `base_1_m` at altitude 0 to `top_1_m` at `height_m`. The paper's gradient
/// (Sec. 6.1) runs from the least to the greatest value of the advection layer: [`FogLayer::min_max_sigma_t`].
///
/// # Errors
/// As [`homogeneous`].
pub fn linear_gradient(
    height_m: f64,
    base_1_m: f64,
    top_1_m: f64,
    albedo: f64,
) -> Result<FogLayer, OpticsError> {
    check_range("fog height_m", height_m, 1e-3, 1e5)?;
    layered(&[(0.0, base_1_m), (height_m, top_1_m)], albedo)
}

/// A grey layer from rows (altitude in m, σ_t in 1/m): linear between rows, 0 outside ([`crate::layer_csv::parse_layers`]
/// reads them).
///
/// # Errors
/// If there are fewer than two rows, they do not ascend, or a value is out of range.
pub fn layered(rows: &[(f64, f64)], albedo: f64) -> Result<FogLayer, OpticsError> {
    let (altitude_m, sigma_t) = rows.iter().copied().unzip();
    FogLayer::new(altitude_m, vec![REFERENCE_NM], sigma_t, vec![albedo; rows.len()])
}

impl FogLayer {
    /// A layer from rows: `sigma_t_1_m` and `albedo` are \[altitude\]\[wavelength\].
    ///
    /// # Errors
    /// If the rows are too few, do not ascend or hold values out of range.
    pub(crate) fn new(
        altitude_m: Vec<f64>,
        wavelengths_nm: Vec<f64>,
        sigma_t: Vec<f64>,
        albedo: Vec<f64>,
    ) -> Result<Self, OpticsError> {
        let layer = Self { altitude_m, wavelengths_nm, sigma_t, albedo };
        layer.profile(0.0)?; // makes every check
        Ok(layer)
    }

    /// Altitudes of the rows in m over the datum, ascending.
    #[must_use]
    pub fn altitude_m(&self) -> &[f64] {
        &self.altitude_m
    }

    /// Altitudes of the layer's base and top in m over the datum.
    #[must_use]
    pub fn extent_m(&self) -> [f64; 2] {
        [self.altitude_m[0], self.altitude_m[self.altitude_m.len() - 1]]
    }

    /// Wavelengths of the columns in nm; a grey layer has one, which is valid for all.
    #[must_use]
    pub fn wavelengths_nm(&self) -> &[f64] {
        &self.wavelengths_nm
    }

    /// The profile that light is traced through; `datum_m`: world y of altitude 0.
    ///
    /// # Errors
    /// If the rows are too few, do not ascend or hold values out of range.
    pub fn profile(&self, datum_m: f64) -> Result<ExtinctionProfile, OpticsError> {
        let (w, s, a) = (self.wavelengths_nm.clone(), self.sigma_t.clone(), self.albedo.clone());
        Ok(ExtinctionProfile::new(datum_m, self.altitude_m.clone(), w, s, a)?)
    }

    /// σ_t in 1/m at an altitude in m and 550 nm; 0 outside the layer.
    #[must_use]
    pub fn sigma_t_at(&self, altitude_m: f64) -> f64 {
        self.interpolate(&self.sigma_t, altitude_m).unwrap_or(0.0)
    }

    /// Single-scattering albedo at an altitude in m and 550 nm; none outside the layer.
    #[must_use]
    pub fn albedo_at(&self, altitude_m: f64) -> Option<f64> {
        self.interpolate(&self.albedo, altitude_m)
    }

    fn interpolate(&self, values: &[f64], altitude_m: f64) -> Option<f64> {
        let [base, top] = self.extent_m();
        if !(base..=top).contains(&altitude_m) {
            return None;
        }
        let z = &self.altitude_m;
        let i = z.partition_point(|&a| a <= altitude_m).clamp(1, z.len() - 1);
        let t = (altitude_m - z[i - 1]) / (z[i] - z[i - 1]);
        let (low, high) = (self.reference(values, i - 1), self.reference(values, i));
        Some(low + (high - low) * t)
    }

    /// Value of a row at 550 nm: linear in wavelength, the nearest column beyond the ends.
    fn reference(&self, values: &[f64], row: usize) -> f64 {
        let w = &self.wavelengths_nm;
        let row = &values[row * w.len()..(row + 1) * w.len()];
        if let [only] = row {
            return *only;
        }
        let i = w.partition_point(|&nm| nm <= REFERENCE_NM).clamp(1, w.len() - 1);
        let t = ((REFERENCE_NM - w[i - 1]) / (w[i] - w[i - 1])).clamp(0.0, 1.0);
        row[i - 1] + (row[i] - row[i - 1]) * t
    }

    /// The layer with σ_t multiplied by `factor`, which is that of the number of droplets.
    ///
    /// # Errors
    /// If the factor is negative or not finite.
    pub fn scaled(&self, factor: f64) -> Result<Self, OpticsError> {
        check_range("extinction scale", factor, 0.0, f64::MAX)?;
        let sigma_t = self.sigma_t.iter().map(|s| s * factor).collect();
        Ok(Self { sigma_t, ..self.clone() })
    }

    /// Factor by which the number of droplets must change so that the meteorological optical range (−ln 0.05 / σ_t at
    /// 550 nm) at `altitude_m` is `mor_m`: the argument of [`FogLayer::scaled`].
    ///
    /// # Errors
    /// If the range is not in 0.1 m to 1e6 m, or there is no fog at that altitude.
    pub fn scale_for_mor(&self, mor_m: f64, altitude_m: f64) -> Result<f64, OpticsError> {
        check_range("visibility mor_m", mor_m, 0.1, 1e6)?;
        let sigma = self.sigma_t_at(altitude_m);
        if sigma > 0.0 {
            return Ok(sigma_t_from_mor(mor_m) / sigma);
        }
        let [base, top] = self.extent_m();
        let valid = format!("an altitude with fog, between {base} and {top}");
        Err(OpticsError::Range { what: "visibility altitude_m", value: altitude_m, valid })
    }

    /// The layer scaled by [`FogLayer::scale_for_mor`].
    ///
    /// # Errors
    /// As there.
    pub fn scaled_to_mor(&self, mor_m: f64, altitude_m: f64) -> Result<Self, OpticsError> {
        self.scaled(self.scale_for_mor(mor_m, altitude_m)?)
    }

    /// Mean of σ_t over altitude in 1/m at 550 nm: the paper's homogeneous fog (Sec. 6.1).
    #[must_use]
    pub fn mean_sigma_t(&self) -> f64 {
        let z = &self.altitude_m;
        let s = |i| self.reference(&self.sigma_t, i);
        let depth: f64 = (1..z.len()).map(|i| 0.5 * (z[i] - z[i - 1]) * (s(i - 1) + s(i))).sum();
        depth / (z[z.len() - 1] - z[0])
    }

    /// Least and greatest σ_t over altitude in 1/m at 550 nm: base and top of the paper's linear gradient (Sec. 6.1).
    #[must_use]
    pub fn min_max_sigma_t(&self) -> [f64; 2] {
        (0..self.altitude_m.len())
            .map(|i| self.reference(&self.sigma_t, i))
            .fold([f64::INFINITY, 0.0], |[low, high], s| [low.min(s), high.max(s)])
    }
}

/// Per-droplet quantities of an optics table between its rows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct CrossSections {
    pub(crate) c_ext_m2: f64,
    pub(crate) c_sca_m2: f64,
    pub(crate) g: f64,
}

/// Cubic (four-row Lagrange) interpolation in ζ at wavelength row `l`: about 1e-7 with rows 1/32 apart, where linear
/// interpolation is off by 1e-4.
pub(crate) fn cross_sections(view: &OpticsView<'_>, zeta: f64, l: usize) -> CrossSections {
    let (rows, w) = (view.zeta, view.wavelengths_nm.len());
    let used = rows.len().min(4);
    let first = rows.partition_point(|&z| z <= zeta).saturating_sub(2).min(rows.len() - used);
    let near = &rows[first..first + used];
    let mut sum = CrossSections { c_ext_m2: 0.0, c_sca_m2: 0.0, g: 0.0 };
    for (j, zj) in near.iter().enumerate() {
        let weight: f64 = (near.iter().enumerate())
            .filter(|&(k, _)| k != j)
            .map(|(_, zk)| (zeta - zk) / (zj - zk))
            .product();
        let cell = (first + j) * w + l;
        sum.c_ext_m2 += weight * view.c_ext_m2[cell];
        sum.c_sca_m2 += weight * view.c_sca_m2[cell];
        sum.g += weight * view.g[cell];
    }
    sum
}

/// [`cross_sections`] between the table's wavelengths, linear as a layer is; the nearest column beyond the ends.
pub(crate) fn cross_sections_at(view: &OpticsView<'_>, zeta: f64, wavelength_nm: f64) -> CrossSections {
    let w = view.wavelengths_nm;
    let upper = w.partition_point(|&nm| nm <= wavelength_nm).clamp(1, w.len().max(2) - 1).min(w.len() - 1);
    let lower = upper.saturating_sub(1);
    let t = if upper == lower { 0.0 } else { (wavelength_nm - w[lower]) / (w[upper] - w[lower]) };
    let (a, b) = (cross_sections(view, zeta, lower), cross_sections(view, zeta, upper));
    let mix = |a: f64, b: f64| a + (b - a) * t.clamp(0.0, 1.0);
    CrossSections {
        c_ext_m2: mix(a.c_ext_m2, b.c_ext_m2),
        c_sca_m2: mix(a.c_sca_m2, b.c_sca_m2),
        g: mix(a.g, b.g),
    }
}
