//! Frames that share paths.

use crate::common::{assert_same, cache, folder, ids, json, read_json, run, sweep, write};
use std::path::Path;

const LINES: &str = "outputs: [image, hdr, direct, airlight]\n\
    fog: {model: homogeneous, height_m: 50, sigma_t_1_m: 0.01, phase: {hg: 0.8}}\n";

/// Two fogs and two intensities of the sun: four frames of one pass.
fn four_frames() -> tempfile::TempDir {
    let dir = folder(&format!(
        "{LINES}sweep: {{axes: {{fog.sigma_t_1_m: [0.01, 0.012], lighting.groups.0.intensity: [1, 3]}}}}\n"
    ));
    let lighting = "lighting: {environment: {radiance: 1}, sun: {elevation_deg: 30, azimuth_deg: 20, irradiance: 1}, \
                    groups: [{name: sun, lights: [sun]}]}";
    let text = std::fs::read_to_string(dir.path().join("c.yaml")).expect("read");
    let text = text.replace("lighting: day", lighting).replace("samples: 3", "samples: 4, share: fog");
    write(dir.path(), "c.yaml", text);
    dir
}

fn record(dir: &Path, id: &str) -> serde_json::Value {
    read_json(&dir.join(format!("{id}.json")))
}

#[test]
fn whole_or_in_pieces() {
    let dir = four_frames();
    let plan = run(&["plan", "c.yaml"], dir.path()).ok().stdout;
    assert!(plan.contains("1 pass: frames share paths (render.share)"), "{plan}");
    let ids = ids(dir.path());
    let said = sweep(dir.path(), "whole").ok().stdout;
    assert!(said.contains("4 frames done, 0 failed"), "{said}");
    for id in &ids {
        let share = &record(&dir.path().join("whole"), id)["share"];
        assert_eq!((&share["frames"], &share["fogs"]), (&serde_json::json!(ids), &2.into()));
    }
    // One frame alone is the same frame, and so are the others when they come later, by other threads.
    let args =
        ["render", "c.yaml", "--frame", "2", "--out", "pieces", "--threads", "1", "--cache-dir", &cache()];
    run(&args, dir.path()).ok();
    let done = |id: &&String| dir.path().join(format!("pieces/{id}.done")).exists();
    assert_eq!(ids.iter().filter(done).collect::<Vec<_>>(), [&ids[2]]);
    let said = sweep(dir.path(), "pieces").ok().stdout;
    assert!(said.contains("1 frames are done already, 3 to go"), "{said}");
    assert_same(&dir.path().join("whole"), &dir.path().join("pieces"));
    // Three times the sun, to the last digit but rounding.
    let sun = |k: usize| {
        let file = dir.path().join(format!("whole/{}.hdr.exr", ids[k]));
        fogbank::dataset::read_exr_channels(&file).expect("a readable file")["group.sun.G"].values.clone()
    };
    for (a, b) in sun(0).iter().zip(sun(1)) {
        assert!((3.0 * a - b).abs() <= 1e-5 * b.abs(), "{a} {b}");
    }
    let refused = run(&["replay", "c.yaml", "--frame", "1", "--pixel", "3,3", "--sample", "0"], dir.path());
    assert!(refused.code == Some(2) && refused.stderr.contains("shares its paths"), "{}", refused.stderr);
}

#[test]
fn a_frame_that_cannot_be_made_leaves_its_set() {
    let dir = folder(
        "outputs: [image]\nsweep: {axes: {fog: [{model: homogeneous, height_m: 50, sigma_t_1_m: 0.01, phase: {hg: 0.8}}, \
         {model: layered, file: nowhere.csv, phase: {hg: 0.8}}, \
         {model: homogeneous, height_m: 60, sigma_t_1_m: 0.01, phase: {hg: 0.8}}]}}\n",
    );
    let args = ["sweep", "c.yaml", "--set", "render.share=fog", "--out", "out", "--cache-dir", &cache()];
    let out = run(&args, dir.path());
    assert_eq!(out.code, Some(1), "{}", out.stderr);
    assert!(out.stderr.contains("nowhere.csv"), "{}", out.stderr);
    let plan = run(&["plan", "c.yaml", "--json", "--set", "render.share=fog"], dir.path()).ok().stdout;
    let ids: Vec<String> =
        plan.lines().map(|line| json(line)["id"].as_str().expect("id").to_owned()).collect();
    let share = &record(&dir.path().join("out"), &ids[2])["share"];
    assert_eq!((&share["frames"], &share["fogs"]), (&serde_json::json!([ids[0], ids[2]]), &2.into()));
    assert!(dir.path().join(format!("out/{}.failed.json", ids[1])).exists());
}
