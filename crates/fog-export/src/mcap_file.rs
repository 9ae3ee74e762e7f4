//! MCAP (mcap.dev) with Foxglove's messages in Protocol Buffers: a file per path, and one of frames without a path after another.
//!
//! Topics of a camera: `/NAME/image`, `/NAME/depth` (metres), `/NAME/calibration`, `/NAME/objects` (boxes in the world) and
//! `/NAME/record` (JSON); `/tf` has the cameras' poses. Times are those of the path; frames without one are a second apart.

mod messages;
mod proto;
mod schema;

use std::collections::BTreeMap;
use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use fog_dataset::FileKind;
use mcap::records::MessageHeader;
use mcap::{McapError, WriteOptions};

use crate::camera::Camera;
use crate::frame::Frame;
use crate::job::{Job, Writer};
use crate::track::{self, Track};
use crate::{Error, Result};

/// The outputs that frames must have.
pub(crate) const NEEDS: &[&str] = &["image"];

/// The camera of frames without a rig.
const ONLY_CAMERA: &str = "camera";
const RECORD_SCHEMA: &[u8] = br#"{"title":"fogbank.Record","type":"object"}"#;

/// The writer; one file is open at a time.
pub(crate) struct Mcap<'a> {
    job: &'a Job<'a>,
    track: Track,
    descriptors: Vec<u8>,
    files: u64,
    open: Option<Recording>,
}

struct Recording {
    writer: mcap::Writer<BufWriter<File>>,
    path: PathBuf,
    of_path: bool,
    /// Frames without a path so far.
    still: u64,
    /// Numbers of the messages of each channel.
    sequences: BTreeMap<u16, u32>,
}

impl<'a> Mcap<'a> {
    pub(crate) fn begin(job: &'a Job<'a>) -> Self {
        Self { job, track: Track::default(), descriptors: proto::descriptors(), files: 0, open: None }
    }

    fn create(&mut self, of_path: bool) -> Result<Recording> {
        let path = self.job.folder.path(&format!("{}-{:06}.mcap", self.job.file_stem(), self.files))?;
        self.files += 1;
        let file = BufWriter::new(File::create(&path).map_err(Error::io("create", &path))?);
        let options = WriteOptions::new().compression(None).library("Fogbank");
        let mut writer = options.create(file).map_err(|e| failed(e, &path))?;
        let header = self.job.reader.header();
        let about =
            [("name", &header.name), ("config", &header.config_digest), ("code", &header.code_digest)];
        let metadata = about.map(|(key, value)| (key.to_owned(), value.clone())).into();
        let metadata = mcap::records::Metadata { name: "fogbank".to_owned(), metadata };
        writer.write_metadata(&metadata).map_err(|e| failed(e, &path))?;
        Ok(Recording { writer, path, of_path, still: 0, sequences: BTreeMap::new() })
    }

    fn close(&mut self) -> Result<()> {
        if let Some(mut recording) = self.open.take() {
            recording.writer.finish().map_err(|e| failed(e, &recording.path))?;
            recording.writer.into_inner().flush().map_err(Error::io("write", &recording.path))?;
        }
        Ok(())
    }
}

impl Recording {
    /// Adds a message of one of Foxglove's schemas.
    fn send(&mut self, descriptors: &[u8], topic: &str, schema: &str, time: u64, data: &[u8]) -> Result<()> {
        let name = format!("foxglove.{schema}");
        self.write((topic, "protobuf"), (&name, "protobuf", descriptors), time, data)
    }

    fn write(
        &mut self,
        (topic, encoding): (&str, &str),
        (name, kind, schema): (&str, &str, &[u8]),
        time: u64,
        data: &[u8],
    ) -> Result<()> {
        let fail = |e: McapError| failed(e, &self.path);
        let schema = self.writer.add_schema(name, kind, schema).map_err(fail)?;
        let channel = self.writer.add_channel(schema, topic, encoding, &BTreeMap::new()).map_err(fail)?;
        let sequence = self.sequences.entry(channel).or_insert(0);
        let header =
            MessageHeader { channel_id: channel, sequence: *sequence, log_time: time, publish_time: time };
        *sequence += 1;
        self.writer.write_to_known_channel(&header, data).map_err(fail)
    }
}

impl Writer for Mcap<'_> {
    fn frame(&mut self, frame: &Frame<'_>) -> Result<()> {
        let place = self.track.next(frame.plan);
        let of_path = track::is_of_path(frame.plan);
        let fits = |open: &Recording| open.of_path == of_path && !(of_path && place.begins_sequence);
        if !self.open.as_ref().is_some_and(fits) {
            self.close()?;
            self.open = Some(self.create(of_path)?);
        }
        let Some(open) = &mut self.open else { return Ok(()) };
        let record = frame.record()?;
        let seconds = if of_path {
            record["path"]["time_s"].as_f64().unwrap_or(place.step as f64)
        } else {
            open.still += u64::from(place.begins_pose);
            open.still.saturating_sub(1) as f64
        };
        let time = (seconds.max(0.0) * 1e9).round() as u64;
        let name = track::camera(frame.plan).unwrap_or(ONLY_CAMERA);
        let (size, camera) = (frame.size()?, Camera::of(frame)?);
        let topic = |what: &str| format!("/{name}/{what}");
        let descriptors = &self.descriptors;
        let mut send =
            |topic: &str, schema: &str, data: &[u8]| open.send(descriptors, topic, schema, time, data);
        send("/tf", "FrameTransform", &messages::transform(time, name, &camera))?;
        let distortion = &record["sensor"]["intrinsics"]["distortion"];
        match messages::calibration(time, name, size, (&camera, distortion)) {
            Some(message) => send(&topic("calibration"), "CameraCalibration", &message)?,
            None => self.job.losses.add("panoramas", 1, "frames of a panorama, which has no calibration"),
        }
        let read = |kind| {
            let path = frame.path(kind);
            fs::read(&path).map_err(Error::io("read", &path))
        };
        let png = read(FileKind::Image)?;
        send(&topic("image"), "CompressedImage", &messages::image(time, name, &png))?;
        if frame.outputs().depth {
            let depth = frame.channel(FileKind::Truth, "depth.Z")?;
            send(&topic("depth"), "RawImage", &messages::depth(time, name, size, &depth.values))?;
        }
        if frame.outputs().objects {
            send(&topic("objects"), "SceneUpdate", &messages::boxes(time, &frame.objects()?))?;
        }
        let schema = ("fogbank.Record", "jsonschema", RECORD_SCHEMA);
        open.write((&topic("record"), "json"), schema, time, &read(FileKind::Record)?)
    }

    fn finish(&mut self) -> Result<()> {
        self.close()
    }
}

fn failed(e: McapError, path: &Path) -> Error {
    Error::io("write", path)(io::Error::other(e))
}
