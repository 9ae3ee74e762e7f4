//! Paths through patchy fog.
//!
//! Even and patchy fog differ in what a flight crosses and in nothing else: depths at all wavelengths, the place in the even
//! layer whose droplets are at its end, and a factor on their density ([`fog_core::patchiness::PatchyFog`]). They are functions
//! of the ray, not samples, so that weights between wavelengths and strategies are those of even fog. Walks through patches
//! take microseconds: they are functions of their own, so that even fog pays one comparison for a flight.

use super::{Event, Lanes, Path, PathTracer};
use fog_core::patchiness::{Crossed, PatchyFog};
use fog_core::spectrum::Spectrum;
use fog_core::{Vec3A, math};
use fog_scene::medium::MediumLanes;

impl PathTracer<'_> {
    /// True if the fog is patchy.
    #[inline(always)]
    pub(super) fn is_patchy(&self) -> bool {
        self.medium.as_ref().is_some_and(|medium| medium.patchy.is_some())
    }

    /// `fly` in patchy fog. The surface comes first, for walking through the fog behind it would cost more than its test.
    #[cold]
    #[inline(never)]
    pub(super) fn fly_through_patches(
        &self,
        origin: Vec3A,
        direction: Vec3A,
        lanes: &Lanes,
        u: f64,
    ) -> (Event, f64, Crossed) {
        let (medium, lanes) = self.medium.as_ref().zip(lanes.medium.as_ref()).expect("patches are of fog");
        let patchy = medium.patchy.as_ref().expect("called in patchy fog");
        let hit = self.scene.scatterer(origin, direction, f32::INFINITY, u.to_bits());
        let end = hit.as_ref().map_or(f64::INFINITY, |hit| f64::from(hit.t));
        let tau = math::neg_ln(1.0 - u);
        let crossed = patchy.fly(origin, direction, end, tau, &lanes.profile);
        let event = match hit {
            _ if crossed.collided => Event::Collision { t: crossed.t, tau },
            Some(hit) => Event::Surface(hit),
            None => Event::Escape,
        };
        (event, end, crossed)
    }

    /// What the path's flight crosses on its first `t` metres.
    #[inline]
    pub(super) fn cross(&self, path: &Path, t: f64, lanes: &MediumLanes) -> Crossed {
        let medium = self.medium.as_ref().expect("only fog is crossed");
        if let Some(patchy) = &medium.patchy {
            return patchy.fly(path.origin, path.direction, t, f64::INFINITY, &lanes.profile);
        }
        let (y, dy) = (f64::from(path.origin.y), f64::from(path.direction.y));
        let even_y = (y + t * dy).clamp(medium.profile.base_y(), medium.profile.top_y());
        let depth = medium.profile.optical_depth(y, dy, t, &lanes.profile);
        Crossed { t, depth, even_y, density: 1.0, collided: false }
    }

    /// World y in the even layer of the droplets that the path has collided with, and the factor on their density.
    #[inline]
    pub(super) fn even_place(&self, path: &Path) -> (f64, f32) {
        let medium = self.medium.as_ref().expect("collision needs fog");
        let even = || (f64::from(path.origin.y).clamp(medium.profile.base_y(), medium.profile.top_y()), 1.0);
        path.crossed.map_or_else(even, |crossed| (crossed.even_y, crossed.density as f32))
    }

    /// Transmittance of patchy fog along a ray at all lanes.
    #[cold]
    #[inline(never)]
    pub(super) fn transmittance_of_patches(
        &self,
        patchy: &PatchyFog<'_>,
        origin: Vec3A,
        direction: Vec3A,
        distance: f32,
        lanes: &MediumLanes,
    ) -> Spectrum {
        patchy.fly(origin, direction, f64::from(distance), f64::INFINITY, &lanes.profile).depth.exp_neg()
    }
}
