//! Which frames are of one moment, and which of one way: the plan has the poses of a path in order, and of each pose all cameras
//! of the rig.

use fog_dataset::{PlanFrame, Reader};
use serde_json::Value;

use crate::Result;

/// Name of the rig's camera in the axes of a frame.
const CAMERA: &str = "rig.camera";
/// Number of the pose in the axes of a frame.
const POSE: &str = "path.index";

/// Follows the plan.
#[derive(Debug, Default)]
pub(crate) struct Track {
    /// Axes of the last frame without pose and camera.
    key: Option<String>,
    index: Option<u64>,
    /// Cameras met at this pose.
    cameras: Vec<String>,
    place: Place,
}

/// Where a frame is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Place {
    /// Of all sequences, from 0. A frame without a path is one of its own.
    pub(crate) sequence: u64,
    /// Of all poses, from 0; cameras of one moment share it.
    pub(crate) pose: u64,
    /// Of the poses of the sequence, from 0.
    pub(crate) step: u64,
    pub(crate) begins_sequence: bool,
    pub(crate) begins_pose: bool,
}

impl Track {
    /// The place of the next frame.
    pub(crate) fn next(&mut self, plan: &PlanFrame) -> Place {
        let rest = plan.axes.iter().filter(|(name, _)| !matches!(name.as_str(), CAMERA | POSE));
        let key = Value::Object(rest.map(|(k, v)| (k.clone(), v.clone())).collect()).to_string();
        let index = plan.axes.get(POSE).and_then(Value::as_u64);
        let camera = camera(plan).unwrap_or_default().to_owned();
        let first = self.key.is_none();
        let same_way = self.key.as_ref() == Some(&key);
        let same_pose = same_way && index == self.index && !self.cameras.contains(&camera);
        let goes_on = same_way && index.is_some() && index > self.index;
        if same_pose {
            self.place.begins_pose = false;
            self.place.begins_sequence = false;
        } else {
            self.cameras.clear();
            let sequence = self.place.sequence + u64::from(!goes_on && !first);
            let step = if goes_on { self.place.step + 1 } else { 0 };
            let pose = self.place.pose + u64::from(!first);
            self.place = Place { sequence, pose, step, begins_sequence: !goes_on, begins_pose: true };
        }
        self.cameras.push(camera);
        (self.key, self.index) = (Some(key), index);
        self.place
    }
}

/// The rig's camera that a frame is of.
pub(crate) fn camera(plan: &PlanFrame) -> Option<&str> {
    plan.axes.get(CAMERA).and_then(Value::as_str)
}

/// Whether a frame is one of a path.
pub(crate) fn is_of_path(plan: &PlanFrame) -> bool {
    plan.axes.contains_key(POSE)
}

/// The cameras of a data set's first rig.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Rig {
    /// Names in order; empty without a rig.
    pub(crate) cameras: Vec<String>,
    /// The two of them, if they are all and look the same way, beside each other and with equal sensors: left, right and their
    /// distance in m.
    pub(crate) stereo: Option<(String, String, f64)>,
}

impl Rig {
    /// Reads as much of the plan as the first pose has frames.
    pub(crate) fn of(reader: &Reader) -> Result<Self> {
        let (mut track, mut first) = (Track::default(), Vec::new());
        for frame in reader.frames()? {
            let frame = frame?;
            if track.next(&frame).pose > 0 {
                break;
            }
            first.push(frame);
        }
        let cameras = first.iter().filter_map(camera).map(str::to_owned).collect();
        let stereo = match &first[..] {
            [a, b] => stereo(a, b).or_else(|| stereo(b, a)),
            _ => None,
        };
        Ok(Self { cameras, stereo })
    }

    /// Distance of the two cameras of a stereo pair, m; 0 where there is none.
    pub(crate) fn baseline_m(&self) -> f64 {
        self.stereo.as_ref().map_or(0.0, |(_, _, baseline_m)| *baseline_m)
    }

    /// Whether a frame is of the right camera of a stereo pair.
    pub(crate) fn is_right(&self, plan: &PlanFrame) -> bool {
        self.stereo.as_ref().is_some_and(|(_, right, _)| camera(plan) == Some(right))
    }
}

fn stereo(left: &PlanFrame, right: &PlanFrame) -> Option<(String, String, f64)> {
    let mount = |frame: &PlanFrame| frame.spec["rig"]["mount"].clone();
    let (a, b) = (mount(left), mount(right));
    let same = |key: &str| a[key] == b[key];
    let position = |m: &Value, c: usize| m["position_m"][c].as_f64();
    // The offset is along the rig's x axis: it is along the cameras' if they are not turned in the rig.
    let straight = ["heading_deg", "pitch_deg", "roll_deg"].iter().all(|key| same(key) && a[*key] == 0.0);
    let level = (1..3).all(|c| position(&a, c) == position(&b, c));
    let baseline = position(&b, 0)? - position(&a, 0)?;
    let matched = straight && level && left.spec["sensor"] == right.spec["sensor"] && baseline > 0.0;
    matched.then_some((camera(left)?.to_owned(), camera(right)?.to_owned(), baseline))
}

#[cfg(test)]
mod tests {
    use fog_dataset::OutputSet;
    use serde_json::json;

    use super::*;

    fn frame(axes: Value, x: f64) -> PlanFrame {
        PlanFrame {
            id: "f".to_owned(),
            pair_id: None,
            axes: axes.as_object().cloned().unwrap_or_default(),
            outputs: OutputSet::default(),
            spec: json!({"rig": {"mount": {"position_m": [x, 0.0, 0.0], "heading_deg": 0.0, "pitch_deg": 0.0,
                "roll_deg": 0.0}}, "sensor": {"width_px": 8}}),
        }
    }

    #[test]
    fn poses_and_sequences_are_counted() {
        let mut track = Track::default();
        let mut at = |axes: Value| {
            let p = track.next(&frame(axes, 0.0));
            (p.sequence, p.pose, p.step)
        };
        let both =
            |fog: u64, pose: u64, name: &str| json!({"fog": fog, "path.index": pose, "rig.camera": name});
        assert_eq!(at(both(1, 0, "l")), (0, 0, 0));
        assert_eq!(at(both(1, 0, "r")), (0, 0, 0));
        assert_eq!(at(both(1, 1, "l")), (0, 1, 1));
        // One that failed was left out.
        assert_eq!(at(both(1, 3, "r")), (0, 2, 2));
        assert_eq!(at(both(2, 0, "l")), (1, 3, 0));
        assert_eq!(at(both(2, 0, "l")), (2, 4, 0));
        assert_eq!(at(json!({"fog": 2})), (3, 5, 0));
        assert_eq!(at(json!({"fog": 2})), (4, 6, 0));
    }

    #[test]
    fn stereo_is_two_equal_cameras_beside_each_other() {
        let [a, b] = [("l", -0.1), ("r", 0.4)].map(|(name, x)| frame(json!({"rig.camera": name}), x));
        let (left, right, baseline) = stereo(&a, &b).expect("a stereo rig");
        assert_eq!((left.as_str(), right.as_str(), baseline), ("l", "r", 0.5));
        assert!(stereo(&b, &a).is_none());
        let mut turned = b;
        turned.spec["rig"]["mount"]["heading_deg"] = json!(1.0);
        assert!(stereo(&a, &turned).is_none());
    }
}
