//! The clear sky: sunlight scattered by molecules and aerosol of a round earth's air, by day and in twilight.
//!
//! Scattering of any order, absorption by ozone (which makes the blue hour blue), reflection by the ground. The light of the sun
//! goes straight: without refraction the sun sets half of a degree too early, and grazing light is not spread. What is
//! scattered does not depend on who shines, so that the moon's sky is the sun's with another light.

mod air;
mod columns;
mod harmonics;
mod rays;
mod scatter;

use self::air::{Bands, solar_irradiance};
use self::scatter::{Heading, Scattered, Scatterers};
use fog_core::bands::{BANDS, BandSpectrum};
use fog_core::math;

/// What a clear air is like.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AtmosphereSettings {
    /// Optical depth of the aerosol at 550 nm from the ground to the zenith.
    pub aerosol_optical_depth: f64,
    /// Ozone in Dobson units.
    pub ozone_du: f64,
    /// Albedo of the level ground.
    pub ground_albedo: f64,
}

/// A clear air, and how it scatters the light of one distant source at any height; for the source's irradiance 1 outside the air.
#[derive(Clone, Debug)]
pub struct Atmosphere {
    scatterers: Scatterers,
    scattered: Scattered,
}

impl Atmosphere {
    /// Solves the scattering on all cores.
    #[must_use]
    pub fn new(settings: &AtmosphereSettings) -> Self {
        let scatterers = Scatterers::new(settings);
        let scattered = scatterers.solve();
        Self { scatterers, scattered }
    }

    /// Radiance of the sky at sea level, in 1/sr: `elevation_deg` of the direction (0 to 90) and its azimuth from the source's,
    /// for a source at `source_elevation_deg` over the horizon. From 20° below it on it is 0.
    #[must_use]
    pub fn sky(&self, source_elevation_deg: f64, elevation_deg: f64, azimuth_deg: f64) -> BandSpectrum {
        if source_elevation_deg <= LOWEST_DEG {
            return BandSpectrum([0.0; BANDS]);
        }
        let (elevation, azimuth) = (elevation_deg.to_radians(), azimuth_deg.to_radians());
        let from = Heading {
            up: math::f64::sin(elevation),
            sunward: math::f64::cos(elevation) * math::f64::cos(azimuth),
        };
        spectrum(&self.scatterers.sky(&self.scattered, zenith_angle(source_elevation_deg), from))
    }

    /// Radiance of the ground, in 1/sr.
    #[must_use]
    pub fn ground(&self, source_elevation_deg: f64) -> BandSpectrum {
        if source_elevation_deg <= LOWEST_DEG {
            return BandSpectrum([0.0; BANDS]);
        }
        spectrum(&self.scatterers.ground(&self.scattered, zenith_angle(source_elevation_deg)))
    }

    /// Transmittance of the air from the ground to a source at an elevation: mean over a disc of this diameter, whose part below
    /// the horizon does not shine.
    #[must_use]
    pub fn transmittance(&self, elevation_deg: f64, diameter_deg: f64) -> BandSpectrum {
        // Strips of the disc, by the chords in their middles.
        const STRIPS: usize = 16;
        let (mut sum, mut area) = ([0.0f32; BANDS], 0.0);
        for strip in 0..STRIPS {
            let x = (2.0 * strip as f64 + 1.0) / STRIPS as f64 - 1.0;
            let chord = (1.0 - x * x).sqrt();
            let elevation = elevation_deg + 0.5 * diameter_deg * x;
            let Scatterers { air, columns, .. } = &self.scatterers;
            let passed = columns.transmittance(air, 0.0, zenith_angle(elevation));
            for (sum, passed) in sum.iter_mut().zip(passed) {
                *sum += passed * chord as f32;
            }
            area += chord;
        }
        BandSpectrum(sum.map(|s| s / area as f32))
    }
}

/// Elevation of a source in degrees from which on down the sky is left dark: light of the stars is a hundred times that of the
/// sun there.
pub const LOWEST_DEG: f64 = -20.0;

/// The sun's spectral irradiance outside the air at its mean distance by band, in W m⁻² nm⁻¹ (`tables/sky`).
#[must_use]
pub fn sun_irradiance() -> [f64; BANDS] {
    solar_irradiance()
}

fn zenith_angle(elevation_deg: f64) -> f64 {
    (90.0 - elevation_deg).to_radians()
}

fn spectrum(bands: &Bands) -> BandSpectrum {
    BandSpectrum(core::array::from_fn(|i| bands[i]))
}

#[cfg(test)]
mod tests;
