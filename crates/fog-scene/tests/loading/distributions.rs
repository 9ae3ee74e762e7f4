//! Measured distributions of lights, out of files and out of `extras`.

use super::common::{TRIANGLE, document, glb, refusal};
use fog_scene::lamp::Lamp;
use fog_scene::{Limits, SceneError, load};
use glam::Vec3A;
use serde_json::{Value, json};

/// 500 cd along the axis, 100 cd across it towards +X and nothing elsewhere; 0.8 of it where the axis is level.
const FILE: &str = "IESNA:LM-63-2002\n[TEST] none\nTILT=INCLUDE\n1\n2\n0 90\n1 0.8\n\
    1 -1 1 2 4 1 2 0 0 0\n1 1 50\n0 90\n0 90 180 270\n500 100\n500 0\n500 0\n500 0\n";

fn with_light(light: Value, node: Value) -> (Value, Vec<u8>) {
    let (mut root, bin) = document(&TRIANGLE, 4);
    root["extensions"] = json!({"KHR_lights_punctual": {"lights": [light]}});
    root["extensionsUsed"] = json!(["KHR_lights_punctual"]);
    let mut all = json!({"name": "lantern", "extensions": {"KHR_lights_punctual": {"light": 0}}});
    for (key, value) in node.as_object().unwrap() {
        all[key.as_str()] = value.clone();
    }
    root["nodes"] = json!([{"mesh": 0}, all]);
    root["scenes"] = json!([{"nodes": [0, 1]}]);
    (root, bin)
}

/// The lamp of a scene beside whose file the files of these names and contents lie.
fn load_beside(root: &Value, bin: &[u8], files: &[(&str, &str)]) -> Result<Lamp, SceneError> {
    let folder = tempfile::tempdir().unwrap();
    for (name, content) in files {
        std::fs::write(folder.path().join(name), content).unwrap();
    }
    let path = folder.path().join("scene.glb");
    std::fs::write(&path, glb(root, bin)).unwrap();
    load(&path, &Limits::default()).map(|scene| scene.lights.lamps[0].clone())
}

/// Candela of green towards a direction.
fn candela(lamp: &Lamp, away: Vec3A) -> f32 {
    lamp.intensity[1] * lamp.falloff(away)
}

#[test]
fn a_file_gives_the_intensities() {
    let half = 0.5f32.sqrt();
    let light = json!({"type": "point", "intensity": 3, "extras": {"ies": "sub.ies", "radius_m": 0.25}});
    // The node's file counts before the light's. A quarter turn about +X takes −Z to −Y.
    for (node, file) in [
        (json!({"rotation": [-half, 0, 0, half]}), "sub.ies"),
        (json!({"rotation": [-half, 0, 0, half], "extras": {"ies": "own%20file.ies"}}), "own file.ies"),
    ] {
        let (root, bin) = with_light(light.clone(), node);
        let lamp = load_beside(&root, &bin, &[(file, FILE)]).unwrap();
        assert_eq!(lamp.radius_m, 0.25);
        // Straight down: no tilt.
        assert!((candela(&lamp, Vec3A::NEG_Y) - 500.0).abs() < 0.1);
        assert!((candela(&lamp, Vec3A::X) - 100.0).abs() < 0.1);
        assert!(candela(&lamp, Vec3A::NEG_X) < 0.1 && candela(&lamp, Vec3A::Y) == 0.0);
    }
    // Level: a tilt of 90°. The colour gives the hue, and its luminance is that of the file.
    let mut red = light;
    red["color"] = json!([1.0, 0.0, 0.0]);
    let (root, bin) = with_light(red, json!({}));
    let lamp = load_beside(&root, &bin, &[("sub.ies", FILE)]).unwrap();
    let luminance = 0.2126 * lamp.intensity[0] * lamp.falloff(Vec3A::NEG_Z);
    assert!((luminance - 400.0).abs() < 0.2, "{luminance}");
    assert_eq!(lamp.intensity[1..], [0.0, 0.0]);
}

#[test]
fn a_table_gives_the_intensities() {
    let table = json!({"pole": "down", "vertical_deg": [85, 90, 95], "horizontal_deg": [0, 10, 180],
                       "candela": [1, 5, 3, 0, 0, 0, 0, 0, 0]});
    let light = json!({"type": "spot", "intensity": 5, "spot": {}, "extras": {"photometry": table}});
    let (root, bin) = with_light(light, json!({}));
    let lamp = load_beside(&root, &bin, &[]).unwrap();
    let (s, c) = (0.087_155_74, 0.996_194_7);
    for (away, want) in [
        (Vec3A::NEG_Z, 5.0),
        (Vec3A::new(0.0, s, -c), 3.0),
        (Vec3A::new(0.0, -s, -c), 1.0),
        (Vec3A::new(s, 0.0, -c), 2.5),
        (Vec3A::new(-s, 0.0, -c), 2.5),
        (Vec3A::Z, 0.0),
    ] {
        assert!((candela(&lamp, away) - want).abs() < 1e-3, "{away}: {}", candela(&lamp, away));
    }
    assert!(lamp.axis().unwrap().dot(Vec3A::NEG_Z) > 0.99);
}

#[test]
fn bad_distributions_are_refused() {
    let of = |extras: Value| {
        let light = json!({"type": "point", "name": "lamp", "extras": extras});
        let (root, bin) = with_light(light, json!({}));
        refusal(&root, &bin)
    };
    let table = |vertical: Value, horizontal: Value, candela: Value| json!({"photometry": {"vertical_deg": vertical, "horizontal_deg": horizontal, "candela": candela}});
    for (message, part) in [
        (of(json!({"ies": 7})), "light `lamp`: extras.ies is 7"),
        (of(json!({"ies": "../x.ies"})), "URI \"../x.ies\" leaves the scene's folder"),
        (of(json!({"ies": "/etc/passwd"})), "is an absolute path"),
        (of(json!({"ies": "none.ies"})), "URI \"none.ies\" cannot be read"),
        (of(json!({"ies": "data:text/plain;base64,QUJD"})), "line 1: begins with `ABC`"),
        (of(json!({"radius_m": -1})), "extras.radius_m is -1; valid: 0 to 100"),
        (of(json!({"photometry": 3})), "has no list `candela`"),
        (of(table(json!([0, "x"]), json!([0]), json!([1, 2]))), "`vertical_deg` has \"x\""),
        (of(table(json!([0, 90]), json!([0]), json!([1]))), "1 intensities for 2 × 1 angles"),
        (of(table(json!([90, 0]), json!([0]), json!([1, 2]))), "do not ascend"),
    ] {
        assert!(message.contains(part), "{message}\nshould have {part}");
    }
    let mut pole = table(json!([0]), json!([0]), json!([1]));
    pole["photometry"]["pole"] = json!("up");
    assert!(of(pole).contains("pole is \"up\"; valid"));
    let beam = json!({"type": "directional", "extras": {"photometry": {
        "vertical_deg": [0], "horizontal_deg": [0], "candela": [1]}}});
    let (root, bin) = with_light(beam, json!({}));
    assert!(refusal(&root, &bin).contains("it is directional"));
}
