//! Labels of the made scenes, from configuration to files.

use crate::common::{config, ids, json, read_json, run, sweep, write};
use fogbank::dataset::{StoredFrame, read_frame};
use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

const OUTPUTS: &str = "outputs: [image, hdr, depth, distance, transmittance, tau, direct, airlight, normals, position, \
                       albedo, semantic, instance, flow, objects]\n";

/// A picture of whole numbers.
fn mask(dir: &Path, id: &str, kind: &str) -> Vec<u16> {
    let picture = image::open(dir.join(format!("out/{id}.{kind}.png"))).expect("a PNG");
    match picture {
        image::DynamicImage::ImageLuma8(p) => p.into_raw().into_iter().map(u16::from).collect(),
        image::DynamicImage::ImageLuma16(p) => p.into_raw(),
        other => panic!("{kind} is {:?}", other.color()),
    }
}

/// Pixels of each value.
fn counts(mask: &[u16]) -> BTreeMap<u16, u64> {
    let mut counts = BTreeMap::new();
    mask.iter().for_each(|&v| *counts.entry(v).or_insert(0) += 1);
    counts
}

/// Checks a frame's masks against its records and its classes, and returns the records.
fn checked(dir: &Path, id: &str) -> Vec<Value> {
    let (semantic, instance) = (mask(dir, id, "semantic"), mask(dir, id, "instance"));
    let classes = read_json(&dir.join("out/classes.json"));
    let names: Vec<&str> =
        classes["classes"].as_array().unwrap().iter().map(|c| c["name"].as_str().unwrap()).collect();
    assert_eq!((names[7], names[23], names[26], names[34]), ("road", "sky", "car", "license plate"));
    let objects =
        read_json(&dir.join(format!("out/{id}.objects.json")))["objects"].as_array().unwrap().clone();
    let number = |o: &Value, key: &str| o[key].as_u64().unwrap();
    let seen: BTreeMap<u16, u64> = objects
        .iter()
        .filter(|o| number(o, "visible_pixels") > 0)
        .map(|o| (number(o, "instance") as u16, number(o, "visible_pixels")))
        .collect();
    let mut in_mask = counts(&instance);
    in_mask.remove(&0);
    assert_eq!(in_mask, seen);
    for o in &objects {
        assert_eq!(names[number(o, "class_id") as usize], o["class"].as_str().unwrap());
        let occlusion = o["occlusion"].as_f64().unwrap_or(1.0);
        assert!((0.0..=1.0).contains(&occlusion) && (0.0..=1.0).contains(&o["truncation"].as_f64().unwrap()));
        assert_eq!(o["detectable"].as_bool().unwrap(), o["hidden_by"].is_null(), "{o}");
        assert!(o["box_3d"]["size_m"].as_array().unwrap().iter().all(|v| v.as_f64().unwrap() >= 0.0));
    }
    // Sky is the class of the pixels without a distance, and none of them has an instance.
    let frame = read_frame(&dir.join("out"), id).expect("readable");
    for (i, &d) in frame.channels["distance.Z"].values.iter().enumerate() {
        assert_eq!(d == f32::INFINITY, semantic[i] == 23, "pixel {i}");
        assert!(d != f32::INFINITY || instance[i] == 0);
    }
    layers(&frame);
    objects
}

/// Checks normals and positions.
fn layers(frame: &StoredFrame) {
    let at = |name: &str, i: usize| f64::from(frame.channels[name].values[i]);
    let eye: Vec<f64> =
        (0..3).map(|r| frame.record["camera"]["world_from_camera"][r][3].as_f64().unwrap()).collect();
    for i in 0..frame.channels["N.X"].values.len() {
        let distance = at("distance.Z", i);
        let normal = ["N.X", "N.Y", "N.Z"].map(|name| at(name, i));
        let length = normal.iter().map(|c| c * c).sum::<f64>().sqrt();
        if distance.is_infinite() {
            assert!(length == 0.0 && at("P.X", i).is_nan());
            continue;
        }
        assert!((length - 1.0).abs() < 1e-5);
        let way = [("P.X", 0), ("P.Y", 1), ("P.Z", 2)].map(|(name, c): (&str, usize)| at(name, i) - eye[c]);
        let found = way.iter().map(|c| c * c).sum::<f64>().sqrt();
        assert!((found / distance - 1.0).abs() < 1e-4, "{found} {distance}");
        assert!((0.0..=1.0).contains(&at("albedo.G", i)));
    }
}

#[test]
fn a_street_in_fog_is_labelled() {
    let dir = tempfile::tempdir().expect("temporary folder");
    let lines = format!(
        "scene: {{generate: urban, length_m: 80}}\nlighting: day\n{OUTPUTS}\
         fog: {{model: homogeneous, height_m: 60, sigma_t_1_m: 0.08, phase: {{hg: 0.83}}}}\n\
         classes: {{tree: \"tree_*\", paint: {{material: \"road paint\"}}, nothing: \"no such *\"}}\n\
         labels: {{min_pixels: 3}}\n\
         path: {{poses: [{{position_m: [1.6, 1.5, 0]}}, {{position_m: [1.6, 1.5, -0.5]}}]}}\n"
    );
    write(
        dir.path(),
        "c.yaml",
        config(&lines).replace("width_px: 24, height_px: 14", "width_px: 64, height_px: 36"),
    );
    let told = run(&["sweep", "c.yaml", "--out", "out"], dir.path());
    assert_eq!(told.code, Some(0), "{}", told.stderr);
    let said = format!("{}{}", told.stdout, told.stderr);
    assert!(said.contains("has no node or mesh `no such *` for class `nothing`"), "{said}");
    let ids = ids(dir.path());
    assert_eq!(ids.len(), 2);
    let mut reasons = BTreeSet::new();
    for id in &ids {
        let objects = checked(dir.path(), id);
        let classes: BTreeSet<&str> = objects.iter().map(|o| o["class"].as_str().unwrap()).collect();
        for class in ["road", "sidewalk", "building", "car", "tree", "paint", "terrain"] {
            assert!(classes.contains(class), "no {class} in {classes:?}");
        }
        assert!(!classes.contains("vegetation"));
        reasons.extend(objects.iter().map(|o| o["hidden_by"].as_str().unwrap_or("nothing").to_owned()));
    }
    assert!(["nothing", "fog", "small"].iter().all(|r| reasons.contains(*r)), "{reasons:?}");
    // The first frame flows on to the second, the second to nowhere.
    let flow =
        |id: &str, name: &str| read_frame(&dir.path().join("out"), id).unwrap().channels[name].values.clone();
    assert!(flow(&ids[0], "flow_valid.Y").iter().filter(|v| **v == 1.0).count() > 500);
    assert!(flow(&ids[1], "flow.X").iter().all(|v| v.is_nan()));
    let (row, column) = (flow(&ids[0], "flow.Y"), flow(&ids[0], "flow.X"));
    // Ahead, what is below goes down, and what is to the right goes right.
    assert!(row[35 * 64 + 32] > 0.5 && column[30 * 64 + 62] > 0.0);
    let report = run(&["verify", "out"], dir.path());
    assert_eq!(report.code, Some(0), "{}{}", report.stdout, report.stderr);
    write(dir.path(), &format!("out/{}.objects.json", ids[0]), "{}");
    let report = run(&["verify", "out"], dir.path());
    assert!(report.code != Some(0) && format!("{}{}", report.stdout, report.stderr).contains("objects.json"));
}

#[test]
fn a_runway_has_its_keypoints() {
    let dir = tempfile::tempdir().expect("temporary folder");
    let lines = format!(
        "scene: {{generate: runway, length_m: 1200}}\nlighting: day\n{}fog: none\n\
         camera: {{altitude_m: 40, position_m: [0, 0, 600], pitch_deg: -3}}\n",
        OUTPUTS.replace("flow, ", "")
    );
    write(
        dir.path(),
        "c.yaml",
        config(&lines).replace("width_px: 24, height_px: 14", "width_px: 96, height_px: 54"),
    );
    sweep(dir.path(), "out").ok();
    let id = &ids(dir.path())[0];
    let objects = checked(dir.path(), id);
    let runway = objects.iter().find(|o| o["class"] == "runway").expect("the runway");
    let points: BTreeMap<&str, &Value> =
        runway["keypoints"].as_array().unwrap().iter().map(|k| (k["name"].as_str().unwrap(), k)).collect();
    let image = |name: &str| [0, 1].map(|c| points[name]["image_px"][c].as_f64().unwrap());
    let [left, right] = ["threshold_left", "threshold_right"].map(image);
    // 45 m at 601 m, with the axis in the middle.
    let focal = 48.0 * 3f64.sqrt();
    assert!((left[0] + right[0] - 96.0).abs() < 1e-2 && (left[1] - right[1]).abs() < 1e-2);
    assert!((right[0] - left[0] - 45.0 * focal / 600.0).abs() < 0.05, "{left:?} {right:?} {focal}");
    for name in ["threshold_left", "threshold_right", "end_left", "end_right", "aiming_point"] {
        assert_eq!(
            (&points[name]["visible"], &points[name]["transmittance"]),
            (&json("true"), &json("1.0")),
            "{name}"
        );
    }
    assert!(objects.iter().any(|o| o["class"] == "runway marking"));
}
