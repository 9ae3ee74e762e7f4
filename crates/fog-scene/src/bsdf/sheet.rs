//! Light that goes through a thin sheet (`KHR_materials_transmission`): what the dielectric part does not reflect, tinted
//! by the base colour, straight on through smooth sheets and blurred like a reflection by rough ones. Nothing is bent:
//! both sides of the sheet bend by opposite angles.
//!
//! Of smooth sheets rays are let pass the share that is clear at every wavelength, before a surface is met
//! ([`SurfaceParameters::clear_share`]): light is then found through windows by aiming at it. What is left, the colour of
//! coloured glass, is found by paths that happen on the light alone: a parallel beam, which no path can happen on, shines
//! through coloured glass as if it had its darkest colour only.

use super::ggx::{Ggx, MIN_ALPHA};
use super::schlick;
use crate::material::SurfaceParameters;
use fog_core::Vec3A;
use fog_core::colour::upsample;
use fog_core::spectrum::Spectrum;

/// The transmitting part of one surface point.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sheet {
    tint: Spectrum,
    mean_tint: f32,
    f0: Spectrum,
    mean_f0: f32,
    f90: f32,
    /// `None` where light goes straight on.
    blur: Option<Ggx>,
}

impl Sheet {
    /// `None` if nothing goes through.
    pub(super) fn new(p: &SurfaceParameters, basis: &[Spectrum; 3]) -> Option<Self> {
        let share = p.transmission * (1.0 - p.metallic);
        let mean = |c: [f32; 3]| (c[0] + c[1] + c[2]) / 3.0;
        (share > 0.0).then(|| Self {
            tint: upsample(p.base_color, basis) * share,
            mean_tint: mean(p.base_color) * share,
            f0: upsample(p.f0, basis),
            mean_f0: mean(p.f0),
            f90: p.f90,
            blur: (p.roughness * p.roughness > MIN_ALPHA).then(|| Ggx::new(p.roughness)),
        })
    }

    /// True if light goes straight on, in a direction that has no density.
    #[inline]
    pub(super) fn is_straight(&self) -> bool {
        self.blur.is_none()
    }

    /// Share of light that goes through microfacets met at an angle.
    #[inline]
    pub(super) fn transmittance(&self, cos: f32) -> Spectrum {
        let fresnel = self.f0.map(|f0| schlick(f0, self.f90, cos));
        self.tint * (Spectrum::ONE - fresnel)
    }

    /// About the mean of [`Sheet::transmittance`], for choosing between layers: the same at every wavelength.
    #[inline]
    pub(super) fn mean_transmittance(&self, cos: f32) -> f32 {
        self.mean_tint * (1.0 - schlick(self.mean_f0, self.f90, cos))
    }

    /// Value × |cos θi| and density of blurred light; `wo` is above the sheet, `wi` below.
    #[inline]
    pub(super) fn eval(&self, wo: Vec3A, wi: Vec3A) -> (Spectrum, f32) {
        let Some(ggx) = &self.blur else { return (Spectrum::ZERO, 0.0) };
        let mirrored = mirror(wi);
        let h = (wo + mirrored).normalize();
        let (value, pdf) = ggx.mirror(wo, mirrored, h);
        (self.transmittance(wo.dot(h).clamp(0.0, 1.0)) * value, pdf)
    }

    /// Direction of the light on the other side; it may be on this side, where there is none.
    #[inline]
    pub(super) fn sample(&self, wo: Vec3A, u: [f32; 2]) -> Vec3A {
        self.blur.as_ref().map_or(-wo, |ggx| mirror(ggx.sample(wo, u)))
    }
}

fn mirror(w: Vec3A) -> Vec3A {
    Vec3A::new(w.x, w.y, -w.z)
}
