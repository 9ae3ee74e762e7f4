//! LARD (Ducoffe et al. 2023, arXiv 2304.09938; github.com/deel-ai/LARD): `images/` and one CSV file, in the columns of the first
//! edition (`src/labeling/labels.py` of 2023) or the second (of 2025).
//!
//! Image points count from the corner of the image, as LARD's do before it drops their fractions; distances are nautical miles,
//! heights feet, angles degrees.

mod geometry;

use fog_dataset::FileKind;
use serde_json::Value;

use crate::folder::Sink;
use crate::frame::Frame;
use crate::job::{Job, Writer};
use crate::track::{Place, Track};
use crate::{Error, Result};
use geometry::{Runway, Seen};

/// The outputs that frames must have.
pub(crate) const NEEDS: &[&str] = &["image", "objects"];

/// Which edition's columns and definitions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Edition {
    V1,
    V2,
}

/// Columns of the first edition before the corners.
const V1: [&str; 21] = [
    "image",
    "height",
    "width",
    "type",
    "original_dataset",
    "scenario",
    "airport",
    "runway",
    "time_to_landing",
    "weather",
    "night",
    "time",
    "slant_distance",
    "along_track_distance",
    "height_above_runway",
    "lateral_path_angle",
    "vertical_path_angle",
    "yaw",
    "pitch",
    "roll",
    "watermark_height",
];
/// Columns of the second.
const V2: [&str; 26] = [
    "uuid",
    "image",
    "height",
    "width",
    "type",
    "original_dataset",
    "scenario",
    "airport",
    "runway",
    "time_to_landing",
    "weather",
    "night",
    "time",
    "lat_cam",
    "lon_cam",
    "alt_cam",
    "yaw",
    "pitch",
    "roll",
    "slant_distance",
    "along_track_distance",
    "height_above_runway",
    "lateral_path_angle",
    "vertical_path_angle",
    "watermark_height",
    "runway_in_cone",
];
/// Ours, after the corners.
const OWN: [&str; 4] =
    ["fogbank_frame", "fogbank_mor_m", "fogbank_runway_detectable", "fogbank_runway_transmittance"];

impl Edition {
    /// Names of the corners in the columns: of the first edition as one meets them reading the image, of the second by their place
    /// on the runway.
    fn corners(self) -> [&'static str; 4] {
        match self {
            Self::V1 => ["A", "B", "C", "D"],
            Self::V2 => ["TR", "TL", "BL", "BR"],
        }
    }

    fn columns(self) -> Vec<String> {
        let columns: &[&str] = match self {
            Self::V1 => &V1,
            Self::V2 => &V2,
        };
        let corners = self.corners().into_iter().flat_map(|name| ["x", "y"].map(|c| format!("{c}_{name}")));
        let own = OWN.iter().map(ToString::to_string);
        columns.iter().map(ToString::to_string).chain(corners).chain(own).collect()
    }
}

/// The writer.
pub(crate) struct Lard<'a> {
    job: &'a Job<'a>,
    edition: Edition,
    columns: Vec<String>,
    csv: Sink,
    track: Track,
    rows: u64,
}

impl<'a> Lard<'a> {
    pub(crate) fn begin(job: &'a Job<'a>, edition: Edition) -> Result<Self> {
        let columns = edition.columns();
        // LARD's own loader looks for a file with the folder's name.
        let mut csv = job.folder.create(&format!("{}.csv", job.folder.name()))?;
        csv.write(columns.join(";") + "\n")?;
        Ok(Self { job, edition, columns, csv, track: Track::default(), rows: 0 })
    }

    /// Writes the line of a runway that is seen.
    fn row(&mut self, frame: &Frame<'_>, place: Place, object: &Value, seen: &Seen) -> Result<()> {
        let record = frame.record()?;
        let [width, height] = frame.size()?;
        let corners = seen.corners(self.edition, f64::from(width));
        let measures = seen.measures(self.edition);
        let camera = |key: &str| record["camera"][key].as_f64().unwrap_or_default();
        let cell = |column: &str| -> String {
            match column {
                "uuid" | "fogbank_frame" => frame.id().to_owned(),
                "image" => format!("images/{}.png", frame.id()),
                "height" => height.to_string(),
                "width" => width.to_string(),
                "type" => "fogbank".to_owned(),
                "original_dataset" => text(&self.job.reader.header().name),
                "scenario" => text(&format!("{}_{}", self.job.reader.header().name, place.sequence)),
                "runway" => seen.runway.number(),
                "weather" => if record["fog"].is_object() { "fog" } else { "" }.to_owned(),
                "night" => night(&record["lighting"]["preset"]),
                "alt_cam" => number(seen.eye.y),
                "yaw" => number((camera("heading_deg") + 180.0).rem_euclid(360.0) - 180.0),
                "pitch" => number(90.0 + camera("pitch_deg")),
                "roll" => number(camera("roll_deg")),
                "slant_distance" => number(measures.slant_nm),
                "along_track_distance" => number(measures.along_track_nm),
                "height_above_runway" => number(measures.height_ft),
                "lateral_path_angle" => number(measures.lateral_deg),
                "vertical_path_angle" => number(measures.vertical_deg),
                "runway_in_cone" => "UNKNOWN".to_owned(),
                "fogbank_mor_m" => value(&record["fog_state"]["at_camera"]["mor_m"]),
                "fogbank_runway_detectable" => value(&object["detectable"]),
                "fogbank_runway_transmittance" => {
                    let bands = &object["transmittance"];
                    value(if bands[1].is_null() { &bands[0] } else { &bands[1] })
                }
                // Corners are named x_A, y_A and so on; everything else is unknown, and empty as in LARD.
                other => corners.get(other).map_or_else(String::new, |v| number(*v)),
            }
        };
        let line: Vec<String> = self.columns.iter().map(|column| cell(column)).collect();
        self.csv.write(line.join(";") + "\n")?;
        self.rows += 1;
        Ok(())
    }
}

impl Writer for Lard<'_> {
    fn frame(&mut self, frame: &Frame<'_>) -> Result<()> {
        let place = self.track.next(frame.plan);
        let eye = crate::camera::Camera::of(frame)?.position();
        let size = frame.size()?;
        let mut rows = 0;
        for object in frame.objects()? {
            let Some(runway) = Runway::of(&object) else { continue };
            let Some(seen) = Seen::of(runway, &object, eye) else {
                self.job.losses.add("runways_behind", 1, "runways with a corner behind the camera, left out");
                continue;
            };
            if self.edition == Edition::V1 && !seen.is_whole(size) {
                let what = "runways that are not whole in the image, left out as in LARD's first edition";
                self.job.losses.add("runways_not_whole", 1, what);
                continue;
            }
            self.row(frame, place, &object, &seen)?;
            rows += 1;
        }
        if rows == 0 {
            let what = "frames without a runway to be labelled, left out with their pictures";
            self.job.losses.add("frames_without_runway", 1, what);
            return Ok(());
        }
        self.job.folder.copy(&frame.path(FileKind::Image), &format!("images/{}.png", frame.id()))
    }

    fn finish(&mut self) -> Result<()> {
        if self.rows == 0 {
            let reason = "no frame shows a runway with the keypoints threshold_left, threshold_right, end_left and end_right \
                          (scenes of `generate: runway` have them)";
            return Err(Error::Option(format!("nothing to export as {}: {reason}", self.job.format)));
        }
        self.csv.close()
    }
}

/// Whether a preset of light is one of night, as pandas writes it; empty where there is none.
fn night(preset: &Value) -> String {
    preset
        .as_str()
        .map_or_else(String::new, |name| if name.starts_with("night") { "True" } else { "False" }.to_owned())
}

/// Six decimals, as LARD's second edition writes.
fn number(value: f64) -> String {
    format!("{:.6}", (value * 1e6).round() / 1e6 + 0.0)
}

fn value(value: &Value) -> String {
    match value {
        Value::Null => String::new(),
        Value::Bool(true) => "True".to_owned(),
        Value::Bool(false) => "False".to_owned(),
        other => other.to_string(),
    }
}

/// A text without what separates cells and lines.
fn text(text: &str) -> String {
    text.replace([';', '"', '\n', '\r'], "_")
}
