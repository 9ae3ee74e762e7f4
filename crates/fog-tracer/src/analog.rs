//! The analog integrator: the oracle that the fast one is tested against, and its explanation.
//!
//! It does what light does, backwards and at one wavelength: fly until something is hit, scatter or be absorbed, and look
//! at what shines only when running into it. Nothing is estimated ahead, nothing is weighted between wavelengths. Lights
//! without extent cannot be run into: all of them are looked at from every scattering.

mod null_collisions;

use self::null_collisions::Collision;
use crate::lights::lamp_light;
use crate::path::PathTracer;
use fog_core::colour::upsample;
use fog_core::random::PathRng;
use fog_core::spectrum::{Spectrum, Wavelengths};
use fog_core::{Vec3A, math, warp};
use fog_scene::camera::Ray;

impl PathTracer<'_> {
    /// Relative radiance along a ray at one wavelength. A sun that is a parallel beam cannot be hit and counts as dark.
    #[must_use]
    pub fn analog_radiance(&self, ray: Ray, wavelength_nm: f32, rng: &mut PathRng) -> f32 {
        let wavelengths = Wavelengths::monochromatic(wavelength_nm);
        let lanes = self.lanes(&wavelengths);
        let basis = lanes.basis;
        let (mut origin, mut direction) = (ray.origin, ray.direction);
        let mut sum = 0.0;
        let mut beta = 1.0;
        let mut edges = 1;
        loop {
            // Fly: how far does the photon get in the fog?
            let flight = self.medium.as_ref().and_then(|medium| {
                let lanes = medium.lanes(&wavelengths);
                if let Some(fog) = self.null_collisions(&lanes) {
                    return fog.fly(origin, direction, f64::INFINITY, rng);
                }
                let tau = -math::f64::ln(1.0 - rng.uniform_f64());
                let (y, dy) = (f64::from(origin.y), f64::from(direction.y));
                let t = medium.profile.free_flight(y, dy, f64::INFINITY, tau, &lanes.profile)?;
                let even_y = (y + t * dy).clamp(medium.profile.base_y(), medium.profile.top_y());
                Some(Collision { t, even_y })
            });
            let t_max = flight.as_ref().map_or(f32::INFINITY, |collision| collision.t as f32);
            let key = if self.scene.has_partial_opacity() { rng.next_u64() } else { 0 };
            if let Some(hit) = self.scene.scatterer(origin, direction, t_max, key) {
                // A surface: add what it emits, reflect or transmit by its BSDF.
                let surface = self.scene.surface(&hit, direction, &basis);
                sum += beta * surface.emission[0];
                let to_local = surface.world_from_shading.transpose();
                let sample =
                    surface.bsdf.and_then(|b| b.sample(to_local * -direction, rng.uniform(), rng.uniform2()));
                if let Some(bsdf) =
                    surface.bsdf.filter(|_| self.settings.max_depth.is_none_or(|max| edges < max))
                {
                    let lit =
                        self.lamps_and_beams(surface.point.position, &basis, &wavelengths, rng, |towards| {
                            let wi = to_local * towards;
                            let agree = surface.normal.dot(towards) * wi.z > 0.0;
                            let value = bsdf.eval(to_local * -direction, wi).0[0];
                            (if agree { value } else { 0.0 }, surface.point.spawn_origin(towards))
                        });
                    sum += beta * lit;
                }
                let Some(sample) = sample else { return sum };
                direction = (surface.world_from_shading * sample.wi).normalize();
                if direction.dot(surface.normal) * sample.wi.z <= 0.0 {
                    return sum;
                }
                beta *= sample.weight[0];
                origin = surface.point.spawn_origin(direction);
            } else if let (Some(Collision { t, even_y: y }), Some(medium)) = (flight, &self.medium) {
                // A droplet: absorbed, or turned by its phase function.
                let lanes = medium.lanes(&wavelengths);
                if rng.uniform() >= medium.profile.albedo(y, &lanes.profile)[0] {
                    return sum;
                }
                let droplet = medium.phase.scatterer(medium.profile.zeta(y), &lanes.phase, rng);
                let m = medium.phase.sample(droplet.row, &droplet.lanes, rng.uniform_f64(), rng.uniform());
                let sin = (m * (2.0 - m)).max(0.0).sqrt();
                origin += direction * t as f32;
                if self.settings.max_depth.is_none_or(|max| edges < max) {
                    sum += beta
                        * self.lamps_and_beams(origin, &basis, &wavelengths, rng, |towards| {
                            let m = 0.5 * (towards - direction).length_squared();
                            (medium.phase.eval(droplet.row, m, &droplet.lanes)[0], origin)
                        });
                }
                let local = warp::spherical(1.0 - m, sin, math::TAU_F32 * rng.uniform());
                direction = (warp::frame(direction) * local).normalize();
            } else {
                // Out of the scene: the environment, the sky and the sun's disc.
                sum += beta * self.scene.environment.map_or(0.0, |e| e.radiance);
                let sky = self.scene.sky.as_ref();
                sum += beta * sky.map_or(0.0, |sky| sky.radiance(direction, lanes.sky())[0]);
                let sun = self.scene.sun.filter(|s| s.contains(direction));
                return sum + beta * sun.map_or(0.0, |s| s.radiance() * lanes.sun[0]);
            }
            if self.settings.max_depth.is_some_and(|max| edges >= max) || beta == 0.0 {
                return sum;
            }
            edges += 1;
        }
    }

    /// Light of all lamps and beams at a point, each weighted by `value` of the unit vector towards it, which also says from
    /// where to look.
    fn lamps_and_beams(
        &self,
        from: Vec3A,
        basis: &[Spectrum; 3],
        wavelengths: &Wavelengths,
        rng: &mut PathRng,
        value: impl Fn(Vec3A) -> (f32, Vec3A),
    ) -> f32 {
        let lamps = (0..self.scene.lamps().lights().len()).filter_map(|i| {
            let light = lamp_light(self.scene, i, from, 1.0, basis)?;
            Some((light.direction, light.distance, light.radiance[0]))
        });
        let beams = self.scene.beams().iter();
        let beams = beams.map(|b| (b.direction, f32::INFINITY, upsample(b.illuminance, basis)[0]));
        lamps
            .chain(beams)
            .map(|(direction, distance, irradiance)| {
                let (weight, origin) = value(direction);
                let key = if self.scene.has_partial_opacity() { rng.next_u64() } else { 0 };
                if weight == 0.0 || self.scene.occluded(origin, direction, distance * (1.0 - 1e-4), key) {
                    return 0.0;
                }
                let depth = self.medium.as_ref().map_or(0.0, |medium| {
                    let (y, dy) = (f64::from(origin.y), f64::from(direction.y));
                    let lanes = medium.lanes(wavelengths);
                    if let Some(fog) = self.null_collisions(&lanes) {
                        let stopped = fog.fly(origin, direction, f64::from(distance), rng).is_some();
                        return if stopped { f32::INFINITY } else { 0.0 };
                    }
                    medium.profile.optical_depth(y, dy, f64::from(distance), &lanes.profile)[0]
                });
                weight * irradiance * math::fast_exp(-depth)
            })
            .sum()
    }
}
