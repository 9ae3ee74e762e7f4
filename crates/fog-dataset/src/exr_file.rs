//! OpenEXR files of f32 channels, written with the same bytes every time, and read back.

use std::collections::BTreeMap;
use std::fs::File;
use std::io::{BufReader, Cursor};
use std::path::Path;

use exr::image::{AnyChannel, AnyChannels, Encoding, FlatSamples, Image, Layer};
use exr::meta::attribute::{AttributeValue, Chromaticities, LineOrder, Text};
use exr::meta::header::LayerAttributes;
use exr::prelude::{ReadChannels, ReadLayers, Vec2, WritableImage};

use crate::exr_header::sort_attributes;
use crate::{Error, Result, View};

/// Custom attributes are stored under this prefix, so that none can be taken for a standard one.
const ATTRIBUTE_PREFIX: &str = "fogbank.";

/// Lossless, one block per line, lines in order: the only settings that give the same bytes in every run.
const ENCODING: Encoding = Encoding {
    compression: exr::compression::Compression::ZIP1,
    blocks: exr::image::Blocks::ScanLines,
    line_order: LineOrder::Increasing,
};

/// Primaries and white of Rec. 709 and sRGB.
pub(crate) const REC_709: Chromaticities = Chromaticities {
    red: Vec2(0.64, 0.33),
    green: Vec2(0.30, 0.60),
    blue: Vec2(0.15, 0.06),
    white: Vec2(0.3127, 0.3290),
};

/// Value of a custom EXR attribute.
#[derive(Clone, Debug, PartialEq)]
pub enum Attribute {
    /// A string.
    Text(String),
    /// A number.
    Number(f32),
}

/// One channel of a picture.
#[derive(Clone, Debug, PartialEq)]
pub struct Channel {
    /// Columns.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Row-major values, row 0 at the top.
    pub values: Vec<f32>,
}

/// What a file is to hold.
pub(crate) struct Picture {
    pub(crate) width: u32,
    pub(crate) height: u32,
    /// Channel name and row-major values; names must be ASCII and differ.
    pub(crate) channels: Vec<(String, Vec<f32>)>,
    /// Our own attributes; names without the prefix.
    pub(crate) attributes: BTreeMap<String, Attribute>,
    /// Attributes of other conventions, by whole names.
    pub(crate) foreign: Vec<(String, String)>,
    /// OpenEXR's attributes of the view.
    pub(crate) view: View,
    /// Whether R, G, B are Rec. 709 primaries with D65.
    pub(crate) colour: bool,
}

/// The bytes of an EXR file; `path` is only for messages.
pub(crate) fn encode(picture: Picture, path: &Path) -> Result<Vec<u8>> {
    let size = Vec2(picture.width as usize, picture.height as usize);
    let channels = picture
        .channels
        .into_iter()
        .map(|(name, values)| AnyChannel::new(text(&name), FlatSamples::F32(values)))
        .collect();
    let own = picture
        .attributes
        .into_iter()
        .map(|(name, value)| (text(&format!("{ATTRIBUTE_PREFIX}{name}")), attribute_value(value)));
    let foreign =
        picture.foreign.into_iter().map(|(name, value)| (text(&name), AttributeValue::Text(text(&value))));
    let own = LayerAttributes {
        world_to_camera: picture.view.world_to_camera,
        world_to_normalized_device: picture.view.world_to_ndc,
        white_luminance: picture.view.white_luminance_cd_m2.filter(|_| picture.colour),
        other: own.chain(foreign).collect(),
        ..LayerAttributes::default()
    };
    let mut image = Image::from_layer(Layer::new(size, own, ENCODING, AnyChannels::sort(channels)));
    image.attributes.chromaticities = picture.colour.then_some(REC_709);
    let mut bytes = Cursor::new(Vec::new());
    image.write().to_buffered(&mut bytes).map_err(Error::picture("encode", path))?;
    let mut bytes = bytes.into_inner();
    sort_attributes(&mut bytes).ok_or("malformed header").map_err(Error::picture("encode", path))?;
    Ok(bytes)
}

/// Any text as EXR's bytes (UTF-8).
fn text(s: &str) -> Text {
    Text::from_bytes_unchecked(s.as_bytes().into())
}

fn attribute_value(value: Attribute) -> AttributeValue {
    match value {
        Attribute::Text(s) => AttributeValue::Text(text(&s)),
        Attribute::Number(x) => AttributeValue::F32(x),
    }
}

/// What [`read`] found in a file.
pub(crate) struct Contents {
    pub(crate) channels: BTreeMap<String, Channel>,
    /// Our custom attributes that are numbers, without their prefix.
    pub(crate) numbers: BTreeMap<String, f32>,
    pub(crate) chromaticities: Option<Chromaticities>,
}

/// All channels of the first layer of an EXR file by name, as f32 (half and integer samples are converted).
///
/// # Errors
/// [`Error::Io`] when the file cannot be opened, [`Error::Picture`] when it is not a readable EXR picture.
pub fn read_exr_channels(path: &Path) -> Result<BTreeMap<String, Channel>> {
    Ok(read(path)?.channels)
}

/// The first layer of an EXR file.
pub(crate) fn read(path: &Path) -> Result<Contents> {
    let file = File::open(path).map_err(Error::io("open", path))?;
    let image = exr::image::read::read()
        .no_deep_data()
        .largest_resolution_level()
        .all_channels()
        .first_valid_layer()
        .all_attributes()
        .from_buffered(BufReader::new(file))
        .map_err(Error::picture("decode", path))?;
    let Vec2(columns, rows) = image.layer_data.size;
    let size = |n: usize| u32::try_from(n).map_err(Error::picture("decode", path));
    let (width, height) = (size(columns)?, size(rows)?);
    let number = |(name, value): (Text, AttributeValue)| match value {
        AttributeValue::F32(x) => Some((name.to_string().strip_prefix(ATTRIBUTE_PREFIX)?.to_owned(), x)),
        _ => None,
    };
    let channel = |channel: AnyChannel<FlatSamples>| {
        let values = match channel.sample_data {
            FlatSamples::F32(values) => values,
            other => other.values_as_f32().collect(),
        };
        (channel.name.to_string(), Channel { width, height, values })
    };
    Ok(Contents {
        channels: image.layer_data.channel_data.list.into_iter().map(channel).collect(),
        numbers: image.layer_data.attributes.other.into_iter().filter_map(number).collect(),
        chromaticities: image.attributes.chromaticities,
    })
}
