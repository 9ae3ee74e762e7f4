//! Visual ranges along any straight path through a layer, from exact optical depths.
//!
//! The layer depends on altitude alone, so that every straight path between two altitudes crosses the same mean
//! extinction; only its length depends on the slope.

use super::allard::allard_m;
use super::koschmieder::{KOSCHMIEDER_OPTICAL_DEPTH, MOR_OPTICAL_DEPTH};
use crate::error::{OpticsError, check_range};
use crate::layer::{FogLayer, REFERENCE_NM};
use fog_core::math::PI;
use fog_core::math::f64::{exp, ln, sin};
use fog_core::profile::ExtinctionProfile;
use fog_core::spectrum::Wavelengths;

/// What is looked for, and when it is seen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Law {
    /// A dark object at 5 % contrast: optical depth −ln 0.05.
    Mor,
    /// A dark object at 2 % contrast: optical depth 3.912.
    Koschmieder,
    /// A light of some intensity in cd at an illuminance threshold in lx.
    Allard {
        /// Luminous intensity in cd, > 0.
        intensity_cd: f64,
        /// Threshold in lx, > 0.
        threshold_lx: f64,
    },
}

impl Law {
    /// Range in m through an even extinction coefficient `sigma_t_1_m` (1/m).
    #[must_use]
    pub fn range_m(&self, sigma_t_1_m: f64) -> f64 {
        match *self {
            Self::Mor => MOR_OPTICAL_DEPTH / sigma_t_1_m,
            Self::Koschmieder => KOSCHMIEDER_OPTICAL_DEPTH / sigma_t_1_m,
            Self::Allard { intensity_cd, threshold_lx } => allard_m(intensity_cd, threshold_lx, sigma_t_1_m),
        }
    }

    fn check(&self) -> Result<(), OpticsError> {
        if let Self::Allard { intensity_cd, threshold_lx } = *self {
            check_range("light intensity (cd)", intensity_cd, 1e-6, 1e12)?;
            check_range("illuminance threshold (lx)", threshold_lx, 1e-12, 1e6)?;
        }
        Ok(())
    }
}

/// Altitudes in m that a sight may begin or end at.
const ALTITUDE_RANGE_M: [f64; 2] = [-1e5, 1e5];

/// Sight through a layer at one wavelength.
#[derive(Clone, Debug)]
pub struct Sight {
    profile: ExtinctionProfile,
    wavelength_nm: f64,
}

impl Sight {
    /// Sight through `layer` at 550 nm.
    ///
    /// # Errors
    /// If the layer's rows hold values out of range.
    pub fn new(layer: &FogLayer) -> Result<Self, OpticsError> {
        Self::at(layer, REFERENCE_NM)
    }

    /// Sight at another wavelength in nm; beyond the layer's wavelengths the nearest one counts.
    ///
    /// # Errors
    /// As [`Sight::new`], or if the wavelength is not in 100 to 1e5 nm.
    pub fn at(layer: &FogLayer, wavelength_nm: f64) -> Result<Self, OpticsError> {
        check_range("wavelength_nm", wavelength_nm, 100.0, 1e5)?;
        Ok(Self { profile: layer.profile(0.0)?, wavelength_nm })
    }

    /// Extinction coefficient in 1/m at an altitude in m; 0 outside the layer.
    #[must_use]
    pub fn sigma_t(&self, altitude_m: f64) -> f64 {
        self.profile.sigma_t_at(altitude_m, self.wavelength_nm)
    }

    /// Optical depth from an altitude (m) along an elevation angle (degrees, −90 straight down to 90 straight up) over a
    /// distance in m, which may be infinite.
    ///
    /// # Errors
    /// If an argument is out of range.
    pub fn optical_depth(
        &self,
        altitude_m: f64,
        elevation_deg: f64,
        distance_m: f64,
    ) -> Result<f64, OpticsError> {
        let rise = rise(altitude_m, elevation_deg)?;
        check_range("distance_m", distance_m, 0.0, f64::INFINITY)?;
        Ok(self.profile.optical_depth_at(altitude_m, rise, distance_m, self.wavelength_nm))
    }

    /// Mean extinction coefficient in 1/m of every straight path between two altitudes in m: that at the altitude if they
    /// are equal.
    ///
    /// # Errors
    /// If an altitude is out of range.
    pub fn mean_sigma_t(&self, from_m: f64, to_m: f64) -> Result<f64, OpticsError> {
        check_altitude(from_m)?;
        check_altitude(to_m)?;
        let (low, high) = (from_m.min(to_m), from_m.max(to_m));
        if high - low < 1e-9 {
            return Ok(self.sigma_t(low));
        }
        Ok(self.profile.optical_depth_at(low, 1.0, high - low, self.wavelength_nm) / (high - low))
    }

    /// Optical depth between two points: two altitudes in m, and the horizontal distance between them in m.
    ///
    /// # Errors
    /// If an altitude or the distance is out of range.
    pub fn optical_depth_between(&self, from_m: f64, to_m: f64, across_m: f64) -> Result<f64, OpticsError> {
        let mean = self.mean_sigma_t(from_m, to_m)?;
        Ok(mean * path_length_m(from_m, to_m, across_m)?)
    }

    /// Horizontal range in m at an altitude in m; +inf where nothing limits it.
    ///
    /// # Errors
    /// If the altitude or a number of the law is out of range.
    pub fn horizontal_m(&self, law: &Law, altitude_m: f64) -> Result<f64, OpticsError> {
        law.check()?;
        check_altitude(altitude_m)?;
        Ok(law.range_m(self.sigma_t(altitude_m)))
    }

    /// Range in m from an altitude (m) along an elevation angle (degrees): where the path's optical depth τ(R) reaches the
    /// law's threshold, or, for a light, where I e^(−τ(R)) / R² = E_T. +inf if that is nowhere (a dark object is then seen
    /// through the rest of the layer). The ground does not end it.
    ///
    /// # Errors
    /// If an argument or a number of the law is out of range.
    pub fn along_m(&self, law: &Law, altitude_m: f64, elevation_deg: f64) -> Result<f64, OpticsError> {
        law.check()?;
        let rise = rise(altitude_m, elevation_deg)?;
        let lanes = self.profile.lanes(&Wavelengths::monochromatic(self.wavelength_nm as f32));
        let at_depth = |tau| self.profile.free_flight(altitude_m, rise, f64::INFINITY, tau, &lanes);
        Ok(match *law {
            Law::Mor => at_depth(MOR_OPTICAL_DEPTH).unwrap_or(f64::INFINITY),
            Law::Koschmieder => at_depth(KOSCHMIEDER_OPTICAL_DEPTH).unwrap_or(f64::INFINITY),
            Law::Allard { intensity_cd, threshold_lx } => {
                self.light_along_m(intensity_cd, threshold_lx, altitude_m, rise)
            }
        })
    }

    /// Greatest distance in m along a straight path from one altitude to another from which the law is met: how far away,
    /// measured along the slant, the pilot at `from_m` sees things at `to_m`. None if they are not even seen straight
    /// below (or above), at |from − to|. +inf where nothing limits it.
    ///
    /// # Errors
    /// If an altitude or a number of the law is out of range.
    pub fn to_altitude_m(&self, law: &Law, from_m: f64, to_m: f64) -> Result<Option<f64>, OpticsError> {
        law.check()?;
        let range = law.range_m(self.mean_sigma_t(from_m, to_m)?);
        Ok(Some(range).filter(|&r| r >= (from_m - to_m).abs()))
    }

    /// Root over R of τ(R) + 2 ln R = ln(I/E_T), whose left side rises. In clear air R would be √(I/E_T): the root is not
    /// beyond that.
    fn light_along_m(&self, intensity_cd: f64, threshold_lx: f64, altitude_m: f64, rise: f64) -> f64 {
        let wanted = ln(intensity_cd) - ln(threshold_lx);
        let (mut low, mut high) = (0.0, (intensity_cd / threshold_lx).sqrt());
        loop {
            let r = 0.5 * (low + high);
            if r <= low || r >= high {
                return high;
            }
            let tau = self.profile.optical_depth_at(altitude_m, rise, r, self.wavelength_nm);
            if tau + 2.0 * ln(r) < wanted { low = r } else { high = r }
        }
    }
}

fn check_altitude(altitude_m: f64) -> Result<(), OpticsError> {
    check_range("altitude_m", altitude_m, ALTITUDE_RANGE_M[0], ALTITUDE_RANGE_M[1])
}

/// Share of light that crosses an optical depth without being scattered or absorbed, e^(−τ): also the contrast of a dark
/// object against the sky behind it.
#[must_use]
pub fn transmittance(optical_depth: f64) -> f64 {
    exp(-optical_depth)
}

/// Length in m of the straight path between two altitudes in m that are `across_m` apart horizontally.
///
/// # Errors
/// If an altitude or the distance is out of range.
pub fn path_length_m(from_m: f64, to_m: f64, across_m: f64) -> Result<f64, OpticsError> {
    check_altitude(from_m)?;
    check_altitude(to_m)?;
    check_range("horizontal distance_m", across_m, 0.0, 1e7)?;
    Ok(((from_m - to_m) * (from_m - to_m) + across_m * across_m).sqrt())
}

/// Distance in m from one altitude to another along an elevation angle in degrees; none where the line does not lead there.
/// 0 if they are equal.
///
/// # Errors
/// If an altitude or the angle is out of range.
pub fn distance_to_altitude_m(
    from_m: f64,
    to_m: f64,
    elevation_deg: f64,
) -> Result<Option<f64>, OpticsError> {
    check_altitude(to_m)?;
    let climb = to_m - from_m;
    let rise = rise(from_m, elevation_deg)?;
    Ok(match climb {
        0.0 => Some(0.0),
        _ => Some(climb / rise).filter(|d| *d > 0.0 && d.is_finite()),
    })
}

/// Metres of altitude per metre of path.
fn rise(altitude_m: f64, elevation_deg: f64) -> Result<f64, OpticsError> {
    check_altitude(altitude_m)?;
    check_range("elevation angle (degrees)", elevation_deg, -90.0, 90.0)?;
    Ok(sin(elevation_deg * PI / 180.0))
}

#[cfg(test)]
mod tests;
