//! The GGX distribution of microfacets (Walter et al. 2007) with Smith masking.

use fog_core::Vec3A;
use fog_core::math::{self, PI_F32};

/// Smallest α: smoother surfaces are rendered with it, for they have no density that light sampling could meet.
pub(crate) const MIN_ALPHA: f32 = 1e-3;

/// Isotropic GGX.
#[derive(Clone, Copy, Debug)]
pub(super) struct Ggx {
    alpha: f32,
}

impl Ggx {
    /// α is the square of glTF's perceptual roughness.
    #[inline]
    pub(super) fn new(roughness: f32) -> Self {
        Self { alpha: (roughness * roughness).clamp(MIN_ALPHA, 1.0) }
    }

    /// Reflection of a mirror of these microfacets, D G₂ / (4 cos θo): value × |cos θi| in 1/sr; and the density in 1/sr of
    /// [`Ggx::sample`]. `h` is the half vector, both directions are above the surface.
    #[inline]
    pub(super) fn mirror(&self, wo: Vec3A, wi: Vec3A, h: Vec3A) -> (f32, f32) {
        let d = self.distribution(h.z);
        (d * self.masking2(wo.z, wi.z) / (4.0 * wo.z), d * self.masking1(wo.z) / (4.0 * wo.z))
    }

    /// Direction reflected by a visible microfacet; it may point below the surface.
    #[inline]
    pub(super) fn sample(&self, wo: Vec3A, u: [f32; 2]) -> Vec3A {
        let h = self.sample_visible_normal(wo, u);
        2.0 * wo.dot(h) * h - wo
    }

    /// Distribution of normals.
    #[inline]
    fn distribution(&self, cos_h: f32) -> f32 {
        let a2 = self.alpha * self.alpha;
        // cos²(a² − 1) + 1 = cos² a² + sin², which keeps its digits for smooth surfaces
        let d = cos_h * cos_h * a2 + (1.0 - cos_h * cos_h).max(0.0);
        a2 / (PI_F32 * d * d)
    }

    #[inline]
    fn lambda(&self, cos: f32) -> f32 {
        let tan2 = (1.0 - cos * cos).max(0.0) / (cos * cos);
        0.5 * ((1.0 + self.alpha * self.alpha * tan2).sqrt() - 1.0)
    }

    #[inline]
    fn masking1(&self, cos: f32) -> f32 {
        1.0 / (1.0 + self.lambda(cos))
    }

    /// Height-correlated Smith masking and shadowing.
    #[inline]
    fn masking2(&self, cos_o: f32, cos_i: f32) -> f32 {
        1.0 / (1.0 + self.lambda(cos_o) + self.lambda(cos_i))
    }

    /// Normal among those visible from `wo` (Heitz 2018, "Sampling the GGX distribution of visible normals").
    #[inline]
    fn sample_visible_normal(&self, wo: Vec3A, u: [f32; 2]) -> Vec3A {
        let a = self.alpha;
        let v = Vec3A::new(a * wo.x, a * wo.y, wo.z).normalize();
        let length2 = v.x * v.x + v.y * v.y;
        let t1 = if length2 > 0.0 { Vec3A::new(-v.y, v.x, 0.0) / length2.sqrt() } else { Vec3A::X };
        let t2 = v.cross(t1);
        let r = u[0].sqrt();
        let phi = math::TAU_F32 * u[1];
        let x = r * math::f32::cos(phi);
        let s = 0.5 * (1.0 + v.z);
        let y = (1.0 - s) * (1.0 - x * x).max(0.0).sqrt() + s * r * math::f32::sin(phi);
        let n = x * t1 + y * t2 + (1.0 - x * x - y * y).max(0.0).sqrt() * v;
        Vec3A::new(a * n.x, a * n.y, n.z.max(1e-6)).normalize()
    }
}
