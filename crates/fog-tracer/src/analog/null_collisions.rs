//! Patchy fog as the oracle sees it: candidates in a fog as dense as the densest, of which the share that the fog is less
//! dense at their place is passed over (Woodcock et al. 1965). It knows nothing of waves along rays.

use crate::path::PathTracer;
use fog_core::patchiness::{Area, PatchyFog, PatchyLayer};
use fog_core::profile::{ExtinctionProfile, ProfileLanes};
use fog_core::random::PathRng;
use fog_core::{Vec3A, math};
use fog_scene::medium::MediumLanes;

/// Patchy fog along a ray.
pub(super) struct NullCollisions<'a> {
    patchy: &'a PatchyFog<'a>,
    layer: PatchyLayer<'a>,
    profile: &'a ExtinctionProfile,
    lanes: ProfileLanes,
    /// Extinction in 1/m that is nowhere exceeded.
    majorant: f64,
}

/// A collision.
pub(super) struct Collision {
    /// Distance in m.
    pub(super) t: f64,
    /// World y of the droplet in the even layer.
    pub(super) even_y: f64,
}

impl PathTracer<'_> {
    /// The fog where it is patchy, at the wavelength of lane 0.
    pub(super) fn null_collisions(&self, lanes: &MediumLanes) -> Option<NullCollisions<'_>> {
        let medium = self.medium.as_ref()?;
        let patchy = medium.patchy.as_ref()?;
        let (profile, layer) = (medium.profile, patchy.layer());
        let densest = layer.field().density_bounds(&Area::EVERYWHERE)[1];
        let majorant = densest * profile.largest_sigma_t(&lanes.profile);
        Some(NullCollisions { patchy, layer, profile, lanes: lanes.profile, majorant })
    }
}

impl NullCollisions<'_> {
    /// The first collision along a ray before `t_max`, if any.
    pub(super) fn fly(
        &self,
        origin: Vec3A,
        direction: Vec3A,
        t_max: f64,
        rng: &mut PathRng,
    ) -> Option<Collision> {
        let span = self.patchy.clip(origin, direction, t_max)?;
        let mut t = span.enter;
        loop {
            t -= math::f64::ln(1.0 - rng.uniform_f64()) / self.majorant;
            if t.is_nan() || t >= span.exit {
                return None;
            }
            let point = (origin.as_dvec3() + direction.as_dvec3() * t).to_array();
            let even_y = self.layer.even_altitude_m(point);
            let inside = (self.profile.base_y()..=self.profile.top_y()).contains(&even_y);
            if inside && self.majorant * rng.uniform_f64() < self.sigma_t(point) {
                return Some(Collision { t, even_y });
            }
        }
    }

    /// σ_t in 1/m at a point in the layer.
    fn sigma_t(&self, point: [f64; 3]) -> f64 {
        self.layer.sigma_t(point, |y| f64::from(self.profile.sigma_t(y, &self.lanes)[0]))
    }
}
