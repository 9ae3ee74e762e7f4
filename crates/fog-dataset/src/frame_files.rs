//! What a frame is stored from.

use std::collections::BTreeMap;

use fog_film::Frame;

use crate::Attribute;

/// A rendered frame and what is stored with it. Everything but `seconds` must be a function of the frame's place in the
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
    /// Seconds that the frame took; go to `<id>.timing.json` only.
    pub seconds: f64,
    /// Custom attributes for the EXR files (camera pose, intrinsics, …), stored as `fogbank.<name>`; `frame_id`, `exposure`
    /// and `wavelength_nm` are set here and win.
    pub attributes: &'a BTreeMap<String, Attribute>,
}
