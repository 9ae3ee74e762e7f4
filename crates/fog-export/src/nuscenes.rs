//! nuScenes (Caesar et al., CVPR 2020): `samples/` and the 13 tables of its schema as JSON.
//!
//! The world has x east, y north, z up; the vehicle, and things, x forward, y left, z up; cameras x right, y down, z forward.
//! A path is a scene, a moment of it a sample, a thing in a scene an instance. Nothing was scanned: there are no points.

mod axes;
mod scene;
mod table;

use std::collections::{BTreeMap, BTreeSet};

use fog_dataset::FileKind;
use serde_json::{Value, json};

use crate::camera::{Box3, Camera};
use crate::classes::{Classes, MOVERS};
use crate::frame::Frame;
use crate::job::{Job, Writer};
use crate::track::{self, Place, Track};
use crate::{Result, png};

use scene::{Scene, Thing};
use table::{Table, token};

/// The outputs that frames must have.
pub(crate) const NEEDS: &[&str] = &["image", "objects"];

/// The folder of the tables.
const VERSION: &str = "v1.0-fogbank";

/// nuScenes' category of a class; classes that it lacks are named after ours.
fn category(class: &str) -> String {
    match class {
        "person" => "human.pedestrian.adult".to_owned(),
        "car" => "vehicle.car".to_owned(),
        "truck" => "vehicle.truck".to_owned(),
        "bus" => "vehicle.bus.rigid".to_owned(),
        "trailer" | "caravan" => "vehicle.trailer".to_owned(),
        "motorcycle" => "vehicle.motorcycle".to_owned(),
        "bicycle" => "vehicle.bicycle".to_owned(),
        other => format!("fogbank.{}", other.replace(' ', "_")),
    }
}

/// The tables that grow with the frames.
struct Tables {
    scene: Table,
    sample: Table,
    sample_data: Table,
    ego_pose: Table,
    calibrated_sensor: Table,
    instance: Table,
    sample_annotation: Table,
}

/// The writer.
pub(crate) struct Nuscenes<'a> {
    job: &'a Job<'a>,
    classes: Classes,
    track: Track,
    tables: Tables,
    sensors: BTreeSet<String>,
    categories: BTreeMap<String, String>,
    scene: Option<Scene>,
}

impl<'a> Nuscenes<'a> {
    pub(crate) fn begin(job: &'a Job<'a>) -> Result<Self> {
        let table = |name: &str| Table::create(job.folder, &format!("{VERSION}/{name}.json"));
        Ok(Self {
            job,
            classes: Classes::of(job)?,
            track: Track::default(),
            tables: Tables {
                scene: table("scene")?,
                sample: table("sample")?,
                sample_data: table("sample_data")?,
                ego_pose: table("ego_pose")?,
                calibrated_sensor: table("calibrated_sensor")?,
                instance: table("instance")?,
                sample_annotation: table("sample_annotation")?,
            },
            sensors: BTreeSet::new(),
            categories: BTreeMap::new(),
            scene: None,
        })
    }

    /// Whether a thing is to be annotated: people and vehicles, unless classes are asked for.
    fn keeps(&self, object: &Value) -> bool {
        let chosen = !self.job.options.classes.is_empty();
        let mover = object["class_id"].as_u64().is_some_and(|id| MOVERS.contains(&id));
        self.classes.keeps(object) && (chosen || mover)
    }

    /// The picture's record, with those of the vehicle's and the camera's pose.
    fn sample_data(&mut self, frame: &Frame<'_>, camera: &Camera, file: &str) -> Result<()> {
        let Some(scene) = &mut self.scene else { return Ok(()) };
        let record = frame.record()?;
        let channel = channel(frame);
        let (ego, mount) = axes::poses(record, camera);
        let ego_token = token(&["ego_pose", frame.id()]);
        let timestamp = scene.timestamp();
        let mut pose = ego.json(&ego_token);
        pose["timestamp"] = json!(timestamp);
        self.tables.ego_pose.push(&pose)?;
        let [fx, fy, cx, cy] = camera.intrinsics;
        let intrinsic = json!([[fx, 0.0, cx], [0.0, fy, cy], [0.0, 0.0, 1.0]]);
        let calibrated = scene.calibrated(&channel, &mount, &intrinsic);
        if let Some(mut value) = calibrated.new {
            value["sensor_token"] = json!(token(&["sensor", &channel]));
            value["camera_intrinsic"] = intrinsic;
            self.tables.calibrated_sensor.push(&value)?;
        }
        self.sensors.insert(channel.clone());
        let [width, height] = frame.size()?;
        let data = json!({
            "token": token(&["sample_data", frame.id()]),
            "sample_token": scene.sample_token(),
            "ego_pose_token": ego_token,
            "calibrated_sensor_token": calibrated.token,
            "timestamp": timestamp,
            "fileformat": "png",
            "is_key_frame": true,
            "height": height,
            "width": width,
            "filename": file,
            "fogbank": frame.details()?,
        });
        scene.add_data(channel, data, &mut self.tables.sample_data)
    }

    /// Takes the things that a frame shows into its sample.
    fn add_things(&mut self, frame: &Frame<'_>) -> Result<()> {
        for object in frame.objects()? {
            if !self.keeps(&object) {
                self.job.losses.add(
                    "things_left_out",
                    1,
                    "things that are neither people nor vehicles (--classes asks for others)",
                );
                continue;
            }
            if object["visible_pixels"] == 0 {
                self.job.losses.add(
                    "unseen_things",
                    1,
                    "things without a visible pixel, left out of their frame",
                );
                continue;
            }
            let (Some(number), Some(class), Some(solid)) =
                (object["instance"].as_u64(), object["class"].as_str(), Box3::of(&object, "world"))
            else {
                return Err(frame.damaged("objects.json", "a thing has no instance, class or box"));
            };
            let name = category(class);
            let category = token(&["category", &name]);
            self.categories.insert(name, category.clone());
            if let Some(scene) = &mut self.scene {
                scene.see(number, Thing::new(&object, category, axes::solid(&solid), &channel(frame)));
            }
        }
        Ok(())
    }

    /// Ends the scene, and what of it was kept back.
    fn close_scene(&mut self) -> Result<()> {
        match self.scene.take() {
            Some(scene) => scene.close(&mut self.tables),
            None => Ok(()),
        }
    }

    fn begin_sample(&mut self, frame: &Frame<'_>, place: Place) -> Result<()> {
        if place.begins_sequence || self.scene.is_none() {
            self.close_scene()?;
            let name = &self.job.reader.header().name;
            self.scene = Some(Scene::new(name, place.sequence, frame.details()?));
        }
        let seconds = frame.record()?["path"]["time_s"].as_f64().unwrap_or(place.step as f64);
        match &mut self.scene {
            Some(scene) => scene.begin_sample(frame.id(), seconds, &mut self.tables),
            None => Ok(()),
        }
    }

    /// The tables that do not grow with the frames, and the map that the schema asks for.
    fn small_tables(&self) -> Result<()> {
        let write = |name: &str, rows: Value| {
            self.job.folder.write(&format!("{VERSION}/{name}.json"), format!("{rows:#}\n"))
        };
        let levels = [
            ("1", "v0-40", "0 to 40 %"),
            ("2", "v40-60", "40 to 60 %"),
            ("3", "v60-80", "60 to 80 %"),
            ("4", "v80-100", "80 to 100 %"),
        ];
        let level = |(token, level, share): (&str, &str, &str)| json!({ "token": token, "level": level, "description": format!("{share} of the thing's pixels are visible") });
        write("visibility", levels.map(level).into_iter().collect())?;
        write("attribute", json!([]))?;
        let category =
            |(name, token): (&String, &String)| json!({ "token": token, "name": name, "description": "" });
        write("category", self.categories.iter().map(category).collect())?;
        let sensor = |channel: &String| json!({ "token": token(&["sensor", channel]), "channel": channel, "modality": "camera" });
        write("sensor", self.sensors.iter().map(sensor).collect())?;
        let log = token(&["log"]);
        let name = &self.job.reader.header().name;
        write(
            "log",
            json!([{ "token": log, "logfile": "", "vehicle": "fogbank", "date_captured": "", "location": name }]),
        )?;
        let map = json!([{ "token": token(&["map"]), "log_tokens": [log], "category": "semantic_prior", "filename": "maps/none.png" }]);
        write("map", map)?;
        png::grey8(self.job.folder, "maps/none.png", [1, 1], &[0])
    }
}

/// The channel of a frame's camera: `CAM_` and its name in the rig in capitals, else `CAM_FRONT`.
fn channel(frame: &Frame<'_>) -> String {
    match track::camera(frame.plan) {
        Some(name) => format!("CAM_{}", name.to_ascii_uppercase()),
        None => "CAM_FRONT".to_owned(),
    }
}

impl Writer for Nuscenes<'_> {
    fn frame(&mut self, frame: &Frame<'_>) -> Result<()> {
        let place = self.track.next(frame.plan);
        let camera = Camera::pinhole_of(frame, self.job)?;
        if place.begins_pose {
            self.begin_sample(frame, place)?;
        }
        let file = format!("samples/{}/{}.png", channel(frame), frame.id());
        self.job.folder.copy(&frame.path(FileKind::Image), &file)?;
        self.sample_data(frame, &camera, &file)?;
        self.add_things(frame)
    }

    fn finish(&mut self) -> Result<()> {
        self.close_scene()?;
        self.small_tables()?;
        let t = &mut self.tables;
        [
            &mut t.scene,
            &mut t.sample,
            &mut t.sample_data,
            &mut t.ego_pose,
            &mut t.calibrated_sensor,
            &mut t.instance,
            &mut t.sample_annotation,
        ]
        .into_iter()
        .try_for_each(Table::close)
    }
}
