//! What a frame is stored from.

use std::collections::BTreeMap;

use fog_core::colour::Rgb;
use fog_film::{Frame, srgb8};
use serde_json::Value;

use crate::Attribute;

/// A rendered frame and what is stored with it. Everything but `seconds` and `denoised` must be a function of the frame's place in the
/// plan and the code, or two runs differ.
#[derive(Clone, Copy, Debug)]
pub struct FrameFiles<'a> {
    /// The frame's id in the plan.
    pub id: &'a str,
    /// The picture.
    pub frame: &'a Frame,
    /// The whole record for `<id>.json`; no clock time or duration in it.
    pub record: &'a serde_json::Value,
    /// Factor from radiance to the 8-bit picture, whose white is 1.
    pub exposure: f32,
    /// The picture without its noise, where the frame's outputs ask for it.
    pub denoised: Option<&'a DenoisedPicture>,
    /// Records of the things in the picture, where the frame's outputs ask for them.
    pub objects: Option<&'a Value>,
    /// The pictures of the sensor, where the frame has one: its sRGB picture is then the developed one.
    pub camera: Option<&'a CameraPicture>,
    /// The same view in clear air, where the frame's outputs ask for it.
    pub clear: Option<&'a ClearPicture>,
    /// Seconds that the frame took; go to `<id>.timing.json` only.
    pub seconds: f64,
    /// Names of the things by number, that of instance i of the mask at i − 1; may be empty where no mask is asked for.
    pub instances: &'a [String],
    /// The view, for attributes of the EXR files that OpenEXR defines.
    pub view: View,
    /// Custom attributes for the EXR files (intrinsics, …), stored as `fogbank.<name>`; `frame_id`, `exposure`
    /// and `wavelength_nm` are set here and win.
    pub attributes: &'a BTreeMap<String, Attribute>,
}

/// A frame's view in OpenEXR's conventions (openexr.com, "Standard Attributes": the spaces of RenderMan). Points are row
/// vectors on the left of the matrices, which are stored row by row: the last four numbers of `world_to_camera` are the
/// world's origin.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct View {
    /// `worldToCamera`: x right, y up, z forward, in metres; left-handed.
    pub world_to_camera: Option<[f32; 16]>,
    /// `worldToNDC`: after division by the fourth coordinate x and y from (0, 0), the upper left corner of the image, to (1, 1),
    /// the lower right one; only of lenses without distortion.
    pub world_to_ndc: Option<[f32; 16]>,
    /// `whiteLuminance`: luminance of R = G = B = 1; goes to files of colours only.
    pub white_luminance_cd_m2: Option<f32>,
}

/// What a frame's sensor gives.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CameraPicture {
    /// One number per pixel, for `<id>.raw.png`.
    pub raw: Vec<u16>,
    /// The developed picture, three bytes of sRGB per pixel.
    pub srgb8: Vec<u8>,
}

/// A frame's view in clear air.
#[derive(Clone, Debug, PartialEq)]
pub struct ClearPicture {
    /// The frame without fog, of the same size and channels.
    pub frame: Frame,
    /// Its picture at the same exposure, three bytes of sRGB per pixel.
    pub srgb8: Vec<u8>,
}

/// An estimate of a frame's radiance without its noise. It may depend on more than the frame: its files are no part of what
/// two runs have in common, and the frame's marker does not know their content.
#[derive(Clone, Debug, PartialEq)]
pub struct DenoisedPicture {
    /// One triple per pixel; of mono frames all three are the radiance.
    pub rgb: Vec<Rgb>,
    /// How it was made, a JSON object for `<id>.denoised.json`.
    pub details: Value,
}

impl DenoisedPicture {
    /// Its sRGB picture at an exposure, three bytes per pixel.
    #[must_use]
    pub fn to_srgb8(&self, exposure: f32) -> Vec<u8> {
        self.rgb.iter().flat_map(|rgb| rgb.map(|v| srgb8(v * exposure))).collect()
    }
}
