//! Runway visual range: over which the pilot of an aircraft on the centre line sees the runway's markings or its lights
//! (ICAO Annex 3, definitions; how it is assessed: Doc 9328, *Manual of Runway Visual Range Observing and Reporting
//! Practices*, 3rd edition 2005).
//!
//! The range of the markings follows from Koschmieder's law at 5 % contrast, that of the lights from Allard's law; the
//! greater of both is the RVR. Near the threshold the pilot follows the centre-line lights, farther away the edge lights.
//!
//! The numbers below are those of the documents named, as they are commonly reprinted; where a text could be compared, its
//! constant says so.

use super::allard::allard_m;
use super::koschmieder::mor_m;
use crate::error::{OpticsError, check_range};
use core::fmt;

/// Height in m over the runway at which extinction is assessed: "approximately 2.5 m" (Annex 3, Appendix 3, 4.3.1.1;
/// compared with the 16th edition, 2007).
pub const ASSESSMENT_HEIGHT_M: f64 = 2.5;

/// Height in m of a pilot's eye over the runway in the touchdown zone that RVR stands for: about 5 m (Doc 9328).
pub const PILOT_EYE_HEIGHT_M: f64 = 5.0;

/// RVR in m up to which the centre-line lights count, and from which on the edge lights do; between them the intensity is
/// linear in the range (practice described in Doc 9328; the text could not be compared).
pub const TRANSITION_M: [f64; 2] = [200.0, 550.0];

/// Lights of a runway, as they shine towards the pilot.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RunwayLights {
    /// Intensity of the edge lights at full brightness, in cd.
    pub edge_cd: f64,
    /// Intensity of the centre-line lights at full brightness, in cd.
    pub centre_line_cd: f64,
    /// Brightness setting in per cent of the full intensity; stages of 100, 30, 10, 3 and 1 % are common.
    pub setting_percent: f64,
}

impl Default for RunwayLights {
    /// High-intensity lights of Annex 14, Volume I, Appendix 2 at full brightness: edge lights of 10 000 cd, centre-line
    /// lights of 5000 cd (average of the main beam of new lights; the ratio of 0.5 to 1.0 was compared with the collective
    /// notes to Fig. A2-1 to A2-11).
    fn default() -> Self {
        Self { edge_cd: 10_000.0, centre_line_cd: 5000.0, setting_percent: 100.0 }
    }
}

impl RunwayLights {
    /// Intensity in cd that counts at a distance: that of the centre line up to 200 m, of the edge from 550 m on, linear
    /// in between ([`TRANSITION_M`]).
    #[must_use]
    pub fn intensity_cd(&self, range_m: f64) -> f64 {
        let t = ((range_m - TRANSITION_M[0]) / (TRANSITION_M[1] - TRANSITION_M[0])).clamp(0.0, 1.0);
        (self.centre_line_cd + (self.edge_cd - self.centre_line_cd) * t) * self.setting_percent / 100.0
    }

    fn check(&self) -> Result<(), OpticsError> {
        check_range("edge light intensity (cd)", self.edge_cd, 0.0, 1e9)?;
        check_range("centre-line light intensity (cd)", self.centre_line_cd, 0.0, 1e9)?;
        check_range("light setting (%)", self.setting_percent, 0.0, 100.0)
    }
}

/// A runway visual range and what it is made of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rvr {
    /// Range of the markings, Koschmieder at 5 % contrast, in m.
    pub markings_m: f64,
    /// Range of the lights, Allard, in m.
    pub lights_m: f64,
    /// Intensity of the lights at that range, in cd.
    pub intensity_cd: f64,
    /// The greater of both, in m; +inf in clear air.
    pub rvr_m: f64,
}

impl Rvr {
    /// RVR in air of extinction coefficient `sigma_t_1_m` (1/m, at 550 nm, taken at [`ASSESSMENT_HEIGHT_M`]), seen with the
    /// illuminance threshold `threshold_lx` (lx; [`super::threshold::ICAO`]).
    ///
    /// # Errors
    /// If σ is negative or not a number, the threshold not in 1e-9 to 1 lx, or a light's intensity or setting out of range.
    pub fn new(sigma_t_1_m: f64, lights: &RunwayLights, threshold_lx: f64) -> Result<Self, OpticsError> {
        check_range("sigma_t (1/m)", sigma_t_1_m, 0.0, f64::MAX)?;
        check_range("illuminance threshold (lx)", threshold_lx, 1e-9, 1.0)?;
        lights.check()?;
        let lights_m = range_of_lights(sigma_t_1_m, lights, threshold_lx);
        let markings_m = mor_m(sigma_t_1_m);
        Ok(Self {
            markings_m,
            lights_m,
            intensity_cd: lights.intensity_cd(lights_m),
            rvr_m: markings_m.max(lights_m),
        })
    }

    /// The range as it is reported.
    #[must_use]
    pub fn reported(&self) -> Reported {
        Reported::new(self.rvr_m)
    }
}

/// Allard's range with an intensity that depends on the range: it lies between the ranges of both kinds of lights, where
/// bisection finds it.
fn range_of_lights(sigma_t: f64, lights: &RunwayLights, threshold_lx: f64) -> f64 {
    let range = |r: f64| allard_m(lights.intensity_cd(r), threshold_lx, sigma_t);
    let (centre, edge) = (range(0.0), range(f64::INFINITY));
    let (mut low, mut high) = (centre.min(edge), centre.max(edge));
    loop {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            return low;
        }
        if range(middle) >= middle { low = middle } else { high = middle }
    }
}

/// RVR as it is reported (Annex 3, Appendix 3, 4.3.6): in steps of 25 m below 400 m, 50 m from 400 to 800 m and 100 m above
/// 800 m, rounded down; 50 m and 2000 m are the limits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reported {
    /// Below 50 m.
    Below50,
    /// A step from 50 to 2000, in m.
    Metres(u32),
    /// Above 2000 m.
    Above2000,
}

impl Reported {
    /// Report of a range in m ≥ 0; what is not a number counts as below the limit.
    #[must_use]
    pub fn new(rvr_m: f64) -> Self {
        let step = match rvr_m {
            r if r > 2000.0 => return Self::Above2000,
            r if r.is_nan() || r < 50.0 => return Self::Below50,
            r if r < 400.0 => 25.0,
            r if r < 800.0 => 50.0,
            _ => 100.0,
        };
        Self::Metres(((rvr_m / step).floor() * step) as u32)
    }
}

impl fmt::Display for Reported {
    /// As in METAR: `0325`, `M0050` (less than 50 m), `P2000` (more than 2000 m).
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Below50 => f.write_str("M0050"),
            Self::Metres(m) => write!(f, "{m:04}"),
            Self::Above2000 => f.write_str("P2000"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::visibility::threshold;
    use fog_core::math::f64::exp;

    #[test]
    fn reports_round_down_to_their_steps() {
        for (range, text) in [
            (0.0, "M0050"),
            (49.999, "M0050"),
            (50.0, "0050"),
            (74.9, "0050"),
            (75.0, "0075"),
            (349.0, "0325"),
            (399.9, "0375"),
            (400.0, "0400"),
            (449.0, "0400"),
            (799.0, "0750"),
            (800.0, "0800"),
            (1999.0, "1900"),
            (2000.0, "2000"),
            (2000.1, "P2000"),
            (f64::INFINITY, "P2000"),
            (f64::NAN, "M0050"),
        ] {
            assert_eq!(Reported::new(range).to_string(), text, "{range}");
        }
    }

    #[test]
    fn the_greater_of_markings_and_lights_counts() {
        let lights = RunwayLights::default();
        let thick = Rvr::new(0.03, &lights, threshold::NIGHT.illuminance_lx).unwrap();
        assert!(thick.lights_m > thick.markings_m && thick.rvr_m == thick.lights_m);
        // Weak lights on a bright day in thin fog: the markings are seen farther.
        let weak = RunwayLights { setting_percent: 1.0, ..lights };
        let thin = Rvr::new(0.002, &weak, threshold::BRIGHT_DAY.illuminance_lx).unwrap();
        assert!(thin.markings_m > thin.lights_m && thin.rvr_m == thin.markings_m);
        assert!((thin.markings_m - 1497.866).abs() < 1e-3);
        let clear = Rvr::new(0.0, &lights, 1e-4).unwrap();
        assert!(clear.rvr_m == f64::INFINITY && (clear.lights_m / 1e4 - 1.0).abs() < 1e-12);
    }

    #[test]
    fn the_lights_that_count_change_between_200_and_550_m() {
        let lights = RunwayLights::default();
        assert_eq!(
            [0.0, 200.0, 375.0, 550.0, 1e9].map(|r| lights.intensity_cd(r)),
            [5000.0, 5000.0, 7500.0, 10_000.0, 10_000.0]
        );
        let mut last = f64::INFINITY;
        for i in 1..200 {
            let sigma = 0.0005 * f64::from(i);
            let rvr = Rvr::new(sigma, &lights, 1e-4).unwrap();
            let illuminance = rvr.intensity_cd * exp(-sigma * rvr.lights_m) / (rvr.lights_m * rvr.lights_m);
            assert!((illuminance / 1e-4 - 1.0).abs() < 1e-9, "{sigma}: {rvr:?}");
            assert!(rvr.rvr_m < last);
            last = rvr.rvr_m;
        }
    }

    #[test]
    fn nonsense_is_refused() {
        let good = RunwayLights::default();
        for sigma in [-0.1, f64::NAN, f64::INFINITY] {
            assert!(Rvr::new(sigma, &good, 1e-4).is_err(), "{sigma}");
        }
        assert!(Rvr::new(0.1, &good, 0.0).is_err());
        for bad in [
            RunwayLights { setting_percent: 101.0, ..good },
            RunwayLights { edge_cd: -1.0, ..good },
            RunwayLights { centre_line_cd: f64::NAN, ..good },
        ] {
            assert!(Rvr::new(0.1, &bad, 1e-4).is_err(), "{bad:?}");
        }
    }
}
