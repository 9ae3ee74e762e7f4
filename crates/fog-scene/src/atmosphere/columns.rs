//! How much air, ozone and aerosol lies between a point and the sun.

use super::air::{Air, Bands, GROUND_KM, TOP_KM, WIDTH, densities};
use fog_core::math;

/// Rows of the table, even in the root of the altitude.
const ROWS: usize = 48;
/// Columns, even in the root of the angle over the horizon.
const COLUMNS: usize = 128;
/// Steps of an integral on one side of the point nearest to the ground.
const STEPS: usize = 64;
/// Stands for none, so that there is a logarithm.
const LEAST_KM: f64 = 1e-12;

/// Logarithms of the columns of air, ozone and aerosol (in km at their densities at sea level and peak), by altitude and angle
/// over the horizon as it is seen from there. No refraction.
#[derive(Clone, Debug)]
pub(super) struct Columns(Vec<[f32; 3]>);

impl Columns {
    pub(super) fn new() -> Self {
        let mut rows = Vec::with_capacity(ROWS * COLUMNS);
        for i in 0..ROWS {
            let x = i as f64 / (ROWS - 1) as f64;
            let altitude = TOP_KM * x * x;
            let horizon = horizon_angle(altitude);
            for j in 0..COLUMNS {
                let w = j as f64 / (COLUMNS - 1) as f64;
                let zenith_angle = horizon * (1.0 - w * w);
                rows.push(columns(altitude, zenith_angle).map(|c| math::f64::ln(c.max(LEAST_KM)) as f32));
            }
        }
        Self(rows)
    }

    /// Transmittance from a point towards the sun: altitude in km and the sun's zenith angle there, in radians.
    pub(super) fn transmittance(&self, air: &Air, altitude_km: f64, zenith_angle: f64) -> Bands {
        let over_horizon = 1.0 - zenith_angle / horizon_angle(altitude_km);
        if over_horizon <= 0.0 {
            return [0.0; WIDTH];
        }
        let y = (altitude_km / TOP_KM).clamp(0.0, 1.0).sqrt() * (ROWS - 1) as f64;
        let x = over_horizon.min(1.0).sqrt() * (COLUMNS - 1) as f64;
        let (i, j) = ((y as usize).min(ROWS - 2), (x as usize).min(COLUMNS - 2));
        let (a, b) = ((y - i as f64) as f32, (x - j as f64) as f32);
        let at = |i: usize, j: usize| self.0[i * COLUMNS + j];
        let [p, q, r, s] = [at(i, j), at(i, j + 1), at(i + 1, j), at(i + 1, j + 1)];
        let column: [f32; 3] = core::array::from_fn(|k| {
            let (lower, upper) = (p[k] + (q[k] - p[k]) * b, r[k] + (s[k] - r[k]) * b);
            math::fast_exp(lower + (upper - lower) * a)
        });
        let mut out = [0.0; WIDTH];
        for w in 0..WIDTH {
            let depth = air.rayleigh[w] * column[0] + air.ozone[w] * column[1] + air.aerosol[w] * column[2];
            out[w] = math::fast_exp(-depth);
        }
        out
    }
}

/// Zenith angle of the ground's horizon seen from an altitude, in radians.
fn horizon_angle(altitude_km: f64) -> f64 {
    math::PI - math::f64::asin((GROUND_KM / (GROUND_KM + altitude_km.max(0.0))).min(1.0))
}

/// Columns along a straight ray out of the air that passes over the ground.
fn columns(altitude_km: f64, zenith_angle: f64) -> [f64; 3] {
    let radius = GROUND_KM + altitude_km;
    let (along, nearest) = (radius * math::f64::cos(zenith_angle), radius * math::f64::sin(zenith_angle));
    let half_chord = |radius: f64| (radius * radius - nearest * nearest).max(0.0).sqrt();
    let end = half_chord(GROUND_KM + TOP_KM);
    // Distances from the point nearest to the ground, graded towards where the air is dense.
    let part = |from: f64, to: f64| {
        let mut sum = [0.0; 3];
        for k in 0..STEPS {
            let (u0, u1) = (k as f64 / STEPS as f64, (k + 1) as f64 / STEPS as f64);
            let at = |u: f64| from + (to - from) * u * u;
            let middle = at(0.5 * (u0 + u1));
            let d = densities(nearest.hypot(middle) - GROUND_KM);
            let length = at(u1) - at(u0);
            for (sum, density) in sum.iter_mut().zip([d.air, d.ozone, d.aerosol]) {
                *sum += f64::from(density) * length;
            }
        }
        sum
    };
    if along >= 0.0 {
        part(along, end)
    } else {
        let (down, up) = (part(0.0, -along), part(0.0, end));
        core::array::from_fn(|k| down[k] + up[k])
    }
}
