//! The formats.

use std::fmt;

use crate::job::{Job, Writer};
use crate::{Error, Result, coco};

/// A format of others.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// COCO: one JSON file of images, boxes, masks and keypoints.
    Coco,
}

impl Format {
    /// All of them.
    pub const ALL: [Self; 1] = [Self::Coco];

    /// Its name on the command line.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Coco => "coco",
        }
    }

    /// What it is made of, in a line.
    #[must_use]
    pub fn about(self) -> &'static str {
        match self {
            Self::Coco => "COCO: images/, annotations/instances.json with boxes, masks (RLE), keypoints",
        }
    }

    /// The outputs that every frame must have been rendered with.
    #[must_use]
    pub fn needs(self) -> &'static [&'static str] {
        match self {
            Self::Coco => coco::NEEDS,
        }
    }

    /// The format of a name.
    ///
    /// # Errors
    /// [`Error::Option`] if there is none.
    pub fn from_name(name: &str) -> Result<Self> {
        let names = || Self::ALL.map(Self::name).join(", ");
        let found = Self::ALL.into_iter().find(|format| format.name() == name);
        found.ok_or_else(|| Error::Option(format!("unknown format `{name}`, expected one of {}", names())))
    }

    /// A writer of it.
    pub(crate) fn writer<'a>(self, job: &'a Job<'a>) -> Result<Box<dyn Writer + 'a>> {
        Ok(match self {
            Self::Coco => Box::new(coco::Coco::begin(job)?),
        })
    }
}

impl fmt::Display for Format {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}
