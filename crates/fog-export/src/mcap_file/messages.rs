//! A frame as messages of Foxglove's.

use fog_core::{DQuat, DVec3};
use serde_json::Value;

use super::proto::Message;
use crate::camera::{Box3, Camera, Lens};

/// Name of the world's axes.
const WORLD: &str = "world";

/// Moment of a message, nanoseconds.
pub(super) fn timestamp(nanoseconds: u64) -> Message {
    let (seconds, rest) = (nanoseconds / 1_000_000_000, nanoseconds % 1_000_000_000);
    Message::default().number(1, seconds).number(2, rest)
}

/// `foxglove.CompressedImage`.
pub(super) fn image(time: u64, camera: &str, png: &[u8]) -> Vec<u8> {
    let message = Message::default().message(1, &timestamp(time)).bytes(2, png);
    message.text(3, "png").text(4, camera).finish()
}

/// `foxglove.RawImage` of metres.
pub(super) fn depth(time: u64, camera: &str, [width, height]: [u32; 2], metres: &[f32]) -> Vec<u8> {
    let bytes: Vec<u8> = metres.iter().flat_map(|v| v.to_le_bytes()).collect();
    let message = Message::default().message(1, &timestamp(time)).fixed(2, width).fixed(3, height);
    message.text(4, "32FC1").fixed(5, 4 * width).bytes(6, &bytes).text(7, camera).finish()
}

/// `foxglove.CameraCalibration`; `None` of a panorama, which has none.
pub(super) fn calibration(
    time: u64,
    name: &str,
    [width, height]: [u32; 2],
    (camera, distortion): (&Camera, &Value),
) -> Option<Vec<u8>> {
    let numbers = distortion["coefficients"].as_array().map_or(&[][..], Vec::as_slice);
    let numbers: Vec<f64> = numbers.iter().filter_map(Value::as_f64).collect();
    // ROS's names of OpenCV's models.
    let (model, coefficients) = match camera.lens {
        Lens::Pinhole => ("plumb_bob", vec![0.0; 5]),
        Lens::Distorted => ("rational_polynomial", numbers),
        Lens::Other(_) if camera.intrinsics[0] > 0.0 => ("equidistant", numbers),
        Lens::Other(_) => return None,
    };
    let [fx, fy, cx, cy] = camera.intrinsics;
    let message = Message::default().message(1, &timestamp(time)).fixed(2, width).fixed(3, height);
    let message = message.text(4, model).doubles(5, &coefficients);
    let message = message.doubles(6, &[fx, 0.0, cx, 0.0, fy, cy, 0.0, 0.0, 1.0]);
    let message = message.doubles(7, &[1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]);
    let message = message.doubles(8, &[fx, 0.0, cx, 0.0, 0.0, fy, cy, 0.0, 0.0, 0.0, 1.0, 0.0]);
    Some(message.text(9, name).finish())
}

/// `foxglove.FrameTransform`: where the camera stands in the world.
pub(super) fn transform(time: u64, name: &str, camera: &Camera) -> Vec<u8> {
    let (_, turn, place) = camera.world_from_camera.to_scale_rotation_translation();
    let message = Message::default().message(1, &timestamp(time)).text(2, WORLD).text(3, name);
    message.message(4, &vector(place)).message(5, &quaternion(turn)).finish()
}

/// `foxglove.SceneUpdate`: the boxes of the things in place of all earlier ones; green where detectable, else red.
pub(super) fn boxes(time: u64, objects: &[Value]) -> Vec<u8> {
    let all_earlier = Message::default().message(1, &timestamp(time)).number(2, 1);
    let mut update = Message::default().message(1, &all_earlier);
    for object in objects {
        let Some(place) = Box3::of(object, WORLD) else { continue };
        let pose = Message::default().message(1, &vector(place.centre)).message(2, &quaternion(place.turn));
        let (red, green) = if object["detectable"] == true { (0.1, 0.8) } else { (0.9, 0.1) };
        let colour = Message::default().double(1, red).double(2, green).double(3, 0.1).double(4, 0.4);
        let cube = Message::default().message(1, &pose).message(2, &vector(place.size)).message(3, &colour);
        let mut entity = Message::default().message(1, &timestamp(time)).text(2, WORLD);
        entity = entity.text(3, &object["instance"].to_string());
        for key in ["name", "class", "detectable", "hidden_by", "visible_pixels", "occlusion", "truncation"] {
            let value = object[key].as_str().map_or_else(|| object[key].to_string(), str::to_owned);
            entity = entity.message(6, &Message::default().text(1, key).text(2, &value));
        }
        update = update.message(2, &entity.message(8, &cube));
    }
    update.finish()
}

fn vector(v: DVec3) -> Message {
    Message::default().double(1, v.x).double(2, v.y).double(3, v.z)
}

fn quaternion(q: DQuat) -> Message {
    Message::default().double(1, q.x).double(2, q.y).double(3, q.z).double(4, q.w)
}
