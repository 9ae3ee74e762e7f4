//! Single pictures from files of ours and of other programs, and maps to files.

use std::fs;
use std::io::Read;
use std::path::Path;

use exr::math::Vec2;
use exr::meta::MetaData;
use exr::meta::attribute::Chromaticities;
use fog_core::colour::{Rgb, srgb_decode};
use fog_film::{Picture, Scale, Srgb8Picture};
use image::{ImageFormat, ImageReader};

use crate::exr_file::{self, REC_709};
use crate::layers::STANDARD_ERROR;
use crate::{Error, Result, atomic, encode};

/// First bytes of an OpenEXR file.
const EXR_MAGIC: [u8; 4] = [0x76, 0x2f, 0x31, 0x01];
/// Most pixels of a picture that is read.
const MAX_PIXELS: u64 = 1 << 27;
/// Largest difference of a chromaticity coordinate that still counts as rounding.
const CHROMATICITY_ROUNDING: f32 = 1e-3;

/// Reads a picture; what kind of file it is follows from its first bytes, not from its name.
///
/// OpenEXR: the channels `R`, `G`, `B` (or `Y`, as grey) of the first layer are linear radiance, with the exposure that
/// our files record or else 1, and with `standard_error.Y` if the file has it. Radiance HDR (RGBE): linear radiance. PNG and
/// JPEG: sRGB of 8 or 16 bits; an alpha channel, a colour profile and a gamma are ignored.
///
/// # Errors
/// [`Error::Io`] when the file cannot be read, [`Error::NotAPicture`] when it is something else or its colours are not those
/// of sRGB (Rec. 709 primaries), [`Error::Picture`] when it cannot be decoded.
pub fn read_picture(path: &Path) -> Result<Picture> {
    let mut start = Vec::new();
    let mut file = fs::File::open(path).map_err(Error::io("read", path))?;
    file.by_ref().take(16).read_to_end(&mut start).map_err(Error::io("read", path))?;
    if start.starts_with(&EXR_MAGIC) {
        return from_exr(path);
    }
    match image::guess_format(&start) {
        Ok(format @ (ImageFormat::Png | ImageFormat::Jpeg)) => from_srgb(path, format),
        Ok(ImageFormat::Hdr) => from_rgbe(path),
        _ => Err(not_a_picture(
            path,
            "it is neither PNG nor JPEG nor Radiance HDR nor OpenEXR, going by its first bytes".into(),
        )),
    }
}

/// Writes a PNG, whole or not at all.
///
/// # Errors
/// [`Error::Io`] when the system refuses.
pub fn write_png(path: &Path, picture: &Srgb8Picture) -> Result<()> {
    let bytes = encode::png(picture.width, picture.height, &picture.bytes, path)?;
    let dir = path.parent().filter(|dir| !dir.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let name = path.file_name().and_then(|name| name.to_str());
    let name = name.ok_or(std::io::ErrorKind::InvalidFilename.into()).map_err(Error::io("write", path))?;
    atomic::write(dir, name, &bytes)
}

fn not_a_picture(path: &Path, reason: String) -> Error {
    Error::NotAPicture { path: path.to_path_buf(), reason }
}

fn too_large(path: &Path, width: usize, height: usize) -> Error {
    not_a_picture(path, format!("it has {width} × {height} px; up to {MAX_PIXELS} px in all are read"))
}

fn from_srgb(path: &Path, format: ImageFormat) -> Result<Picture> {
    let (width, height, mut rgb) = decode(path, format)?;
    for pixel in &mut rgb {
        *pixel = pixel.map(srgb_decode);
    }
    Ok(Picture { width, height, scale: Scale::Display, rgb, standard_error: None })
}

fn from_rgbe(path: &Path) -> Result<Picture> {
    let (width, height, rgb) = decode(path, ImageFormat::Hdr)?;
    Ok(Picture { width, height, scale: Scale::Radiance { exposure: 1.0 }, rgb, standard_error: None })
}

fn decode(path: &Path, format: ImageFormat) -> Result<(u32, u32, Vec<Rgb>)> {
    let open = || -> Result<_> {
        let mut reader = ImageReader::open(path).map_err(Error::io("read", path))?;
        reader.set_format(format);
        Ok(reader)
    };
    let (width, height) = open()?.into_dimensions().map_err(Error::picture("decode", path))?;
    if u64::from(width) * u64::from(height) > MAX_PIXELS {
        return Err(too_large(path, width as usize, height as usize));
    }
    let decoded = open()?.decode().map_err(Error::picture("decode", path))?.into_rgb32f();
    let (width, height) = decoded.dimensions();
    Ok((width, height, decoded.pixels().map(|pixel| pixel.0).collect()))
}

/// Refuses an OpenEXR file whose header promises more than [`MAX_PIXELS`], before room is made for them.
fn check_exr_size(path: &Path) -> Result<()> {
    let file = fs::File::open(path).map_err(Error::io("read", path))?;
    let header = MetaData::read_from_unbuffered(file, false).map_err(Error::picture("decode", path))?;
    let pixels = |size: Vec2<usize>| (size.0 as u64).saturating_mul(size.1 as u64);
    match header.headers.iter().map(|h| h.layer_size).find(|size| pixels(*size) > MAX_PIXELS) {
        Some(Vec2(width, height)) => Err(too_large(path, width, height)),
        None => Ok(()),
    }
}

fn from_exr(path: &Path) -> Result<Picture> {
    check_exr_size(path)?;
    let mut contents = exr_file::read(path)?;
    if contents.chromaticities.is_some_and(|found| !is_rec_709(&found)) {
        let reason = "its primaries are not those of sRGB (Rec. 709); convert it first".to_owned();
        return Err(not_a_picture(path, reason));
    }
    let channels = &mut contents.channels;
    let names = channels.keys().cloned().collect::<Vec<_>>().join(", ");
    let planes = match (channels.remove("R"), channels.remove("G"), channels.remove("B")) {
        (Some(r), Some(g), Some(b)) => [r, g, b],
        _ => match channels.remove("Y") {
            Some(y) => [y.clone(), y.clone(), y],
            None => {
                let reason = format!("it has neither channels R, G, B nor Y, but {names}");
                return Err(not_a_picture(path, reason));
            }
        },
    };
    let (width, height) = (planes[0].width, planes[0].height);
    let pixels = width as usize * height as usize;
    if planes.iter().any(|plane| plane.values.len() != pixels) {
        return Err(not_a_picture(path, "its channels are subsampled".to_owned()));
    }
    let rgb = (0..pixels).map(|i| -> Rgb { [0, 1, 2].map(|c: usize| planes[c].values[i]) }).collect();
    let exposure = contents.numbers.get("exposure").copied().unwrap_or(1.0);
    let standard_error = contents.channels.remove(STANDARD_ERROR).map(|channel| channel.values);
    Ok(Picture { width, height, scale: Scale::Radiance { exposure }, rgb, standard_error })
}

fn is_rec_709(found: &Chromaticities) -> bool {
    let coordinates = |c: &Chromaticities| [c.red, c.green, c.blue, c.white].map(|v| [v.0, v.1]);
    let pairs = coordinates(found).into_iter().flatten().zip(coordinates(&REC_709).into_iter().flatten());
    pairs.into_iter().all(|(a, b)| (a - b).abs() <= CHROMATICITY_ROUNDING)
}
