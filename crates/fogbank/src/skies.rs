//! Skies of frames, each computed once: clear ones from the air, others from their standard.

use fog_core::bands::{BANDS, BandSpectrum};
use fog_core::colour::{Observer, luminance};
use fog_core::daylight::daylight;
use fog_core::math;
use fog_plan::{LightingSpec, MoonSpec, SkyBrightness, SkySpec, SunSpec};
use fog_scene::atmosphere::{Atmosphere, AtmosphereSettings, sun_irradiance};
use fog_scene::cie_sky::CieSky;
use fog_scene::dome::{Dome, SourceSky};
use fog_scene::light::Sun;
use fog_scene::moon;
use serde_json::{Value, json};
use std::collections::HashMap;

/// An atmosphere, and the bits of a source's elevation over it.
type Source = (String, u64);

/// A sky and what hangs in it, in units of D65 of 1 cd/m² and 1 lx.
#[derive(Debug)]
pub(crate) struct Sky {
    pub(crate) dome: Dome,
    disc: Option<Disc>,
    state: Value,
}

/// Sun or moon as it is seen through the air.
#[derive(Debug)]
struct Disc {
    name: &'static str,
    elevation_deg: f64,
    azimuth_deg: f64,
    diameter_deg: f64,
    /// Illuminance across the beam by band.
    light: BandSpectrum,
}

/// Atmospheres, and their skies by the elevation of the source.
#[derive(Debug, Default)]
pub(crate) struct Skies {
    atmospheres: HashMap<String, Atmosphere>,
    sources: HashMap<Source, Option<SourceSky>>,
}

impl Skies {
    /// The sky of a lighting that has one.
    ///
    /// # Errors
    /// If nothing in it shines.
    pub(crate) fn make(
        &mut self,
        sky: &SkySpec,
        lighting: &LightingSpec,
        observer: &Observer,
    ) -> Result<Sky, String> {
        match *sky {
            SkySpec::Clear { aerosol_optical_depth, ozone_du, night_luminance_cd_m2, ground_albedo } => {
                let air = AtmosphereSettings { aerosol_optical_depth, ozone_du, ground_albedo };
                self.clear(&air, night_luminance_cd_m2, lighting, observer)
            }
            SkySpec::Cie { cie_type, brightness, color_temperature_k, ground_albedo } => {
                let sun = lighting.sun.as_ref();
                let (elevation, azimuth) = sun.map_or((90.0, 0.0), |s| (s.elevation_deg, s.azimuth_deg));
                let shape = CieSky::General { kind: cie_type as usize, sun_elevation_deg: elevation };
                shaped(shape, azimuth, brightness, color_temperature_k, ground_albedo, observer)
            }
            SkySpec::Overcast { brightness, color_temperature_k, ground_albedo } => {
                shaped(CieSky::Overcast, 0.0, brightness, color_temperature_k, ground_albedo, observer)
            }
        }
    }

    fn clear(
        &mut self,
        air: &AtmosphereSettings,
        night_cd_m2: f64,
        lighting: &LightingSpec,
        observer: &Observer,
    ) -> Result<Sky, String> {
        let key = format!("{air:?}");
        let atmosphere = self.atmospheres.entry(key.clone()).or_insert_with(|| Atmosphere::new(air));
        // Sun and moon outside the air, and where they stand.
        let sun = lighting.sun.as_ref().map(|sun| disc_of_sun(sun, observer));
        let moon = lighting.moon.as_ref().map(|moon| disc_of_moon(moon, observer));
        let sources: Vec<_> = sun.into_iter().chain(moon).collect();
        for source in &sources {
            let id = (key.clone(), source.elevation_deg.to_bits());
            self.sources.entry(id).or_insert_with(|| SourceSky::new(atmosphere, source.elevation_deg));
        }
        let lit: Vec<_> = sources
            .iter()
            .filter_map(|source| {
                let sky = self.sources[&(key.clone(), source.elevation_deg.to_bits())].as_ref()?;
                Some((sky, source.light, source.azimuth_deg))
            })
            .collect();
        let glow = BandSpectrum::ONE.scaled(night_cd_m2 as f32);
        let dome = Dome::clear(&lit, glow, air.ground_albedo).map_err(|e| format!("lighting.sky: {e}"))?;
        // Of two discs the brighter one is shown: the moon beside the sun adds less than a millionth.
        let seen = sources.into_iter().map(|source| {
            let passed = atmosphere.transmittance(source.elevation_deg, source.diameter_deg);
            Disc { light: product(&source.light, &passed), ..source }
        });
        let lx = |disc: &Disc| illuminance(observer, &disc.light);
        let disc = seen.filter(|disc| lx(disc) > 0.0).max_by(|a, b| lx(a).total_cmp(&lx(b)));
        let state = state_json(observer, &dome, disc.as_ref());
        Ok(Sky { dome, disc, state })
    }
}

impl Sky {
    /// The disc of sun or moon for a relative radiance of 1 that stands for `of_one_cd_m2`.
    pub(crate) fn sun(&self, observer: &Observer, of_one_cd_m2: f64) -> Option<Sun> {
        let disc = self.disc.as_ref()?;
        let lx = illuminance(observer, &disc.light);
        let sun = Sun::new(disc.elevation_deg, disc.azimuth_deg, lx / of_one_cd_m2, disc.diameter_deg);
        Some(sun.with_colour(disc.light.scaled((1.0 / lx) as f32)))
    }

    /// How bright it is, for the record.
    pub(crate) fn state_json(&self) -> &Value {
        &self.state
    }
}

/// A standard sky of one colour.
fn shaped(
    shape: CieSky,
    sun_azimuth_deg: f64,
    brightness: SkyBrightness,
    color_temperature_k: Option<f64>,
    ground_albedo: f64,
    observer: &Observer,
) -> Result<Sky, String> {
    let colour = color_temperature_k.map_or(BandSpectrum::ONE, |k| daylight(observer, k));
    let zenith = match brightness {
        SkyBrightness::Zenith(cd_m2) => cd_m2,
        SkyBrightness::Horizontal(_) => 1.0,
    };
    let sky = |elevation: f64, heading: f64| {
        zenith * shape.relative_luminance(elevation, heading - sun_azimuth_deg)
    };
    let dome = Dome::of_colour(sky, colour, ground_albedo).map_err(|e| format!("lighting.sky: {e}"))?;
    let dome = match brightness {
        SkyBrightness::Zenith(_) => dome,
        SkyBrightness::Horizontal(lx) => {
            let factor = lx / illuminance(observer, &dome.irradiance);
            dome.scaled(factor)
        }
    };
    let state = state_json(observer, &dome, None);
    Ok(Sky { dome, disc: None, state })
}

fn disc_of_sun(sun: &SunSpec, observer: &Observer) -> Disc {
    Disc {
        name: "sun",
        elevation_deg: sun.elevation_deg,
        azimuth_deg: sun.azimuth_deg,
        diameter_deg: sun.angular_diameter_deg,
        light: observer.relative_to_d65(&sun_irradiance()),
    }
}

fn disc_of_moon(moon: &MoonSpec, observer: &Observer) -> Disc {
    let (sun, albedo) = (sun_irradiance(), moon::colour());
    let light = observer.relative_to_d65(&core::array::from_fn(|band| sun[band] * albedo[band]));
    let factor = moon::illuminance_lx(moon.phase_deg) / illuminance(observer, &light);
    Disc {
        name: "moon",
        elevation_deg: moon.elevation_deg,
        azimuth_deg: moon.azimuth_deg,
        diameter_deg: moon::DIAMETER_DEG,
        light: light.scaled(factor as f32),
    }
}

fn product(a: &BandSpectrum, b: &BandSpectrum) -> BandSpectrum {
    let mut out = [0.0; BANDS];
    for (out, (a, b)) in out.iter_mut().zip(a.0.iter().zip(b.0)) {
        *out = a * b;
    }
    BandSpectrum(out)
}

fn rgb(observer: &Observer, light: &BandSpectrum) -> [f64; 3] {
    observer.rgb_of(|nm| light.at(nm))
}

fn illuminance(observer: &Observer, light: &BandSpectrum) -> f64 {
    luminance(rgb(observer, light))
}

fn state_json(observer: &Observer, dome: &Dome, disc: Option<&Disc>) -> Value {
    let disc = disc.map(|disc| {
        let lx = illuminance(observer, &disc.light);
        let up = math::f64::sin(disc.elevation_deg.to_radians()).max(0.0);
        json!({
            "source": disc.name,
            "illuminance_across_the_beam_lx": lx,
            "horizontal_illuminance_lx": lx * up,
            "linear_srgb": rgb(observer, &disc.light),
        })
    });
    json!({
        "zenith_luminance_cd_m2": illuminance(observer, &dome.zenith),
        "zenith_linear_srgb": rgb(observer, &dome.zenith),
        "horizontal_illuminance_lx": illuminance(observer, &dome.irradiance),
        "disc": disc,
        "units": "of the light outside the fog, in cd/m² and lx; linear sRGB scaled to the same luminance",
    })
}
