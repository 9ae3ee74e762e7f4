//! Normal maps as microfacets (Schüssler, Heitz, Hanika & Dachsbacher 2017, "Microfacet-based normal mapping for robust
//! Monte Carlo path tracing").
//!
//! Turning the shading frame towards the mapped normal loses light that is reflected below the surface, and turns black
//! where the mapped normal is seen from behind. Here the surface is made of facets with the mapped normal p and of
//! vertical facets t that join them: the facets cast shadows on each other and every direction above the surface sees
//! some of them. The facets p reflect as the material does, the facets t are mirrors. Paths of one or two reflections
//! count (p, p–t, t–p); the light of longer ones is lost. The sum is reciprocal and never reflects more than it gets.

use super::metallic_roughness::MetallicRoughness;
use fog_core::random::mix64;
use fog_core::spectrum::Spectrum;
use fog_core::{Vec3A, warp};
use glam::Mat3A;

/// Steepest mapped normal, as its cosine to the surface's: steeper ones are turned up to it.
const LEAST_COS: f32 = 0.1;
/// Sine of the angle below which a mapped normal counts as the surface's own.
const FLAT_SIN: f32 = 1e-4;

/// A mapped normal in the shading frame, whose z axis is the surface's own normal.
#[derive(Clone, Copy, Debug)]
pub(super) struct Facet {
    /// Shading frame from the facet's frame (z = p).
    frame: Mat3A,
    /// Normal of the vertical facets, in the shading frame.
    t: Vec3A,
    cos: f32,
    sin: f32,
}

impl Facet {
    /// `None` for the surface's own normal; `normal` is of unit length.
    pub(super) fn new(normal: Vec3A) -> Option<Self> {
        let radius = (normal.x * normal.x + normal.y * normal.y).sqrt();
        if radius.is_nan() || radius < FLAT_SIN {
            return None;
        }
        let cos = normal.z.clamp(LEAST_COS, 1.0);
        let sin = (1.0 - cos * cos).max(0.0).sqrt();
        let t = -Vec3A::new(normal.x, normal.y, 0.0) / radius;
        let p = Vec3A::Z * cos - t * sin;
        Some(Self { frame: warp::frame(p), t, cos, sin })
    }

    /// Projected areas of the facets p and t towards `w`, up to a common factor.
    #[inline]
    fn areas(&self, w: Vec3A) -> (f32, f32) {
        let (p, t) = (w.dot(self.frame.z_axis), w.dot(self.t));
        (p.max(0.0), t.max(0.0) * self.sin)
    }

    /// Share of a facet's visible side that other facets do not hide from `w`.
    #[inline]
    fn visible(&self, w: Vec3A) -> f32 {
        let (p, t) = self.areas(w);
        (w.z.max(0.0) * self.cos / (p + t)).min(1.0)
    }

    /// Probability that light from `w` meets a facet p and not t.
    #[inline]
    fn first(&self, w: Vec3A) -> f32 {
        let (p, t) = self.areas(w);
        p / (p + t)
    }

    /// Reflection at the vertical facets.
    #[inline]
    fn turned(&self, w: Vec3A) -> Vec3A {
        w - 2.0 * w.dot(self.t) * self.t
    }

    /// Value × |cos θi| and density of the material on facets p; both directions are above the surface.
    pub(super) fn eval(&self, base: &MetallicRoughness, wo: Vec3A, wi: Vec3A) -> (Spectrum, f32) {
        let inverse = self.frame.transpose();
        let on_facet = |wo: Vec3A, wi: Vec3A| base.eval(inverse * wo, inverse * wi);
        let first = self.first(wo);
        let visible = self.visible(wi);
        let mut sum = (Spectrum::ZERO, 0.0);
        let mut add = |(value, pdf): (Spectrum, f32), weight: f32| {
            sum.0 += value * weight;
            sum.1 += pdf * weight;
        };
        if first > 0.0 {
            add(on_facet(wo, wi), first * visible);
            if wi.dot(self.t) > 0.0 {
                let before = self.turned(wi);
                add(on_facet(wo, before), first * (1.0 - self.visible(before)) * visible);
            }
        }
        if first < 1.0 {
            add(on_facet(self.turned(wo), wi), (1.0 - first) * visible);
        }
        sum
    }

    /// Direction of the light; `None` where it would be reflected a third time.
    pub(super) fn sample(
        &self,
        base: &MetallicRoughness,
        wo: Vec3A,
        pick: f32,
        u: [f32; 2],
    ) -> Option<Vec3A> {
        // More numbers than are given are needed: they are a hash of these.
        let bits = mix64(u64::from(pick.to_bits()) << 32 ^ u64::from(u[0].to_bits()).rotate_left(17))
            ^ mix64(u64::from(u[1].to_bits()));
        let number = |k: u64| (mix64(bits.wrapping_add(k)) >> 40) as f32 * (1.0 / 16_777_216.0);
        let inverse = self.frame.transpose();
        let on_first = number(1) < self.first(wo);
        let from = inverse * if on_first { wo } else { self.turned(wo) };
        if from.z <= 0.0 {
            return None;
        }
        let local = base.sample(from, pick, u);
        if local.z <= 0.0 {
            return None;
        }
        let out = self.frame * local;
        if number(2) < self.visible(out) {
            return Some(out);
        }
        let again = self.turned(out);
        (on_first && again.dot(self.t) > 0.0 && number(3) < self.visible(again)).then_some(again)
    }
}
