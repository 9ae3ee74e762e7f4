//! What a lidar sees of droplets: extinction, backscatter and their ratio, by polydisperse Mie scattering.
//!
//! β = σ_s p(180°) in 1/(m sr), with the phase function p in 1/sr normalised to 1 over the sphere; the lidar ratio is
//! S = σ_t / β in sr. Single scattering: a real beam in fog also returns light scattered several times forward.

use crate::distribution::DiameterGrid;
use crate::error::{OpticsError, check_range};
use crate::mie::{Complex64, MieSeries};
use crate::parcel::FogParcel;
use crate::size::SizeDistribution;
use crate::water;
use fog_core::math::PI;
use rayon::prelude::*;

/// Wavelengths in nm for which [`Lidar`] is offered.
pub const WAVELENGTH_RANGE_NM: [f64; 2] = [300.0, 2500.0];

/// Wavelengths that are used together, by name.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Preset {
    /// Name by which it is asked for.
    pub name: &'static str,
    /// Wavelengths in nm.
    pub wavelengths_nm: &'static [f64],
}

/// Diode lasers of automotive lidars and ceilometers (905 nm), eye-safe fibre lasers (1550 nm), and the visible range in
/// steps of 50 nm.
pub const PRESETS: [Preset; 3] = [
    Preset { name: "lidar_905", wavelengths_nm: &[905.0] },
    Preset { name: "lidar_1550", wavelengths_nm: &[1550.0] },
    Preset { name: "visible", wavelengths_nm: &[400.0, 450.0, 500.0, 550.0, 600.0, 650.0, 700.0] },
];

/// The preset of a name of [`PRESETS`].
#[must_use]
pub fn preset(name: &str) -> Option<Preset> {
    PRESETS.into_iter().find(|p| p.name == name)
}

/// Widest step of the size parameter x = πd/λ between spheres at which backscatter is taken. It has narrow resonances:
/// steps of 0.05 leave errors below 2 % for gamma spectra of effective radii of 2 to 10 µm, steps of 0.1 µm over 10 %.
const STEP_X: f64 = 0.05;

/// What a lidar needs to know of a fog.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lidar {
    /// Wavelength in nm.
    pub wavelength_nm: f64,
    /// Extinction coefficient σ_t in 1/m.
    pub sigma_t_1_m: f64,
    /// Backscatter coefficient β in 1/(m sr).
    pub backscatter_1_m_sr: f64,
    /// Lidar ratio σ_t / β in sr.
    pub lidar_ratio_sr: f64,
}

impl Lidar {
    /// Of a fog at a wavelength in nm.
    ///
    /// # Errors
    /// If the wavelength is outside [`WAVELENGTH_RANGE_NM`], or a droplet outside the range of [`crate::mie`].
    pub fn new(fog: &FogParcel, wavelength_nm: f64) -> Result<Self, OpticsError> {
        check_range("wavelength_nm", wavelength_nm, WAVELENGTH_RANGE_NM[0], WAVELENGTH_RANGE_NM[1])?;
        let optics = fog.optics(wavelength_nm)?;
        Ok(Self {
            wavelength_nm,
            sigma_t_1_m: optics.sigma_t_1_m,
            backscatter_1_m_sr: optics.backscatter_1_m_sr,
            lidar_ratio_sr: optics.lidar_ratio_sr,
        })
    }
}

/// Backscatter of the spheres of a grid of diameters at one wavelength: what spectra over that grid share.
#[derive(Clone, Debug)]
pub struct BackscatterKernel {
    grid: DiameterGrid,
    wavelength_nm: f64,
    /// Weight of the density at each of the grid's diameters, in m² µm/sr.
    weights: Vec<f64>,
}

impl BackscatterKernel {
    /// Spheres of water of the diameters of `grid` and between them, in steps of at most 0.05 in size parameter, at a
    /// wavelength in nm. Runs on rayon's threads; the order of the sums is fixed.
    ///
    /// # Errors
    /// If the wavelength is outside [`water::WAVELENGTH_RANGE_NM`], or a sphere outside the range of [`crate::mie`].
    pub fn new(grid: &DiameterGrid, wavelength_nm: f64) -> Result<Self, OpticsError> {
        Self::with_steps(grid, wavelength_nm, STEP_X)
    }

    fn with_steps(grid: &DiameterGrid, wavelength_nm: f64, step_x: f64) -> Result<Self, OpticsError> {
        let m = water::refractive_index(wavelength_nm)?;
        let between: Vec<[f64; 2]> = (1..grid.count())
            .into_par_iter()
            .map(|i| between(m, wavelength_nm, [grid.diameter_um(i - 1), grid.diameter_um(i)], step_x))
            .collect::<Result<_, OpticsError>>()?;
        let mut weights = vec![0.0; grid.count()];
        for (i, [low, high]) in between.iter().enumerate() {
            weights[i] += low;
            weights[i + 1] += high;
        }
        Ok(Self { grid: *grid, wavelength_nm, weights })
    }

    /// Wavelength in nm.
    #[must_use]
    pub fn wavelength_nm(&self) -> f64 {
        self.wavelength_nm
    }

    /// Differential cross section at 180° in m²/sr, per droplet of a spectrum: ∫ n̂ Q_back d²/16 dd, with n̂ linear between
    /// the grid's diameters.
    ///
    /// # Errors
    /// If the spectrum is over another grid.
    pub fn cross_section_m2_sr(&self, spectrum: &SizeDistribution) -> Result<f64, OpticsError> {
        if *spectrum.grid() != self.grid {
            return Err(OpticsError::Settings("backscatter of a spectrum over other diameters".to_owned()));
        }
        Ok(spectrum.densities_1_um().iter().zip(&self.weights).map(|(n, w)| n * w).sum())
    }
}

/// ∫ Q_back d²/16 (1 − t) dd and ∫ Q_back d²/16 t dd in m² µm/sr between two diameters in µm, with t from 0 to 1 between
/// them, by the trapezoidal rule.
fn between(
    m: Complex64,
    wavelength_nm: f64,
    [a_um, b_um]: [f64; 2],
    step_x: f64,
) -> Result<[f64; 2], OpticsError> {
    let x_per_um = PI * 1e3 / wavelength_nm;
    let parts = ((b_um - a_um) * x_per_um / step_x).ceil().max(1.0) as usize;
    let h = (b_um - a_um) / parts as f64;
    let mut sums = [0.0; 2];
    for j in 0..=parts {
        let t = j as f64 / parts as f64;
        let d_um = a_um + (b_um - a_um) * t;
        let weight = if j == 0 || j == parts { 0.5 * h } else { h };
        let q_back = MieSeries::new(m, x_per_um * d_um)?.efficiencies().q_back;
        let term = weight * q_back * d_um * d_um * 1e-12 / 16.0;
        sums[0] += term * (1.0 - t);
        sums[1] += term * t;
    }
    Ok(sums)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::parcel::Amount;
    use crate::size::ModifiedGamma;

    #[test]
    fn finer_steps_change_little() {
        for (radius, variance, nm) in
            [(2.0, 0.1, 905.0), (5.0, 0.1, 905.0), (10.0, 0.03, 1550.0), (5.0, 0.1, 550.0)]
        {
            let spectrum = SizeDistribution::gamma(radius, variance).unwrap();
            let with = |step_x| {
                let kernel = BackscatterKernel::with_steps(spectrum.grid(), nm, step_x).unwrap();
                kernel.cross_section_m2_sr(&spectrum).unwrap()
            };
            let ratio = with(STEP_X) / with(STEP_X / 3.0);
            assert!((ratio - 1.0).abs() < 0.02, "{radius} {variance} {nm}: {ratio}");
        }
    }

    #[test]
    fn a_kernel_is_for_its_own_diameters() {
        let (a, b) = (SizeDistribution::gamma(2.0, 0.1).unwrap(), SizeDistribution::gamma(3.0, 0.1).unwrap());
        let kernel = BackscatterKernel::new(a.grid(), 1550.0).unwrap();
        assert!(kernel.cross_section_m2_sr(&a).is_ok() && kernel.cross_section_m2_sr(&b).is_err());
        assert!(BackscatterKernel::new(a.grid(), 50.0).is_err());
    }

    #[test]
    fn water_clouds_have_a_lidar_ratio_near_19_sr() {
        // O'Connor, Illingworth & Hogan, J. Atmos. Oceanic Technol. 21, 777 (2004): 18.8 ± 0.8 sr at 905 nm for
        // stratocumulus droplets, over gamma distributions.
        for (radius, variance) in [(5.0, 0.1), (8.0, 0.1), (10.0, 0.15)] {
            let fog = FogParcel::new(SizeDistribution::gamma(radius, variance).unwrap(), Amount::Mor(100.0))
                .unwrap();
            let lidar = Lidar::new(&fog, 905.0).unwrap();
            assert!((17.5..20.5).contains(&lidar.lidar_ratio_sr), "{radius} {variance}: {lidar:?}");
        }
        let c1 = ModifiedGamma { alpha: 6.0, b: 1.5, gamma: 1.0 };
        let fog = FogParcel::new(SizeDistribution::modified_gamma(c1).unwrap(), Amount::Number(1e8)).unwrap();
        let lidar = Lidar::new(&fog, 905.0).unwrap();
        assert!((17.5..20.5).contains(&lidar.lidar_ratio_sr), "C1: {lidar:?}");
        assert!(Lidar::new(&fog, 299.0).is_err() && Lidar::new(&fog, 2501.0).is_err());
    }

    #[test]
    fn presets_have_names() {
        assert!(PRESETS.iter().all(|p| preset(p.name) == Some(*p)));
        assert_eq!(preset("radar"), None);
    }
}
