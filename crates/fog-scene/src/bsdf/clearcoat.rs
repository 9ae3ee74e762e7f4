//! The clear coat of `KHR_materials_clearcoat`: a GGX mirror of index 1.5 on top of the material.

use super::ggx::Ggx;
use super::schlick;
use crate::material::SurfaceParameters;
use fog_core::Vec3A;

/// Reflectance of the coat at normal incidence: the extension fixes its index at 1.5.
pub(crate) const COAT_F0: f32 = 0.04;

/// The coat of one surface point. It reflects every wavelength alike.
///
/// The extension weights what is below by 1 − coat · F(V·N), which is not reciprocal; here light is weighted on its way in
/// and on its way out.
#[derive(Clone, Copy, Debug)]
pub(super) struct Coat {
    weight: f32,
    ggx: Ggx,
    probability: f32,
}

impl Coat {
    /// `None` without a coat; `below` is about how much light what lies below the coat reflects.
    pub(super) fn new(p: &SurfaceParameters, below: f32) -> Option<Self> {
        // Some more than the reflectance at normal incidence, for grazing light.
        let own = p.clearcoat * (COAT_F0 + 0.05);
        (p.clearcoat > 0.0).then(|| Self {
            weight: p.clearcoat,
            ggx: Ggx::new(p.clearcoat_roughness),
            probability: (own / (own + below)).clamp(0.1, 0.5),
        })
    }

    /// Probability of choosing the coat.
    #[inline]
    pub(super) fn probability(&self) -> f32 {
        self.probability
    }

    /// Share of light that passes the coat once.
    #[inline]
    pub(super) fn transmittance(&self, cos: f32) -> f32 {
        1.0 - self.weight * schlick(COAT_F0, 1.0, cos)
    }

    /// Value × |cos θi| and density; both directions are above the surface.
    #[inline]
    pub(super) fn eval(&self, wo: Vec3A, wi: Vec3A) -> (f32, f32) {
        let h = (wo + wi).normalize();
        let fresnel = schlick(COAT_F0, 1.0, wo.dot(h).clamp(0.0, 1.0));
        let (value, pdf) = self.ggx.mirror(wo, wi, h);
        (self.weight * fresnel * value, pdf)
    }

    #[inline]
    pub(super) fn sample(&self, wo: Vec3A, u: [f32; 2]) -> Vec3A {
        self.ggx.sample(wo, u)
    }
}
