//! Turns of paths at surfaces.

use super::Path;
use fog_core::Vec3A;
use fog_core::random::PathRng;
use fog_core::spectrum::Spectrum;
use fog_scene::scene::Surface;

/// Largest f32 below 1.
const BELOW_ONE: f32 = 1.0 - 0.5 * f32::EPSILON;

/// How a surface turns a path.
pub(crate) struct SurfaceTurn {
    /// The surface's point, from where lights are chosen.
    pub(crate) vertex: Vec3A,
    pub(crate) origin: Vec3A,
    pub(crate) direction: Vec3A,
    /// BSDF times cosine over `pdf`.
    pub(crate) weight: Spectrum,
    /// Density of the direction in 1/sr.
    pub(crate) pdf: f32,
}

/// Draws how a path along `direction` is reflected at a surface or sent through; `None` if it ends there.
#[inline(always)]
pub(crate) fn turn_at_surface(direction: Vec3A, surface: &Surface, rng: &mut PathRng) -> Option<SurfaceTurn> {
    let wo = surface.world_from_shading.transpose() * -direction;
    let (u, v) = rng.turn();
    let sample = surface.bsdf.as_ref()?.sample(wo, rng.uniform(), [(u as f32).min(BELOW_ONE), v])?;
    let direction = (surface.world_from_shading * sample.wi).normalize();
    if direction.dot(surface.normal) * sample.wi.z <= 0.0 {
        return None;
    }
    let (vertex, origin) = (surface.point.position, surface.point.spawn_origin(direction));
    Some(SurfaceTurn { vertex, origin, direction, weight: sample.weight, pdf: sample.pdf })
}

/// Reflects the path at a surface or sends it through; false if it ends there.
pub(crate) fn scatter_at_surface(path: &mut Path, surface: &Surface, rng: &mut PathRng) -> bool {
    let Some(turn) = turn_at_surface(path.direction, surface, rng) else { return false };
    path.beta *= turn.weight;
    path.r_l = path.r_u * (1.0 / turn.pdf);
    (path.vertex, path.origin, path.direction) = (turn.vertex, turn.origin, turn.direction);
    path.depth += 1;
    !path.beta.is_zero()
}
