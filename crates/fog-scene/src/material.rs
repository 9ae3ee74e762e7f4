//! glTF's metallic-roughness materials, and their values at a point.

use crate::texture::Texture;
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
}

/// A material as glTF defines it; every factor multiplies its texture.
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// Name in the file, or `material N`.
    pub name: String,
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
    /// Colour of the dielectric reflection at normal incidence; ≥ 0.
    pub specular_color: Rgb,
}

impl Default for Material {
    /// glTF's default: white, metallic 1, roughness 1.
    fn default() -> Self {
        Self {
            name: "default".into(),
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
            specular_color: [1.0; 3],
        }
    }
}

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
        // KHR_materials_specular: F0 = min(((ior − 1)/(ior + 1))² · colour, 1) · factor, F90 = factor.
        let r = (self.ior - 1.0) / (self.ior + 1.0);
        SurfaceParameters {
            base_color: core::array::from_fn(|c| self.base_color[c] * base[c]),
            metallic: self.metallic * rough[2],
            roughness: self.roughness * rough[1],
            f0: self.specular_color.map(|c| (r * r * c).min(1.0) * self.specular),
            f90: self.specular,
            ior: self.ior,
            emission: self.emission(textures, uv),
            double_sided: self.double_sided,
        }
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

    /// Alpha at texture coordinates: 1 if opaque, else factor × texture.
    #[must_use]
    pub fn alpha(&self, textures: &[Texture], uv: &[[f32; 2]; 2]) -> f32 {
        match self.alpha_mode {
            AlphaMode::Opaque => 1.0,
            AlphaMode::Mask { .. } => self.base_color[3] * texel(textures, self.base_color_texture, uv)[3],
        }
    }

    /// Where this material has holes; `None` if it is opaque.
    #[must_use]
    pub fn alpha_mask(&self, textures: &[Texture]) -> Option<AlphaMask> {
        let AlphaMode::Mask { cutoff } = self.alpha_mode else { return None };
        let texture = self
            .base_color_texture
            .and_then(|r| Some((textures.get(r.texture as usize)?.clone(), usize::from(r.set & 1))));
        Some(AlphaMask { texture, factor: self.base_color[3], cutoff })
    }
}

/// The holes of a material, for the ray test.
#[derive(Clone, Debug)]
pub struct AlphaMask {
    texture: Option<(Texture, usize)>,
    factor: f32,
    cutoff: f32,
}

impl AlphaMask {
    /// False where there is a hole.
    #[must_use]
    pub fn is_solid(&self, uv: &[[f32; 2]; 2]) -> bool {
        let alpha = self.texture.as_ref().map_or(1.0, |(texture, set)| texture.sample(uv[*set])[3]);
        self.factor * alpha >= self.cutoff
    }
}

#[cfg(test)]
mod tests {
    use super::*;

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
    fn masks_cut_below_their_cutoff() {
        let material = |alpha, alpha_mode| Material {
            base_color: [1.0, 1.0, 1.0, alpha],
            alpha_mode,
            ..Material::default()
        };
        let uv = [[0.0; 2]; 2];
        assert!(material(0.2, AlphaMode::Opaque).alpha_mask(&[]).is_none());
        let mask = AlphaMode::Mask { cutoff: 0.5 };
        assert!(!material(0.2, mask).alpha_mask(&[]).unwrap().is_solid(&uv));
        assert!(material(0.5, mask).alpha_mask(&[]).unwrap().is_solid(&uv));
        assert_eq!(material(0.2, AlphaMode::Opaque).alpha(&[], &uv), 1.0);
        assert_eq!(material(0.2, mask).alpha(&[], &uv), 0.2);
    }
}
