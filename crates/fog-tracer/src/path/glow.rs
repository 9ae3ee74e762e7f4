//! Light of lamps that the fog scatters along a flight, at points chosen by their nearness to a lamp.

use super::{Lanes, Path, PathTracer};
use crate::equiangular::Segment;
use crate::lights::lamp_light;
use crate::watch::{Offer, Step, Watch};
use fog_core::math;
use fog_core::patchiness::Crossed;
use fog_core::random::PathRng;
use fog_core::spectrum::Spectrum;
use fog_scene::light_tree::Receiver;

/// How a flight through fog near lamps finds points: what other ways to a vertex a connection to a lamp must count.
pub(super) struct Flight<'a> {
    /// Where points are also chosen by nearness to lamps.
    pub(super) segment: &'a Segment,
    /// Distance of the vertex along it.
    pub(super) t: f64,
    /// Densities of the path before its flight at each wavelength, over that of the hero's flight.
    pub(super) before: Spectrum,
}

impl PathTracer<'_> {
    /// The part of a flight that lies in fog which lamps may light; `end` is the distance of the first surface.
    #[inline]
    pub(super) fn lit_segment(&self, path: &Path, end: f64) -> Option<Segment> {
        let medium = self.medium.as_ref()?;
        if self.lights.lamp_probability() == 0.0 || !self.may_scatter(path, &mut ()) {
            return None;
        }
        let (origin, direction) = (path.origin, path.direction);
        let span = match &medium.patchy {
            None => medium.profile.clip(f64::from(origin.y), f64::from(direction.y), end),
            Some(patchy) => patchy.clip(origin, direction, end),
        }?;
        let (enter, exit) = (span.enter, span.exit);
        (exit > enter).then_some(Segment { origin, direction, enter, exit })
    }

    /// Density per metre of the hero's flight to where the path is now, having crossed `tau`.
    pub(super) fn flight_density(&self, path: &Path, lanes: &Lanes, tau: f64) -> f32 {
        let (medium, lanes) = self.fog(path.depth, lanes).expect("collision needs fog");
        let (y, density) = self.even_place(path);
        medium.profile.sigma_t(y, &lanes.profile)[0] * density * math::fast_exp(-(tau as f32))
    }

    /// Light of a lamp that the fog scatters at a point of the flight chosen by its nearness to the lamp, balanced against
    /// connections from where free flights end.
    pub(super) fn glow(
        &self,
        path: &Path,
        segment: &Segment,
        lanes: &Lanes,
        rng: &mut PathRng,
        watch: &mut impl Watch,
    ) -> Spectrum {
        let (medium, medium_lanes) = self.fog(path.depth, lanes).expect("a lit segment needs fog");
        let lamps = self.scene.lamps();
        let angles = self.phase_angles.as_ref().expect("a lit segment needs lamps");
        let Some((lamp, chosen)) = lamps.choose(&segment.receiver(angles), rng.uniform_f64()) else {
            return Spectrum::ZERO;
        };
        let near = segment.near(lamps.lights()[lamp].position, angles);
        let Some(t) = near.sample(rng.uniform_f64()) else { return Spectrum::ZERO };
        let point = path.origin + path.direction * t as f32;
        let Crossed { even_y, depth, density, .. } = self.cross(path, t, medium_lanes);
        let scatterer = medium.phase.scatterer(medium.profile.zeta(even_y), &medium_lanes.phase, rng);
        let Some(light) = lamp_light(self.scene, lamp, point, 1.0, &lanes.basis) else {
            return Spectrum::ZERO;
        };

        let profile = medium.profile;
        let flight = depth.exp_neg() * profile.sigma_t(even_y, &medium_lanes.profile) * density as f32;
        let m = 0.5 * (light.direction - path.direction).length_squared();
        let phase = medium.phase.eval(scatterer.row, m, &scatterer.lanes);
        let transmittance = self.transmittance(point, light.direction, light.distance, path.depth + 1, lanes);
        let value = path.beta
            * flight
            * profile.albedo(even_y, &medium_lanes.profile)
            * scatterer.probability_ratio
            * phase
            * transmittance
            * light.radiance;
        let aimed = self.lights.lamp_probability() * lamps.probability(lamp, &Receiver::Point(point));
        let own = Spectrum::splat(chosen * near.pdf(t) as f32);
        let density = path.r_u * scatterer.probability_ratio * (flight * aimed + own);
        let mean = density.mean();
        if mean <= 0.0 {
            return Spectrum::ZERO;
        }
        watch.see(|| Step::NearLamp { position: point, distance_m: t });
        let worth = value * (1.0 / mean);
        let offer = Offer { light: &light, value: phase, transmittance, worth, glow: path.depth == 0 };
        self.unless_occluded(point, &offer, rng, watch)
    }
}
