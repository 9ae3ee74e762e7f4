//! PNG files of whole numbers, with the same bytes every time.

use image::codecs::png::{CompressionType, FilterType, PngEncoder};
use image::{ExtendedColorType, ImageEncoder};

use crate::folder::Folder;
use crate::{Error, Result};

/// Writes grey pixels of 8 bits.
pub(crate) fn grey8(folder: &Folder, name: &str, size: [u32; 2], pixels: &[u8]) -> Result<()> {
    write(folder, name, size, pixels, ExtendedColorType::L8)
}

/// Writes grey pixels of 16 bits.
pub(crate) fn grey16(folder: &Folder, name: &str, size: [u32; 2], pixels: &[u16]) -> Result<()> {
    let bytes: Vec<u8> = pixels.iter().flat_map(|v| v.to_ne_bytes()).collect();
    write(folder, name, size, &bytes, ExtendedColorType::L16)
}

/// Writes red, green, blue and opacity of 8 bits each.
pub(crate) fn rgba8(folder: &Folder, name: &str, size: [u32; 2], pixels: &[u8]) -> Result<()> {
    write(folder, name, size, pixels, ExtendedColorType::Rgba8)
}

fn write(
    folder: &Folder,
    name: &str,
    [width, height]: [u32; 2],
    bytes: &[u8],
    kind: ExtendedColorType,
) -> Result<()> {
    let mut out = Vec::new();
    let encoder = PngEncoder::new_with_quality(&mut out, CompressionType::Fast, FilterType::Adaptive);
    encoder.write_image(bytes, width, height, kind).map_err(|e| {
        let source = std::io::Error::other(e.to_string());
        Error::Io { action: "encode", path: name.into(), source }
    })?;
    folder.write(name, out)
}
