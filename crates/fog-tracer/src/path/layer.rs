//! The layer's own light along a path: how the scene differs from it, and where a path is likely to find that out.

use super::{Lanes, Path, PathRadiance, PathTracer, ROULETTE_DEPTH, ROULETTE_MIN, ROULETTE_MIN_KNOWN};
use crate::layer_light::LayerLanes;
use crate::watch::{Step, Watch};
use fog_core::random::PathRng;
use fog_core::spectrum::{Spectrum, Wavelengths};
use fog_scene::light_groups::LightSource;

/// Share of the collisions at which the light that the fog absorbs is counted, for all of them: it is little.
const ABSORPTION_SHARE: f32 = 0.125;

impl PathTracer<'_> {
    /// A path's wavelengths in the layer's light; `None` where the light of whole paths is to be found by themselves.
    #[inline]
    pub(super) fn layer_lanes(&self, wavelengths: &Wavelengths) -> Option<LayerLanes> {
        let layer = self.layer_light.as_ref().filter(|layer| layer.shines())?;
        self.settings.max_depth.is_none().then(|| layer.lanes(wavelengths))
    }

    /// The layer's light that the path would add if it ended on its flight, at world y; none on the first flight, which
    /// tells direct light from airlight and is left to chance.
    #[inline]
    pub(super) fn layer_beside(&self, path: &Path, lanes: &Lanes, y: f64) -> Spectrum {
        let Some((layer, lanes)) = self.layer_light.as_ref().zip(lanes.layer.as_ref()) else {
            return Spectrum::ZERO;
        };
        if path.depth == 0 {
            return Spectrum::ZERO;
        }
        path.beta * layer.radiance(y, path.direction.y, lanes) * (1.0 / path.r_u.mean())
    }

    /// The layer's light ahead of a path that was just turned.
    #[inline]
    pub(super) fn layer_ahead(&self, path: &Path, lanes: &Lanes) -> Spectrum {
        self.layer_beside(path, lanes, f64::from(path.origin.y))
    }

    /// What the layer's light adds after a scattering in the fog: all of it after the first event, and then less
    /// what the fog absorbed of it.
    #[inline]
    pub(super) fn layer_at_collision(&self, path: &Path, lanes: &Lanes, rng: &mut PathRng) -> Spectrum {
        let Some((medium, in_medium)) = self.fog(path.depth - 1, lanes) else {
            return Spectrum::ZERO;
        };
        if lanes.layer.is_none() {
            return Spectrum::ZERO;
        }
        if path.depth == 1 {
            return self.layer_ahead(path, lanes);
        }
        if medium.profile.least_albedo() == 1.0 || rng.uniform() >= ABSORPTION_SHARE {
            return Spectrum::ZERO;
        }
        let y = f64::from(path.origin.y).clamp(medium.profile.base_y(), medium.profile.top_y());
        let albedo = medium.profile.albedo(y, &in_medium.profile);
        // The path's weight holds what was left; the layer's light does not know of absorption.
        self.layer_ahead(path, lanes) * albedo.map(|a| (a - 1.0) / a) * (1.0 / ABSORPTION_SHARE)
    }

    /// Adds what a path that knows the layer's light finds at an event: `after` instead of `expected`.
    #[inline]
    pub(super) fn add_difference(
        &self,
        out: &mut PathRadiance,
        expected: Spectrum,
        after: Spectrum,
        watch: &mut impl Watch,
    ) {
        let added = after - expected;
        if !added.is_zero() {
            watch.see(|| Step::Layer { added });
            watch.light(LightSource::Environment, added, false);
            out.radiance += added;
        }
    }

    /// Throughput below which roulette is played where the path is now, and the least probability of survival.
    #[inline(always)]
    pub(super) fn roulette(&self, path: &Path) -> [f32; 2] {
        let layer = self.layer_light.as_ref().filter(|_| path.depth > ROULETTE_DEPTH);
        match layer.and_then(|layer| layer.worth(f64::from(path.origin.y), path.direction.y)) {
            Some(worth) => [self.roulette_below / worth, ROULETTE_MIN_KNOWN],
            None => [self.roulette_below, ROULETTE_MIN],
        }
    }
}
