//! Light that the air scatters: once exactly, again and again by spherical harmonics.
//!
//! The air is the same all around the earth, so that radiance depends on the altitude and on the sun's zenith angle, and on the
//! direction. At nodes of altitude and angle the moments of the radiance with spherical harmonics of up to order 3 are kept:
//! they are all that Rayleigh scattering needs, and resolve what aerosol scatters twice. The order n + 1 of scattering follows
//! from the moments of order n by integrals along rays over the sphere; what the orders that are left out would add is taken
//! from the ratio of the last two.

use super::AtmosphereSettings;
use super::air::{AEROSOL_G, Air, Bands, Densities, GROUND_KM, WIDTH, densities};
use super::columns::Columns;
use super::harmonics::{GAUSS_6, HARMONICS, ORDER, harmonics};
use super::rays::{Piece, SHELLS, cut, shell_km};
use fog_core::math;
use rayon::prelude::*;

/// Nodes of the sun's zenith angle.
const ANGLES: usize = 71;
/// Azimuths of the rays from each node, over half of the circle.
const AZIMUTHS: usize = 6;
/// Orders of scattering that are followed; the rest is extrapolated.
const ORDERS: usize = 5;

type Moments = [Bands; HARMONICS];

/// Light that has been scattered at least once, on nodes of altitude and sun's zenith angle; for the irradiance 1 of the sun.
#[derive(Clone, Debug)]
pub(super) struct Scattered {
    /// Moments of the radiance: row by altitude, column by angle.
    moments: Vec<Moments>,
    /// Irradiance on the ground, without the sun's own.
    ground: Vec<Bands>,
}

/// The direction of a ray at its start: components upwards, and level towards the sun's azimuth.
#[derive(Clone, Copy, Debug)]
pub(super) struct Heading {
    pub(super) up: f64,
    pub(super) sunward: f64,
}

/// All that scattering needs.
#[derive(Clone, Debug)]
pub(super) struct Scatterers {
    pub(super) air: Air,
    pub(super) columns: Columns,
    ground_albedo: f32,
}

/// Light that is scattered next.
#[derive(Clone, Copy)]
enum Source<'a> {
    Sun,
    Scattered(&'a Scattered),
    Both(&'a Scattered),
}

impl Scatterers {
    pub(super) fn new(settings: &AtmosphereSettings) -> Self {
        Self {
            air: Air::new(settings),
            columns: Columns::new(),
            ground_albedo: settings.ground_albedo as f32,
        }
    }

    /// All orders of scattering.
    pub(super) fn solve(&self) -> Scattered {
        let mut last = self.next(Source::Sun);
        let mut total = last.clone();
        for order in 2..=ORDERS {
            let next = self.next(Source::Scattered(&last));
            total.add(&next);
            if order == ORDERS {
                total.add_rest(&last, &next);
            }
            last = next;
        }
        total
    }

    /// Radiance at sea level from a direction over the horizon, without the sun's own.
    pub(super) fn sky(&self, scattered: &Scattered, sun_zenith_angle: f64, from: Heading) -> Bands {
        self.radiance(0.0, sun_zenith_angle, from, Source::Both(scattered), &mut Vec::new())
    }

    /// Radiance that the level ground sends up where the sun has this zenith angle.
    pub(super) fn ground(&self, scattered: &Scattered, sun_zenith_angle: f64) -> Bands {
        self.reflected(sun_zenith_angle, Source::Both(scattered))
    }

    fn next(&self, source: Source<'_>) -> Scattered {
        let nodes = (0..SHELLS * ANGLES).into_par_iter();
        let found = nodes.map(|i| self.node(shell_km(i / ANGLES), angle(i % ANGLES), source));
        let (moments, mut ground): (Vec<_>, Vec<_>) = found.unzip();
        ground.truncate(ANGLES);
        Scattered { moments, ground }
    }

    /// Moments of the radiance at a point, and its irradiance from above.
    fn node(&self, altitude_km: f64, sun_zenith_angle: f64, source: Source<'_>) -> (Moments, Bands) {
        let (mut moments, mut above) = ([[0.0; WIDTH]; HARMONICS], [0.0; WIDTH]);
        let mut pieces = Vec::new();
        let ratio = GROUND_KM / (GROUND_KM + altitude_km);
        let horizon = -(1.0 - ratio * ratio).max(0.0).sqrt();
        for (low, high) in [(-1.0, horizon), (horizon, 1.0)] {
            for (node, weight) in GAUSS_6 {
                let up = 0.5 * (low + high + (high - low) * node);
                let level = (1.0 - up * up).max(0.0).sqrt();
                let omega = weight * 0.5 * (high - low) * math::TAU / AZIMUTHS as f64;
                for k in 0..AZIMUTHS {
                    let azimuth = math::PI * (k as f64 + 0.5) / AZIMUTHS as f64;
                    let heading = Heading { up, sunward: level * math::f64::cos(azimuth) };
                    let radiance = self.radiance(altitude_km, sun_zenith_angle, heading, source, &mut pieces);
                    let q = harmonics(heading.sunward as f32, up as f32);
                    for (moments, q) in moments.iter_mut().zip(q) {
                        add(moments, &radiance, q * omega as f32);
                    }
                    add(&mut above, &radiance, (up.max(0.0) * omega) as f32);
                }
            }
        }
        (moments, above)
    }

    /// Radiance that arrives at a point from the direction of a ray.
    fn radiance(
        &self,
        altitude_km: f64,
        sun_zenith_angle: f64,
        from: Heading,
        source: Source<'_>,
        pieces: &mut Vec<Piece>,
    ) -> Bands {
        let sun = [math::f64::sin(sun_zenith_angle), math::f64::cos(sun_zenith_angle)];
        let sideways = (1.0 - from.up * from.up - from.sunward * from.sunward).max(0.0).sqrt();
        let start = GROUND_KM + altitude_km;
        // Cosine between the ray and the sun, the same all along it.
        let to_sun = from.sunward * sun[0] + from.up * sun[1];
        let along = |t: f64| {
            let p = [t * from.sunward, start + t * from.up, t * sideways];
            let radius = p.iter().map(|c| c * c).sum::<f64>().sqrt();
            let cosine = ((p[0] * sun[0] + p[1] * sun[1]) / radius).clamp(-1.0, 1.0);
            let up = (p[0] * from.sunward + p[1] * from.up + p[2] * sideways) / radius;
            (radius - GROUND_KM, cosine, up)
        };
        let (mut sum, mut transmittance) = ([0.0; WIDTH], [1.0; WIDTH]);
        let hit = cut(altitude_km, from.up, pieces);
        for piece in &*pieces {
            let (altitude, cosine, up) = along(piece.middle_km);
            let d = densities(altitude);
            let emitted = self.emitted(altitude, cosine, up, to_sun, d, source);
            let Air { rayleigh, ozone, aerosol, .. } = &self.air;
            for w in 0..WIDTH {
                let extinction = rayleigh[w] * d.air + ozone[w] * d.ozone + aerosol[w] * d.aerosol;
                let passed = math::fast_exp(-extinction * piece.length_km as f32);
                sum[w] += transmittance[w] * emitted[w] * (1.0 - passed) / extinction;
                transmittance[w] *= passed;
            }
        }
        if let Some(distance) = hit {
            let (_, cosine, _) = along(distance);
            let ground = self.reflected(math::f64::acos(cosine), source);
            for w in 0..WIDTH {
                sum[w] += transmittance[w] * ground[w];
            }
        }
        sum
    }

    /// Light scattered into the ray per km.
    fn emitted(
        &self,
        altitude_km: f64,
        sun_cosine: f64,
        up: f64,
        to_sun: f64,
        d: Densities,
        source: Source<'_>,
    ) -> Bands {
        let zenith_angle = math::f64::acos(sun_cosine);
        let mut out = [0.0; WIDTH];
        if let Source::Sun | Source::Both(_) = source {
            let sun = self.columns.transmittance(&self.air, altitude_km, zenith_angle);
            let [rayleigh, aerosol] = phases(to_sun as f32);
            let (rayleigh, aerosol) = (rayleigh * d.air, aerosol * d.aerosol);
            for w in 0..WIDTH {
                out[w] =
                    sun[w] * (self.air.rayleigh[w] * rayleigh + self.air.aerosol_scattering[w] * aerosol);
            }
        }
        if let Source::Scattered(scattered) | Source::Both(scattered) = source {
            let sine = (1.0 - sun_cosine * sun_cosine).max(1e-12).sqrt();
            let sunward = (to_sun - up * sun_cosine) / sine;
            let by_order =
                scattered.by_order(altitude_km, zenith_angle, harmonics(sunward as f32, up as f32));
            // (2l + 1) / 4π times the coefficients of Rayleigh's and of Henyey & Greenstein's function.
            let quarter = 0.25 * math::INV_PI_F32;
            let g = AEROSOL_G;
            let rayleigh = [1.0, 0.0, 0.5, 0.0].map(|c| c * quarter * d.air);
            let aerosol = [1.0, 3.0 * g, 5.0 * g * g, 7.0 * g * g * g].map(|c| c * quarter * d.aerosol);
            for (order, sum) in by_order.iter().enumerate() {
                for w in 0..WIDTH {
                    let k = self.air.rayleigh[w] * rayleigh[order]
                        + self.air.aerosol_scattering[w] * aerosol[order];
                    out[w] += k * sum[w];
                }
            }
            // The sum of a few harmonics can fall below nothing.
            for value in &mut out {
                *value = value.max(0.0);
            }
        }
        out
    }

    /// Radiance of the ground.
    fn reflected(&self, sun_zenith_angle: f64, source: Source<'_>) -> Bands {
        let mut irradiance = [0.0; WIDTH];
        if let Source::Sun | Source::Both(_) = source {
            let sun = self.columns.transmittance(&self.air, 0.0, sun_zenith_angle);
            add(&mut irradiance, &sun, math::f64::cos(sun_zenith_angle).max(0.0) as f32);
        }
        if let Source::Scattered(scattered) | Source::Both(scattered) = source {
            let (column, weight) = place(sun_zenith_angle);
            add(&mut irradiance, &scattered.ground[column], 1.0 - weight);
            add(&mut irradiance, &scattered.ground[column + 1], weight);
        }
        irradiance.map(|e| e * self.ground_albedo * math::INV_PI_F32)
    }
}

impl Scattered {
    fn add(&mut self, other: &Self) {
        for (mine, theirs) in self.moments.iter_mut().zip(&other.moments) {
            for (mine, theirs) in mine.iter_mut().zip(theirs) {
                add(mine, theirs, 1.0);
            }
        }
        for (mine, theirs) in self.ground.iter_mut().zip(&other.ground) {
            add(mine, theirs, 1.0);
        }
    }

    /// Adds the geometric series that goes on from `last` to `next` to …
    fn add_rest(&mut self, last: &Self, next: &Self) {
        let rest = |last: f32, next: f32| {
            let ratio = if last > 0.0 { (next / last).clamp(0.0, 0.9) } else { 0.0 };
            ratio / (1.0 - ratio)
        };
        for (i, mine) in self.moments.iter_mut().enumerate() {
            for w in 0..WIDTH {
                let k = rest(last.moments[i][0][w], next.moments[i][0][w]);
                for (mine, next) in mine.iter_mut().zip(&next.moments[i]) {
                    mine[w] += k * next[w];
                }
            }
        }
        for (i, mine) in self.ground.iter_mut().enumerate() {
            for w in 0..WIDTH {
                mine[w] += rest(last.ground[i][w], next.ground[i][w]) * next.ground[i][w];
            }
        }
    }

    /// Sums of moments times harmonics, for each order.
    #[inline]
    fn by_order(&self, altitude_km: f64, zenith_angle: f64, q: [f32; HARMONICS]) -> [Bands; 4] {
        let y = (altitude_km.max(0.0) / shell_km(SHELLS - 1)).sqrt() * (SHELLS - 1) as f64;
        let row = (y as usize).min(SHELLS - 2);
        let a = ((y - row as f64) as f32).min(1.0);
        let (column, b) = place(zenith_angle);
        let mut out = [[0.0; WIDTH]; 4];
        let corners =
            [(0, 0, (1.0 - a) * (1.0 - b)), (0, 1, (1.0 - a) * b), (1, 0, a * (1.0 - b)), (1, 1, a * b)];
        for (i, j, weight) in corners {
            let moments = &self.moments[(row + i) * ANGLES + column + j];
            for k in 0..HARMONICS {
                add(&mut out[ORDER[k]], &moments[k], weight * q[k]);
            }
        }
        out
    }
}

/// Rayleigh's phase function and that of the aerosol, in 1/sr.
fn phases(cosine: f32) -> [f32; 2] {
    let rayleigh = 3.0 / 16.0 * math::INV_PI_F32 * (1.0 + cosine * cosine);
    let g = AEROSOL_G;
    let base = (1.0 + g * g - 2.0 * g * cosine).max(1e-6);
    [rayleigh, 0.25 * math::INV_PI_F32 * (1.0 - g * g) / (base * base.sqrt())]
}

/// Zenith angle of a node in radians: fine steps where the sun sets.
fn angle(i: usize) -> f64 {
    let x = i as f64;
    let degrees = match i {
        0..14 => 6.0 * x,
        14..18 => 84.0 + (x - 14.0),
        18..63 => 88.0 + 0.4 * (x - 18.0),
        _ => 106.0 + 2.0 * (x - 63.0),
    };
    degrees.to_radians()
}

/// Node before a zenith angle, and weight of the next; clamped at the last.
fn place(zenith_angle: f64) -> (usize, f32) {
    let degrees = zenith_angle.to_degrees();
    let x = if degrees < 84.0 {
        degrees / 6.0
    } else if degrees < 88.0 {
        14.0 + (degrees - 84.0)
    } else if degrees < 106.0 {
        18.0 + (degrees - 88.0) / 0.4
    } else {
        63.0 + (degrees - 106.0) / 2.0
    };
    let x = x.clamp(0.0, (ANGLES - 1) as f64);
    let i = (x as usize).min(ANGLES - 2);
    (i, (x - i as f64) as f32)
}

#[inline(always)]
fn add(sum: &mut Bands, values: &Bands, weight: f32) {
    for (sum, value) in sum.iter_mut().zip(values) {
        *sum += value * weight;
    }
}
