//! The metallic-roughness material of glTF 2.0 (specification, appendix B), with `KHR_materials_ior` and
//! `KHR_materials_specular`: a Lambertian base under a GGX coat that takes its Fresnel share.
//!
//! The base is weighted by what the coat lets in and out, (1 − F(cos θo)) (1 − F(cos θi)), not by the specification's
//! 1 − F(V·H): that sum reflects 1.5 times the light that a smooth white dielectric gets at grazing incidence.
//!
//! Directions are in the shading frame (z = normal) and point away from the surface.

use crate::material::SurfaceParameters;
use fog_core::colour::{Rgb, upsample};
use fog_core::math::{INV_PI_F32, PI_F32};
use fog_core::spectrum::Spectrum;
use fog_core::{Vec3A, math, warp};

/// Smallest GGX α: smoother surfaces are rendered with it, for they have no density that light sampling could meet.
const MIN_ALPHA: f32 = 1e-3;

/// Reflection of one surface point at the wavelengths of a path.
#[derive(Clone, Copy, Debug)]
pub struct Bsdf {
    diffuse: Spectrum,
    f0: Spectrum,
    f90: f32,
    alpha: f32,
    specular_probability: f32,
}

/// A direction drawn from a [`Bsdf`].
#[derive(Clone, Copy, Debug)]
pub struct BsdfSample {
    /// Direction of the light, in the shading frame.
    pub wi: Vec3A,
    /// Density in 1/sr.
    pub pdf: f32,
    /// Value × |cos| / pdf.
    pub weight: Spectrum,
}

impl Bsdf {
    /// Evaluates the parameters at the wavelengths whose colour basis is `basis`.
    #[inline]
    #[must_use]
    pub fn new(p: &SurfaceParameters, basis: &[Spectrum; 3]) -> Self {
        let base = upsample(p.base_color, basis);
        let diffuse = base * (1.0 - p.metallic);
        let f0 = upsample(p.f0, basis) * (1.0 - p.metallic) + base * p.metallic;
        let f90 = p.f90 * (1.0 - p.metallic) + p.metallic;
        // The lobe is chosen by colours, not lanes, so that its density is the same at every wavelength.
        let mean = |c: Rgb| (c[0] + c[1] + c[2]) / 3.0;
        let coat =
            (mean(p.f0) + 0.05 * p.f90) * (1.0 - p.metallic) + mean(p.base_color).max(0.05) * p.metallic;
        let body = mean(p.base_color) * (1.0 - p.metallic);
        let specular_probability = if coat > 0.0 { (coat / (coat + body)).clamp(0.1, 1.0) } else { 0.0 };
        let alpha = (p.roughness * p.roughness).clamp(MIN_ALPHA, 1.0);
        Self { diffuse, f0, f90, alpha, specular_probability }
    }

    /// Value × |cos θi| (1/sr) and density (1/sr) for a pair of directions; zero unless both are above the surface.
    #[inline]
    #[must_use]
    pub fn eval(&self, wo: Vec3A, wi: Vec3A) -> (Spectrum, f32) {
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
        let d = self.distribution(h.z);
        // D G / (4 cosθo cosθi) × cosθi = D G₂ / (4 cosθo)
        let specular = d * self.masking2(wo.z, wi.z) / (4.0 * wo.z);
        let value = self.diffuse * through * lambert + fresnel * specular;
        let pdf_specular = d * self.masking1(wo.z) / (4.0 * wo.z);
        let p = self.specular_probability;
        (value, p * pdf_specular + (1.0 - p) * lambert)
    }

    /// Draws a direction of the light; `None` where none is reflected.
    #[inline]
    #[must_use]
    pub fn sample(&self, wo: Vec3A, pick: f32, u: [f32; 2]) -> Option<BsdfSample> {
        if wo.z <= 0.0 {
            return None;
        }
        let wi = if pick < self.specular_probability {
            let h = self.sample_visible_normal(wo, u);
            2.0 * wo.dot(h) * h - wo
        } else {
            warp::cosine_hemisphere(u)
        };
        if wi.z <= 0.0 {
            return None;
        }
        let (value, pdf) = self.eval(wo, wi);
        (pdf > 0.0).then(|| BsdfSample { wi, pdf, weight: value * (1.0 / pdf) })
    }

    /// Schlick's Fresnel between f0 and f90.
    #[inline]
    fn fresnel(&self, cos: f32) -> Spectrum {
        let x = 1.0 - cos;
        let x2 = x * x;
        let w = x2 * x2 * x;
        self.f0 * (1.0 - w) + Spectrum::splat(self.f90 * w)
    }

    /// GGX distribution of normals.
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
