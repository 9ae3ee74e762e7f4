//! What the droplets of a spectrum do to light, by the Mie series.

use super::{DiameterSampler, SizeDistribution};
use crate::error::OpticsError;
use crate::mie::MieSeries;
use crate::water;
use fog_core::math::PI;
use rayon::prelude::*;

/// Means over the droplets of a spectrum, per droplet (not renormalised over the range of diameters).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MeanOptics {
    /// Extinction cross section in m².
    pub c_ext_m2: f64,
    /// Scattering cross section in m².
    pub c_sca_m2: f64,
    /// Mean cosine of the scattering angle.
    pub g: f64,
    /// Differential cross section at 180° in m²/sr, unpolarised: times N it is the lidar's backscatter coefficient in
    /// 1/(m sr), and c_ext over it the lidar ratio in sr.
    pub c_back_m2_sr: f64,
}

/// Cross sections of one droplet.
#[derive(Clone, Copy, Debug)]
struct Droplet {
    ext: f64,
    sca: f64,
    sca_cosine: f64,
    back: f64,
}

impl SizeDistribution {
    /// Means over the droplets at a wavelength in nm: C = ∫ n̂ Q π d²/4 dd by the trapezoidal rule over the grid, Q from the
    /// Mie series of water; g = ∫ n̂ C_sca g dd / C_sca.
    ///
    /// Runs on rayon's threads; the order of the sums is fixed.
    ///
    /// # Errors
    /// If the wavelength is outside [`water::WAVELENGTH_RANGE_NM`], or a droplet outside the range of [`crate::mie`].
    pub fn optics(&self, wavelength_nm: f64) -> Result<MeanOptics, OpticsError> {
        let droplets = self.droplets(wavelength_nm)?;
        let sum = |f: fn(&Droplet) -> f64| -> f64 {
            let terms = droplets.iter().zip(&self.nodes).enumerate();
            terms.map(|(i, (droplet, n))| self.grid.weight_um(i) * n * f(droplet)).sum()
        };
        let c_sca_m2 = sum(|d| d.sca);
        Ok(MeanOptics {
            c_ext_m2: sum(|d| d.ext),
            c_sca_m2,
            g: sum(|d| d.sca_cosine) / c_sca_m2,
            c_back_m2_sr: sum(|d| d.back),
        })
    }

    /// Draws the diameter of the droplet that light of a wavelength (nm) meets: the density is ∝ n(d) C_ext(d), linear
    /// between the grid's diameters.
    ///
    /// # Errors
    /// As [`SizeDistribution::optics`].
    pub fn by_extinction(&self, wavelength_nm: f64) -> Result<DiameterSampler, OpticsError> {
        let droplets = self.droplets(wavelength_nm)?;
        let weights = droplets.iter().zip(&self.nodes).map(|(droplet, n)| n * droplet.ext).collect();
        Ok(DiameterSampler::new(self.grid, weights))
    }

    /// The grid's droplets, in its order.
    fn droplets(&self, wavelength_nm: f64) -> Result<Vec<Droplet>, OpticsError> {
        let m = water::refractive_index(wavelength_nm)?;
        (0..self.grid.count())
            .into_par_iter()
            .map(|i| {
                let d_um = self.grid.diameter_um(i);
                let q = MieSeries::new(m, PI * d_um * 1e3 / wavelength_nm)?.efficiencies();
                let area_m2 = 0.25 * PI * d_um * d_um * 1e-12;
                let sca = q.q_sca * area_m2;
                // |S1(180°)|²/k² = Q_back d²/16 in the convention of `Efficiencies`.
                let back = q.q_back * area_m2 / (4.0 * PI);
                Ok(Droplet { ext: q.q_ext * area_m2, sca, sca_cosine: sca * q.g, back })
            })
            .collect()
    }
}
