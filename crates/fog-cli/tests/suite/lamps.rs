//! Lights of a scene file.

use crate::common::{config, ids, json, read_json, sweep, write};
use fogbank::dataset::read_picture;

/// A spot light 6 m over the ground that shines down, 20 m before the camera, and nothing else.
const LAMP: &str = r#"{"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
  "extensionsUsed": ["KHR_lights_punctual"],
  "extensions": {"KHR_lights_punctual": {"lights": [{"type": "spot", "intensity": 1000,
    "spot": {"innerConeAngle": 0.2, "outerConeAngle": 0.5}}]}},
  "nodes": [{"translation": [0, 6, -20], "rotation": [-0.7071068, 0, 0, 0.7071068],
    "extensions": {"KHR_lights_punctual": {"light": 0}}}]}"#;

#[test]
fn a_cone_of_light_in_fog() {
    let dir = tempfile::tempdir().expect("temporary folder");
    write(dir.path(), "lamp.gltf", LAMP);
    let lines = "scene: {file: lamp.gltf}\n\
                 fog: {model: homogeneous, height_m: 50, sigma_t_1_m: 0.02, phase: {hg: 0.8}}\n\
                 camera: {altitude_m: 2}\noutputs: [image, hdr]\n\
                 sweep: {axes: {lighting: [night, {luminance_of_one_cd_m2: 10}, day]}}\n";
    write(dir.path(), "c.yaml", config(lines).replace("samples: 3", "samples: 64"));
    let out = sweep(dir.path(), "out");
    assert_eq!(out.code, Some(0), "{}", out.stderr);
    let ids = ids(dir.path());
    let picture =
        |k: usize| read_picture(&dir.path().join(format!("out/{}.hdr.exr", ids[k]))).expect("a picture").rgb;
    let record = |k: usize| read_json(&dir.path().join(format!("out/{}.json", ids[k])));

    let night = picture(0);
    // Four columns of the 24 × 14 pixels below the lamp, and the four leftmost, which see what was scattered twice.
    let columns = |from: usize| {
        (0..14).flat_map(|y| &night[y * 24 + from..y * 24 + from + 4]).map(|p| f64::from(p[1])).sum::<f64>()
    };
    let (cone, beside) = (columns(10), columns(0));
    assert!(cone > 5.0 * beside && beside > 0.0, "{cone} in the cone, {beside} beside it");
    let lights = &record(0)["lighting"]["scene_lights"];
    assert_eq!(lights["points_and_spots"], 1);
    assert_eq!(lights["directional"], 0);
    assert_eq!(lights["luminance_of_one_cd_m2"], 1.0);
    assert!(record(0)["lighting"].get("luminance_of_one_cd_m2").is_none());

    let sum = |picture: &[[f32; 3]]| picture.iter().map(|p| f64::from(p[1])).sum::<f64>();
    let ratio = sum(&night) / sum(&picture(1));
    // The light of both is known to some 15 %.
    assert!((5.0..20.0).contains(&ratio), "{ratio}");
    assert_eq!(record(1)["lighting"]["luminance_of_one_cd_m2"], json("10.0"));
    assert!(record(2)["lighting"].get("scene_lights").is_none(), "off by day");
}
