//! Skies as images of the whole sphere.

use crate::atmosphere::{Atmosphere, LOWEST_DEG};
use crate::sky_map::{SkyMap, SkyMapError};
use fog_core::bands::{BANDS, BandSpectrum};
use fog_core::math;
use rayon::prelude::*;

/// Columns of the image.
const WIDTH: usize = 256;
/// Rows of the image, half of them sky.
const HEIGHT: usize = WIDTH / 2;
/// Azimuths from a source at which its sky is computed, over half of the circle with both ends.
const AZIMUTHS: usize = WIDTH / 2 + 1;

/// A sky over level ground.
#[derive(Clone, Debug)]
pub struct Dome {
    /// Radiance by direction; its centre column shows north (−Z).
    pub map: SkyMap,
    /// Radiance of the zenith.
    pub zenith: BandSpectrum,
    /// Irradiance of the sky on level ground.
    pub irradiance: BandSpectrum,
}

/// Scattered light of one source at the centres of the image's texels over the horizon, by azimuth from the source.
#[derive(Clone, Debug)]
pub struct SourceSky {
    /// Row by row from the zenith; [`AZIMUTHS`] values each.
    rows: Vec<BandSpectrum>,
    ground: BandSpectrum,
}

impl SourceSky {
    /// The clear sky of a source at an elevation, for its irradiance 1 outside the air; `None` where it is too low to light any.
    #[must_use]
    pub fn new(atmosphere: &Atmosphere, source_elevation_deg: f64) -> Option<Self> {
        if source_elevation_deg <= LOWEST_DEG {
            return None;
        }
        let rows = (0..HEIGHT / 2 * AZIMUTHS).into_par_iter().map(|i| {
            let azimuth = 180.0 * (i % AZIMUTHS) as f64 / (AZIMUTHS - 1) as f64;
            atmosphere.sky(source_elevation_deg, elevation_deg(i / AZIMUTHS), azimuth)
        });
        Some(Self { rows: rows.collect(), ground: atmosphere.ground(source_elevation_deg) })
    }

    /// The sky at a row, linear between azimuths.
    fn at(&self, row: usize, azimuth_deg: f64) -> BandSpectrum {
        let turned = azimuth_deg.rem_euclid(360.0);
        let x = turned.min(360.0 - turned) / 180.0 * (AZIMUTHS - 1) as f64;
        let i = (x as usize).min(AZIMUTHS - 2);
        let t = (x - i as f64) as f32;
        let [a, b] = [self.rows[row * AZIMUTHS + i], self.rows[row * AZIMUTHS + i + 1]];
        BandSpectrum(core::array::from_fn(|band| a.0[band] + (b.0[band] - a.0[band]) * t))
    }
}

/// A source with its sky: irradiance outside the air, and azimuth.
pub type LitSky<'a> = (&'a SourceSky, BandSpectrum, f64);

impl Dome {
    /// Skies of several sources over each other, and an even glow of the night sky; each over the ground that it lights, which
    /// reflects the glow with `ground_albedo`.
    ///
    /// # Errors
    /// [`SkyMapError::Black`] if nothing shines.
    pub fn clear(skies: &[LitSky<'_>], glow: BandSpectrum, ground_albedo: f64) -> Result<Self, SkyMapError> {
        let sky = |row: usize, heading: f64| {
            let mut sum = glow.0;
            for (sky, irradiance, azimuth) in skies {
                add(&mut sum, &sky.at(row, heading - azimuth), irradiance);
            }
            BandSpectrum(sum)
        };
        let mut ground = glow.scaled(ground_albedo as f32).0;
        for (sky, irradiance, _) in skies {
            add(&mut ground, &sky.ground, irradiance);
        }
        Self::new(sky, |_| BandSpectrum(ground))
    }

    /// A sky of one colour, `luminance(elevation, heading)` times `colour` (both in degrees, over the horizon), over ground of
    /// this albedo that it lights.
    ///
    /// # Errors
    /// [`SkyMapError::Black`] if nothing shines.
    pub fn of_colour(
        luminance: impl Fn(f64, f64) -> f64,
        colour: BandSpectrum,
        ground_albedo: f64,
    ) -> Result<Self, SkyMapError> {
        let reflect = (ground_albedo / math::PI) as f32;
        Self::new(
            |row, heading| colour.scaled(luminance(elevation_deg(row), heading) as f32),
            |irradiance| irradiance.scaled(reflect),
        )
    }

    /// From the radiance by row and heading, and that of the ground by the sky's irradiance.
    fn new(
        sky: impl Fn(usize, f64) -> BandSpectrum,
        ground: impl Fn(BandSpectrum) -> BandSpectrum,
    ) -> Result<Self, SkyMapError> {
        let mut texels = Vec::with_capacity(WIDTH * HEIGHT);
        let (mut irradiance, mut zenith) = ([0.0f32; BANDS], [0.0f32; BANDS]);
        for row in 0..HEIGHT / 2 {
            // ∫ sin e cos e de dφ over the texel.
            let edge = |row: usize| math::f64::cos(math::PI * row as f64 / HEIGHT as f64);
            let weight = math::PI / WIDTH as f64 * (edge(row).powi(2) - edge(row + 1).powi(2));
            for column in 0..WIDTH {
                let heading = 360.0 * ((column as f64 + 0.5) / WIDTH as f64 - 0.5);
                let value = sky(row, heading);
                add(&mut irradiance, &value, &BandSpectrum::ONE.scaled(weight as f32));
                if row == 0 {
                    add(&mut zenith, &value, &BandSpectrum::ONE.scaled(1.0 / WIDTH as f32));
                }
                texels.push(value.0);
            }
        }
        let irradiance = BandSpectrum(irradiance);
        texels.resize(WIDTH * HEIGHT, ground(irradiance).0);
        let map = SkyMap::from_bands(WIDTH, HEIGHT, texels)?;
        Ok(Self { map, zenith: BandSpectrum(zenith), irradiance })
    }

    /// The same sky `factor` times as bright.
    #[must_use]
    pub fn scaled(self, factor: f64) -> Self {
        let k = factor as f32;
        Self {
            map: self.map.scaled(factor),
            zenith: self.zenith.scaled(k),
            irradiance: self.irradiance.scaled(k),
        }
    }
}

/// Elevation of the middle of a row of sky.
fn elevation_deg(row: usize) -> f64 {
    90.0 - 180.0 * (row as f64 + 0.5) / HEIGHT as f64
}

fn add(sum: &mut [f32; BANDS], value: &BandSpectrum, factor: &BandSpectrum) {
    for ((sum, value), factor) in sum.iter_mut().zip(value.0).zip(factor.0) {
        *sum += value * factor;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cie_sky::CieSky;

    #[test]
    fn overcast_sky_gives_seven_ninths_of_an_even_one() {
        // E = 7π/9 of the zenith's luminance (Moon & Spencer 1942).
        let sky = |e: f64, _: f64| 3.0 * CieSky::Overcast.relative_luminance(e, 0.0);
        let dome = Dome::of_colour(sky, BandSpectrum::ONE, 0.5).unwrap();
        assert!((f64::from(dome.irradiance.0[3]) / (7.0 * math::PI / 3.0) - 1.0).abs() < 1e-3);
        assert!((dome.zenith.0[0] - 3.0).abs() < 2e-3);
        let twice = dome.clone().scaled(2.0);
        assert!((twice.map.mean() / dome.map.mean() - 2.0).abs() < 1e-6);
        // Mean radiance: of the sky 2, of the ground half of 7/3.
        assert!((f64::from(dome.map.mean()) - 0.5 * (2.0 + 0.5 * 7.0 / 3.0)).abs() < 2e-3);
    }

    #[test]
    fn a_source_stands_where_its_azimuth_says() {
        let rows = (0..HEIGHT / 2 * AZIMUTHS)
            .map(|i| BandSpectrum::ONE.scaled(if i % AZIMUTHS < 3 { 1.0 } else { 0.0 }))
            .collect();
        let sky = SourceSky { rows, ground: BandSpectrum::ONE };
        let dome = Dome::clear(&[(&sky, BandSpectrum::ONE, 90.0)], BandSpectrum([0.0; BANDS]), 0.2).unwrap();
        use crate::sky_map::SkyLanes;
        use fog_core::bands::BandLanes;
        use fog_core::spectrum::{Spectrum, Wavelengths};
        let bands = BandLanes::new(&Wavelengths::monochromatic(550.0));
        let lanes = SkyLanes { basis: &[Spectrum::ONE; 3], bands: &bands };
        let towards = |heading: f64| {
            let h = heading.to_radians();
            fog_core::Vec3A::new(math::f64::sin(h) as f32, 0.5, -math::f64::cos(h) as f32).normalize()
        };
        assert!((dome.map.radiance(towards(90.0), lanes)[0] - 1.0).abs() < 1e-6);
        assert_eq!(dome.map.radiance(towards(-90.0), lanes)[0], 0.0);
        assert_eq!(dome.map.radiance(towards(0.0), lanes)[0], 0.0);
        assert_eq!(dome.map.radiance(-fog_core::Vec3A::Y, lanes)[0], 1.0);
    }
}
