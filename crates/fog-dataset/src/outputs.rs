//! Which channels of a frame are wanted.

use serde::{Deserialize, Serialize};

use crate::{Error, Result};

/// The outputs of a frame, by the names of the configuration's `outputs`, and `groups` where it has groups of lights; as JSON the list of their names.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(try_from = "Vec<String>", into = "Vec<&'static str>")]
pub struct OutputSet {
    /// 8-bit sRGB picture.
    pub image: bool,
    /// Linear radiance.
    pub hdr: bool,
    /// Planar depth.
    pub depth: bool,
    /// Range.
    pub distance: bool,
    /// Transmittance to the first surface.
    pub transmittance: bool,
    /// Optical depth at 550 nm.
    pub tau: bool,
    /// Unscattered part of the radiance.
    pub direct: bool,
    /// Scattered part of the radiance.
    pub airlight: bool,
    /// Standard error of the luminance.
    pub standard_error: bool,
    /// Number of samples.
    pub samples: bool,
    /// The radiance by groups of lights.
    pub groups: bool,
    /// Estimate of the radiance without its noise.
    pub denoised: bool,
    /// Normals in the world.
    pub normals: bool,
    /// Positions in the world.
    pub position: bool,
    /// Base colour of the first surface.
    pub albedo: bool,
    /// Class of the first surface.
    pub semantic: bool,
    /// Instance of the first surface.
    pub instance: bool,
    /// Optical flow to the next frame of a path.
    pub flow: bool,
    /// Records of the things in the picture.
    pub objects: bool,
    /// Raw picture of the sensor.
    pub raw: bool,
    /// The same view in clear air.
    pub pair: bool,
}

impl OutputSet {
    /// The names, in the order of the fields.
    pub const NAMES: [&'static str; 21] = [
        "image",
        "hdr",
        "depth",
        "distance",
        "transmittance",
        "tau",
        "direct",
        "airlight",
        "standard_error",
        "samples",
        "groups",
        "denoised",
        "normals",
        "position",
        "albedo",
        "semantic",
        "instance",
        "flow",
        "objects",
        "raw",
        "pair",
    ];

    /// Every output.
    #[must_use]
    pub fn all() -> Self {
        let mut all = Self::default();
        for name in Self::NAMES {
            if let Some(flag) = all.flag(name) {
                *flag = true;
            }
        }
        all
    }

    /// The set of the given names, in any order.
    ///
    /// # Errors
    /// [`Error::UnknownOutput`] for a name that is not in [`OutputSet::NAMES`].
    pub fn from_names<S: AsRef<str>>(names: impl IntoIterator<Item = S>) -> Result<Self> {
        let mut set = Self::default();
        for name in names {
            let name = name.as_ref();
            *set.flag(name).ok_or_else(|| Error::UnknownOutput { name: name.to_owned() })? = true;
        }
        Ok(set)
    }

    /// The names in the set, in the order of the fields.
    #[must_use]
    pub fn names(mut self) -> Vec<&'static str> {
        Self::NAMES.into_iter().filter(|name| self.flag(name).is_some_and(|f| *f)).collect()
    }

    /// Whether an `.hdr.exr` belongs to the frame.
    #[must_use]
    pub fn wants_hdr_file(self) -> bool {
        self.hdr || self.direct || self.airlight || self.standard_error || self.samples || self.groups
    }

    /// Whether a `.gt.exr` belongs to the frame.
    #[must_use]
    pub fn wants_truth_file(self) -> bool {
        let fog = self.transmittance || self.tau;
        let surface = self.normals || self.position || self.albedo || self.flow || self.instance;
        self.depth || self.distance || fog || surface
    }

    fn flag(&mut self, name: &str) -> Option<&mut bool> {
        Some(match name {
            "image" => &mut self.image,
            "hdr" => &mut self.hdr,
            "depth" => &mut self.depth,
            "distance" => &mut self.distance,
            "transmittance" => &mut self.transmittance,
            "tau" => &mut self.tau,
            "direct" => &mut self.direct,
            "airlight" => &mut self.airlight,
            "standard_error" => &mut self.standard_error,
            "samples" => &mut self.samples,
            "groups" => &mut self.groups,
            "denoised" => &mut self.denoised,
            "normals" => &mut self.normals,
            "position" => &mut self.position,
            "albedo" => &mut self.albedo,
            "semantic" => &mut self.semantic,
            "instance" => &mut self.instance,
            "flow" => &mut self.flow,
            "objects" => &mut self.objects,
            "raw" => &mut self.raw,
            "pair" => &mut self.pair,
            _ => return None,
        })
    }
}

impl TryFrom<Vec<String>> for OutputSet {
    type Error = Error;

    fn try_from(names: Vec<String>) -> Result<Self> {
        Self::from_names(names)
    }
}

impl From<OutputSet> for Vec<&'static str> {
    fn from(set: OutputSet) -> Self {
        set.names()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_round_trip() {
        assert_eq!(OutputSet::all().names(), OutputSet::NAMES);
        let set = OutputSet::from_names(["tau", "image"]).expect("known names");
        assert_eq!(set.names(), ["image", "tau"]);
        assert!(set.wants_truth_file() && !set.wants_hdr_file());
        assert_eq!(serde_json::to_string(&set).expect("json"), r#"["image","tau"]"#);
        let e = OutputSet::from_names(["depht"]).expect_err("a typo").to_string();
        assert!(e.contains("`depht`") && e.contains("depth"), "{e}");
    }
}
