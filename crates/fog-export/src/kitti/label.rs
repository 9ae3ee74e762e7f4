//! KITTI's labels: a line of 15 columns for each thing.

use fog_core::math::f64::{acos, atan2};
use serde_json::{Value, json};

use crate::Result;
use crate::camera::Box3;
use crate::classes::Classes;
use crate::frame::Frame;
use crate::summary::Losses;

/// A thing's line, and what it has no column for.
pub(super) struct Label {
    pub(super) line: String,
    pub(super) more: Value,
}

/// Share of hidden pixels up to which a thing counts as fully visible (0), and as partly occluded (1).
const OCCLUDED: [f64; 2] = [0.05, 0.5];
/// Angle between a thing's up and the camera's from which on it is counted as tilted, in degrees.
const TILT_DEG: f64 = 0.5;
/// What goes into the side file.
const MORE: [&str; 11] = [
    "instance",
    "name",
    "class",
    "detectable",
    "hidden_by",
    "certain",
    "visible_pixels",
    "occlusion",
    "distance_m",
    "transmittance",
    "box_3d",
];

/// KITTI's type of a class.
fn kind(class: &str) -> Option<&'static str> {
    Some(match class {
        "car" => "Car",
        "truck" => "Truck",
        "person" => "Pedestrian",
        "rider" => "Cyclist",
        "train" => "Tram",
        "bus" | "caravan" | "trailer" | "motorcycle" | "bicycle" => "Misc",
        _ => return None,
    })
}

/// Labels of the things of which a pixel is visible, and which KITTI has a type for.
pub(super) fn labels(
    frame: &Frame<'_>,
    objects: &[Value],
    classes: &Classes,
    losses: &Losses,
) -> Result<Vec<Label>> {
    let size = frame.size()?;
    let mut all = Vec::new();
    for object in objects.iter().filter(|object| classes.keeps(object)) {
        let Some(kind) = object["class"].as_str().and_then(kind) else {
            losses.add("things_without_a_type", 1, "things of classes that KITTI has no type for, left out");
            continue;
        };
        if object["visible_pixels"] == 0 {
            losses.add("unseen_things", 1, "things without a visible pixel, left out");
            continue;
        }
        let label = label(kind, object, size, losses);
        all.push(label.ok_or_else(|| frame.damaged("objects.json", "a thing has no boxes"))?);
    }
    Ok(all)
}

fn label(kind: &str, object: &Value, size: [u32; 2], losses: &Losses) -> Option<Label> {
    let occluded = match object["occlusion"].as_f64() {
        None => 3,
        Some(share) => OCCLUDED.iter().filter(|limit| share > **limit).count(),
    };
    let full = &object["box_2d"]["full"];
    // From the image's corner to the centre of its first pixel.
    let side = |i: usize| Some((full[i].as_f64()? - 0.5).clamp(0.0, f64::from(size[i % 2]) - 1.0));
    let box_2d = [side(0)?, side(1)?, side(2)?, side(3)?];
    let box_3d = Box3::of(object, "camera")?;
    let (bottom, forward) = (box_3d.bottom(), box_3d.forward());
    let up = box_3d.turn * fog_core::DVec3::Y;
    if acos((-up.y).clamp(-1.0, 1.0)).to_degrees() > TILT_DEG {
        losses.add(
            "tilted_boxes",
            1,
            "boxes that stand askew in their camera's axes, of which rotation_y tells only a part",
        );
    }
    let rotation_y = atan2(-forward.z, forward.x);
    let alpha = wrapped(rotation_y - atan2(bottom.x, bottom.z));
    let numbers = [
        box_2d[0],
        box_2d[1],
        box_2d[2],
        box_2d[3],
        box_3d.size.y,
        box_3d.size.x,
        box_3d.size.z,
        bottom.x,
        bottom.y,
        bottom.z,
        rotation_y,
    ];
    let numbers = numbers.map(|v| format!("{:.4}", (v * 1e4).round() / 1e4 + 0.0)).join(" ");
    let truncated = object["truncation"].as_f64().unwrap_or_default();
    let mut more = json!({});
    for key in MORE {
        more[key] = object[key].clone();
    }
    let line = format!("{kind} {truncated:.4} {occluded} {alpha:.4} {numbers}");
    Some(Label { line, more })
}

/// An angle between −π and π.
fn wrapped(angle: f64) -> f64 {
    use std::f64::consts::{PI, TAU};
    (angle + PI).rem_euclid(TAU) - PI
}

#[cfg(test)]
mod tests {
    use fog_core::{DQuat, DVec3};

    use super::*;

    fn thing(turn: DQuat, centre: DVec3) -> Value {
        json!({
            "class": "car", "truncation": 0.25, "occlusion": 0.6, "visible_pixels": 9,
            "box_2d": {"full": [-4.0, 2.5, 30.5, 400.0]},
            "box_3d": {"size_m": [1.8, 1.5, 4.2], "camera": {
                "centre_m": centre.to_array(), "quaternion_wxyz": [turn.w, turn.x, turn.y, turn.z]}}
        })
    }

    #[test]
    fn a_car_ahead_has_kittis_numbers() {
        // A half turn about x takes a thing's axes (y up, looking along -z) into the camera's (y down, z forward): it drives away.
        let away = DQuat::from_rotation_x(std::f64::consts::PI);
        let losses = Losses::default();
        let line = |turn: DQuat, centre: DVec3| {
            label("Car", &thing(turn, centre), [100, 50], &losses).expect("a label").line
        };
        // KITTI's own cars ahead, driving away, have a rotation_y of a quarter turn to the left.
        assert_eq!(
            line(away, DVec3::new(0.0, 0.9, 20.0)),
            "Car 0.2500 2 -1.5708 0.0000 2.0000 30.0000 49.0000 1.5000 1.8000 4.2000 0.0000 1.6500 20.0000 -1.5708"
        );
        // Turned to the right, and seen 45 degrees to the right.
        let right = DQuat::from_rotation_y(std::f64::consts::FRAC_PI_2) * away;
        let found = line(right, DVec3::new(20.0, 0.9, 20.0));
        assert!(
            found.starts_with("Car 0.2500 2 -0.7854 ") && found.ends_with(" 20.0000 1.6500 20.0000 0.0000"),
            "{found}"
        );
        assert!(losses.list().is_empty());
        line(DQuat::from_rotation_x(0.05) * away, DVec3::new(0.0, 0.9, 20.0));
        assert_eq!(losses.list()[0].name, "tilted_boxes");
    }
}
