//! Illuminance at the eye from which a light is seen, by background luminance: the two sets that meteorologists use.
//!
//! The numbers of ICAO's steps are quoted from Annex 3 and Doc 9328 (3rd edition 2005), those of WMO from WMO-No. 8, as they
//! are commonly reprinted; the documents are not public, so that they could not be compared with the originals.

use crate::error::{OpticsError, check_range};
use fog_core::math::f64::pow;

/// A visual threshold of illumination, E_T.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Threshold {
    /// Name by which it is asked for.
    pub name: &'static str,
    /// E_T in lx.
    pub illuminance_lx: f64,
    /// When it holds.
    pub condition: &'static str,
    /// Document.
    pub source: &'static str,
}

const ICAO_SOURCE: &str = "ICAO Annex 3, Attachment D; Doc 9328 (2005)";
const WMO_SOURCE: &str = "WMO-No. 8, chapter on visibility";

const fn icao(name: &'static str, illuminance_lx: f64, condition: &'static str) -> Threshold {
    Threshold { name, illuminance_lx, condition, source: ICAO_SOURCE }
}

const fn wmo(name: &'static str, illuminance_lx: f64, condition: &'static str) -> Threshold {
    Threshold { name, illuminance_lx, condition, source: WMO_SOURCE }
}

/// ICAO's step for night: background luminance up to 50 cd/m².
pub const NIGHT: Threshold = icao("night", 8e-7, "background up to 50 cd/m²");
/// ICAO's intermediate step (dusk and dawn): 51 to 999 cd/m².
pub const TWILIGHT: Threshold = icao("twilight", 1e-5, "background 51 to 999 cd/m²");
/// ICAO's step for a normal day: 1000 to 12 000 cd/m².
pub const DAY: Threshold = icao("day", 1e-4, "background 1000 to 12000 cd/m²");
/// ICAO's step for a bright day (sunlit fog): over 12 000 cd/m².
pub const BRIGHT_DAY: Threshold = icao("bright_day", 1e-3, "background over 12000 cd/m²: sunlit fog");

/// ICAO's four steps, from night to bright day.
pub const ICAO: [Threshold; 4] = [NIGHT, TWILIGHT, DAY, BRIGHT_DAY];

/// WMO's threshold for twilight and dawn, or where there is much artificial light: 10^−6.0 lx.
pub const WMO_TWILIGHT: Threshold = wmo("wmo_twilight", 1e-6, "twilight, dawn, or much artificial light");
/// WMO's threshold for moonlight, or when it is not yet quite dark: 10^−6.7 lx.
pub const WMO_MOONLIGHT: Threshold =
    wmo("wmo_moonlight", 1.995_262_314_968_879_6e-7, "moonlight, or not yet quite dark");
/// WMO's threshold for complete darkness, or no light but starlight: 10^−7.5 lx.
pub const WMO_DARK: Threshold = wmo("wmo_dark", 3.162_277_660_168_379e-8, "no light other than starlight");

/// WMO's three thresholds for observations of lights by night, from twilight to darkness.
pub const WMO: [Threshold; 3] = [WMO_TWILIGHT, WMO_MOONLIGHT, WMO_DARK];

/// Names of all thresholds, ICAO's steps first.
pub const NAMES: [&str; 7] =
    ["night", "twilight", "day", "bright_day", "wmo_twilight", "wmo_moonlight", "wmo_dark"];

/// The threshold of a name of [`NAMES`].
#[must_use]
pub fn named(name: &str) -> Option<Threshold> {
    ICAO.into_iter().chain(WMO).find(|t| t.name == name)
}

/// ICAO's step for a background luminance in cd/m². The steps are given for whole numbers; they change at 50, 1000 and
/// 12 000 here (50 is still night, 12 000 still a normal day).
///
/// # Errors
/// If the luminance is not in 0 to 1e6 cd/m².
pub fn icao_step(background_cd_m2: f64) -> Result<Threshold, OpticsError> {
    check_background(background_cd_m2)?;
    Ok(match background_cd_m2 {
        b if b <= 50.0 => NIGHT,
        b if b < 1000.0 => TWILIGHT,
        b if b <= 12_000.0 => DAY,
        _ => BRIGHT_DAY,
    })
}

/// ICAO's continuous relation, log10 E_T = −5.7 + 0.64 log10 B, in lx for a background luminance B in cd/m²; not below the
/// step for night, 8e-7 lx, which it meets at B = 0.24 cd/m².
///
/// # Errors
/// If the luminance is not in 0 to 1e6 cd/m².
pub fn icao_continuous_lx(background_cd_m2: f64) -> Result<f64, OpticsError> {
    check_background(background_cd_m2)?;
    Ok((pow(10.0, -5.7) * pow(background_cd_m2, 0.64)).max(NIGHT.illuminance_lx))
}

fn check_background(background_cd_m2: f64) -> Result<(), OpticsError> {
    check_range("background luminance (cd/m²)", background_cd_m2, 0.0, 1e6)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_find_their_thresholds() {
        for (name, threshold) in NAMES.iter().zip(ICAO.into_iter().chain(WMO)) {
            assert_eq!(*name, threshold.name);
            assert_eq!(named(name), Some(threshold));
        }
        assert_eq!(named("noon"), None);
        assert!(ICAO.windows(2).all(|w| w[0].illuminance_lx < w[1].illuminance_lx));
        for (threshold, exponent) in WMO.iter().zip([-6.0, -6.7, -7.5]) {
            assert!((threshold.illuminance_lx / pow(10.0, exponent) - 1.0).abs() < 1e-12);
        }
    }

    #[test]
    fn steps_change_where_they_should() {
        let step = |b| icao_step(b).unwrap().name;
        assert_eq!([0.0, 50.0, 51.0, 999.0].map(step), ["night", "night", "twilight", "twilight"]);
        assert_eq!([1000.0, 12_000.0, 12_001.0].map(step), ["day", "day", "bright_day"]);
    }

    #[test]
    fn continuous_relation_runs_through_the_steps() {
        let lx = |b| icao_continuous_lx(b).unwrap();
        assert_eq!(lx(0.0), 8e-7);
        assert!((lx(1.0) / 1.995_262_3e-6 - 1.0).abs() < 1e-7);
        assert!((lx(1e5) / lx(1e3) / 19.054_607 - 1.0).abs() < 1e-6, "100 to the power 0.64");
        // The relation lies within a factor of 3 of the step over each step's range of daylight.
        for b in [1000.0, 3000.0, 12_000.0, 20_000.0] {
            let ratio = lx(b) / icao_step(b).unwrap().illuminance_lx;
            assert!(ratio > 1.0 / 3.0 && ratio < 9.0, "{b}: {ratio}");
        }
        for bad in [-1.0, 2e6, f64::NAN] {
            assert!(icao_continuous_lx(bad).is_err() && icao_step(bad).is_err());
        }
    }
}
