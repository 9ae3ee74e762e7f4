//! Checked numbers and textures of one material, from the gltf crate's types or from raw JSON.

use super::images::Images;
use crate::error::{Failure, SceneErrorKind};
use crate::material::TextureRef;
use crate::texture::Encoding;
use crate::uv_transform::UvTransform;
use gltf::texture::Info;
use serde_json::Value;

/// A texture as a material names it.
pub(super) struct Slot<'a> {
    texture: gltf::Texture<'a>,
    set: u32,
    transform: Option<&'a Value>,
}

const TRANSFORM: &str = "KHR_texture_transform";

impl<'a> Slot<'a> {
    pub(super) fn of_info(info: &'a Info<'a>) -> Self {
        let transform = info.extensions().and_then(|extensions| extensions.get(TRANSFORM));
        Self { texture: info.texture(), set: info.tex_coord(), transform }
    }

    pub(super) fn of_normal(normal: &'a gltf::material::NormalTexture<'a>) -> Self {
        let transform = normal.extensions().and_then(|extensions| extensions.get(TRANSFORM));
        Self { texture: normal.texture(), set: normal.tex_coord(), transform }
    }
}

/// Reader of one material.
pub(super) struct Reader<'a, 'i> {
    pub(super) name: String,
    pub(super) images: &'a mut Images<'i>,
}

impl Reader<'_, '_> {
    /// An error of this material.
    pub(super) fn failure(&self, text: String) -> Failure {
        SceneErrorKind::Material(text).at(|| format!("material `{}`", self.name))
    }

    /// `value`, if it is from `low` to `high`.
    pub(super) fn number(&self, value: f32, key: &str, low: f32, high: f32) -> Result<f32, Failure> {
        if (low..=high).contains(&value) {
            return Ok(value);
        }
        let range = match (low, high) {
            (f32::MIN, f32::MAX) => "a finite number".to_owned(),
            (_, f32::MAX) => format!("a number ≥ {low}"),
            _ => format!("from {low} to {high}"),
        };
        Err(self.failure(format!("{key} is {value}, must be {range}")))
    }

    /// A number from 0 to 1 of a JSON object, 0 if it is not there.
    pub(super) fn json_share(&self, object: &Value, key: &str) -> Result<f32, Failure> {
        let Some(value) = object.get(key) else { return Ok(0.0) };
        let Some(number) = value.as_f64() else {
            return Err(self.failure(format!("{key} is {value}, must be a number")));
        };
        self.number(number as f32, key, 0.0, 1.0)
    }

    /// A texture that a JSON object names.
    pub(super) fn json_texture(
        &mut self,
        object: &Value,
        key: &str,
        encoding: Encoding,
    ) -> Result<Option<TextureRef>, Failure> {
        let Some(info) = object.get(key) else { return Ok(None) };
        let index = info.get("index").and_then(Value::as_u64);
        let texture = index.and_then(|index| self.images.document_texture(index as usize));
        let Some(texture) = texture else {
            return Err(self.failure(format!("{key} names no texture of the file")));
        };
        let set = match info.get("texCoord") {
            None => 0,
            Some(set) => self.set(set, key)?,
        };
        let transform = info.get("extensions").and_then(|extensions| extensions.get(TRANSFORM));
        self.texture(Some(Slot { texture, set, transform }), encoding)
    }

    /// Registers a texture.
    pub(super) fn texture(
        &mut self,
        slot: Option<Slot<'_>>,
        encoding: Encoding,
    ) -> Result<Option<TextureRef>, Failure> {
        let Some(Slot { texture, mut set, transform }) = slot else { return Ok(None) };
        if let Some(other) = transform.and_then(|t| t.get("texCoord")) {
            set = self.set(other, TRANSFORM)?;
        }
        if set > 1 {
            let text = format!("uses TEXCOORD_{set}; only sets 0 and 1 are supported");
            return Err(self.failure(text));
        }
        let transform = transform.map(|t| self.transform(t)).transpose()?.flatten();
        let texture = self.images.texture(&texture, encoding, transform)?;
        Ok(Some(TextureRef { texture, set: set as u8 }))
    }

    fn set(&self, value: &Value, key: &str) -> Result<u32, Failure> {
        let set = value.as_u64().and_then(|set| u32::try_from(set).ok());
        set.ok_or_else(|| self.failure(format!("texCoord of {key} is {value}, must be a whole number ≥ 0")))
    }

    /// A transform of texture coordinates; `None` if it moves nothing.
    fn transform(&self, object: &Value) -> Result<Option<UvTransform>, Failure> {
        let number = |value: &Value, key: &str| {
            let Some(x) = value.as_f64() else {
                return Err(self.failure(format!("{key} of {TRANSFORM} is {value}, must be a number")));
            };
            self.number(x as f32, &format!("{key} of {TRANSFORM}"), f32::MIN, f32::MAX)
        };
        let pair = |key: &str, default: [f32; 2]| match object.get(key) {
            None => Ok(default),
            Some(Value::Array(pair)) if pair.len() == 2 => {
                Ok([number(&pair[0], key)?, number(&pair[1], key)?])
            }
            Some(other) => Err(self.failure(format!("{key} of {TRANSFORM} is {other}, must be two numbers"))),
        };
        let (offset, scale) = (pair("offset", [0.0; 2])?, pair("scale", [1.0; 2])?);
        let rotation = object.get("rotation").map_or(Ok(0.0), |value| number(value, "rotation"))?;
        let moves = (offset, rotation, scale) != ([0.0; 2], 0.0, [1.0; 2]);
        Ok(moves.then(|| UvTransform::new(offset, rotation, scale)))
    }
}
