//! Luminance of standard skies relative to the zenith: CIE S 011 / ISO 15469:2004, "Spatial distribution of daylight: CIE
//! standard general sky".
//!
//! The parameters are the standard's as quoted by Darula & Kittler 2002, "CIE general sky standard defining luminance
//! distributions" (the standard itself was not at hand).

use fog_core::math;

/// Gradation (a, b) and indicatrix (c, d, e) of types 1 to 15.
const TYPES: [[f64; 5]; 15] = [
    [4.0, -0.70, 0.0, -1.0, 0.0],
    [4.0, -0.70, 2.0, -1.5, 0.15],
    [1.1, -0.80, 0.0, -1.0, 0.0],
    [1.1, -0.80, 2.0, -1.5, 0.15],
    [0.0, -1.00, 0.0, -1.0, 0.0],
    [0.0, -1.00, 2.0, -1.5, 0.15],
    [0.0, -1.00, 5.0, -2.5, 0.30],
    [0.0, -1.00, 10.0, -3.0, 0.45],
    [-1.0, -0.55, 2.0, -1.5, 0.15],
    [-1.0, -0.55, 5.0, -2.5, 0.30],
    [-1.0, -0.55, 10.0, -3.0, 0.45],
    [-1.0, -0.32, 10.0, -3.0, 0.45],
    [-1.0, -0.32, 16.0, -3.0, 0.30],
    [-1.0, -0.15, 16.0, -3.0, 0.30],
    [-1.0, -0.15, 24.0, -2.8, 0.15],
];

/// A sky of the standard.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum CieSky {
    /// The CIE overcast sky (Moon & Spencer 1942), the standard's type 16: three times as bright in the zenith as at the horizon.
    Overcast,
    /// One of the types 1 (overcast, steep) to 15 (white-blue, turbid); 5 is the same everywhere, 12 the clear sky.
    General {
        /// 1 to 15; others are taken for the nearest.
        kind: usize,
        /// Elevation of the sun in degrees.
        sun_elevation_deg: f64,
    },
}

impl CieSky {
    /// Luminance over that of the zenith, for a direction at an elevation (0 to 90°) and an azimuth from the sun's.
    #[must_use]
    pub fn relative_luminance(&self, elevation_deg: f64, azimuth_deg: f64) -> f64 {
        let sine = math::f64::sin(elevation_deg.to_radians());
        match *self {
            Self::Overcast => (1.0 + 2.0 * sine) / 3.0,
            Self::General { kind, sun_elevation_deg } => {
                let parameters = &TYPES[kind.clamp(1, TYPES.len()) - 1];
                let sun = sun_elevation_deg.to_radians();
                let cosine = math::f64::sin(sun) * sine
                    + math::f64::cos(sun)
                        * math::f64::cos(elevation_deg.to_radians())
                        * math::f64::cos(azimuth_deg.to_radians());
                let from_sun = math::f64::acos(cosine.clamp(-1.0, 1.0));
                let zenith_from_sun = (90.0 - sun_elevation_deg).to_radians();
                gradation(parameters, sine) * indicatrix(parameters, from_sun)
                    / (gradation(parameters, 1.0) * indicatrix(parameters, zenith_from_sun))
            }
        }
    }

    /// True if the distribution depends on where the sun is.
    #[must_use]
    pub fn depends_on_sun(kind: usize) -> bool {
        TYPES[kind.clamp(1, TYPES.len()) - 1][2] != 0.0
    }
}

fn gradation(&[a, b, ..]: &[f64; 5], sine: f64) -> f64 {
    if sine > 0.0 { 1.0 + a * math::f64::exp(b / sine) } else { 1.0 }
}

fn indicatrix(&[_, _, c, d, e]: &[f64; 5], angle: f64) -> f64 {
    let cosine = math::f64::cos(angle);
    1.0 + c * (math::f64::exp(d * angle) - math::f64::exp(d * 0.5 * math::PI)) + e * cosine * cosine
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_zenith_is_one_and_nothing_is_dark() {
        for kind in 1..=15 {
            for sun in [5.0, 30.0, 60.0, 90.0] {
                let sky = CieSky::General { kind, sun_elevation_deg: sun };
                assert!((sky.relative_luminance(90.0, 50.0) - 1.0).abs() < 1e-12);
                for elevation in [0.0, 1.0, 20.0, 70.0] {
                    for azimuth in [0.0, 90.0, 180.0] {
                        let l = sky.relative_luminance(elevation, azimuth);
                        assert!((0.01..300.0).contains(&l), "type {kind}, sun {sun}: {l}");
                    }
                }
            }
        }
    }

    #[test]
    fn known_skies() {
        // Type 5 is even, type 1 nearly the overcast sky, whose horizon has a third of the zenith.
        let general = |kind| CieSky::General { kind, sun_elevation_deg: 40.0 };
        assert_eq!(general(5).relative_luminance(12.0, 70.0), 1.0);
        for elevation in [0.0, 30.0, 60.0] {
            let [overcast, steep] =
                [CieSky::Overcast, general(1)].map(|sky| sky.relative_luminance(elevation, 0.0));
            assert!((overcast - steep).abs() < 0.06, "{elevation}: {overcast} {steep}");
        }
        assert!((CieSky::Overcast.relative_luminance(0.0, 0.0) - 1.0 / 3.0).abs() < 1e-12);
        // Under the clear sky it is brightest about the sun, and the horizon is brighter than what is over it.
        let clear = general(12);
        assert!(clear.relative_luminance(38.0, 0.0) > 4.0 * clear.relative_luminance(60.0, 180.0));
        assert!(clear.relative_luminance(0.0, 180.0) > clear.relative_luminance(45.0, 180.0));
        assert!(!CieSky::depends_on_sun(1) && CieSky::depends_on_sun(2) && !CieSky::depends_on_sun(5));
    }
}
