//! What shines from far away: a uniform environment, and a sun. Surroundings with structure are a
//! [`SkyMap`](crate::sky_map::SkyMap).
//!
//! Radiance is relative to D65 (`fog_core::colour`): a scalar is the same at every wavelength.

use fog_core::bands::BandSpectrum;
use fog_core::warp;
use fog_core::{Vec3A, math};

/// The sky and whatever lies beyond the scene: the same radiance from every direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Environment {
    /// Relative radiance.
    pub radiance: f32,
}

/// The sun: a uniform disc at infinity, or a parallel beam if its diameter is 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sun {
    /// Unit vector towards the sun.
    pub direction: Vec3A,
    /// Irradiance on a plane normal to the beam, relative to D65.
    pub irradiance: f32,
    /// Factor on the irradiance by wavelength: 1 for the spectrum of D65.
    pub colour: BandSpectrum,
    /// 1 − cos of the disc's half-angle; 0 for a parallel beam.
    pub one_minus_cos: f32,
}

impl Sun {
    /// Sun at `elevation_deg` over the horizon and `azimuth_deg` clockwise from north (−Z), seen under
    /// `angular_diameter_deg`.
    #[must_use]
    pub fn new(elevation_deg: f64, azimuth_deg: f64, irradiance: f64, angular_diameter_deg: f64) -> Self {
        let (e, a) = (elevation_deg.to_radians(), azimuth_deg.to_radians());
        let ce = math::f64::cos(e);
        let direction = Vec3A::new(
            (ce * math::f64::sin(a)) as f32,
            math::f64::sin(e) as f32,
            (-ce * math::f64::cos(a)) as f32,
        );
        // 1 − cos α = 2 sin²(α/2), which keeps its digits for small discs.
        let s = math::f64::sin(0.25 * angular_diameter_deg.to_radians());
        Self {
            direction: direction.normalize(),
            irradiance: irradiance as f32,
            colour: BandSpectrum::ONE,
            one_minus_cos: (2.0 * s * s) as f32,
        }
    }

    /// The same sun in another colour: a factor on its irradiance by wavelength.
    #[must_use]
    pub fn with_colour(self, colour: BandSpectrum) -> Self {
        Self { colour, ..self }
    }

    /// True if the sun is a parallel beam, which no ray can hit by chance.
    #[inline]
    #[must_use]
    pub fn is_beam(&self) -> bool {
        self.one_minus_cos == 0.0
    }

    /// Relative radiance of the disc where its colour is 1: irradiance / (π sin² α).
    #[inline]
    #[must_use]
    pub fn radiance(&self) -> f32 {
        let m = self.one_minus_cos;
        self.irradiance / (math::PI_F32 * m * (2.0 - m))
    }

    /// True if `direction` (unit, away from the viewer) points at the disc.
    #[inline]
    #[must_use]
    pub fn contains(&self, direction: Vec3A) -> bool {
        0.5 * (direction - self.direction).length_squared() <= self.one_minus_cos && !self.is_beam()
    }

    /// Direction uniform over the disc; density [`Sun::pdf`].
    #[inline]
    #[must_use]
    pub fn sample(&self, u: [f32; 2]) -> Vec3A {
        if self.is_beam() {
            return self.direction;
        }
        (warp::frame(self.direction) * warp::uniform_cone(u, self.one_minus_cos)).normalize()
    }

    /// Density of [`Sun::sample`] over the disc, in 1/sr; not for a beam.
    #[inline]
    #[must_use]
    pub fn pdf(&self) -> f32 {
        warp::uniform_cone_pdf(self.one_minus_cos)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sun_stands_where_its_angles_say() {
        let east = Sun::new(0.0, 90.0, 1.0, 0.5);
        assert!((east.direction - Vec3A::X).length() < 1e-6);
        let noon = Sun::new(90.0, 12.0, 1.0, 0.0);
        assert!((noon.direction - Vec3A::Y).length() < 1e-6 && noon.is_beam());
    }

    #[test]
    fn disc_carries_its_irradiance() {
        // ∫ L cos θ dω over the disc = E, for the sun's size and for a huge one.
        for diameter in [0.533, 30.0] {
            let sun = Sun::new(40.0, 10.0, 3.0, diameter);
            let mut rng = fog_core::random::PathRng::new(1, 0, 0);
            let n = 200_000;
            let mean_cos = (0..n)
                .map(|_| {
                    let d = sun.sample(rng.uniform2());
                    assert!(diameter < 1.0 || sun.contains(d));
                    f64::from(d.dot(sun.direction))
                })
                .sum::<f64>()
                / f64::from(n);
            let e = f64::from(sun.radiance()) * mean_cos / f64::from(sun.pdf());
            assert!((e - 3.0).abs() < 2e-3, "{e}");
        }
    }
}
