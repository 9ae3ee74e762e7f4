//! Materials.

use crate::glb::Tex;
use serde_json::{Value, json};

/// A material of glTF's metallic-roughness model. Colours are linear sRGB.
#[derive(Clone, Debug)]
pub(crate) struct Paint {
    pub(crate) name: String,
    pub(crate) color: [f32; 3],
    pub(crate) metallic: f32,
    pub(crate) roughness: f32,
    /// 0 for a Lambertian surface, 1 for a dielectric of index 1.5.
    pub(crate) specular: f32,
    /// A clear coat of varnish, 0 to 1.
    pub(crate) coat: f32,
    /// Colour of the emission, its largest component 1, and its luminance in cd/m².
    pub(crate) emission: Option<([f32; 3], f32)>,
    pub(crate) texture: Option<Tex>,
    pub(crate) emissive_texture: Option<Tex>,
    pub(crate) double_sided: bool,
}

impl Paint {
    /// A dull dielectric: paint, plaster, stone.
    pub(crate) fn new(name: &str, color: [f32; 3]) -> Self {
        Self {
            name: name.to_owned(),
            color,
            metallic: 0.0,
            roughness: 0.9,
            specular: 0.5,
            coat: 0.0,
            emission: None,
            texture: None,
            emissive_texture: None,
            double_sided: false,
        }
    }

    /// A Lambertian surface.
    pub(crate) fn lambertian(name: &str, color: [f32; 3]) -> Self {
        Self { specular: 0.0, roughness: 1.0, ..Self::new(name, color) }
    }

    /// With another roughness and full specular reflection.
    pub(crate) fn smooth(self, roughness: f32) -> Self {
        Self { roughness, specular: 1.0, ..self }
    }

    /// A metal.
    pub(crate) fn metal(self, roughness: f32) -> Self {
        Self { metallic: 1.0, ..self.smooth(roughness) }
    }

    /// With a texture that multiplies the colour.
    pub(crate) fn textured(self, texture: Tex) -> Self {
        Self { texture: Some(texture), ..self }
    }

    /// Shining with a luminance in cd/m².
    pub(crate) fn shining(self, color: [f32; 3], cd_m2: f32) -> Self {
        Self { emission: Some((color, cd_m2)), ..self }
    }

    /// glTF's material.
    pub(crate) fn json(&self) -> Value {
        let [r, g, b] = self.color;
        let mut pbr = json!({"metallicFactor": self.metallic, "roughnessFactor": self.roughness});
        if self.color != [1.0; 3] {
            pbr["baseColorFactor"] = json!([r, g, b, 1.0]);
        }
        if let Some(Tex(index)) = self.texture {
            pbr["baseColorTexture"] = json!({"index": index});
        }
        let mut material = json!({"name": self.name, "pbrMetallicRoughness": pbr});
        let mut extensions = json!({});
        if self.specular != 1.0 {
            extensions["KHR_materials_specular"] = json!({"specularFactor": self.specular});
        }
        if self.coat > 0.0 {
            extensions["KHR_materials_clearcoat"] =
                json!({"clearcoatFactor": self.coat, "clearcoatRoughnessFactor": 0.03});
        }
        if let Some((color, cd_m2)) = self.emission {
            material["emissiveFactor"] = json!(color);
            extensions["KHR_materials_emissive_strength"] = json!({"emissiveStrength": cd_m2});
        }
        if let Some(Tex(index)) = self.emissive_texture {
            material["emissiveTexture"] = json!({"index": index});
        }
        if extensions != json!({}) {
            material["extensions"] = extensions;
        }
        if self.double_sided {
            material["doubleSided"] = true.into();
        }
        material
    }
}
