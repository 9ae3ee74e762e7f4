//! glTF's metallic-roughness materials with their extensions, and their values at a point.
//!
//! Occlusion textures are not read: they approximate, for renderers that cannot, the shadowing that paths find themselves.

mod opacity;
mod parameters;

pub use opacity::Opacity;
pub use parameters::SurfaceParameters;

use crate::texture::Texture;
use fog_core::Vec3A;
use fog_core::colour::Rgb;

/// A texture of the scene and the set of coordinates that it is read with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TextureRef {
    /// Index into the scene's textures.
    pub texture: u32,
    /// 0 or 1: `TEXCOORD_0` or `TEXCOORD_1`.
    pub set: u8,
}

/// What alpha means.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum AlphaMode {
    /// Nothing.
    Opaque,
    /// There is a hole where it is below the cutoff.
    Mask {
        /// The cutoff, usually in [0, 1].
        cutoff: f32,
    },
    /// The share of the surface that is there: a ray is stopped with this probability.
    Blend,
}

/// A map of normals in tangent space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NormalMap {
    /// Linear texture: red along the tangent, green along the bitangent (up in the image), blue along the normal.
    pub texture: TextureRef,
    /// Factor of red and green.
    pub scale: f32,
}

/// A material as glTF defines it; every factor multiplies its texture.
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// Name in the file, or `material N`.
    pub name: String,
    /// `extras.class`: what surfaces of it are where their nodes do not say.
    pub class: Option<String>,
    /// Linear reflectance and alpha, in [0, 1].
    pub base_color: [f32; 4],
    /// sRGB texture of `base_color`.
    pub base_color_texture: Option<TextureRef>,
    /// 0 for dielectrics, 1 for metals.
    pub metallic: f32,
    /// Perceptual roughness in [0, 1]; GGX α is its square.
    pub roughness: f32,
    /// Linear texture: green roughness, blue metalness.
    pub metallic_roughness_texture: Option<TextureRef>,
    /// Emitted radiance, `emissiveStrength` included; ≥ 0.
    pub emissive: Rgb,
    /// sRGB texture of `emissive`.
    pub emissive_texture: Option<TextureRef>,
    /// What alpha means.
    pub alpha_mode: AlphaMode,
    /// True if the back reflects and emits as the front does.
    pub double_sided: bool,
    /// Index of refraction (`KHR_materials_ior`); ≥ 1, or 0 for a full mirror.
    pub ior: f32,
    /// Strength of the dielectric reflection (`KHR_materials_specular`) in [0, 1]; 0 makes a dielectric Lambertian.
    pub specular: f32,
    /// Linear texture whose alpha multiplies `specular`.
    pub specular_texture: Option<TextureRef>,
    /// Colour of the dielectric reflection at normal incidence; ≥ 0.
    pub specular_color: Rgb,
    /// sRGB texture of `specular_color`.
    pub specular_color_texture: Option<TextureRef>,
    /// Normals of the base, not of the clear coat.
    pub normal_map: Option<NormalMap>,
    /// Share of the surface that has a clear coat of index 1.5 (`KHR_materials_clearcoat`), in [0, 1].
    pub clearcoat: f32,
    /// Linear texture whose red multiplies `clearcoat`.
    pub clearcoat_texture: Option<TextureRef>,
    /// Perceptual roughness of the clear coat in [0, 1].
    pub clearcoat_roughness: f32,
    /// Linear texture whose green multiplies `clearcoat_roughness`.
    pub clearcoat_roughness_texture: Option<TextureRef>,
    /// Share of the light that enters a dielectric and leaves on the other side (`KHR_materials_transmission`), in [0, 1].
    /// The surface is a thin sheet: it does not bend light.
    pub transmission: f32,
    /// Linear texture whose red multiplies `transmission`.
    pub transmission_texture: Option<TextureRef>,
}

impl Default for Material {
    /// glTF's default: white, metallic 1, roughness 1.
    fn default() -> Self {
        Self {
            name: "default".into(),
            class: None,
            base_color: [1.0; 4],
            base_color_texture: None,
            metallic: 1.0,
            roughness: 1.0,
            metallic_roughness_texture: None,
            emissive: [0.0; 3],
            emissive_texture: None,
            alpha_mode: AlphaMode::Opaque,
            double_sided: false,
            ior: 1.5,
            specular: 1.0,
            specular_texture: None,
            specular_color: [1.0; 3],
            specular_color_texture: None,
            normal_map: None,
            clearcoat: 0.0,
            clearcoat_texture: None,
            clearcoat_roughness: 0.0,
            clearcoat_roughness_texture: None,
            transmission: 0.0,
            transmission_texture: None,
        }
    }
}

/// Texel of a texture, or 1.
fn texel(textures: &[Texture], reference: Option<TextureRef>, uv: &[[f32; 2]; 2]) -> [f32; 4] {
    let lookup = |r: TextureRef| Some(textures.get(r.texture as usize)?.sample(uv[(r.set & 1) as usize]));
    reference.and_then(lookup).unwrap_or([1.0; 4])
}

impl Material {
    /// All values at texture coordinates (both sets); `textures` are the scene's.
    #[must_use]
    pub fn evaluate(&self, textures: &[Texture], uv: &[[f32; 2]; 2]) -> SurfaceParameters {
        let base = texel(textures, self.base_color_texture, uv);
        let rough = texel(textures, self.metallic_roughness_texture, uv);
        let specular = self.specular * texel(textures, self.specular_texture, uv)[3];
        let tint = texel(textures, self.specular_color_texture, uv);
        // KHR_materials_specular: F0 = min(((ior − 1)/(ior + 1))² · colour, 1) · factor, F90 = factor.
        let r = (self.ior - 1.0) / (self.ior + 1.0);
        SurfaceParameters {
            base_color: core::array::from_fn(|c| self.base_color[c] * base[c]),
            metallic: self.metallic * rough[2],
            roughness: self.roughness * rough[1],
            f0: core::array::from_fn(|c| (r * r * (self.specular_color[c] * tint[c])).min(1.0) * specular),
            f90: specular,
            ior: self.ior,
            emission: self.emission(textures, uv),
            double_sided: self.double_sided,
            clearcoat: self.clearcoat * texel(textures, self.clearcoat_texture, uv)[0],
            clearcoat_roughness: self.clearcoat_roughness
                * texel(textures, self.clearcoat_roughness_texture, uv)[1],
            transmission: self.transmission * texel(textures, self.transmission_texture, uv)[0],
        }
    }

    /// Unit normal of the normal map in tangent space; `None` without a map.
    #[must_use]
    pub fn mapped_normal(&self, textures: &[Texture], uv: &[[f32; 2]; 2]) -> Option<Vec3A> {
        let map = self.normal_map?;
        let [x, y, z, _] = texel(textures, Some(map.texture), uv).map(|c| 2.0 * c - 1.0);
        Vec3A::new(x * map.scale, y * map.scale, z).try_normalize()
    }

    /// Emitted radiance at texture coordinates.
    #[must_use]
    pub fn emission(&self, textures: &[Texture], uv: &[[f32; 2]; 2]) -> Rgb {
        if !self.is_emissive() {
            return [0.0; 3];
        }
        let emissive = texel(textures, self.emissive_texture, uv);
        core::array::from_fn(|c| self.emissive[c] * emissive[c])
    }

    /// True if the material may emit somewhere.
    #[must_use]
    pub fn is_emissive(&self) -> bool {
        self.emissive.iter().any(|&c| c > 0.0)
    }

    /// Share of the surface that is there, in [0, 1], at texture coordinates and an alpha of the vertices' colour.
    #[must_use]
    pub fn coverage(&self, textures: &[Texture], uv: &[[f32; 2]; 2], vertex_alpha: f32) -> f32 {
        let alpha = || self.base_color[3] * texel(textures, self.base_color_texture, uv)[3] * vertex_alpha;
        match self.alpha_mode {
            AlphaMode::Opaque => 1.0,
            AlphaMode::Mask { cutoff } => f32::from(u8::from(alpha() >= cutoff)),
            AlphaMode::Blend => alpha(),
        }
    }

    /// All textures that the material reads.
    pub fn textures(&self) -> impl Iterator<Item = TextureRef> {
        [
            self.base_color_texture,
            self.metallic_roughness_texture,
            self.emissive_texture,
            self.specular_texture,
            self.specular_color_texture,
            self.normal_map.map(|map| map.texture),
            self.clearcoat_texture,
            self.clearcoat_roughness_texture,
            self.transmission_texture,
        ]
        .into_iter()
        .flatten()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::texture::{Encoding, Filter, Image, Wrap};
    use std::sync::Arc;

    #[test]
    fn dielectric_reflectance_follows_the_extensions() {
        let glass = Material { metallic: 0.0, ..Material::default() }.evaluate(&[], &[[0.0; 2]; 2]);
        assert!((glass.f0[0] - 0.04).abs() < 1e-6 && glass.f90 == 1.0);
        let matte = Material { specular: 0.0, ..Material::default() }.evaluate(&[], &[[0.0; 2]; 2]);
        assert_eq!((matte.f0, matte.f90), ([0.0; 3], 0.0));
        let mirror = Material { ior: 0.0, ..Material::default() }.evaluate(&[], &[[0.0; 2]; 2]);
        assert_eq!(mirror.f0, [1.0; 3]);
    }

    #[test]
    fn coverage_follows_the_alpha_mode() {
        let textures: Arc<[Texture]> = Arc::new([]);
        let uv = [[0.0; 2]; 2];
        let material = |alpha, alpha_mode| Material {
            base_color: [1.0, 1.0, 1.0, alpha],
            alpha_mode,
            ..Material::default()
        };
        let coverage = |alpha, mode, vertex| material(alpha, mode).coverage(&textures, &uv, vertex);
        assert!(Opacity::new(&material(0.2, AlphaMode::Opaque), &textures).is_none());
        assert_eq!(coverage(0.2, AlphaMode::Opaque, 0.5), 1.0);
        let mask = AlphaMode::Mask { cutoff: 0.5 };
        assert!(!Opacity::new(&material(0.2, mask), &textures).unwrap().is_partial());
        assert_eq!([0.2, 0.5].map(|alpha| coverage(alpha, mask, 1.0)), [0.0, 1.0]);
        assert_eq!(coverage(0.5, mask, 0.9), 0.0);
        assert!(Opacity::new(&material(0.2, AlphaMode::Blend), &textures).unwrap().is_partial());
        assert_eq!(coverage(0.5, AlphaMode::Blend, 0.5), 0.25);
    }

    #[test]
    fn clear_glass_passes_what_it_does_not_reflect() {
        let pane = Material { metallic: 0.0, roughness: 0.0, transmission: 1.0, ..Material::default() };
        let values = pane.evaluate(&[], &[[0.0; 2]; 2]);
        assert!((values.clear_share(1.0) - 0.96).abs() < 1e-6 && values.clear_share(0.0) == 0.0);
        let tinted = values.tinted([0.5, 0.25, 1.0, 1.0]);
        assert!((tinted.clear_share(1.0) - 0.24).abs() < 1e-6);
        let coated = SurfaceParameters { clearcoat: 1.0, ..values };
        assert!((coated.clear_share(1.0) - 0.96f32.powi(3)).abs() < 1e-6);
        for opaque in [
            SurfaceParameters { roughness: 0.2, ..values },
            SurfaceParameters { metallic: 1.0, ..values },
            SurfaceParameters { transmission: 0.0, ..values },
        ] {
            assert_eq!(opaque.clear_share(1.0), 0.0);
        }
    }

    #[test]
    fn normal_maps_are_decoded_and_scaled() {
        let image = Arc::new(Image::new(1, 1, vec![[255, 0, 255, 255]]).unwrap());
        let texture = Texture::new(image, Encoding::Linear, Filter::Nearest, [Wrap::Repeat; 2]);
        let bump = |scale| Material {
            normal_map: Some(NormalMap { texture: TextureRef { texture: 0, set: 0 }, scale }),
            ..Material::default()
        };
        let normal = bump(0.5).mapped_normal(&[texture], &[[0.5; 2]; 2]).unwrap();
        assert!((normal - Vec3A::new(0.5, -0.5, 1.0).normalize()).length() < 1e-6, "{normal}");
        assert!(Material::default().mapped_normal(&[], &[[0.0; 2]; 2]).is_none());
    }
}
