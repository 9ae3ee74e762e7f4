//! From glTF's material to ours.

use super::Warnings;
use super::images::Images;
use crate::error::{Failure, SceneErrorKind};
use crate::material::{AlphaMode, Material, TextureRef};
use crate::texture::Encoding;
use gltf::texture::Info;

/// Converts one material and registers its textures.
pub(super) fn convert(
    material: &gltf::Material<'_>,
    images: &mut Images<'_>,
    warnings: &mut Warnings,
) -> Result<Material, Failure> {
    let index = material.index().map_or_else(|| "default".into(), |i| i.to_string());
    let name = material.name().map_or_else(|| format!("material {index}"), str::to_owned);
    let place = || format!("material `{name}`");
    let number = |value: f32, key: &str, low: f32, high: f32| {
        if (low..=high).contains(&value) {
            return Ok(value);
        }
        let range =
            if high == f32::MAX { format!("a number ≥ {low}") } else { format!("from {low} to {high}") };
        Err(SceneErrorKind::Material(format!("{key} is {value}, must be {range}")).at(place))
    };
    let pbr = material.pbr_metallic_roughness();
    let specular = material.specular();
    let mut ignored = |what: &str| warnings.add(format!("{} of material `{name}` was ignored", what));
    if material.normal_texture().is_some() {
        ignored("the normal map");
    }
    if specular.as_ref().is_some_and(|s| s.specular_texture().is_some()) {
        ignored("specularTexture");
    }
    if specular.as_ref().is_some_and(|s| s.specular_color_texture().is_some()) {
        ignored("specularColorTexture");
    }
    let alpha_mode = match material.alpha_mode() {
        gltf::material::AlphaMode::Opaque => AlphaMode::Opaque,
        gltf::material::AlphaMode::Mask => {
            let cutoff = number(material.alpha_cutoff().unwrap_or(0.5), "alphaCutoff", 0.0, f32::MAX)?;
            AlphaMode::Mask { cutoff }
        }
        gltf::material::AlphaMode::Blend => {
            ignored("alphaMode BLEND (transparency)");
            AlphaMode::Opaque
        }
    };

    let mut texture = |info: Option<Info<'_>>, encoding| -> Result<Option<TextureRef>, Failure> {
        let Some(info) = info else { return Ok(None) };
        if info.tex_coord() > 1 {
            let text = format!("uses TEXCOORD_{}; only sets 0 and 1 are supported", info.tex_coord());
            return Err(SceneErrorKind::Material(text).at(place));
        }
        let texture = images.texture(&info.texture(), encoding)?;
        Ok(Some(TextureRef { texture, set: info.tex_coord() as u8 }))
    };
    let base_color_texture = texture(pbr.base_color_texture(), Encoding::Srgb)?;
    let metallic_roughness_texture = texture(pbr.metallic_roughness_texture(), Encoding::Linear)?;
    let emissive_texture = texture(material.emissive_texture(), Encoding::Srgb)?;

    let mut base_color = pbr.base_color_factor();
    for factor in &mut base_color {
        *factor = number(*factor, "baseColorFactor", 0.0, 1.0)?;
    }
    let strength = number(material.emissive_strength().unwrap_or(1.0), "emissiveStrength", 0.0, f32::MAX)?;
    let mut emissive = material.emissive_factor();
    for factor in &mut emissive {
        *factor = number(*factor, "emissiveFactor", 0.0, 1.0)? * strength;
    }
    let mut specular_color =
        specular.as_ref().map_or([1.0; 3], gltf::material::Specular::specular_color_factor);
    for factor in &mut specular_color {
        *factor = number(*factor, "specularColorFactor", 0.0, f32::MAX)?;
    }
    let ior = material.ior().unwrap_or(1.5);
    Ok(Material {
        base_color,
        base_color_texture,
        metallic: number(pbr.metallic_factor(), "metallicFactor", 0.0, 1.0)?,
        roughness: number(pbr.roughness_factor(), "roughnessFactor", 0.0, 1.0)?,
        metallic_roughness_texture,
        emissive,
        emissive_texture,
        alpha_mode,
        double_sided: material.double_sided(),
        ior: if ior == 0.0 { 0.0 } else { number(ior, "ior (if not 0)", 1.0, f32::MAX)? },
        specular: number(specular.map_or(1.0, |s| s.specular_factor()), "specularFactor", 0.0, 1.0)?,
        specular_color,
        name,
    })
}
