//! Next-event estimation: connections of a path to the lights.

use super::glow::Flight;
use super::{Lanes, Path, PathTracer};
use crate::lights::LightSample;
use crate::lobe::FogLobe;
use crate::watch::{Offer, Visibility, Watch};
use fog_core::Vec3A;
use fog_core::random::PathRng;
use fog_core::spectrum::Spectrum;
use fog_scene::scene::Surface;

impl PathTracer<'_> {
    /// Next-event estimation from a point in the fog.
    pub(super) fn lights_in_fog(
        &self,
        path: &Path,
        lobe: &FogLobe<'_>,
        flight: Option<&Flight<'_>>,
        lanes: &Lanes,
        rng: &mut PathRng,
        watch: &mut impl Watch,
    ) -> Spectrum {
        let Some(light) = self.lights.sample(self.scene, path.origin, lanes, rng) else {
            return Spectrum::ZERO;
        };
        let value = lobe.value(light.direction);
        let ahead = path.depth + 1;
        let transmittance = self.transmittance(path.origin, light.direction, light.distance, ahead, lanes);
        let mut density = path.r_u * light.density(value.density * transmittance);
        if let (Some(flight), Some(lamp), Some(angles)) = (flight, light.lamp(), &self.phase_angles) {
            let lamps = self.scene.lamps();
            let near = flight.segment.near(lamps.lights()[lamp].position, angles).pdf(flight.t) as f32;
            density += flight.before * (lamps.probability(lamp, &flight.segment.receiver(angles)) * near);
        }
        let sum = path.beta * value.phase * transmittance * light.radiance * (1.0 / density.mean());
        let offer = Offer { light: &light, value: value.phase, transmittance, worth: sum, glow: false };
        self.unless_occluded(path.origin, &offer, rng, watch)
    }

    /// Next-event estimation from a surface.
    pub(super) fn lights_at_surface(
        &self,
        path: &Path,
        s: &Surface,
        lanes: &Lanes,
        rng: &mut PathRng,
        watch: &mut impl Watch,
    ) -> Spectrum {
        let Some(bsdf) = &s.bsdf else { return Spectrum::ZERO };
        let Some(light) = self.lights.sample(self.scene, s.point.position, lanes, rng) else {
            return Spectrum::ZERO;
        };
        let to_local = s.world_from_shading.transpose();
        let wi = to_local * light.direction;
        let (value, pdf) = bsdf.eval(to_local * -path.direction, wi);
        // Shading frame and triangle must agree on the side that the light is on.
        if pdf == 0.0 || s.normal.dot(light.direction) * wi.z <= 0.0 {
            return Spectrum::ZERO;
        }
        let origin = s.point.spawn_origin(light.direction);
        let ahead = path.depth + 1;
        let transmittance = self.transmittance(origin, light.direction, light.distance, ahead, lanes);
        let density = light.density(transmittance * pdf);
        let sum = path.beta * value * transmittance * light.radiance * (1.0 / (path.r_u * density).mean());
        let offer = Offer { light: &light, value, transmittance, worth: sum, glow: false };
        self.unless_occluded(origin, &offer, rng, watch)
    }

    /// What the offer is worth if nothing stands before the light; small worths are played for before the shadow ray is
    /// traced.
    #[inline]
    pub(super) fn unless_occluded(
        &self,
        origin: Vec3A,
        offer: &Offer<'_>,
        rng: &mut PathRng,
        watch: &mut impl Watch,
    ) -> Spectrum {
        let (light, sum) = (offer.light, offer.worth);
        let (keep, visibility) = self.shadow(origin, light, sum.max_lane(), rng);
        watch.see(|| offer.step(keep, visibility));
        if visibility != Visibility::Free {
            return Spectrum::ZERO;
        }
        let seen = sum * (1.0 / keep);
        watch.light(light.source, seen, offer.glow);
        seen
    }

    /// What becomes of a connection whose largest worth is `largest`, and the probability with which it was traced at all.
    #[inline(always)]
    pub(crate) fn shadow(
        &self,
        origin: Vec3A,
        light: &LightSample,
        largest: f32,
        rng: &mut PathRng,
    ) -> (f32, Visibility) {
        if largest <= 0.0 {
            return (1.0, Visibility::Dark);
        }
        let keep = (largest * self.lights.shadow_scale()).min(1.0);
        if keep < 1.0 && rng.uniform() >= keep {
            return (keep, Visibility::Dropped);
        }
        let key = if self.scene.has_partial_opacity() { rng.next_u64() } else { 0 };
        if self.scene.occluded(origin, light.direction, light.distance * (1.0 - 1e-4), key) {
            return (keep, Visibility::Blocked);
        }
        (keep, Visibility::Free)
    }

    /// Transmittance of the fog along a ray after so many scatterings, at all lanes.
    #[inline(always)]
    pub(super) fn transmittance(
        &self,
        origin: Vec3A,
        direction: Vec3A,
        distance: f32,
        depth: u32,
        lanes: &Lanes,
    ) -> Spectrum {
        let Some((medium, lanes)) = self.fog(depth, lanes) else {
            return Spectrum::ONE;
        };
        if let Some(patchy) = &medium.patchy {
            return self.transmittance_of_patches(patchy, origin, direction, distance, lanes);
        }
        let (y, dy) = (f64::from(origin.y), f64::from(direction.y));
        medium.profile.optical_depth(y, dy, f64::from(distance), &lanes.profile).exp_neg()
    }
}
