//! Cityscapes (Cordts et al., CVPR 2016): `leftImg8bit/`, `gtFine/`, `camera/`, and of stereo rigs `rightImg8bit/` and
//! `disparity/`.
//!
//! Instance pictures hold 1000 · label + number for the classes that have instances, else the label. Disparity is 256 · d + 1.

mod labels;
mod outline;

use fog_dataset::FileKind;
use serde_json::{Value, json};

use crate::camera::Camera;
use crate::classes::Classes;
use crate::frame::Frame;
use crate::job::{Job, Writer};
use crate::track::{self, Rig, Track};
use crate::{Result, png};
use labels::Labels;

/// The outputs that frames must have.
pub(crate) const NEEDS: &[&str] = &["image", "semantic", "instance"];

/// The split that all frames are of.
const SPLIT: &str = "train";

/// The writer.
pub(crate) struct Cityscapes<'a> {
    job: &'a Job<'a>,
    classes: Classes,
    rig: Rig,
    track: Track,
}

impl<'a> Cityscapes<'a> {
    pub(crate) fn begin(job: &'a Job<'a>) -> Result<Self> {
        let (classes, rig) = (Classes::of(job)?, Rig::of(job.reader)?);
        Ok(Self { job, classes, rig, track: Track::default() })
    }

    /// The data set's name as a city's, with the camera's where there are several that are no stereo pair: letters and digits.
    fn city(&self, frame: &Frame<'_>) -> String {
        let plain = |text: &str| -> String {
            text.chars().filter(char::is_ascii_alphanumeric).map(|c| c.to_ascii_lowercase()).collect()
        };
        let cameras = &self.rig.cameras;
        let camera = match (&self.rig.stereo, track::camera(frame.plan)) {
            (None, Some(name)) if cameras.iter().filter(|other| plain(other) == plain(name)).count() > 1 => {
                // Names that differ in other signs only.
                let place = cameras.iter().position(|other| other == name).unwrap_or_default();
                format!("{}{place}", plain(name))
            }
            (None, Some(name)) => plain(name),
            _ => String::new(),
        };
        let city = plain(&self.job.reader.header().name) + &camera;
        if city.is_empty() { "fogbank".to_owned() } else { city }
    }

    fn disparity(&self, frame: &Frame<'_>, camera: &Camera, baseline_m: f64, name: &str) -> Result<()> {
        let depth = frame.channel(FileKind::Truth, "depth.Z")?;
        let scale = camera.intrinsics[0] * baseline_m;
        let mut near = 0;
        let code = |&metres: &f32| -> u16 {
            let steps = (scale / f64::from(metres) * 256.0).round() + 1.0;
            if steps > f64::from(u16::MAX) {
                near += 1;
                return 0;
            }
            // NaN, where a lens shows nothing, becomes 0: no value.
            steps as u16
        };
        let pixels: Vec<u16> = depth.values.iter().map(code).collect();
        self.job.losses.add(
            "disparity_above_255_px",
            near,
            "pixels with a disparity above 255.99 pixels, stored as 0 (no value)",
        );
        png::grey16(self.job.folder, name, [depth.width, depth.height], &pixels)
    }
}

impl Writer for Cityscapes<'_> {
    fn frame(&mut self, frame: &Frame<'_>) -> Result<()> {
        let place = self.track.next(frame.plan);
        let camera = Camera::pinhole_of(frame, self.job)?;
        let (folder, city, losses) = (self.job.folder, self.city(frame), self.job.losses);
        let core = format!("{city}_{:06}_{:06}", place.sequence, place.step);
        let path = |kind: &str, end: &str| format!("{kind}/{SPLIT}/{city}/{core}_{end}");
        if self.rig.is_right(frame.plan) {
            // Everything else is of the left picture.
            return folder.copy(&frame.path(FileKind::Image), &path("rightImg8bit", "rightImg8bit.png"));
        }
        folder.copy(&frame.path(FileKind::Image), &path("leftImg8bit", "leftImg8bit.png"))?;
        let labels = Labels::of(frame, &self.classes, losses)?;
        let size = labels.size;
        png::grey8(folder, &path("gtFine", "gtFine_labelIds.png"), size, &labels.ids)?;
        png::grey16(folder, &path("gtFine", "gtFine_instanceIds.png"), size, &labels.instance_ids())?;
        png::rgba8(folder, &path("gtFine", "gtFine_color.png"), size, &labels.colours(&self.classes))?;
        let polygons = labels.polygons(&self.classes, losses);
        folder.write(&path("gtFine", "gtFine_polygons.json"), format!("{polygons}\n"))?;
        let baseline = self.rig.baseline_m();
        let text = format!("{:#}\n", camera_json(frame.record()?, &camera, baseline));
        folder.write(&path("camera", "camera.json"), text)?;
        if baseline > 0.0 && frame.outputs().depth {
            self.disparity(frame, &camera, baseline, &path("disparity", "disparity.png"))?;
        }
        folder.write(&path("fogbank", "fogbank.json"), format!("{:#}\n", frame.details()?))
    }

    fn finish(&mut self) -> Result<()> {
        Ok(())
    }
}

/// Focal lengths and principal point; pose in the rig by ISO 8855 (x forward, y left, z up; yaw to the left, pitch down, roll to
/// the right, in radians). A camera without a rig has the pitch and roll of its own.
fn camera_json(record: &Value, camera: &Camera, baseline_m: f64) -> Value {
    let mount = &record["rig"]["mount"];
    let in_rig = mount.is_object();
    let angle = |key: &str| {
        let of = if in_rig { &mount[key] } else { &record["camera"][key] };
        of.as_f64().unwrap_or_default().to_radians()
    };
    let position = |c: usize| mount["position_m"][c].as_f64().unwrap_or_default();
    let [fx, fy, u0, v0] = camera.intrinsics;
    json!({
        "extrinsic": {
            "baseline": baseline_m,
            "x": position(2),
            "y": 0.0 - position(0),
            "z": 0.0 - position(1),
            "yaw": if in_rig { 0.0 - angle("heading_deg") } else { 0.0 },
            "pitch": 0.0 - angle("pitch_deg"),
            "roll": angle("roll_deg"),
        },
        "intrinsic": { "fx": fx, "fy": fy, "u0": u0, "v0": v0 },
    })
}
