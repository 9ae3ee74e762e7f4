//! File names of a data set and of its frames.

use crate::{Error, OutputSet, Result};

pub(crate) const HEADER: &str = "dataset.json";
pub(crate) const CLASSES: &str = "classes.json";
pub(crate) const CONFIG: &str = "config.resolved.yaml";
pub(crate) const PLAN: &str = "plan.jsonl";
pub(crate) const INDEX: &str = "index.csv";

/// The kinds of file that a frame can have, by what follows the id.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// `rgb.png`: the sRGB picture.
    Image,
    /// `hdr.exr`: radiance.
    Hdr,
    /// `gt.exr`: truth per pixel.
    Truth,
    /// `raw.png`: the sensor's raw picture.
    Raw,
    /// `clear.exr`: radiance in clear air.
    Clear,
    /// `clear.rgb.png`: its sRGB picture.
    ClearImage,
    /// `json`: the record.
    Record,
    /// `semantic.png`: classes.
    Semantic,
    /// `instance.png`: instances.
    Instance,
    /// `objects.json`: records of the things in the picture.
    Objects,
    /// `denoised.exr`: a guess at the radiance without noise.
    Denoised,
    /// `denoised.png`: its sRGB picture.
    DenoisedImage,
    /// `denoised.json`: what guessed it.
    Denoising,
    /// `timing.json`: seconds.
    Timing,
    /// `done`: the marker.
    Done,
    /// `failed.json`: why the frame failed.
    Failed,
}

impl Kind {
    /// The kinds that hold the frame and are hashed, in the order in which they are written.
    pub(crate) const HASHED: [Self; 10] = [
        Self::Image,
        Self::Hdr,
        Self::Truth,
        Self::Record,
        Self::Semantic,
        Self::Instance,
        Self::Objects,
        Self::Raw,
        Self::Clear,
        Self::ClearImage,
    ];

    /// The kinds that depend on more than the frame: on a library and the processor. Of two pictures and their record,
    /// which has their hashes, the record is written last.
    pub(crate) const DENOISED: [Self; 2] = [Self::Denoised, Self::DenoisedImage];

    /// Every kind; the marker first, so that a frame that is being removed does not count as done.
    pub(crate) fn all() -> impl Iterator<Item = Self> {
        let rest = [Self::Denoising, Self::Timing, Self::Failed];
        [Self::Done].into_iter().chain(Self::HASHED).chain(Self::DENOISED).chain(rest)
    }

    /// File name of this kind for a frame.
    #[must_use]
    pub fn file(self, id: &str) -> String {
        let suffix = match self {
            Self::Image => "rgb.png",
            Self::Hdr => "hdr.exr",
            Self::Truth => "gt.exr",
            Self::Raw => "raw.png",
            Self::Clear => "clear.exr",
            Self::ClearImage => "clear.rgb.png",
            Self::Record => "json",
            Self::Semantic => "semantic.png",
            Self::Instance => "instance.png",
            Self::Objects => "objects.json",
            Self::Denoised => "denoised.exr",
            Self::DenoisedImage => "denoised.png",
            Self::Denoising => "denoised.json",
            Self::Timing => "timing.json",
            Self::Done => "done",
            Self::Failed => "failed.json",
        };
        format!("{id}.{suffix}")
    }

    /// Whether the outputs ask for this hashed kind.
    #[must_use]
    pub fn wanted(self, outputs: OutputSet) -> bool {
        match self {
            Self::Image => outputs.image,
            Self::Hdr => outputs.wants_hdr_file(),
            Self::Truth => outputs.wants_truth_file(),
            Self::Semantic => outputs.semantic,
            Self::Instance => outputs.instance,
            Self::Objects => outputs.objects,
            Self::Raw => outputs.raw,
            Self::Clear | Self::ClearImage => outputs.pair,
            _ => true,
        }
    }
}

/// Refuses ids that are no portable file name or whose files could be taken for those of something else.
pub(crate) fn check_id(id: &str) -> Result<()> {
    let bad = |reason| Err(Error::BadId { id: id.to_owned(), reason });
    if id.is_empty() || id.len() > 200 {
        return bad("it must have 1 to 200 characters");
    }
    if !id.bytes().all(|b| b.is_ascii_alphanumeric() || b"._-".contains(&b)) {
        return bad("only letters, digits, `.`, `_` and `-` are allowed");
    }
    if !id.as_bytes()[0].is_ascii_alphanumeric() {
        return bad("it must begin with a letter or digit");
    }
    let taken_ends = [".timing", ".failed", ".denoised", ".objects", ".clear"];
    if ["dataset", "classes"].contains(&id) || taken_ends.iter().any(|taken| id.ends_with(taken)) {
        return bad(
            "`dataset`, `classes` and names ending in `.timing`, `.failed`, `.denoised`, `.objects` or `.clear` are taken",
        );
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ids_stay_inside_the_folder() {
        for good in ["000001", "f-000001_h2.5", "a"] {
            assert!(check_id(good).is_ok(), "{good}");
        }
        let long = "x".repeat(201);
        for bad in [
            "",
            "../a",
            "a/b",
            "a\\b",
            ".hidden",
            "dataset",
            "a.timing",
            "a.failed",
            "a.denoised",
            "a.objects",
            "classes",
            "a.clear",
            "ä",
            "a b",
            &long,
        ] {
            assert!(check_id(bad).is_err(), "{bad}");
        }
    }
}
