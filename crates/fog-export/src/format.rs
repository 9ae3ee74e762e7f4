//! The formats.

use std::fmt;

use crate::job::{Job, Writer};
use crate::lard::{self, Edition, Lard};
use crate::{Error, Result, cityscapes, coco, huggingface, kitti, mcap_file, nuscenes, webdataset};

/// A format of others.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// COCO: pictures, and one JSON file of boxes, masks and keypoints.
    Coco,
    /// KITTI: pictures, labels, calibration and depth of the object benchmark, and sequences of the odometry benchmark.
    Kitti,
    /// Cityscapes: pictures, labels as pictures and polygons, cameras, disparity of stereo rigs.
    Cityscapes,
    /// LARD's first edition: pictures of runways, and a CSV file of their corners.
    LardV1,
    /// LARD's second edition.
    LardV2,
    /// nuScenes: pictures, and the 13 tables of its schema.
    Nuscenes,
    /// WebDataset: tar files of the data set's own files.
    WebDataset,
    /// Hugging Face `datasets`: Parquet files with the pictures in them, and a card.
    HuggingFace,
    /// MCAP with Foxglove's messages: pictures, depth, cameras and boxes by time.
    Mcap,
}

/// What is to be said of a format.
struct Entry {
    name: &'static str,
    about: &'static str,
    needs: &'static [&'static str],
}

impl Format {
    /// All of them.
    pub const ALL: &'static [Self] = &[
        Self::Coco,
        Self::Kitti,
        Self::Cityscapes,
        Self::LardV1,
        Self::LardV2,
        Self::Nuscenes,
        Self::WebDataset,
        Self::HuggingFace,
        Self::Mcap,
    ];

    fn entry(self) -> Entry {
        match self {
            Self::Coco => Entry {
                name: "coco",
                about: "images/, annotations/instances.json: boxes, masks (RLE), keypoints",
                needs: coco::NEEDS,
            },
            Self::Kitti => Entry {
                name: "kitti",
                about: "training/ with image_2, label_2, calib, depth_2; odometry/ of paths",
                needs: kitti::NEEDS,
            },
            Self::Cityscapes => Entry {
                name: "cityscapes",
                about: "leftImg8bit/, gtFine/, camera/; of stereo rigs rightImg8bit/, disparity/",
                needs: cityscapes::NEEDS,
            },
            Self::LardV1 => Entry {
                name: "lard-v1",
                about: "images/ and a CSV file: corners of runways, distances and angles of the approach",
                needs: lard::NEEDS,
            },
            Self::LardV2 => Entry {
                name: "lard-v2",
                about: "the same in the columns of 2025: several runways, cut ones too",
                needs: lard::NEEDS,
            },
            Self::Nuscenes => Entry {
                name: "nuscenes",
                about: "samples/ and v1.0-fogbank/ with the 13 tables: scenes, poses, boxes, instances",
                needs: nuscenes::NEEDS,
            },
            Self::WebDataset => Entry {
                name: "webdataset",
                about: "NAME-000000.tar, …: every file of each frame, under one key (--shard-size)",
                needs: webdataset::NEEDS,
            },
            Self::HuggingFace => Entry {
                name: "huggingface",
                about: "data/train-*.parquet with pictures, axes, EXR files (--shard-size); README.md",
                needs: huggingface::NEEDS,
            },
            Self::Mcap => Entry {
                name: "mcap",
                about: "NAME-000000.mcap, …: Foxglove's messages of pictures, depth, cameras, boxes",
                needs: mcap_file::NEEDS,
            },
        }
    }

    /// Its name on the command line.
    #[must_use]
    pub fn name(self) -> &'static str {
        self.entry().name
    }

    /// What it writes, in a line.
    #[must_use]
    pub fn about(self) -> &'static str {
        self.entry().about
    }

    /// The outputs that every frame must have been rendered with.
    #[must_use]
    pub fn needs(self) -> &'static [&'static str] {
        self.entry().needs
    }

    /// Whether it fills one file after another up to a size.
    #[must_use]
    pub fn is_sharded(self) -> bool {
        matches!(self, Self::WebDataset | Self::HuggingFace)
    }

    /// The format of a name.
    ///
    /// # Errors
    /// [`Error::Option`] if there is none.
    pub fn from_name(name: &str) -> Result<Self> {
        let found = Self::ALL.iter().copied().find(|format| format.name() == name);
        found.ok_or_else(|| {
            let names: Vec<&str> = Self::ALL.iter().map(|format| format.name()).collect();
            Error::Option(format!("unknown format `{name}`, expected one of {}", names.join(", ")))
        })
    }

    /// A writer of it.
    pub(crate) fn writer<'a>(self, job: &'a Job<'a>) -> Result<Box<dyn Writer + 'a>> {
        Ok(match self {
            Self::Coco => Box::new(coco::Coco::begin(job)?),
            Self::Kitti => Box::new(kitti::Kitti::begin(job)?),
            Self::Cityscapes => Box::new(cityscapes::Cityscapes::begin(job)?),
            Self::LardV1 => Box::new(Lard::begin(job, Edition::V1)?),
            Self::LardV2 => Box::new(Lard::begin(job, Edition::V2)?),
            Self::Nuscenes => Box::new(nuscenes::Nuscenes::begin(job)?),
            Self::WebDataset => Box::new(webdataset::WebDataset::begin(job)),
            Self::HuggingFace => Box::new(huggingface::HuggingFace::begin(job)?),
            Self::Mcap => Box::new(mcap_file::Mcap::begin(job)),
        })
    }
}

impl fmt::Display for Format {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}
