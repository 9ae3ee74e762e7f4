//! The light of an emitter that a path runs into, together with that of its twin ([`fog_scene::twins`]): the path could as well
//! have been turned towards that.
//!
//! A path of density D that brings f and the same path with its end at the twin, D' and f', are found by each other, for twins
//! are so in turn and areas stay the same. The balance heuristic over both gives (f + f') / (D + D') to either.

use super::{Lanes, Path, PathTracer};
use fog_core::Vec3A;
use fog_core::colour::upsample;
use fog_core::spectrum::Spectrum;
use fog_scene::Hit;
use fog_scene::scene::{Scene, Surface};
use fog_scene::twins::Twins;
use std::sync::Arc;

/// Largest ratio of the densities of twins up to which both are looked at. It must hold from either side.
const LARGEST_RATIO: f32 = 16.0;

/// How the last event turned a path, where the density of other directions from there can be told.
#[derive(Clone, Copy, Debug)]
pub(super) enum Turn {
    /// It cannot.
    Untold,
    /// By the phase function.
    Droplet {
        before: Vec3A,
        /// Of the phase function's table.
        row: usize,
    },
    /// By the cosine.
    Lambert { shading: Vec3A, normal: Vec3A },
}

impl Turn {
    /// Of a path that this surface has reflected.
    #[inline]
    pub(super) fn at_surface(surface: &Surface) -> Self {
        let lambertian = surface.bsdf.as_ref().is_some_and(|bsdf| bsdf.is_lambertian());
        let (shading, normal) = (surface.world_from_shading.z_axis, surface.normal);
        if lambertian { Self::Lambert { shading, normal } } else { Self::Untold }
    }
}

/// The twins of a scene, if there are any and the turns of paths can be told.
pub(super) fn of_scene(scene: &Scene) -> Option<Arc<Twins>> {
    // The sun changes how fog turns paths.
    let told = scene.sun.is_none() && scene.medium.as_ref().is_none_or(|medium| medium.can_share());
    told.then(|| scene.twins()).filter(|twins| !twins.is_empty())
}

impl PathTracer<'_> {
    /// What a surface emits towards the path, and what its twin would.
    #[inline(always)]
    pub(super) fn emitted(&self, path: &Path, hit: &Hit, surface: &Surface, lanes: &Lanes) -> Spectrum {
        if let Some([u, v]) = self.twin(path, hit) {
            return self.emitted_with_twin(path, hit, surface, Hit { u, v, ..*hit }, lanes);
        }
        if surface.emission.is_zero() {
            return Spectrum::ZERO;
        }
        let pdf = self.pdf_of_aiming(path, hit, -surface.normal.dot(path.direction));
        path.beta * surface.emission * (1.0 / (path.r_u + path.r_l * pdf).mean())
    }

    #[inline]
    fn twin(&self, path: &Path, hit: &Hit) -> Option<[f32; 2]> {
        if matches!(path.turn, Turn::Untold) { None } else { self.twins.as_ref()?.of(hit) }
    }

    #[inline]
    fn pdf_of_aiming(&self, path: &Path, hit: &Hit, cos: f32) -> f32 {
        if path.depth == 0 { 0.0 } else { self.lights.emitter_pdf(self.scene, path.vertex, hit, cos) }
    }

    /// The mean of both, by their densities.
    fn emitted_with_twin(
        &self,
        path: &Path,
        hit: &Hit,
        surface: &Surface,
        twin: Hit,
        lanes: &Lanes,
    ) -> Spectrum {
        let position = self.scene.loaded().geometry.surface(&twin).position;
        let offset = position - path.origin;
        let distance = offset.length();
        let direction = offset * (1.0 / distance);
        let twin = Hit { t: distance, ..twin };
        let (rgb, normal) = self.scene.emission_towards(&twin, direction);
        let dark = rgb == [0.0; 3];
        if dark && surface.emission.is_zero() {
            return Spectrum::ZERO;
        }
        let (cos, cos_twin) = (-surface.normal.dot(path.direction), normal.dot(direction).abs());
        let own = self.pdf_of_aiming(path, hit, cos);
        let (density, with_aiming) = (path.r_u.mean(), (path.r_u + path.r_l * own).mean());
        let alone = path.beta * surface.emission * (1.0 / with_aiming);

        // Densities by the area of the emitters.
        let areas = cos_twin * hit.t * hit.t / (cos * distance * distance);
        let ratio = self.turn_ratio(path, direction, lanes)
            * self.pass_ratio(path, hit, &twin, direction, lanes)
            * areas;
        let r_u = path.r_u * ratio;
        let density_of_twin = r_u.mean();
        let near = density_of_twin <= density * LARGEST_RATIO && density <= density_of_twin * LARGEST_RATIO;
        if !near || self.scene.occluded(path.origin, direction, distance * (1.0 - 1e-4), 0) {
            return alone;
        }
        // Each shares its light with connections as it would alone.
        let sum = density + density_of_twin;
        if dark {
            return alone * (density / sum);
        }
        let pdf = self.pdf_of_aiming(path, &twin, cos_twin);
        let with_aiming = density_of_twin + path.r_l.mean() * pdf * areas;
        let light = path.beta * ratio * upsample(rgb, &lanes.basis) * (1.0 / with_aiming);
        (alone * density + light * density_of_twin) * (1.0 / sum)
    }

    /// Density of having been turned along `direction` over that of the path's own.
    #[inline]
    fn turn_ratio(&self, path: &Path, direction: Vec3A, lanes: &Lanes) -> Spectrum {
        match path.turn {
            Turn::Untold => Spectrum::ZERO,
            Turn::Lambert { shading, normal } => {
                let cos = shading.dot(direction);
                let above = cos > 0.0 && normal.dot(direction) > 0.0;
                Spectrum::splat(if above { cos / shading.dot(path.direction) } else { 0.0 })
            }
            Turn::Droplet { before, row } => {
                let Some((medium, lanes)) = self.fog(path.depth - 1, lanes) else { return Spectrum::ZERO };
                let m = |after: Vec3A| 0.5 * (after - before).length_squared();
                let at = |after: Vec3A| medium.phase.eval(row, m(after), &lanes.phase);
                at(direction) / at(path.direction)
            }
        }
    }

    /// Transmittance to the twin over that of the path's flight.
    #[inline]
    fn pass_ratio(&self, path: &Path, hit: &Hit, twin: &Hit, direction: Vec3A, lanes: &Lanes) -> Spectrum {
        let Some((medium, lanes)) = self.fog(path.depth, lanes) else { return Spectrum::ONE };
        let depth = |direction: Vec3A, t: f32| {
            let (y, dy) = (f64::from(path.origin.y), f64::from(direction.y));
            medium.profile.optical_depth(y, dy, f64::from(t), &lanes.profile)
        };
        (depth(direction, twin.t) - depth(path.direction, hit.t)).exp_neg()
    }
}
