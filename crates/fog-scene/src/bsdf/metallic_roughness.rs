//! The metallic-roughness material of glTF 2.0 (specification, appendix B), with `KHR_materials_ior` and
//! `KHR_materials_specular`: a Lambertian base under a GGX coat that takes its Fresnel share.
//!
//! The base is weighted by what the coat lets in and out, (1 − F(cos θo)) (1 − F(cos θi)), not by the specification's
//! 1 − F(V·H): that sum reflects 1.5 times the light that a smooth white dielectric gets at grazing incidence.

use super::ggx::Ggx;
use crate::material::SurfaceParameters;
use fog_core::colour::{Rgb, upsample};
use fog_core::math::INV_PI_F32;
use fog_core::spectrum::Spectrum;
use fog_core::{Vec3A, warp};

/// Reflection of one surface point without its clear coat; the share of light that goes through is left out.
#[derive(Clone, Copy, Debug)]
pub(super) struct MetallicRoughness {
    diffuse: Spectrum,
    f0: Spectrum,
    f90: f32,
    ggx: Ggx,
    specular_probability: f32,
    reflectance: f32,
}

impl MetallicRoughness {
    /// Evaluates the parameters at the wavelengths whose colour basis is `basis`.
    #[inline]
    pub(super) fn new(p: &SurfaceParameters, basis: &[Spectrum; 3]) -> Self {
        let base = upsample(p.base_color, basis);
        let diffuse = base * (1.0 - p.metallic) * (1.0 - p.transmission);
        let f0 = upsample(p.f0, basis) * (1.0 - p.metallic) + base * p.metallic;
        let f90 = p.f90 * (1.0 - p.metallic) + p.metallic;
        // The lobe is chosen by colours, not lanes, so that its density is the same at every wavelength.
        let mean = |c: Rgb| (c[0] + c[1] + c[2]) / 3.0;
        let coat =
            (mean(p.f0) + 0.05 * p.f90) * (1.0 - p.metallic) + mean(p.base_color).max(0.05) * p.metallic;
        let body = mean(p.base_color) * (1.0 - p.metallic) * (1.0 - p.transmission);
        let specular_probability = if coat > 0.0 { (coat / (coat + body)).clamp(0.1, 1.0) } else { 0.0 };
        let ggx = Ggx::new(p.roughness);
        Self { diffuse, f0, f90, ggx, specular_probability, reflectance: coat + body }
    }

    /// About how much light is reflected, for choosing between layers.
    pub(super) fn reflectance(&self) -> f32 {
        self.reflectance
    }

    /// True if nothing is reflected by facets.
    #[inline]
    pub(super) fn is_lambertian(&self) -> bool {
        self.specular_probability == 0.0
    }

    /// Value × |cos θi| (1/sr) and density (1/sr) for a pair of directions; zero unless both are above the surface.
    #[inline]
    pub(super) fn eval(&self, wo: Vec3A, wi: Vec3A) -> (Spectrum, f32) {
        if wo.z <= 0.0 || wi.z <= 0.0 {
            return (Spectrum::ZERO, 0.0);
        }
        let lambert = wi.z * INV_PI_F32;
        if self.specular_probability == 0.0 {
            return (self.diffuse * lambert, lambert);
        }
        let h = (wo + wi).normalize();
        let cos_h = wo.dot(h).clamp(0.0, 1.0);
        let fresnel = self.fresnel(cos_h);
        let through = (Spectrum::ONE - self.fresnel(wo.z)) * (Spectrum::ONE - self.fresnel(wi.z));
        let (specular, pdf_specular) = self.ggx.mirror(wo, wi, h);
        let value = self.diffuse * through * lambert + fresnel * specular;
        let p = self.specular_probability;
        (value, p * pdf_specular + (1.0 - p) * lambert)
    }

    /// Direction of the light, which may be below the surface where none is reflected; `wo` is above it.
    #[inline]
    pub(super) fn sample(&self, wo: Vec3A, pick: f32, u: [f32; 2]) -> Vec3A {
        if pick < self.specular_probability { self.ggx.sample(wo, u) } else { warp::cosine_hemisphere(u) }
    }

    /// Schlick's Fresnel between f0 and f90.
    #[inline]
    fn fresnel(&self, cos: f32) -> Spectrum {
        let x = 1.0 - cos;
        let x2 = x * x;
        let w = x2 * x2 * x;
        self.f0 * (1.0 - w) + Spectrum::splat(self.f90 * w)
    }
}
