//! A frame's pictures as arrays of pixels, by the names of the outputs: what a program computes with that does not care which
//! file they are in, or whether the frame was stored at all.

use std::collections::BTreeMap;
use std::path::Path;

use image::{DynamicImage, ImageReader};
use serde_json::Value;

use crate::layers::{self, SAMPLES, STANDARD_ERROR};
use crate::{Channel, Error, FileKind, FrameFiles, OutputSet, PlanFrame, Reader, Result};

/// A picture of a frame: row 0 at the top, the components of a pixel side by side.
#[derive(Clone, Debug, PartialEq)]
pub struct Raster {
    /// Columns.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Values of each pixel, at least 1.
    pub components: usize,
    /// height × width × components of them.
    pub values: Values,
}

/// Values of a [`Raster`].
#[derive(Clone, Debug, PartialEq)]
pub enum Values {
    /// Radiance and truth.
    F32(Vec<f32>),
    /// Instances, and the numbers of a sensor.
    U16(Vec<u16>),
    /// sRGB pictures and classes.
    U8(Vec<u8>),
}

const COLOUR: &[&[&str]] = &[&["R", "G", "B"], &["Y"]];
const XYZ: &[&[&str]] = &[&["X", "Y", "Z"]];

/// Names of a frame's pictures in the order of [`OutputSet::NAMES`]: those of its outputs, but for `flow` also `flow_valid`,
/// for `pair` `clear` and `clear_image`, for `denoised` also `denoised_image`, for groups of lights `group.NAME` each; none for
/// `objects`.
#[must_use]
pub fn raster_names(frame: &PlanFrame) -> Vec<String> {
    let names = |output: &'static str| match output {
        "flow" => vec!["flow".to_owned(), "flow_valid".to_owned()],
        "pair" => vec!["clear".to_owned(), "clear_image".to_owned()],
        "denoised" => vec!["denoised".to_owned(), "denoised_image".to_owned()],
        "groups" => {
            let groups = frame.spec["lighting"]["groups"].as_array();
            let name = |group: &Value| Some(format!("group.{}", group["name"].as_str()?));
            groups.into_iter().flatten().filter_map(name).collect()
        }
        output => file_of_raster(output).map(|_| output.to_owned()).into_iter().collect(),
    };
    frame.outputs.names().into_iter().flat_map(names).collect()
}

/// The file that a picture is in; `None` for a name that no picture has.
#[must_use]
pub fn file_of_raster(name: &str) -> Option<FileKind> {
    Some(match name {
        "image" => FileKind::Image,
        "clear_image" => FileKind::ClearImage,
        "denoised_image" => FileKind::DenoisedImage,
        "semantic" => FileKind::Semantic,
        "instance" => FileKind::Instance,
        "raw" => FileKind::Raw,
        _ => channels_of(name)?.0,
    })
}

/// File, prefix and possible sets of components of a picture that is kept as channels.
fn channels_of(name: &str) -> Option<(FileKind, String, &'static [&'static [&'static str]])> {
    use FileKind::{Clear, Denoised, Hdr, Truth};
    let (kind, prefix, components): (_, _, &[&[&str]]) = match name {
        "hdr" => (Hdr, "", COLOUR),
        "direct" => (Hdr, "direct.", COLOUR),
        "airlight" => (Hdr, "airlight.", COLOUR),
        "standard_error" => (Hdr, "", &[&[STANDARD_ERROR]]),
        "samples" => (Hdr, "", &[&[SAMPLES]]),
        "clear" => (Clear, "", COLOUR),
        "denoised" => (Denoised, "", COLOUR),
        "depth" => (Truth, "depth.", &[&["Z"]]),
        "distance" => (Truth, "distance.", &[&["Z"]]),
        "transmittance" => (Truth, "transmittance.", COLOUR),
        "tau" => (Truth, "tau.", &[&["Y"]]),
        "normals" => (Truth, "N.", XYZ),
        "position" => (Truth, "P.", XYZ),
        "albedo" => (Truth, "albedo.", COLOUR),
        "flow" => (Truth, "flow.", &[&["X", "Y"]]),
        "flow_valid" => (Truth, "flow_valid.", &[&["Y"]]),
        _ => {
            name.strip_prefix("group.").filter(|group| !group.is_empty())?;
            return Some((Hdr, format!("{name}."), COLOUR));
        }
    };
    Some((kind, prefix.to_owned(), components))
}

impl Raster {
    /// Takes the channels of a picture out of those of its file ([`file_of_raster`]), by [`crate::read_exr_channels`] or
    /// [`Reader::channels`]; `None` if they are not there. A single channel keeps its buffer, several are woven into one.
    #[must_use]
    pub fn take(name: &str, channels: &mut BTreeMap<String, Channel>) -> Option<Self> {
        let (_, prefix, choices) = channels_of(name)?;
        let names = choices
            .iter()
            .map(|set| set.iter().map(|c| format!("{prefix}{c}")).collect::<Vec<_>>())
            .find(|names| names.iter().all(|name| channels.contains_key(name)))?;
        let mut planes: Vec<Channel> = names.iter().filter_map(|name| channels.remove(name)).collect();
        let (width, height) = (planes[0].width, planes[0].height);
        let values = match &mut planes[..] {
            [only] => std::mem::take(&mut only.values),
            [a, b] => weave([&a.values, &b.values]),
            [a, b, c] => weave([&a.values, &b.values, &c.values]),
            _ => return None,
        };
        Some(Self { width, height, components: planes.len(), values: Values::F32(values) })
    }

    /// The pictures of a frame that is not stored, as they would be read back.
    #[must_use]
    pub fn of_frame(files: &FrameFiles<'_>, outputs: OutputSet) -> BTreeMap<String, Self> {
        let groups = files.frame.groups.iter().map(|group| format!("group.{}", group.name));
        let names =
            OutputSet::NAMES.into_iter().chain(["flow_valid", "clear"]).map(str::to_owned).chain(groups);
        let mut of_file = channels_by_file(files, outputs);
        let mut rasters = whole_numbers(files, outputs);
        for name in names {
            let Some((kind, ..)) = channels_of(&name) else { continue };
            let channels = of_file.iter_mut().find(|(file, _)| *file == kind);
            if let Some(raster) = channels.and_then(|(_, channels)| Self::take(&name, channels)) {
                rasters.insert(name, raster);
            }
        }
        rasters
    }
}

/// The channels of a frame's OpenEXR files.
fn channels_by_file(
    files: &FrameFiles<'_>,
    outputs: OutputSet,
) -> Vec<(FileKind, BTreeMap<String, Channel>)> {
    let frame = files.frame;
    let (width, height) = (frame.width, frame.height);
    let clear = files.clear.filter(|_| outputs.pair).map(|clear| layers::clear(&clear.frame, outputs));
    let denoised = files.denoised.filter(|_| outputs.denoised).map(|d| layers::denoised(frame, &d.rgb));
    let lists = [
        (FileKind::Hdr, layers::radiance(frame, outputs)),
        (FileKind::Truth, layers::truth(frame, outputs)),
        (FileKind::Clear, clear.unwrap_or_default()),
        (FileKind::Denoised, denoised.unwrap_or_default()),
    ];
    let channel = |(name, values): (String, Vec<f32>)| (name, Channel { width, height, values });
    lists.map(|(kind, list)| (kind, list.into_iter().map(channel).collect())).into()
}

/// The pictures of a frame that are PNG files.
fn whole_numbers(files: &FrameFiles<'_>, outputs: OutputSet) -> BTreeMap<String, Raster> {
    let (frame, surface) = (files.frame, &files.frame.truth.surface);
    let image = || match files.camera {
        Some(camera) => camera.srgb8.clone(),
        None => frame.to_srgb8(files.exposure),
    };
    let clear = files.clear.filter(|_| outputs.pair).map(|clear| clear.srgb8.clone());
    let denoised = files.denoised.filter(|_| outputs.denoised).map(|d| d.to_srgb8(files.exposure));
    let raw = files.camera.filter(|_| outputs.raw).map(|camera| camera.raw.clone());
    let all = [
        ("image", outputs.image.then(|| Values::U8(image()))),
        ("clear_image", clear.map(Values::U8)),
        ("denoised_image", denoised.map(Values::U8)),
        ("semantic", outputs.semantic.then(|| Values::U8(surface.semantic.clone()))),
        ("instance", outputs.instance.then(|| Values::U16(surface.instance.clone()))),
        ("raw", raw.map(Values::U16)),
    ];
    let raster = |(name, values): (&str, Option<Values>)| {
        let components = if name.ends_with("image") { 3 } else { 1 };
        let (width, height, values) = (frame.width, frame.height, values?);
        Some((name.to_owned(), Raster { width, height, components, values }))
    };
    all.into_iter().filter_map(raster).collect()
}

impl Reader {
    /// One of a frame's sRGB pictures or pictures of whole numbers, from a file of its own.
    ///
    /// # Errors
    /// [`Error::Io`] when it cannot be read, [`Error::Picture`] when it is not such a PNG.
    pub fn raster(&self, frame: &PlanFrame, kind: FileKind) -> Result<Raster> {
        decode(&self.path(frame, kind))
    }
}

fn decode(path: &Path) -> Result<Raster> {
    let reader = ImageReader::open(path).map_err(Error::io("open", path))?;
    let picture = reader.decode().map_err(Error::picture("decode", path))?;
    let (width, height) = (picture.width(), picture.height());
    let (components, values) = match picture {
        DynamicImage::ImageRgb8(p) => (3, Values::U8(p.into_raw())),
        DynamicImage::ImageLuma8(p) => (1, Values::U8(p.into_raw())),
        DynamicImage::ImageLuma16(p) => (1, Values::U16(p.into_raw())),
        other => return Err(Error::picture("decode", path)(format!("it has {:?} pixels", other.color()))),
    };
    Ok(Raster { width, height, components, values })
}

/// Planes side by side.
fn weave<const N: usize>(planes: [&[f32]; N]) -> Vec<f32> {
    (0..planes[0].len()).map(|i| planes.map(|plane| plane[i])).collect::<Vec<_>>().into_flattened()
}
