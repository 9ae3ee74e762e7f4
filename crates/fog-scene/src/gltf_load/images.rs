//! Decoding the images that materials use, once each.

use super::accessor::Buffers;
use super::files::Files;
use crate::error::{Failure, SceneErrorKind};
use crate::texture::{Encoding, Filter, Image, Texture, Wrap};
use crate::uv_transform::UvTransform;
use gltf::texture::{MagFilter, MinFilter, WrappingMode};
use gltf::{Document, image::Source};
use image::{ImageFormat, ImageReader};
use std::collections::BTreeMap;
use std::io::Cursor;
use std::sync::Arc;

/// Decoder of images and collector of textures.
pub(super) struct Images<'a> {
    document: &'a Document,
    buffers: &'a Buffers,
    files: &'a mut Files,
    limit: u64,
    pixels_left: u64,
    images: BTreeMap<usize, Arc<Image>>,
    by_use: BTreeMap<(usize, bool, Option<[u32; 6]>), u32>,
    textures: Vec<Texture>,
}

impl<'a> Images<'a> {
    pub(super) fn new(
        document: &'a Document,
        buffers: &'a Buffers,
        files: &'a mut Files,
        limit: u64,
    ) -> Self {
        Self {
            document,
            buffers,
            files,
            limit,
            pixels_left: limit,
            images: BTreeMap::new(),
            by_use: BTreeMap::new(),
            textures: Vec::new(),
        }
    }

    /// Index of a glTF texture read in an encoding and at moved coordinates; decodes its image at its first use.
    pub(super) fn texture(
        &mut self,
        texture: &gltf::Texture<'_>,
        encoding: Encoding,
        transform: Option<UvTransform>,
    ) -> Result<u32, Failure> {
        let key = (texture.index(), encoding == Encoding::Srgb, transform.map(|t| t.bits()));
        if let Some(&index) = self.by_use.get(&key) {
            return Ok(index);
        }
        let image = self.image(texture.source().index())?;
        let sampler = texture.sampler();
        let filter = match (sampler.mag_filter(), sampler.min_filter()) {
            (Some(MagFilter::Nearest), _) | (None, Some(MinFilter::Nearest)) => Filter::Nearest,
            _ => Filter::Bilinear,
        };
        let wrap = [sampler.wrap_s(), sampler.wrap_t()].map(|mode| match mode {
            WrappingMode::ClampToEdge => Wrap::Clamp,
            WrappingMode::MirroredRepeat => Wrap::Mirror,
            WrappingMode::Repeat => Wrap::Repeat,
        });
        let index = self.textures.len() as u32;
        let texture = Texture::new(image, encoding, filter, wrap);
        self.textures.push(match transform {
            Some(transform) => texture.moved(transform),
            None => texture,
        });
        self.by_use.insert(key, index);
        Ok(index)
    }

    /// A texture of the file.
    pub(super) fn document_texture(&self, index: usize) -> Option<gltf::Texture<'a>> {
        self.document.textures().nth(index)
    }

    /// All textures asked for, by index.
    pub(super) fn into_textures(self) -> Vec<Texture> {
        self.textures
    }

    fn image(&mut self, index: usize) -> Result<Arc<Image>, Failure> {
        if let Some(image) = self.images.get(&index) {
            return Ok(Arc::clone(image));
        }
        let missing = || SceneErrorKind::Image(format!("image {index} does not exist"));
        let image = self.document.images().nth(index).ok_or_else(missing)?;
        let name = image.name().map_or_else(|| index.to_string(), str::to_owned);
        let place = || format!("image `{name}`");
        let decoded = match image.source() {
            Source::View { view, .. } => {
                let bytes = self.buffers.view(&view).map_err(|e| SceneErrorKind::Image(e).at(place))?;
                decode(bytes, self.pixels_left, self.limit)
            }
            Source::Uri { uri, .. } => {
                let bytes = self.files.fetch(uri).map_err(|e| e.at(place))?;
                decode(&bytes, self.pixels_left, self.limit)
            }
        };
        let decoded = Arc::new(decoded.map_err(|e| e.at(place))?);
        self.pixels_left -= decoded.texels().len() as u64;
        self.images.insert(index, Arc::clone(&decoded));
        Ok(decoded)
    }
}

/// Decodes a PNG or JPEG of at most `pixels` pixels; `limit` is what the message names.
fn decode(bytes: &[u8], pixels: u64, limit: u64) -> Result<Image, SceneErrorKind> {
    let format = match image::guess_format(bytes) {
        Ok(format @ (ImageFormat::Png | ImageFormat::Jpeg)) => format,
        _ => {
            let text = format!("is {}; only PNG and JPEG are supported{}", kind_of(bytes), advice(bytes));
            return Err(SceneErrorKind::Image(text));
        }
    };
    let broken = |e: image::ImageError| SceneErrorKind::Image(format!("cannot be decoded: {e}"));
    let reader = || ImageReader::with_format(Cursor::new(bytes), format);
    let (width, height) = reader().into_dimensions().map_err(broken)?;
    let size = u64::from(width) * u64::from(height);
    if size > pixels {
        return Err(SceneErrorKind::TooManyPixels { limit });
    }
    let mut reader = reader();
    // The checked size at 16 bits for four channels, twice, and some working memory.
    let mut limits = image::Limits::default();
    limits.max_alloc = Some(size * 16 + (64 << 20));
    reader.limits(limits);
    let rgba = reader.decode().map_err(broken)?.into_rgba8();
    let (width, height) = rgba.dimensions();
    let (texels, _) = rgba.as_raw().as_chunks::<4>();
    Image::new(width, height, texels.to_vec()).ok_or_else(|| SceneErrorKind::Image("is empty".into()))
}

/// What makes an image readable.
fn advice(bytes: &[u8]) -> &'static str {
    match kind_of(bytes) {
        "a WebP image" => ": convert with `gltf-transform png in.glb out.glb`",
        "a KTX image" => ": convert with `gltf-transform ktxdecompress in.glb out.glb`",
        _ => "",
    }
}

/// Names the formats that glTF files may meet.
fn kind_of(bytes: &[u8]) -> &'static str {
    if bytes.starts_with(b"RIFF") && bytes.get(8..12) == Some(b"WEBP") {
        "a WebP image"
    } else if bytes.starts_with(&[0xab, b'K', b'T', b'X']) {
        "a KTX image"
    } else if bytes.starts_with(b"DDS ") {
        "a DDS image"
    } else {
        "of an unknown format"
    }
}
