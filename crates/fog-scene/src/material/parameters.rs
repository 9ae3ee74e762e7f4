//! A material's values at one point.

use super::Material;
use crate::bsdf::{COAT_F0, MIN_ALPHA, schlick};
use fog_core::colour::Rgb;

/// A material's values at one point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfaceParameters {
    /// Linear reflectance in [0, 1].
    pub base_color: Rgb,
    /// Metalness in [0, 1].
    pub metallic: f32,
    /// Perceptual roughness in [0, 1].
    pub roughness: f32,
    /// Reflectance of the dielectric part at normal incidence.
    pub f0: Rgb,
    /// Reflectance of the dielectric part at grazing incidence.
    pub f90: f32,
    /// Index of refraction.
    pub ior: f32,
    /// Emitted radiance.
    pub emission: Rgb,
    /// True if the back reflects and emits as the front does.
    pub double_sided: bool,
    /// Share of the surface that has a clear coat, in [0, 1].
    pub clearcoat: f32,
    /// Perceptual roughness of the clear coat in [0, 1].
    pub clearcoat_roughness: f32,
    /// Share of the light that enters the dielectric part and leaves on the other side, in [0, 1].
    pub transmission: f32,
}

impl Default for SurfaceParameters {
    /// glTF's default material everywhere.
    fn default() -> Self {
        Material::default().evaluate(&[], &[[0.0; 2]; 2])
    }
}

impl SurfaceParameters {
    /// Multiplies the base colour by a vertex colour (`COLOR_0`).
    #[must_use]
    pub fn tinted(mut self, vertex_color: [f32; 4]) -> Self {
        for (own, vertex) in self.base_color.iter_mut().zip(vertex_color) {
            *own *= vertex;
        }
        self
    }

    /// Share of light at the angle whose cosine is `cos` that the clear coat lets through once, in [0, 1].
    #[inline]
    #[must_use]
    pub fn coat_transmittance(&self, cos: f32) -> f32 {
        1.0 - self.clearcoat * schlick(COAT_F0, 1.0, cos)
    }

    /// Share of light that goes straight through smooth glass at every wavelength alike, in [0, 1]; `cos` of the angle of
    /// incidence. Rays pass the surface with this probability, and only the rest is scattered by its BSDF.
    ///
    /// The least of transmission · colour · (1 − metalness) · (1 − F), so that it is no more than the true share at any
    /// wavelength; 0 if the surface blurs what is behind it.
    #[must_use]
    pub fn clear_share(&self, cos: f32) -> f32 {
        if self.transmission <= 0.0 || self.roughness * self.roughness > MIN_ALPHA {
            return 0.0;
        }
        let least = self.base_color.iter().fold(f32::INFINITY, |a, &b| a.min(b));
        let tint = least * (1.0 - self.metallic) * self.transmission;
        let f0 = self.f0.iter().fold(0.0f32, |a, &b| a.max(b));
        let through = (1.0 - schlick(f0, self.f90, cos)).max(0.0);
        let coat = self.coat_transmittance(cos);
        (tint * through * coat * coat).clamp(0.0, 1.0)
    }
}
