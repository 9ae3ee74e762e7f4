//! A frame that fails: exit code 1, its reason kept, the other frames done, and a rerun makes up for it.

use crate::common::{
    Run, assert_same, cache, config, folder, ids, names, read_json, repository, run, sweep, write,
};
use std::fs;
use std::path::Path;

/// Insists on exit code 1, one line on stderr with `part`, and the failure of frame `id` on record.
fn failed(run: &Run, dir: &Path, id: &str, part: &str) {
    assert_eq!(run.code, Some(1), "{}\n{}", run.stdout, run.stderr);
    assert_eq!(run.stderr.lines().count(), 1, "{}", run.stderr);
    assert!(run.stderr.contains(&format!("{id}  FAILED: ")) && run.stderr.contains(part), "{}", run.stderr);
    assert!(!run.stderr.contains("panicked"), "{}", run.stderr);
    let record = read_json(&dir.join(format!("out/{id}.failed.json")));
    assert_eq!(record["id"], id);
    assert!(record["reason"].as_str().unwrap().contains(part), "{record}");
}

/// The sweep once more, with the frames that have failed.
fn again(dir: &Path) -> Run {
    run(&["sweep", "c.yaml", "--out", "out", "--retry-failed", "--cache-dir", &cache()], dir)
}

/// The column `status` of the index.
fn states(dir: &Path) -> Vec<String> {
    let index = fs::read_to_string(dir.join("out/index.csv")).unwrap();
    assert!(index.starts_with("index,id,status,pair_id,"), "{index}");
    index.lines().skip(1).map(|line| line.split(',').nth(2).unwrap().to_owned()).collect()
}

#[test]
fn missing_scene_of_one_frame() {
    let dir = tempfile::tempdir().unwrap();
    let here = repository("scenes/street.glb");
    let lines = format!(
        "fog: none\nlighting: day\nscene: none\nsweep: {{axes: {{scene: [{{file: late.glb}}, {{file: {here:?}}}]}}}}\n"
    );
    write(dir.path(), "c.yaml", config(&lines));
    let ids = ids(dir.path());

    for _ in 0..2 {
        failed(&again(dir.path()), dir.path(), &ids[0], "late.glb: cannot be read");
        assert_eq!(states(dir.path()), ["failed", "done"]);
        assert!(!dir.path().join(format!("out/{}.done", ids[0])).exists());
        assert_eq!(run(&["verify", "out"], dir.path()).code, Some(1));
    }

    fs::copy(here, dir.path().join("late.glb")).unwrap();
    // Without being asked to, no frame that has failed is tried again.
    let left = sweep(dir.path(), "out");
    assert_eq!(left.code, Some(1));
    assert!(left.stderr.contains("1 frames failed before and are not tried again"), "{}", left.stderr);
    let said = again(dir.path()).ok().stdout;
    assert!(said.contains("2 frames done, 0 failed, 0 missing"), "{said}");
    assert_eq!(states(dir.path()), ["done", "done"]);
    assert!(!names(&dir.path().join("out")).iter().any(|n| n.contains("failed")));
    run(&["verify", "out"], dir.path()).ok();
    // No trace of the failure: as if the scene had been there from the beginning.
    sweep(dir.path(), "at_once").ok();
    assert_same(&dir.path().join("out"), &dir.path().join("at_once"));
}

#[test]
fn bad_fog_of_one_frame() {
    let dir = folder(
        "sweep:\n  axes:\n    fog: [none, {model: layered, file: l.csv, phase: {hg: 0}}, \
         {model: homogeneous, height_m: 9, sigma_t_1_m: 0.1, phase: {hg: 0}}]\n",
    );
    write(dir.path(), "l.csv", "altitude_m,sigma_t_1_m\n0,x\n");
    failed(&sweep(dir.path(), "out"), dir.path(), &ids(dir.path())[1], "l.csv:2");
    assert_eq!(states(dir.path()), ["done", "failed", "done"]);
}

#[test]
fn file_of_one_frame_cannot_be_written() {
    let dir = folder("fog: none\nsweep: {axes: {camera.altitude_m: [2, 3, 4]}}\n");
    let ids = ids(dir.path());
    run(&["render", "c.yaml", "--frame", "0", "--out", "out", "--cache-dir", &cache()], dir.path()).ok();
    assert_eq!(states(dir.path()), ["done", "missing", "missing"]);
    let blocked = dir.path().join(format!("out/{}.gt.exr", ids[1]));
    fs::create_dir(&blocked).unwrap();
    failed(&sweep(dir.path(), "out"), dir.path(), &ids[1], "cannot write");
    assert_eq!(states(dir.path()), ["done", "failed", "done"]);
    fs::remove_dir(blocked).unwrap();
    again(dir.path()).ok();
    assert_eq!(states(dir.path()), ["done", "done", "done"]);
}
