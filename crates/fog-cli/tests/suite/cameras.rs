//! Rigs, paths, lenses and rolling shutters, from configuration to files.

use crate::common::{assert_same, cache, folder, ids, names, read_json, repository, run, sweep, write};
use fog_dataset::read_frame;
use serde_json::{Value, json};
use std::path::Path;

fn records(dir: &Path) -> Vec<Value> {
    ids(dir).iter().map(|id| read_json(&dir.join("out").join(format!("{id}.json")))).collect()
}

fn near(a: &Value, b: f64) -> bool {
    (a.as_f64().expect("a number") - b).abs() < 1e-6
}

const RIG_ON_A_PATH: &str = "fog: none\nrender: {samples: 1}\n\
    path: {poses: [{position_m: [0, 2, 0], time_s: 0, heading_deg: 10}, {position_m: [0, 2, -2], time_s: 0.5, heading_deg: 14}]}\n\
    cameras: {left: {position_m: [-0.1, 0, 0]}, right: {position_m: [0.1, 0, 0], sensor: {lens: {fisheye: {k1: -0.02, \
    field_of_view_deg: 150}}}}}\nsensor: {shutter: {rolling: {readout_s: 0.05}}, width_px: 24, height_px: 14}\n";

#[test]
fn a_rig_flies_along_a_path() {
    let dir = tempfile::tempdir().expect("temporary folder");
    let scene = repository("scenes/street.glb");
    let text = format!("version: 1\nname: rig\nscene: {{file: {scene:?}}}\nlighting: day\n{RIG_ON_A_PATH}");
    write(dir.path(), "c.yaml", text);
    sweep(dir.path(), "out").ok();
    let all = ids(dir.path());
    let starts = ["rig_0000_left-", "rig_0000_right-", "rig_0001_left-", "rig_0001_right-"];
    assert!(all.len() == 4 && all.iter().zip(starts).all(|(id, start)| id.starts_with(start)), "{all:?}");

    let records = records(dir.path());
    assert!(near(&records[0]["path"]["time_s"], 0.0) && near(&records[2]["path"]["time_s"], 0.5));
    assert_eq!(records[1]["path"]["next"]["camera"], {
        let mut next = records[3]["camera"].clone();
        for key in ["world_from_camera", "quaternion_wxyz", "axes"] {
            next.as_object_mut().unwrap().remove(key);
        }
        next
    });
    assert!(records[3]["path"].get("next").is_none());
    // The camera in its rig, and the rig in the world: heading 10 degrees.
    let rig = &records[1]["rig"];
    assert_eq!(rig["camera"], "right");
    assert!(near(&rig["rig_from_camera"][0][3], 0.1) && near(&rig["rig_from_camera"][1][3], 0.0), "{rig}");
    assert!(near(&rig["world_from_rig"][2][2], -fog_core::math::f64::cos(10f64.to_radians())), "{rig}");
    // A tenth of the way to the next pose is gone when the last row is read.
    let end = &records[0]["readout_end"];
    assert!(near(&end["heading_deg"], 10.4) && end["world_from_camera"].is_array(), "{end}");
    assert_eq!(records[1]["sensor"]["shutter"], json!({"rolling": {"readout_s": 0.05}}));
    assert_eq!(records[0]["sensor"]["intrinsics"]["distortion"], "none");
    let fisheye = &records[1]["sensor"]["intrinsics"];
    assert_eq!(fisheye["distortion"]["coefficients"], json!([-0.02, 0.0, 0.0, 0.0]));
    assert!(records[1]["conventions"]["depth"].as_str().unwrap().contains("NaN"));

    // Beyond 75 degrees from its axis the fisheye sees nothing: black, and no truth.
    let frame = read_frame(&dir.path().join("out"), &all[1]).expect("readable");
    let (depth, red) = (&frame.channels["depth.Z"].values, &frame.channels["R"].values);
    assert!(depth[0].is_nan() && red[0] == 0.0 && frame.channels["tau.Y"].values[0].is_nan());
    assert!(depth[7 * 24 + 12].is_finite() && red[7 * 24 + 12] > 0.0);
    let index = std::fs::read_to_string(dir.path().join("out/index.csv")).unwrap();
    assert!(index.starts_with("index,id,status,pair_id,path.index,rig.camera,"), "{index}");

    // One frame alone has the same bytes, and a folder of it goes on.
    run(&["render", "c.yaml", "--frame", &all[2], "--out", "out2", "--cache-dir", &cache()], dir.path()).ok();
    sweep(dir.path(), "out2").ok();
    assert_same(&dir.path().join("out"), &dir.path().join("out2"));
    let replay =
        ["replay", "c.yaml", "--frame", &all[1], "--pixel", "0,0", "--sample", "0", "--cache-dir", &cache()];
    let unseen = run(&replay, dir.path());
    assert!(
        unseen.code != Some(0) && unseen.stderr.contains("the lens sees nothing at pixel 0,0"),
        "{}",
        unseen.stderr
    );
}

#[test]
fn panoramas_and_the_plan() {
    let dir = folder(
        "fog: none\noutputs: [depth, distance]\nsweep: {axes: {sensor: [{width_px: 16, height_px: 8, lens: equirectangular}]}}\n",
    );
    sweep(dir.path(), "out").ok();
    let record = &records(dir.path())[0];
    assert_eq!(record["sensor"]["intrinsics"]["latitude_deg"], json!([-90.0, 90.0]));
    let id = &ids(dir.path())[0];
    let frame = read_frame(&dir.path().join("out"), id).expect("readable");
    assert_eq!(frame.channels["depth.Z"], frame.channels["distance.Z"]);
    // The camera is 2 m over the street: straight down is that far.
    let down = frame.channels["distance.Z"].values[7 * 16 + 3];
    assert!((2.0..2.1).contains(&down), "{down}");
    assert!(names(&dir.path().join("out")).iter().any(|name| name.ends_with(".gt.exr")));

    let poses = "fog: none\ncamera: {altitude_m: 2}\ncameras: {a: {}, b: {heading_deg: 90}}\n";
    write(dir.path(), "p.yaml", crate::common::config(&format!("scene: none\nlighting: day\n{poses}")));
    let plan = run(&["plan", "p.yaml"], dir.path()).ok().stdout;
    assert!(plan.starts_with("t: 2 frames\n") && plan.contains("cameras              a, b"), "{plan}");
}
