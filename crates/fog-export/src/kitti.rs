//! KITTI (Geiger et al., CVPR 2012): the layout of the object benchmark, and of the odometry benchmark for paths.
//!
//! Camera axes x right, y down, z forward; a thing's location is the middle of its lower face; its `rotation_y` turns x into
//! where it looks, 0 to the right, clockwise seen from above. Pixel coordinates count from 0 at the centre of the top left pixel.

mod calib;
mod depth;
mod label;

use std::fs;

use fog_core::DMat4;
use fog_dataset::FileKind;
use serde_json::json;

use crate::camera::Camera;
use crate::classes::Classes;
use crate::folder::Sink;
use crate::frame::Frame;
use crate::job::{Job, Writer};
use crate::track::{self, Place, Rig, Track};
use crate::{Error, Result};

/// The outputs that frames must have.
pub(crate) const NEEDS: &[&str] = &["image", "objects"];

/// The writer.
pub(crate) struct Kitti<'a> {
    job: &'a Job<'a>,
    classes: Classes,
    rig: Rig,
    track: Track,
    /// The sequences being written, by the camera's folder.
    ways: Vec<(String, Way)>,
}

/// A sequence of the odometry benchmark.
struct Way {
    sequence: u64,
    number: u64,
    /// World from the left camera of the first frame.
    start: DMat4,
    steps: u64,
    last_pose: Option<u64>,
    times: Sink,
    poses: Sink,
}

impl<'a> Kitti<'a> {
    pub(crate) fn begin(job: &'a Job<'a>) -> Result<Self> {
        let (classes, rig) = (Classes::of(job)?, Rig::of(job.reader)?);
        Ok(Self { job, classes, rig, track: Track::default(), ways: Vec::new() })
    }

    /// The folder of a frame's camera; empty where there is one camera or a stereo pair.
    fn root(&self, frame: &Frame<'_>) -> String {
        match (track::camera(frame.plan), &self.rig.stereo) {
            (Some(name), None) => format!("{name}/"),
            _ => String::new(),
        }
    }

    /// The picture and its numbers for the odometry benchmark.
    fn odometry(
        &mut self,
        frame: &Frame<'_>,
        camera: &Camera,
        (root, right): (&str, bool),
        place: Place,
        image: &str,
    ) -> Result<()> {
        let baseline = self.rig.baseline_m();
        // Where the left camera is, if this is the right one.
        let offset = if right { -baseline } else { 0.0 };
        let left = camera.world_from_camera * DMat4::from_translation([offset, 0.0, 0.0].into());
        let known = self.ways.iter().position(|(name, _)| name == root);
        let at = match known {
            Some(at) if self.ways[at].1.sequence == place.sequence => at,
            _ => {
                let number = known.map_or(0, |at| self.ways[at].1.number + 1);
                if let Some(at) = known {
                    self.ways.swap_remove(at).1.close()?;
                }
                let dir = format!("{root}odometry/sequences/{number:02}");
                let text = calib::odometry(camera, baseline);
                self.job.folder.write(&format!("{dir}/calib.txt"), text)?;
                let times = self.job.folder.create(&format!("{dir}/times.txt"))?;
                let poses = self.job.folder.create(&format!("{root}odometry/poses/{number:02}.txt"))?;
                let way = Way {
                    sequence: place.sequence,
                    number,
                    start: left,
                    steps: 0,
                    last_pose: None,
                    times,
                    poses,
                };
                self.ways.push((root.to_owned(), way));
                self.ways.len() - 1
            }
        };
        let way = &mut self.ways[at].1;
        if way.last_pose != Some(place.pose) {
            way.last_pose = Some(place.pose);
            way.steps += 1;
            let time = frame.record()?["path"]["time_s"].as_f64().unwrap_or(way.steps as f64 - 1.0);
            way.times.write(format!("{time:e}\n"))?;
            way.poses.write(calib::row(&(way.start.inverse() * left)) + "\n")?;
        }
        let side = side(right);
        let link =
            format!("{root}odometry/sequences/{:02}/image_{side}/{:06}.png", way.number, way.steps - 1);
        let (from, to) = (self.job.folder.path(image)?, self.job.folder.path(&link)?);
        // One file under two names where the file system can.
        match fs::hard_link(&from, &to) {
            Ok(()) => Ok(()),
            Err(_) => fs::copy(&from, &to).map(drop).map_err(Error::io("write", &to)),
        }
    }
}

/// KITTI's number of a colour camera.
fn side(right: bool) -> u8 {
    if right { 3 } else { 2 }
}

impl Way {
    fn close(mut self) -> Result<()> {
        self.times.close()?;
        self.poses.close()
    }
}

impl Writer for Kitti<'_> {
    fn frame(&mut self, frame: &Frame<'_>) -> Result<()> {
        let place = self.track.next(frame.plan);
        let camera = Camera::pinhole_of(frame, self.job)?;
        let (root, right) = (self.root(frame), self.rig.is_right(frame.plan));
        let side = side(right);
        let (folder, losses) = (self.job.folder, self.job.losses);
        let name = format!("{:06}", place.pose);
        let training = format!("{root}training");
        let image = format!("{training}/image_{side}/{name}.png");
        folder.copy(&frame.path(FileKind::Image), &image)?;
        let mut meta = json!({ "frame": frame.details()? });
        if frame.outputs().depth {
            depth::write(frame, folder, &format!("{training}/depth_{side}/{name}.png"), losses)?;
        }
        let objects = frame.objects()?;
        let labels = label::labels(frame, &objects, &self.classes, losses)?;
        if right {
            losses.add("right_labels", labels.len() as u64, "labels of right pictures, kept in meta_3/ only");
        } else {
            let text: String = labels.iter().map(|label| label.line.clone() + "\n").collect();
            folder.write(&format!("{training}/label_2/{name}.txt"), text)?;
            let calibration = calib::object(&camera, self.rig.baseline_m());
            folder.write(&format!("{training}/calib/{name}.txt"), calibration)?;
        }
        meta["labels"] = labels.into_iter().map(|label| label.more).collect();
        folder.write(&format!("{training}/meta_{side}/{name}.json"), format!("{meta:#}\n"))?;
        if track::is_of_path(frame.plan) {
            self.odometry(frame, &camera, (&root, right), place, &image)?;
        }
        Ok(())
    }

    fn finish(&mut self) -> Result<()> {
        self.ways.drain(..).try_for_each(|(_, way)| way.close())
    }
}
