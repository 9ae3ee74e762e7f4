//! COCO (Lin et al., ECCV 2014): `images/` and one JSON file of images, categories and annotations.
//!
//! Boxes are `[x, y, width, height]` from the image's top left corner, around the visible pixels; masks are compressed
//! run-length codes by columns; a keypoint at the centre of the top left pixel is `(0, 0)`.

mod keypoints;
mod rle;

use std::collections::BTreeMap;
use std::fs;
use std::io::{BufRead, BufReader};

use fog_dataset::FileKind;
use serde_json::{Value, json};

use crate::Result;
use crate::classes::Classes;
use crate::folder::Sink;
use crate::frame::Frame;
use crate::job::{Job, Writer};
use keypoints::Keypoints;

/// The outputs that frames must have.
pub(crate) const NEEDS: &[&str] = &["image", "instance", "objects"];

const IMAGES: &str = "annotations/images.part";
const ANNOTATIONS: &str = "annotations/annotations.part";

/// The writer. Images and annotations are kept in a file each, line by line, and joined at the end.
pub(crate) struct Coco<'a> {
    job: &'a Job<'a>,
    classes: Classes,
    images: Sink,
    annotations: Sink,
    keypoints: Keypoints,
    last_annotation: u64,
}

impl<'a> Coco<'a> {
    pub(crate) fn begin(job: &'a Job<'a>) -> Result<Self> {
        Ok(Self {
            job,
            classes: Classes::of(job)?,
            images: job.folder.create(IMAGES)?,
            annotations: job.folder.create(ANNOTATIONS)?,
            keypoints: Keypoints::default(),
            last_annotation: 0,
        })
    }

    /// One thing with its mask.
    fn annotation(&mut self, frame: &Frame<'_>, object: &Value, runs: &rle::Runs) -> Result<Value> {
        let class = &object["class_id"];
        let sides = object["box_2d"]["visible"].as_array().filter(|sides| sides.len() == 4);
        let sides =
            sides.ok_or_else(|| frame.damaged("objects.json", "a visible thing has no visible box"))?;
        let side = |i: usize| sides[i].as_f64().unwrap_or_default();
        let [width, height] = frame.size()?;
        self.last_annotation += 1;
        let mut value = json!({
            "id": self.last_annotation,
            "image_id": frame.number + 1,
            "category_id": class,
            "bbox": [side(0), side(1), side(2) - side(0), side(3) - side(1)],
            "area": runs.area(),
            "segmentation": { "size": [height, width], "counts": runs.compressed() },
            "iscrowd": 0,
        });
        let (points, count) = self.keypoints.of(object, [width, height]);
        if !points.is_empty() {
            value["keypoints"] = json!(points);
            value["num_keypoints"] = json!(count);
        }
        for key in OWN {
            value[key] = object[key].clone();
        }
        value["box_2d_full"] = object["box_2d"]["full"].clone();
        Ok(value)
    }
}

/// Fields of ours that annotations keep under their own names (`docs/labels.md`).
const OWN: [&str; 11] = [
    "instance",
    "name",
    "detectable",
    "hidden_by",
    "certain",
    "occlusion",
    "truncation",
    "distance_m",
    "transmittance",
    "contrast",
    "box_3d",
];

impl Writer for Coco<'_> {
    fn frame(&mut self, frame: &Frame<'_>) -> Result<()> {
        let file = format!("{}.png", frame.id());
        self.job.folder.copy(&frame.path(FileKind::Image), &format!("images/{file}"))?;
        let [width, height] = frame.size()?;
        let image = json!({
            "id": frame.number + 1,
            "file_name": file,
            "width": width,
            "height": height,
            "fogbank": frame.details()?,
        });
        self.images.write(format!("{image}\n"))?;
        let mask = frame.mask(FileKind::Instance)?;
        let mut all = rle::runs(&mask);
        for object in &frame.objects()? {
            if !self.classes.keeps(object) {
                continue;
            }
            let number = object["instance"].as_u64().and_then(|n| u16::try_from(n).ok());
            if let Some(runs) = number.and_then(|n| all.remove(&n)) {
                let annotation = self.annotation(frame, object, &runs)?;
                self.annotations.write(format!("{annotation}\n"))?;
            } else {
                self.job.losses.add("unseen_things", 1, "things without a visible pixel, left out");
            }
        }
        Ok(())
    }

    fn finish(&mut self) -> Result<()> {
        self.images.close()?;
        self.annotations.close()?;
        let mut out = self.job.folder.create("annotations/instances.json")?;
        let header = self.job.reader.header();
        let info = json!({
            "description": format!("{} (Fogbank)", header.name),
            "version": header.config_digest,
            "contributor": format!("Fogbank, code {}", header.code_digest),
        });
        out.write(format!("{{\"info\":{info},\"licenses\":[],\n\"categories\":["))?;
        let skeletons = self.keypoints.by_class();
        for (i, class) in self.classes.kept().enumerate() {
            let mut category = json!({ "id": class.id, "name": class.name, "supercategory": class.group() });
            if let Some(names) = skeletons.get(&u64::from(class.id)) {
                category["keypoints"] = json!(names);
                category["skeleton"] = json!([]);
            }
            out.item(i == 0, category)?;
        }
        out.write("],\n\"images\":[")?;
        self.join(&mut out, IMAGES, &BTreeMap::new())?;
        out.write("],\n\"annotations\":[")?;
        self.join(&mut out, ANNOTATIONS, &skeletons)?;
        out.write("]}\n")?;
        out.close()
    }
}

impl Coco<'_> {
    /// Puts the lines of a file into a list, with as many keypoints as their classes have in the end, and removes the file.
    fn join(&self, out: &mut Sink, name: &str, skeletons: &BTreeMap<u64, Vec<String>>) -> Result<()> {
        let path = self.job.folder.path(name)?;
        let file = fs::File::open(&path).map_err(crate::Error::io("read", &path))?;
        for (i, line) in BufReader::new(file).lines().enumerate() {
            let mut line = line.map_err(crate::Error::io("read", &path))?;
            if !skeletons.is_empty() {
                line = keypoints::padded(&line, skeletons).unwrap_or(line);
            }
            out.item(i == 0, line)?;
        }
        fs::remove_file(&path).map_err(crate::Error::io("remove", &path))
    }
}
