//! What is recorded of each frame, and of the whole.

use crate::common::{folder, ids, read_json, run, sweep};
use serde_json::{Value, json};
use std::collections::HashSet;
use std::fs;
use std::path::Path;

fn records(dir: &Path) -> Vec<Value> {
    ids(dir).iter().map(|id| read_json(&dir.join(format!("out/{id}.json")))).collect()
}

#[test]
fn every_parameter_of_a_frame() {
    let dir = folder(
        "fog: {model: advection, height_m: 100}\n\
         camera: {altitude_m: 30, position_m: [4, 0, -6], heading_deg: 90}\n",
    );
    sweep(dir.path(), "out").ok();
    let record = &records(dir.path())[0];
    assert_eq!(record["id"], ids(dir.path())[0]);
    assert_eq!(record["camera"]["altitude_m"], 30.0);
    assert_eq!(record["sensor"]["width_px"], 24);
    assert_eq!(record["lighting"]["preset"], "day");
    assert_eq!(record["render"]["samples"], 3);
    assert_eq!(record["noise"]["samples_per_pixel"], 3);
    assert!(record["noise"]["relative_standard_error"].as_f64().unwrap() > 0.0);
    assert!(record["seed"].is_u64());

    // Heading 90° looks along +X: OpenCV's z axis is the third column.
    let pose = &record["camera"]["world_from_camera"];
    let column = |c: usize| [0, 1, 2].map(|r| pose[r][c].as_f64().unwrap());
    let near = |a: [f64; 3], b: [f64; 3]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-6);
    assert!(near(column(0), [0.0, 0.0, 1.0]) && near(column(1), [0.0, -1.0, 0.0]), "{pose}");
    assert!(near(column(2), [1.0, 0.0, 0.0]) && near(column(3), [4.0, 30.0, -6.0]), "{pose}");
    // 12 px / tan 30°, and the middle of the picture.
    let k = &record["sensor"]["intrinsics"];
    assert!((k["fx_px"].as_f64().unwrap() - 12.0 * 3f64.sqrt()).abs() < 1e-4, "{k}");
    assert_eq!([&k["cx_px"], &k["cy_px"]], [&json!(11.5), &json!(6.5)]);

    for (digest, length) in
        [(&record["config_digest"], 64), (&record["digest"], 64), (&record["pair_id"], 16)]
    {
        assert_eq!(digest.as_str().unwrap().len(), length);
    }
    let header = read_json(&dir.path().join("out/dataset.json"));
    assert_eq!(record["config_digest"], header["config_digest"]);
    assert_eq!(record["code"]["digest"], header["code_digest"]);
}

#[test]
fn the_fog_at_camera_base_and_top() {
    let dir = folder("fog: {model: advection, height_m: 100}\ncamera: {altitude_m: 30}\n");
    sweep(dir.path(), "out").ok();
    let state = &records(dir.path())[0]["fog_state"];
    assert_eq!(state["wavelength_nm"], 550.0);
    for (place, altitude) in [("at_camera", 30.0), ("at_base", 0.0), ("at_top", 100.0)] {
        let state = &state[place];
        let number =
            |key: &str| state[key].as_f64().unwrap_or_else(|| panic!("{place}: {key} is {}", state[key]));
        assert_eq!(number("altitude_m"), altitude);
        assert!(number("sigma_t_1_m") > 1e-3, "{state}");
        assert!((0.99..=1.0).contains(&number("albedo")), "{state}");
        assert!((0.7..0.95).contains(&number("g")), "{state}");
        assert_eq!(number("mor_contrast_threshold"), 0.05);
        assert!((0.001..2.0).contains(&number("liquid_water_content_g_m3")), "{state}");
        assert!(number("number_density_1_m3") > 1e6, "{state}");
        assert!((0.5..30.0).contains(&number("effective_radius_um")), "{state}");
    }
}

#[test]
fn the_top_belongs_to_the_layer_on_any_datum() {
    // (43.21 + 50) - 43.21 is more than 50.
    let dir = folder(
        "outputs: [tau]\nsweep: {axes: {fog: [{model: advection, height_m: 50, datum_m: 43.21}, \
         {model: homogeneous, height_m: 50, sigma_t_1_m: 0.02, phase: {hg: 0.8}, datum_m: 43.21}]}}\n",
    );
    sweep(dir.path(), "out").ok();
    for record in records(dir.path()) {
        let top = &record["fog_state"]["at_top"];
        assert_eq!(top["altitude_m"], 50.0);
        assert!(top["sigma_t_1_m"].as_f64().unwrap() > 1e-3, "{top}");
    }
}

#[test]
fn a_grey_fog_has_no_droplets_and_clear_air_no_fog() {
    let dir = folder(
        "sweep: {axes: {fog: [none, {model: homogeneous, height_m: 50, sigma_t_1_m: 0.02, \
         single_scattering_albedo: 0.9, phase: {hg: 0.8}}]}}\n",
    );
    sweep(dir.path(), "out").ok();
    let records = records(dir.path());
    assert_eq!(records[0]["fog_state"], Value::Null);
    let state = &records[1]["fog_state"]["at_camera"];
    assert_eq!(
        [&state["sigma_t_1_m"], &state["albedo"], &state["g"]],
        [&json!(0.02), &json!(0.9), &json!(0.8)]
    );
    for key in ["liquid_water_content_g_m3", "number_density_1_m3", "effective_radius_um"] {
        assert_eq!(state.get(key), Some(&Value::Null), "{key}");
    }
}

#[test]
fn pairs_differ_in_fog_alone() {
    let dir = folder(
        "sweep: {axes: {lighting: [day, night], camera.altitude_m: [2, 30], fog: [none, \
         {model: homogeneous, height_m: 50, sigma_t_1_m: 0.02, phase: {hg: 0.8}}, \
         {model: homogeneous, height_m: 50, sigma_t_1_m: 0.03, phase: {hg: 0.8}}]}}\n",
    );
    sweep(dir.path(), "out").ok();
    let records = records(dir.path());
    let pairs: Vec<_> = records.iter().map(|r| r["pair_id"].as_str().unwrap()).collect();
    assert_eq!(pairs.len(), 12);
    assert!(pairs.chunks(3).all(|three| three.iter().all(|pair| *pair == three[0])), "{pairs:?}");
    assert_eq!(pairs.iter().collect::<HashSet<_>>().len(), 4);
    assert_eq!(records.iter().map(|r| r["seed"].as_u64()).collect::<HashSet<_>>().len(), 12);
}

#[test]
fn the_resolved_configuration_makes_the_same_frames() {
    let dir = folder("fog: {model: homogeneous, height_m: 50, sigma_t_1_m: 0.02, phase: {hg: 0.8}}\n");
    sweep(dir.path(), "out").ok();
    let args =
        ["render", "out/config.resolved.yaml", "--out", "again", "--cache-dir", &crate::common::cache()];
    run(&args, dir.path()).ok();
    crate::common::assert_same(&dir.path().join("out"), &dir.path().join("again"));
    let plan = fs::read_to_string(dir.path().join("out/plan.jsonl")).unwrap();
    assert_eq!(plan.lines().count(), 1);
}
