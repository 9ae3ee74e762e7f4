//! From glTF's material to ours.

use super::Warnings;
use super::images::Images;
use super::material_reader::{Reader, Slot};
use super::nodes::text;
use crate::error::Failure;
use crate::material::{AlphaMode, Material, NormalMap};
use crate::texture::Encoding;
use gltf::material::Specular;
use serde_json::Value;

/// Converts one material and registers its textures.
pub(super) fn convert(
    material: &gltf::Material<'_>,
    images: &mut Images<'_>,
    warnings: &mut Warnings,
) -> Result<Material, Failure> {
    let index = material.index().map_or_else(|| "default".into(), |i| i.to_string());
    let name = material.name().map_or_else(|| format!("material {index}"), str::to_owned);
    let mut reader = Reader { name: name.clone(), images };
    let class = text(material.extras(), "class").as_deref().map(str::to_owned);
    let mut out = Material { name, class, double_sided: material.double_sided(), ..Material::default() };
    out.alpha_mode = match material.alpha_mode() {
        gltf::material::AlphaMode::Opaque => AlphaMode::Opaque,
        gltf::material::AlphaMode::Mask => {
            let cutoff = material.alpha_cutoff().unwrap_or(0.5);
            AlphaMode::Mask { cutoff: reader.number(cutoff, "alphaCutoff", 0.0, f32::MAX)? }
        }
        gltf::material::AlphaMode::Blend => AlphaMode::Blend,
    };
    read_base(material, &mut out, &mut reader)?;
    read_emission(material, &mut out, &mut reader)?;
    read_specular(material, &mut out, &mut reader)?;
    if let Some(coat) = material.extension_value("KHR_materials_clearcoat") {
        read_clearcoat(coat, &mut out, &mut reader, warnings)?;
    }
    if let Some(transmission) = material.extension_value("KHR_materials_transmission") {
        out.transmission = reader.json_share(transmission, "transmissionFactor")?;
        out.transmission_texture =
            reader.json_texture(transmission, "transmissionTexture", Encoding::Linear)?;
    }
    if let Some(normal) = material.normal_texture() {
        read_normal_map(&normal, &mut out, &mut reader, warnings)?;
    }
    if material.extension_value("KHR_materials_unlit").is_some() {
        warnings.add(format!("material `{}` is unlit: it reflects its base colour, as chalk does", out.name));
        out = unlit(out);
    }
    Ok(out)
}

fn read_base(
    material: &gltf::Material<'_>,
    out: &mut Material,
    reader: &mut Reader<'_, '_>,
) -> Result<(), Failure> {
    let pbr = material.pbr_metallic_roughness();
    out.base_color_texture =
        reader.texture(pbr.base_color_texture().as_ref().map(Slot::of_info), Encoding::Srgb)?;
    out.metallic_roughness_texture =
        reader.texture(pbr.metallic_roughness_texture().as_ref().map(Slot::of_info), Encoding::Linear)?;
    for (own, factor) in out.base_color.iter_mut().zip(pbr.base_color_factor()) {
        *own = reader.number(factor, "baseColorFactor", 0.0, 1.0)?;
    }
    out.metallic = reader.number(pbr.metallic_factor(), "metallicFactor", 0.0, 1.0)?;
    out.roughness = reader.number(pbr.roughness_factor(), "roughnessFactor", 0.0, 1.0)?;
    Ok(())
}

fn read_emission(
    material: &gltf::Material<'_>,
    out: &mut Material,
    reader: &mut Reader<'_, '_>,
) -> Result<(), Failure> {
    out.emissive_texture =
        reader.texture(material.emissive_texture().as_ref().map(Slot::of_info), Encoding::Srgb)?;
    let strength = material.emissive_strength().unwrap_or(1.0);
    let strength = reader.number(strength, "emissiveStrength", 0.0, f32::MAX)?;
    for (own, factor) in out.emissive.iter_mut().zip(material.emissive_factor()) {
        *own = reader.number(factor, "emissiveFactor", 0.0, 1.0)? * strength;
    }
    Ok(())
}

fn read_specular(
    material: &gltf::Material<'_>,
    out: &mut Material,
    reader: &mut Reader<'_, '_>,
) -> Result<(), Failure> {
    let ior = material.ior().unwrap_or(1.5);
    out.ior = if ior == 0.0 { 0.0 } else { reader.number(ior, "ior (if not 0)", 1.0, f32::MAX)? };
    let Some(specular) = material.specular() else { return Ok(()) };
    out.specular = reader.number(specular.specular_factor(), "specularFactor", 0.0, 1.0)?;
    for (own, factor) in out.specular_color.iter_mut().zip(Specular::specular_color_factor(&specular)) {
        *own = reader.number(factor, "specularColorFactor", 0.0, f32::MAX)?;
    }
    out.specular_texture =
        reader.texture(specular.specular_texture().as_ref().map(Slot::of_info), Encoding::Linear)?;
    out.specular_color_texture =
        reader.texture(specular.specular_color_texture().as_ref().map(Slot::of_info), Encoding::Srgb)?;
    Ok(())
}

fn read_clearcoat(
    coat: &Value,
    out: &mut Material,
    reader: &mut Reader<'_, '_>,
    warnings: &mut Warnings,
) -> Result<(), Failure> {
    out.clearcoat = reader.json_share(coat, "clearcoatFactor")?;
    out.clearcoat_roughness = reader.json_share(coat, "clearcoatRoughnessFactor")?;
    if out.clearcoat == 0.0 {
        return Ok(());
    }
    out.clearcoat_texture = reader.json_texture(coat, "clearcoatTexture", Encoding::Linear)?;
    out.clearcoat_roughness_texture =
        reader.json_texture(coat, "clearcoatRoughnessTexture", Encoding::Linear)?;
    if coat.get("clearcoatNormalTexture").is_some() {
        warnings.add(format!(
            "clearcoatNormalTexture of material `{}` was ignored: its clear coat is smooth",
            out.name
        ));
    }
    Ok(())
}

fn read_normal_map(
    normal: &gltf::material::NormalTexture<'_>,
    out: &mut Material,
    reader: &mut Reader<'_, '_>,
    warnings: &mut Warnings,
) -> Result<(), Failure> {
    if out.transmission > 0.0 {
        warnings.add(format!("the normal map of the transmitting material `{}` was ignored", out.name));
        return Ok(());
    }
    let scale = reader.number(normal.scale(), "scale of normalTexture", f32::MIN, f32::MAX)?;
    let texture = reader.texture(Some(Slot::of_normal(normal)), Encoding::Linear)?;
    out.normal_map = texture.map(|texture| NormalMap { texture, scale });
    Ok(())
}

/// `KHR_materials_unlit` asks for the base colour whatever the light, which no surface in fog and daylight can have. The
/// nearest one is Lambertian: the extension's own fallback, dielectric and rough, without its reflection.
fn unlit(material: Material) -> Material {
    Material {
        metallic: 0.0,
        metallic_roughness_texture: None,
        roughness: 1.0,
        specular: 0.0,
        normal_map: None,
        clearcoat: 0.0,
        transmission: 0.0,
        emissive: [0.0; 3],
        ..material
    }
}
