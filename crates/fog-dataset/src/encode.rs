//! The bytes of each file of a frame.

use std::path::Path;

use fog_film::{Channels, Frame};
use image::codecs::png::{CompressionType, FilterType, PngEncoder};
use image::{ExtendedColorType, ImageEncoder};
use serde_json::{Value, json};

use crate::cryptomatte::cryptomatte;
use crate::exr_file::{Picture, encode};
use crate::names::Kind;
use crate::{Attribute, Error, FrameFiles, OutputSet, Result, layers};

/// Why a file cannot be made.
const NOT_GIVEN: &str = "the frame's outputs ask for it, but it was not given";

/// Why there is no layer of instances.
const UNNAMED: &str = "an instance of its mask has no name";

/// Bytes of one hashed file; `path` is only for messages.
pub(crate) fn hashed(kind: Kind, files: &FrameFiles<'_>, outputs: OutputSet, path: &Path) -> Result<Vec<u8>> {
    match kind {
        Kind::Image => {
            let frame = files.frame;
            match files.camera {
                Some(camera) => png(frame.width, frame.height, &camera.srgb8, path),
                None => png(frame.width, frame.height, &frame.to_srgb8(files.exposure), path),
            }
        }
        Kind::Hdr => radiance(files, layers::radiance(files.frame, outputs), path),
        Kind::Truth => {
            let mut channels = layers::truth(files.frame, outputs);
            let mut foreign = Vec::new();
            if outputs.instance {
                let layer = cryptomatte(&files.frame.truth.surface.instance, files.instances);
                let layer = layer.ok_or(UNNAMED).map_err(Error::picture("encode", path))?;
                channels.extend(layer.channels);
                foreign = layer.attributes;
            }
            if channels.iter().any(|(_, values)| values.is_empty()) {
                return Err(Error::picture("encode", path)(NOT_GIVEN));
            }
            encode(Picture { foreign, ..picture(files, channels, false) }, path)
        }
        Kind::Semantic => {
            let frame = files.frame;
            grey(frame, &frame.truth.surface.semantic, ExtendedColorType::L8, path)
        }
        Kind::Instance => {
            let frame = files.frame;
            let bytes: Vec<u8> =
                frame.truth.surface.instance.iter().flat_map(|id| id.to_ne_bytes()).collect();
            grey(frame, &bytes, ExtendedColorType::L16, path)
        }
        Kind::Objects => match files.objects {
            Some(objects) => Ok(pretty(objects)),
            None => Err(Error::picture("encode", path)(NOT_GIVEN)),
        },
        Kind::Raw => {
            let camera = files.camera.ok_or(NOT_GIVEN).map_err(Error::picture("encode", path))?;
            let bytes: Vec<u8> = camera.raw.iter().flat_map(|v| v.to_ne_bytes()).collect();
            grey(files.frame, &bytes, ExtendedColorType::L16, path)
        }
        Kind::Clear | Kind::ClearImage => {
            let clear = files.clear.ok_or(NOT_GIVEN).map_err(Error::picture("encode", path))?;
            let frame = &clear.frame;
            if (frame.width, frame.height) != (files.frame.width, files.frame.height) {
                return Err(Error::picture("encode", path)("it has not as many pixels as the frame"));
            }
            match kind {
                Kind::Clear => radiance(files, layers::clear(frame, outputs), path),
                _ => png(frame.width, frame.height, &clear.srgb8, path),
            }
        }
        _ => Ok(pretty(files.record)),
    }
}

/// `<id>.timing.json`: seconds, and samples (not pixels) per second, null when no time was measured.
pub(crate) fn timing(files: &FrameFiles<'_>) -> Vec<u8> {
    let samples = files.frame.samples.iter().sum::<u64>() as f64;
    let rate = (files.seconds > 0.0).then(|| samples / files.seconds);
    pretty(&json!({ "seconds": files.seconds, "samples_per_second": rate }))
}

/// Indented JSON and a newline.
pub(crate) fn pretty(value: &Value) -> Vec<u8> {
    format!("{value:#}\n").into_bytes()
}

/// An 8-bit RGB PNG; `path` is only for messages.
pub(crate) fn png(width: u32, height: u32, bytes: &[u8], path: &Path) -> Result<Vec<u8>> {
    pixels(width, height, bytes, ExtendedColorType::Rgb8, path)
}

/// A PNG of one channel of whole numbers; `bytes` are in the machine's order.
fn grey(frame: &Frame, bytes: &[u8], kind: ExtendedColorType, path: &Path) -> Result<Vec<u8>> {
    if bytes.is_empty() {
        return Err(Error::picture("encode", path)(NOT_GIVEN));
    }
    pixels(frame.width, frame.height, bytes, kind, path)
}

fn pixels(width: u32, height: u32, bytes: &[u8], kind: ExtendedColorType, path: &Path) -> Result<Vec<u8>> {
    let mut out = Vec::new();
    PngEncoder::new_with_quality(&mut out, CompressionType::Fast, FilterType::Adaptive)
        .write_image(bytes, width, height, kind)
        .map_err(Error::picture("encode", path))?;
    Ok(out)
}

/// An EXR file of radiance; `path` is only for messages.
pub(crate) fn radiance(
    files: &FrameFiles<'_>,
    channels: Vec<(String, Vec<f32>)>,
    path: &Path,
) -> Result<Vec<u8>> {
    encode(picture(files, channels, true), path)
}

fn picture(files: &FrameFiles<'_>, channels: Vec<(String, Vec<f32>)>, radiance: bool) -> Picture {
    let mut attributes = files.attributes.clone();
    attributes.insert("frame_id".to_owned(), Attribute::Text(files.id.to_owned()));
    attributes.insert("exposure".to_owned(), Attribute::Number(files.exposure));
    if let Channels::Mono { wavelength_nm } = files.frame.channels {
        attributes.insert("wavelength_nm".to_owned(), Attribute::Number(wavelength_nm));
    }
    let colour = radiance && files.frame.channels == Channels::Rgb;
    let (width, height) = (files.frame.width, files.frame.height);
    Picture { width, height, channels, attributes, foreign: Vec::new(), view: files.view, colour }
}
