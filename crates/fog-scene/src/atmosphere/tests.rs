//! The clear sky against measured daylight and twilight, and against following photons one by one.

use super::air::{AEROSOL_G, Bands, GROUND_KM, TOP_KM, densities};
use super::*;
use fog_core::Vec3A;
use fog_core::colour::{Observer, luminance};
use fog_core::moments::Moments;
use fog_core::random::PathRng;
use fog_core::warp;
use std::sync::LazyLock;

const SETTINGS: AtmosphereSettings =
    AtmosphereSettings { aerosol_optical_depth: 0.1, ozone_du: 300.0, ground_albedo: 0.2 };

/// Solved once for all tests.
static CLEAR: LazyLock<Atmosphere> = LazyLock::new(|| Atmosphere::new(&SETTINGS));

/// Linear sRGB of sunlight times a spectrum, in cd/m² or lx.
fn rgb(of_sun: &BandSpectrum) -> [f64; 3] {
    let observer = Observer::new();
    let sun = observer.relative_to_d65(&sun_irradiance());
    observer.rgb_of(|nm| of_sun.at(nm) * sun.at(nm))
}

fn photometric(of_sun: &BandSpectrum) -> f64 {
    luminance(rgb(of_sun))
}

/// Irradiance on the ground from the sky alone, by an even sum over the sky.
fn from_sky(source_elevation_deg: f64) -> BandSpectrum {
    let (rows, columns) = (24, 16);
    let mut sum = [0.0f32; BANDS];
    for i in 0..rows {
        // Sines of elevation, finer towards the horizon.
        let x = (f64::from(i) + 0.5) / f64::from(rows);
        let (sine, width) = (x * x, 2.0 * x / f64::from(rows));
        for j in 0..columns {
            let azimuth = 180.0 * (f64::from(j) + 0.5) / f64::from(columns);
            let radiance = CLEAR.sky(source_elevation_deg, math::f64::asin(sine).to_degrees(), azimuth);
            for (sum, value) in sum.iter_mut().zip(radiance.0) {
                *sum += value * (sine * width * math::TAU / f64::from(columns)) as f32;
            }
        }
    }
    BandSpectrum(sum)
}

/// Measured horizontal illuminance in lx under a clear sky by the sun's elevation in degrees: the fit of Seidelmann (ed.) 1992,
/// "Explanatory Supplement to the Astronomical Almanac", as commonly quoted.
fn measured_lx(elevation_deg: f64) -> f64 {
    let x = elevation_deg / 90.0;
    let [a, b, c, d] = match elevation_deg {
        e if e > 20.0 => [3.74, 3.97, -4.07, 1.47],
        e if e > 5.0 => [3.05, 13.28, -45.98, 64.33],
        e if e > -0.8 => [2.88, 22.26, -207.64, 1034.30],
        e if e > -5.0 => [2.88, 21.81, -258.11, -858.36],
        _ => [2.70, 12.17, -431.69, -1899.83],
    };
    math::f64::pow(10.0, a + x * (b + x * (c + x * d)))
}

#[test]
fn the_sun_outside_the_air() {
    // 133 klx (ASTM G 173), somewhat warmer than D65.
    let lx = photometric(&BandSpectrum::ONE);
    assert!((131e3..135e3).contains(&lx), "{lx}");
    let [r, g, b] = rgb(&BandSpectrum::ONE);
    assert!(r > g && g > b && r < 1.25 * b);
}

#[test]
fn illuminance_from_noon_to_nautical_twilight() {
    // Real air differs from day to day; measured and computed agree within a third over seven decades.
    for elevation in [60.0, 30.0, 10.0, 2.0, 0.0, -2.0, -4.0, -6.0, -9.0, -12.0] {
        let up = math::f64::sin(f64::to_radians(elevation)).max(0.0);
        let sky = from_sky(elevation);
        let lx = photometric(&sky) + up * photometric(&CLEAR.transmittance(elevation, 0.533));
        let ratio = lx / measured_lx(elevation);
        assert!((0.75..1.34).contains(&ratio), "{elevation}°: {lx} lx, {ratio} of what is measured");
        // The ground's radiance tells the same irradiance.
        let ground = photometric(&CLEAR.ground(elevation)) * math::PI / SETTINGS.ground_albedo;
        assert!(
            (ground / lx - 1.0).abs() < 0.03,
            "{elevation}°: {ground} lx on the ground, {lx} lx from the sky"
        );
    }
}

#[test]
fn colours_of_sun_and_sky() {
    let share_of_blue = |s: &BandSpectrum| {
        let [r, _, b] = rgb(s);
        b / (r + b)
    };
    // The sky is bluer than the sun, the sun reddens as it sinks.
    assert!(share_of_blue(&CLEAR.sky(45.0, 89.0, 0.0)) > 0.6);
    let suns = [60.0, 20.0, 5.0, 1.0].map(|e| share_of_blue(&CLEAR.transmittance(e, 0.533)));
    assert!(suns.is_sorted_by(|a, b| a > b) && suns[0] < 0.47 && suns[3] < 0.05, "{suns:?}");
    // The zenith of the blue hour is blue because of ozone, without which it would be yellowish (Hulburt 1953).
    let zenith = CLEAR.sky(-6.0, 89.0, 0.0);
    assert!(share_of_blue(&zenith) > 0.65, "{}", share_of_blue(&zenith));
    // Over the set sun there is a warm glow, opposite the earth's shadow.
    let [glow, shadow] = [0.0, 180.0].map(|azimuth| CLEAR.sky(-4.0, 2.0, azimuth));
    assert!(share_of_blue(&glow) < 0.4 && photometric(&glow) > 3.0 * photometric(&shadow));
}

#[test]
fn the_night_is_dark_and_finite() {
    for elevation in [-15.0, -19.9, -20.0, -60.0, -90.0] {
        let zenith = CLEAR.sky(elevation, 90.0, 0.0);
        let horizon = CLEAR.sky(elevation, 0.0, 0.0);
        for value in [zenith, horizon, CLEAR.ground(elevation), CLEAR.transmittance(elevation, 0.533)]
            .iter()
            .flat_map(|s| s.0)
        {
            assert!((0.0..1e-6).contains(&value), "{elevation}°: {value}");
        }
    }
    assert_eq!(CLEAR.sky(LOWEST_DEG, 5.0, 0.0).0, [0.0; BANDS]);
}

#[test]
fn the_setting_disc_shines_with_what_is_over_the_horizon() {
    let at = |e: f64| CLEAR.transmittance(e, 0.533).0[15];
    assert!(at(0.3) > at(0.0) && at(0.0) > at(-0.2) && at(-0.2) > 0.0 && at(-0.27) == 0.0);
    // Straight up, Bouguer's law with the optical depths of the air: 0.063 of molecules at 612 nm, aerosol 0.087, ozone 0.036.
    let up = -math::f32::ln(CLEAR.transmittance(90.0, 0.0).at(612.0));
    assert!((up - 0.186).abs() < 0.006, "{up}");
}

/// Radiance at sea level for one band by paths that scatter as light does, with a connection to the sun at each scattering.
fn followed(
    band: usize,
    sun_elevation_deg: f64,
    elevation_deg: f64,
    azimuth_deg: f64,
    paths: u64,
) -> Moments {
    let Scatterers { air, columns, .. } = &CLEAR.scatterers;
    let along = |elevation: f64, azimuth: f64| {
        let (e, a) = (elevation.to_radians(), azimuth.to_radians());
        [math::f64::cos(e) * math::f64::cos(a), math::f64::sin(e), math::f64::cos(e) * math::f64::sin(a)]
    };
    let (sun, view) = (along(sun_elevation_deg, 0.0), along(elevation_deg, azimuth_deg));
    let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let majorant = f64::from(air.rayleigh[band] + air.aerosol[band]) + 0.01;
    let shines = |p: [f64; 3]| {
        let radius = dot(p, p).sqrt();
        let cosine = (dot(p, sun) / radius).clamp(-1.0, 1.0);
        let bands: Bands = columns.transmittance(air, (radius - GROUND_KM).max(0.0), math::f64::acos(cosine));
        f64::from(bands[band])
    };
    let mut moments = Moments::default();
    for path in 0..paths {
        let mut rng = PathRng::new(5, band as u64, path);
        let (mut p, mut d, mut weight, mut sum) = ([0.0, GROUND_KM + 1e-6, 0.0], view, 1.0, 0.0);
        for _ in 0..4000 {
            let step = math::neg_ln(1.0 - rng.uniform_f64()) / majorant;
            let b = dot(p, d);
            let (r2, ground2) = (dot(p, p), GROUND_KM * GROUND_KM);
            let under = b * b - r2 + ground2;
            let hit = if b < 0.0 && under > 0.0 { -b - under.sqrt() } else { f64::INFINITY };
            let t = step.min(hit);
            p = core::array::from_fn(|k| p[k] + t * d[k]);
            let radius = dot(p, p).sqrt();
            let turned = if hit <= step {
                let normal = p.map(|c| c / radius);
                weight *= SETTINGS.ground_albedo;
                sum += weight * shines(p) * dot(normal, sun).max(0.0) / math::PI;
                let n = Vec3A::from_array(normal.map(|c| c as f32));
                p = normal.map(|c| c * (GROUND_KM + 1e-6));
                warp::frame(n) * warp::cosine_hemisphere(rng.uniform2())
            } else if radius > GROUND_KM + TOP_KM {
                break;
            } else {
                let at = densities(radius - GROUND_KM);
                let rayleigh = f64::from(air.rayleigh[band] * at.air);
                let aerosol = f64::from(air.aerosol_scattering[band] * at.aerosol);
                let absorbed =
                    f64::from(air.ozone[band] * at.ozone + air.aerosol[band] * at.aerosol) - aerosol;
                let x = rng.uniform_f64() * majorant;
                if x >= rayleigh + aerosol + absorbed {
                    continue;
                }
                weight *= (rayleigh + aerosol) / (rayleigh + aerosol + absorbed);
                let phase = |c: f64| {
                    let g = f64::from(AEROSOL_G);
                    let base = 1.0 + g * g - 2.0 * g * c;
                    let henyey = (1.0 - g * g) / (base * base.sqrt());
                    (rayleigh * 0.75 * (1.0 + c * c) + aerosol * henyey)
                        / (rayleigh + aerosol)
                        / (4.0 * math::PI)
                };
                sum += weight * shines(p) * phase(dot(d, sun));
                let turned = warp::uniform_sphere(rng.uniform2());
                let to = turned.to_array().map(f64::from);
                weight *= phase(dot(d, to)) * 4.0 * math::PI;
                turned
            };
            let survival = weight.min(1.0);
            if rng.uniform_f64() >= survival {
                break;
            }
            weight /= survival;
            let length = f64::from(turned.length());
            d = turned.to_array().map(|c| f64::from(c) / length);
        }
        moments.add(sum);
    }
    moments
}

#[test]
fn orders_of_scattering_add_up_to_what_single_paths_find() {
    // 440 nm, where light is scattered most, and 600 nm in twilight, which ozone absorbs.
    for (band, sun, elevation, azimuth) in
        [(3, 40.0, 89.0, 0.0), (3, 40.0, 8.0, 120.0), (3, 3.0, 30.0, 60.0), (11, -3.0, 12.0, 0.0)]
    {
        let m = followed(band, sun, elevation, azimuth, 40_000);
        let got = f64::from(CLEAR.sky(sun, elevation, azimuth).0[band]);
        let allowed = 4.5 * m.standard_error() + 0.03 * m.mean();
        assert!(
            (got - m.mean()).abs() < allowed,
            "sun {sun}°, from {elevation}° {azimuth}°: {got:e}, followed {:e} ± {:e}",
            m.mean(),
            m.standard_error()
        );
        assert!(
            m.standard_error() < 0.06 * m.mean(),
            "too noisy to tell: {} of {}",
            m.standard_error(),
            m.mean()
        );
    }
}
