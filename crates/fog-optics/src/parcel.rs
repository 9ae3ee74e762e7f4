//! Droplets of one spectrum in air: number, water, extinction and visibility from one another.
//!
//! One amount and a spectrum fix everything ([`FogParcel::new`]); two amounts and a family of spectra fix the droplets'
//! size too ([`Family::fog`]).

mod family;

pub use family::Family;

use crate::advection::AdvectionModel;
use crate::error::{OpticsError, check_range};
use crate::layer::REFERENCE_NM;
use crate::lidar::BackscatterKernel;
use crate::size::{DropletMoments, MeanOptics, SizeDistribution};
use crate::visibility::{mor_m, sigma_t_from_mor};
use fog_core::math::PI;

/// How much of a spectrum there is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Amount {
    /// Number of droplets per m³ whose diameters lie in the spectrum's range, 1 to 1e13.
    Number(f64),
    /// Liquid water content in g/m³, 1e-9 to 1000.
    Water(f64),
    /// Extinction coefficient in 1/m at 550 nm, 1e-9 to 1000.
    SigmaT(f64),
    /// Meteorological optical range in m, −ln 0.05 / σ_t at 550 nm, 0.003 to 3e9.
    Mor(f64),
}

impl Amount {
    /// Refuses an amount outside of its range.
    ///
    /// # Errors
    /// With name, value, unit and range if it is.
    pub fn check(&self) -> Result<(), OpticsError> {
        match *self {
            Self::Number(n) => check_range("number density (1/m³)", n, 1.0, 1e13),
            Self::Water(w) => check_range("liquid water content (g/m³)", w, 1e-9, 1e3),
            Self::SigmaT(s) => check_range("sigma_t (1/m)", s, 1e-9, 1e3),
            Self::Mor(m) => check_range("mor_m", m, 0.003, 3e9),
        }
    }
}

/// Droplets of one spectrum, so many per m³.
#[derive(Clone, Debug, PartialEq)]
pub struct FogParcel {
    distribution: SizeDistribution,
    moments: DropletMoments,
    reference: MeanOptics,
    /// What the density per droplet is multiplied by, in 1/m³: droplets of all diameters.
    factor_1_m3: f64,
}

impl FogParcel {
    /// Fog of a spectrum in the amount given.
    ///
    /// # Errors
    /// If the amount is out of its range, or a droplet of the spectrum is too large or small for the Mie series.
    pub fn new(distribution: SizeDistribution, amount: Amount) -> Result<Self, OpticsError> {
        amount.check()?;
        let moments = distribution.moments();
        let reference = distribution.optics(REFERENCE_NM)?;
        let factor_1_m3 = match amount {
            Amount::Number(n) => n / moments.share_in_range,
            Amount::Water(w) => w / moments.mass_g,
            Amount::SigmaT(s) => s / reference.c_ext_m2,
            Amount::Mor(m) => sigma_t_from_mor(m) / reference.c_ext_m2,
        };
        Ok(Self { distribution, moments, reference, factor_1_m3 })
    }

    /// The advection fog of `model` with height `height_m`, at `altitude_m` over its base; none where it has no droplets.
    ///
    /// # Errors
    /// If the height is outside [`crate::advection::HEIGHT_RANGE_M`], or the altitude outside 0 to the height.
    pub fn advection(
        model: &AdvectionModel,
        height_m: f64,
        altitude_m: f64,
    ) -> Result<Option<Self>, OpticsError> {
        model.check_height(height_m)?;
        check_range("altitude_m in the fog", altitude_m, 0.0, height_m)?;
        let zeta = altitude_m / height_m;
        let factor_1_m3 = model.number_density_1_m3(zeta, height_m);
        if factor_1_m3 <= 0.0 {
            return Ok(None);
        }
        let distribution = model.distribution(zeta);
        let (moments, reference) = (distribution.moments(), distribution.optics(REFERENCE_NM)?);
        Ok(Some(Self { distribution, moments, reference, factor_1_m3 }))
    }

    /// The same spectrum with another number of droplets: `factor` times as many.
    ///
    /// # Errors
    /// If the factor is not in 0 to 1e6.
    pub fn scaled(&self, factor: f64) -> Result<Self, OpticsError> {
        check_range("number_density_scale", factor, 0.0, 1e6)?;
        Ok(Self { factor_1_m3: self.factor_1_m3 * factor, ..self.clone() })
    }

    /// The argument of [`FogParcel::scaled`] that makes the meteorological optical range `mor_m`.
    ///
    /// # Errors
    /// If the range is out of that of [`Amount::Mor`], or there are no droplets to be scaled.
    pub fn factor_for_mor(&self, mor_m: f64) -> Result<f64, OpticsError> {
        Amount::Mor(mor_m).check()?;
        check_range(
            "sigma_t (1/m) that is to be scaled",
            self.sigma_t_550_1_m(),
            f64::MIN_POSITIVE,
            f64::MAX,
        )?;
        Ok(sigma_t_from_mor(mor_m) / self.sigma_t_550_1_m())
    }

    /// The spectrum.
    #[must_use]
    pub fn distribution(&self) -> &SizeDistribution {
        &self.distribution
    }

    /// Sums over the spectrum, per droplet.
    #[must_use]
    pub fn moments(&self) -> &DropletMoments {
        &self.moments
    }

    /// Droplets per m³ whose diameters lie in the spectrum's range.
    #[must_use]
    pub fn number_density_1_m3(&self) -> f64 {
        self.factor_1_m3 * self.moments.share_in_range
    }

    /// Liquid water content in g/m³.
    #[must_use]
    pub fn liquid_water_content_g_m3(&self) -> f64 {
        self.factor_1_m3 * self.moments.mass_g
    }

    /// Extinction coefficient in 1/m at 550 nm.
    #[must_use]
    pub fn sigma_t_550_1_m(&self) -> f64 {
        self.factor_1_m3 * self.reference.c_ext_m2
    }

    /// Meteorological optical range in m, −ln 0.05 / σ_t at 550 nm.
    #[must_use]
    pub fn mor_m(&self) -> f64 {
        mor_m(self.sigma_t_550_1_m())
    }

    /// Everything at a wavelength in nm, by the Mie series.
    ///
    /// # Errors
    /// If the wavelength is outside [`crate::water::WAVELENGTH_RANGE_NM`], or a droplet outside the range of [`crate::mie`].
    pub fn optics(&self, wavelength_nm: f64) -> Result<FogOptics, OpticsError> {
        self.optics_with(&BackscatterKernel::new(self.distribution.grid(), wavelength_nm)?)
    }

    /// As [`FogParcel::optics`], with a kernel for the spectrum's diameters that several fogs share: it takes most of the
    /// time.
    ///
    /// # Errors
    /// As there, or if the kernel is for other diameters.
    pub fn optics_with(&self, kernel: &BackscatterKernel) -> Result<FogOptics, OpticsError> {
        let wavelength_nm = kernel.wavelength_nm();
        let mean = if wavelength_nm == REFERENCE_NM {
            self.reference
        } else {
            self.distribution.optics(wavelength_nm)?
        };
        let c_back_m2_sr = kernel.cross_section_m2_sr(&self.distribution)?;
        let area_m2 = 0.25 * PI * self.distribution.moment(2) * 1e-12;
        let n = self.factor_1_m3;
        Ok(FogOptics {
            wavelength_nm,
            q_ext: mean.c_ext_m2 / area_m2,
            q_sca: mean.c_sca_m2 / area_m2,
            q_back: 4.0 * PI * c_back_m2_sr / area_m2,
            g: mean.g,
            sigma_t_1_m: n * mean.c_ext_m2,
            sigma_s_1_m: n * mean.c_sca_m2,
            albedo: (mean.c_sca_m2 / mean.c_ext_m2).clamp(0.0, 1.0),
            backscatter_1_m_sr: n * c_back_m2_sr,
            lidar_ratio_sr: mean.c_ext_m2 / c_back_m2_sr,
        })
    }
}

/// A fog's optical quantities at one wavelength. Efficiencies are means weighted by the droplets' cross-sectional areas.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FogOptics {
    /// Wavelength in nm.
    pub wavelength_nm: f64,
    /// Extinction efficiency.
    pub q_ext: f64,
    /// Scattering efficiency.
    pub q_sca: f64,
    /// Backscattering efficiency in the convention of [`crate::mie::Efficiencies`].
    pub q_back: f64,
    /// Mean cosine of the scattering angle.
    pub g: f64,
    /// Extinction coefficient in 1/m.
    pub sigma_t_1_m: f64,
    /// Scattering coefficient in 1/m.
    pub sigma_s_1_m: f64,
    /// Single-scattering albedo.
    pub albedo: f64,
    /// Backscatter coefficient β = σ_s p(180°) in 1/(m sr).
    pub backscatter_1_m_sr: f64,
    /// Lidar ratio S = σ_t / β in sr.
    pub lidar_ratio_sr: f64,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_amount_leads_back_to_every_other() {
        let fog = FogParcel::new(SizeDistribution::gamma(6.0, 0.12).unwrap(), Amount::Number(1e8)).unwrap();
        let amounts = [
            Amount::Number(fog.number_density_1_m3()),
            Amount::Water(fog.liquid_water_content_g_m3()),
            Amount::SigmaT(fog.sigma_t_550_1_m()),
            Amount::Mor(fog.mor_m()),
        ];
        for amount in amounts {
            let again = FogParcel::new(fog.distribution().clone(), amount).unwrap();
            assert!((again.number_density_1_m3() / 1e8 - 1.0).abs() < 1e-12, "{amount:?}");
            assert!((again.mor_m() / fog.mor_m() - 1.0).abs() < 1e-12, "{amount:?}");
        }
        // Large droplets cast twice their shadow: σ_t ≈ 2 · 3 W / (4 ρ r_eff), a little more at x = 68.
        let geometric = 1.5 * fog.liquid_water_content_g_m3() / (1e6 * 6e-6);
        let ratio = fog.sigma_t_550_1_m() / geometric;
        assert!(ratio > 1.02 && ratio < 1.10, "{ratio}");
    }

    #[test]
    fn optics_fit_together() {
        let fog = FogParcel::new(SizeDistribution::gamma(6.0, 0.12).unwrap(), Amount::Mor(200.0)).unwrap();
        let at_550 = fog.optics(550.0).unwrap();
        assert_eq!(at_550.sigma_t_1_m, fog.sigma_t_550_1_m());
        assert!(at_550.albedo > 0.99999 && at_550.q_ext >= at_550.q_sca);
        let at_1550 = fog.optics(1550.0).unwrap();
        assert!(at_1550.albedo < 0.9995 && at_1550.sigma_s_1_m < at_1550.sigma_t_1_m);
        let ratio = at_1550.sigma_t_1_m / at_1550.backscatter_1_m_sr;
        assert!((ratio / at_1550.lidar_ratio_sr - 1.0).abs() < 1e-12);
        // p(180°) two ways: from β, and from Q_back.
        let p = at_550.backscatter_1_m_sr / at_550.sigma_s_1_m;
        assert!((at_550.q_back / (4.0 * PI * at_550.q_sca) / p - 1.0).abs() < 1e-12);
        assert!(fog.optics(100.0).is_err());
    }

    #[test]
    fn the_model_s_fog_is_that_of_its_layer() {
        let model = AdvectionModel::arcata().unwrap();
        let fog = FogParcel::advection(&model, 180.0, 60.0).unwrap().unwrap();
        let wanted =
            model.number_density_1_m3(60.0 / 180.0, 180.0) * model.moments(60.0 / 180.0).share_in_range;
        assert!((fog.number_density_1_m3() / wanted - 1.0).abs() < 1e-12);
        assert!((fog.scaled(2.0).unwrap().mor_m() / fog.mor_m() - 0.5).abs() < 1e-12);
        for (height, altitude) in
            [(0.0, 0.0), (5000.0, 2.0), (180.0, 181.0), (180.0, -1.0), (180.0, f64::NAN)]
        {
            assert!(FogParcel::advection(&model, height, altitude).is_err(), "{height} {altitude}");
        }
    }

    #[test]
    fn nonsense_is_refused() {
        let spectrum = SizeDistribution::gamma(6.0, 0.12).unwrap();
        for bad in [Amount::Number(0.0), Amount::Water(-0.1), Amount::SigmaT(f64::NAN), Amount::Mor(0.0)] {
            assert!(FogParcel::new(spectrum.clone(), bad).is_err(), "{bad:?}");
        }
    }
}
