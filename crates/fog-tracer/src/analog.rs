//! The analog integrator: the oracle that the fast one is tested against, and its explanation.
//!
//! It does what light does, backwards and at one wavelength: fly until something is hit, scatter or be absorbed, and look
//! at what shines only when running into it. Nothing is estimated ahead, nothing is weighted between wavelengths.

use crate::path::PathTracer;
use fog_core::random::PathRng;
use fog_core::spectrum::Wavelengths;
use fog_core::{math, warp};
use fog_scene::camera::Ray;

impl PathTracer<'_> {
    /// Relative radiance along a ray at one wavelength. A sun that is a parallel beam cannot be hit and counts as dark.
    #[must_use]
    pub fn analog_radiance(&self, ray: Ray, wavelength_nm: f32, rng: &mut PathRng) -> f32 {
        let wavelengths = Wavelengths::monochromatic(wavelength_nm);
        let basis = self.observer.lane_basis(&wavelengths);
        let (mut origin, mut direction) = (ray.origin, ray.direction);
        let mut sum = 0.0;
        let mut beta = 1.0;
        let mut edges = 1;
        loop {
            // Fly: how far does the photon get in the fog?
            let flight = self.medium.as_ref().and_then(|medium| {
                let tau = -math::f64::ln(1.0 - rng.uniform_f64());
                let (y, dy) = (f64::from(origin.y), f64::from(direction.y));
                let lanes = medium.lanes(&wavelengths);
                medium.profile.free_flight(y, dy, f64::INFINITY, tau, &lanes.profile)
            });
            let t_max = flight.map_or(f32::INFINITY, |t| t as f32);
            let key = if self.scene.has_partial_opacity() { rng.next_u64() } else { 0 };
            if let Some(hit) = self.scene.scatterer(origin, direction, t_max, key) {
                // A surface: add what it emits, reflect or transmit by its BSDF.
                let surface = self.scene.surface(&hit, direction, &basis);
                sum += beta * surface.emission[0];
                let to_local = surface.world_from_shading.transpose();
                let sample =
                    surface.bsdf.and_then(|b| b.sample(to_local * -direction, rng.uniform(), rng.uniform2()));
                let Some(sample) = sample else { return sum };
                direction = (surface.world_from_shading * sample.wi).normalize();
                if direction.dot(surface.normal) * sample.wi.z <= 0.0 {
                    return sum;
                }
                beta *= sample.weight[0];
                origin = surface.point.spawn_origin(direction);
            } else if let (Some(t), Some(medium)) = (flight, &self.medium) {
                // A droplet: absorbed, or turned by its phase function.
                let y = (f64::from(origin.y) + t * f64::from(direction.y))
                    .clamp(medium.profile.base_y(), medium.profile.top_y());
                let lanes = medium.lanes(&wavelengths);
                if rng.uniform() >= medium.profile.albedo(y, &lanes.profile)[0] {
                    return sum;
                }
                let droplet = medium.phase.scatterer(medium.profile.zeta(y), &lanes.phase, rng);
                let m = medium.phase.sample(droplet.row, &droplet.lanes, rng.uniform_f64(), rng.uniform());
                let sin = (m * (2.0 - m)).max(0.0).sqrt();
                origin += direction * t as f32;
                let local = warp::spherical(1.0 - m, sin, math::TAU_F32 * rng.uniform());
                direction = (warp::frame(direction) * local).normalize();
            } else {
                // Out of the scene: the environment and the sun's disc.
                sum += beta * self.scene.environment.map_or(0.0, |e| e.radiance);
                let sun = self.scene.sun.filter(|s| s.contains(direction));
                return sum + beta * sun.map_or(0.0, |s| s.radiance());
            }
            if self.settings.max_depth.is_some_and(|max| edges >= max) || beta == 0.0 {
                return sum;
            }
            edges += 1;
        }
    }
}
