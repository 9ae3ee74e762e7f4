//! A fog of droplets: any spectrum with any vertical profile of number density, over a layer of given thickness.

use crate::advection::AdvectionModel;
use crate::error::{OpticsError, check_range};
use crate::size::SizeDistribution;
use crate::vertical::VerticalProfile;

/// Least and greatest thickness of a layer in m. An advection model has a range of its own
/// ([`crate::advection::HEIGHT_RANGE_M`]).
pub const HEIGHT_RANGE_M: [f64; 2] = [1.0, 5000.0];

/// Greatest number density in 1/m³ that a fog may have: far more than the 10¹⁰ of the densest measured fogs.
const MAX_NUMBER_1_M3: f64 = 1e15;

/// Droplet spectra by relative altitude.
#[derive(Clone, Debug, PartialEq)]
pub enum Spectra {
    /// The same spectrum at every altitude.
    Same(SizeDistribution),
    /// The spectra of an advection model by altitude (Kolářová, Lachiver & Wilkie 2024).
    Advection(AdvectionModel),
}

impl Spectra {
    /// The spectrum at relative altitude ζ = z/H, clamped to [0, 1].
    #[must_use]
    pub fn distribution(&self, zeta: f64) -> SizeDistribution {
        match self {
            Self::Same(distribution) => distribution.clone(),
            Self::Advection(model) => model.distribution(zeta),
        }
    }
}

/// Spectra, numbers and thickness of a fog layer.
#[derive(Clone, Debug, PartialEq)]
pub struct DropletLayer {
    spectra: Spectra,
    profile: VerticalProfile,
    number_density_1_m3: f64,
    height_m: f64,
}

impl DropletLayer {
    /// A fog with `number_density_1_m3` droplets per m³ in the mean over its altitudes, of all diameters
    /// ([`SizeDistribution::share_in_range`] of them lie in the spectrum's range), distributed over altitude by `profile`, in
    /// a layer of `height_m`, 1 to 5000.
    ///
    /// # Errors
    /// If the height or the number density (0 to 1e15 1/m³) is out of range.
    pub fn new(
        spectra: Spectra,
        profile: VerticalProfile,
        number_density_1_m3: f64,
        height_m: f64,
    ) -> Result<Self, OpticsError> {
        check_range("fog height_m", height_m, HEIGHT_RANGE_M[0], HEIGHT_RANGE_M[1])?;
        check_range("number_density_1_m3", number_density_1_m3, 0.0, MAX_NUMBER_1_M3)?;
        Ok(Self { spectra, profile, number_density_1_m3, height_m })
    }

    /// The fog of an advection model with a height in m: its spectra and its scaling matrix.
    ///
    /// # Errors
    /// If the height is outside [`crate::advection::HEIGHT_RANGE_M`].
    pub fn advection(model: &AdvectionModel, height_m: f64) -> Result<Self, OpticsError> {
        let (profile, mean_1_m3) = VerticalProfile::advection(model, height_m)?;
        Self::new(Spectra::Advection(model.clone()), profile, mean_1_m3, height_m)
    }

    /// The same fog with `factor` times as many droplets, 0 to 1e6.
    ///
    /// # Errors
    /// If the factor is out of range, or the number density becomes so.
    pub fn scaled(self, factor: f64) -> Result<Self, OpticsError> {
        check_range("number_density_scale", factor, 0.0, 1e6)?;
        let number = self.number_density_1_m3 * factor;
        Self::new(self.spectra, self.profile, number, self.height_m)
    }

    /// Spectra by relative altitude.
    #[must_use]
    pub fn spectra(&self) -> &Spectra {
        &self.spectra
    }

    /// Thickness of the layer in m.
    #[must_use]
    pub fn height_m(&self) -> f64 {
        self.height_m
    }

    /// Mean over altitude of the number density in 1/m³.
    #[must_use]
    pub fn mean_number_density_1_m3(&self) -> f64 {
        self.number_density_1_m3
    }

    /// Number density in 1/m³ at relative altitude ζ, of all diameters; 0 outside of 0 to 1.
    #[must_use]
    pub fn number_density_1_m3(&self, zeta: f64) -> f64 {
        self.number_density_1_m3 * self.profile.at(zeta)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn wrong_heights_and_numbers_are_refused() {
        let gamma = Spectra::Same(SizeDistribution::gamma(5.0, 0.1).unwrap());
        let fog =
            |number, height| DropletLayer::new(gamma.clone(), VerticalProfile::uniform(), number, height);
        for bad in [0.0, -10.0, 5001.0, f64::NAN] {
            assert!(fog(1e8, bad).unwrap_err().to_string().contains("fog height_m"), "{bad}");
        }
        for bad in [-1.0, 1e16, f64::NAN] {
            assert!(fog(bad, 50.0).unwrap_err().to_string().contains("number_density_1_m3"), "{bad}");
        }
        assert!(fog(1e8, 50.0).unwrap().scaled(-1.0).is_err());
        let twice = fog(1e8, 50.0).unwrap().scaled(2.0).unwrap();
        assert_eq!((twice.number_density_1_m3(0.5), twice.number_density_1_m3(1.1)), (2e8, 0.0));
    }

    #[test]
    fn advection_fog_is_its_models() {
        let model = AdvectionModel::arcata().unwrap();
        let fog = DropletLayer::advection(&model, 180.0).unwrap();
        let n = fog.number_density_1_m3(0.75) / model.number_density_1_m3(0.75, 180.0);
        assert!((n - 1.0).abs() < 1e-13);
        assert_eq!(fog.spectra().distribution(0.3), model.distribution(0.3));
    }
}
