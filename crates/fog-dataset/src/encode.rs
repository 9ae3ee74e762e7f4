//! The bytes of each file of a frame.

use std::path::Path;

use fog_film::Channels;
use image::codecs::png::{CompressionType, FilterType, PngEncoder};
use image::{ExtendedColorType, ImageEncoder};
use serde_json::{Value, json};

use crate::exr_file::{Picture, encode};
use crate::names::Kind;
use crate::{Attribute, Error, FrameFiles, OutputSet, Result, layers};

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
        Kind::Truth => encode(picture(files, layers::truth(files.frame, outputs), false), path),
        Kind::Raw => {
            let camera = files.camera.ok_or(NOT_GIVEN).map_err(Error::picture("encode", path))?;
            png16(files.frame.width, files.frame.height, &camera.raw, path)
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

const NOT_GIVEN: &str = "the frame's outputs ask for it, but it was not given";

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
    let mut out = Vec::new();
    PngEncoder::new_with_quality(&mut out, CompressionType::Fast, FilterType::Adaptive)
        .write_image(bytes, width, height, ExtendedColorType::Rgb8)
        .map_err(Error::picture("encode", path))?;
    Ok(out)
}

/// A 16-bit PNG of one channel; `path` is only for messages.
fn png16(width: u32, height: u32, values: &[u16], path: &Path) -> Result<Vec<u8>> {
    // The encoder takes the machine's byte order.
    let bytes: Vec<u8> = values.iter().flat_map(|v| v.to_ne_bytes()).collect();
    let mut out = Vec::new();
    PngEncoder::new_with_quality(&mut out, CompressionType::Fast, FilterType::Adaptive)
        .write_image(&bytes, width, height, ExtendedColorType::L16)
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
    Picture { width: files.frame.width, height: files.frame.height, channels, attributes, colour }
}
