//! A scene while its frames come: what has a successor in it is kept back until that one is known.

use std::collections::BTreeMap;

use serde_json::{Map, Value, json};

use super::Tables;
use super::axes::Pose;
use super::table::{Table, token};
use crate::Result;

/// A thing in a sample, as its cameras see it.
pub(super) struct Thing {
    category: String,
    pose: Pose,
    size: [f64; 3],
    /// The greatest share of its pixels that a camera sees of it.
    visible: f64,
    /// What each camera tells of it.
    views: Map<String, Value>,
}

/// What a camera's view keeps of our own.
const OWN: [&str; 9] = [
    "instance",
    "name",
    "class",
    "detectable",
    "hidden_by",
    "visible_pixels",
    "occlusion",
    "distance_m",
    "transmittance",
];

impl Thing {
    pub(super) fn new(
        object: &Value,
        category: String,
        (pose, size): (Pose, [f64; 3]),
        channel: &str,
    ) -> Self {
        let own = OWN.iter().map(|key| ((*key).to_owned(), object[*key].clone()));
        let view = Value::Object(own.collect());
        let visible = 1.0 - object["occlusion"].as_f64().unwrap_or(1.0);
        Self { category, pose, size, visible, views: [(channel.to_owned(), view)].into_iter().collect() }
    }

    /// nuScenes' level of visibility, which counts pixels over all cameras; here it is that of the camera that sees most.
    fn level(&self) -> &'static str {
        match self.visible {
            v if v > 0.8 => "4",
            v if v > 0.6 => "3",
            v if v > 0.4 => "2",
            _ => "1",
        }
    }
}

/// A thing's course through the scene.
struct Course {
    category: String,
    token: String,
    count: u64,
    first: String,
    /// The annotation whose successor is not known yet.
    last: Value,
}

/// A calibrated sensor: its token, and its record if it is new.
pub(super) struct Calibrated {
    pub(super) token: String,
    pub(super) new: Option<Value>,
}

/// A scene.
pub(super) struct Scene {
    name: String,
    token: String,
    details: Value,
    samples: u64,
    first: String,
    /// The sample at work.
    sample: Value,
    things: BTreeMap<u64, Thing>,
    courses: BTreeMap<u64, Course>,
    /// The last picture of each channel.
    data: BTreeMap<String, Value>,
    sensors: BTreeMap<String, (String, Value)>,
}

impl Scene {
    pub(super) fn new(data_set: &str, sequence: u64, details: Value) -> Self {
        let name = format!("{data_set}-{sequence:04}");
        Self {
            token: token(&["scene", &name]),
            name,
            details,
            samples: 0,
            first: String::new(),
            sample: Value::Null,
            things: BTreeMap::new(),
            courses: BTreeMap::new(),
            data: BTreeMap::new(),
            sensors: BTreeMap::new(),
        }
    }

    /// Begins the next moment.
    pub(super) fn begin_sample(&mut self, frame: &str, seconds: f64, tables: &mut Tables) -> Result<()> {
        let own = token(&["sample", frame]);
        let before = self.sample["token"].as_str().unwrap_or_default().to_owned();
        self.end_sample(&own, tables)?;
        if self.samples == 0 {
            self.first.clone_from(&own);
        }
        self.samples += 1;
        self.sample = json!({
            "token": own,
            "timestamp": (seconds * 1e6).round() as i64,
            "scene_token": self.token,
            "prev": before,
        });
        Ok(())
    }

    pub(super) fn timestamp(&self) -> Value {
        self.sample["timestamp"].clone()
    }

    pub(super) fn sample_token(&self) -> Value {
        self.sample["token"].clone()
    }

    /// The calibrated sensor of a channel: a new one when its place or its numbers change.
    pub(super) fn calibrated(&mut self, channel: &str, mount: &Pose, intrinsic: &Value) -> Calibrated {
        // Poses in single precision: a mount that stays is the same in every frame to a few 1e-7.
        let rounded = |v: f64| (v * 1e5).round() as i64;
        let turn = mount.rotation.to_array().map(rounded);
        let place = mount.translation.to_array().map(rounded);
        let content = json!([place, turn, intrinsic]);
        if let Some((token, known)) = self.sensors.get(channel)
            && *known == content
        {
            return Calibrated { token: token.clone(), new: None };
        }
        let own = token(&["calibrated_sensor", &self.name, channel, &content.to_string()]);
        self.sensors.insert(channel.to_owned(), (own.clone(), content));
        Calibrated { new: Some(mount.json(&own)), token: own }
    }

    /// Takes a picture; the channel's last one has its successor now.
    pub(super) fn add_data(&mut self, channel: String, mut data: Value, table: &mut Table) -> Result<()> {
        data["prev"] = json!("");
        if let Some(mut last) = self.data.remove(&channel) {
            data["prev"] = last["token"].clone();
            last["next"] = data["token"].clone();
            table.push(&last)?;
        }
        self.data.insert(channel, data);
        Ok(())
    }

    /// Takes what a camera sees of a thing.
    pub(super) fn see(&mut self, number: u64, thing: Thing) {
        match self.things.get_mut(&number) {
            Some(known) => {
                known.visible = known.visible.max(thing.visible);
                known.views.extend(thing.views);
            }
            None => drop(self.things.insert(number, thing)),
        }
    }

    fn end_sample(&mut self, next: &str, tables: &mut Tables) -> Result<()> {
        if self.sample.is_null() {
            return Ok(());
        }
        let sample_token = self.sample["token"].as_str().unwrap_or_default().to_owned();
        self.sample["next"] = json!(next);
        tables.sample.push(&self.sample)?;
        for (number, thing) in std::mem::take(&mut self.things) {
            let instance = token(&["instance", &self.name, &number.to_string()]);
            let own = token(&["sample_annotation", &sample_token, &number.to_string()]);
            let mut annotation = thing.pose.json(&own);
            annotation["sample_token"] = json!(sample_token);
            annotation["instance_token"] = json!(instance);
            annotation["visibility_token"] = json!(thing.level());
            annotation["attribute_tokens"] = json!([]);
            annotation["size"] = json!(thing.size);
            annotation["num_lidar_pts"] = json!(0);
            annotation["num_radar_pts"] = json!(0);
            annotation["prev"] = json!("");
            annotation["fogbank"] = Value::Object(thing.views);
            match self.courses.get_mut(&number) {
                Some(course) => {
                    annotation["prev"] = course.last["token"].clone();
                    course.last["next"] = json!(own);
                    tables.sample_annotation.push(&course.last)?;
                    course.last = annotation;
                    course.count += 1;
                }
                None => {
                    let category = thing.category;
                    let course = Course { category, token: instance, count: 1, first: own, last: annotation };
                    self.courses.insert(number, course);
                }
            }
        }
        Ok(())
    }

    /// Writes all that was kept back.
    pub(super) fn close(mut self, tables: &mut Tables) -> Result<()> {
        self.end_sample("", tables)?;
        for (_, mut course) in std::mem::take(&mut self.courses) {
            tables.instance.push(&json!({
                "token": course.token,
                "category_token": course.category,
                "nbr_annotations": course.count,
                "first_annotation_token": course.first,
                "last_annotation_token": course.last["token"],
            }))?;
            course.last["next"] = json!("");
            tables.sample_annotation.push(&course.last)?;
        }
        for (_, mut data) in std::mem::take(&mut self.data) {
            data["next"] = json!("");
            tables.sample_data.push(&data)?;
        }
        tables.scene.push(&json!({
            "token": self.token,
            "log_token": token(&["log"]),
            "name": self.name,
            "description": describe(&self.details),
            "nbr_samples": self.samples,
            "first_sample_token": self.first,
            "last_sample_token": self.sample["token"],
            "fogbank": { "axes": self.details["axes"], "fog": self.details["fog"], "lighting": self.details["lighting"] },
        }))
    }
}

/// The fog of a scene in words.
fn describe(details: &Value) -> String {
    let model = details["fog"]["model"].as_str().unwrap_or("none");
    let light = details["lighting"]["preset"].as_str().unwrap_or("own");
    match details["fog_at_camera"]["mor_m"].as_f64() {
        Some(mor) => format!("fog: {model}, visibility (MOR) {mor:.0} m at the camera; lighting: {light}"),
        None => format!("fog: {model}; lighting: {light}"),
    }
}
