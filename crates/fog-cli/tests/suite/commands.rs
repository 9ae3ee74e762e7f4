//! The commands that do not render.

use crate::common::{assert_same, folder, ids, json, names, repository, run, sweep};
use std::fs;

const SWEEP: &str = "sweep: {axes: {fog: [none, {model: homogeneous, height_m: 9, sigma_t_1_m: 0.1, phase: {hg: 0}}], \
                     camera.altitude_m: [2, 30, 50]}}\n";

#[test]
fn schema_is_json_schema() {
    let dir = tempfile::tempdir().unwrap();
    let schema = json(&run(&["schema"], dir.path()).ok().stdout);
    assert!(schema["$schema"].as_str().unwrap().contains("json-schema.org"));
    for key in [
        "version", "name", "seed", "scene", "fog", "camera", "sensor", "lighting", "render", "outputs",
        "sweep",
    ] {
        assert!(schema["properties"][key].is_object(), "{key}");
    }
    assert_eq!(schema["additionalProperties"], false);
}

#[test]
fn plan_lists_frames_and_writes_nothing() {
    let dir = folder(SWEEP);
    let listed = run(&["plan", "c.yaml"], dir.path()).ok().stdout;
    assert!(listed.contains("t: 6 frames (grid)") && listed.contains("camera.altitude_m"), "{listed}");
    assert!(listed.contains("on disk") && listed.contains("about"), "{listed}");
    let ids = ids(dir.path());
    let lines: Vec<_> =
        listed.lines().rev().take(6).map(|line| line.split_whitespace().last().unwrap()).collect();
    assert!(lines.into_iter().rev().eq(&ids), "{listed}");
    assert_eq!(names(dir.path()), ["c.yaml"]);
}

#[test]
fn plan_as_json_is_the_plan_of_the_data_set() {
    let dir = folder(SWEEP);
    let plan = run(&["plan", "c.yaml", "--json", "--set", "render.samples=2"], dir.path()).ok().stdout;
    let frames: Vec<_> = plan.lines().map(json).collect();
    assert_eq!(frames.len(), 6);
    for (i, frame) in frames.iter().enumerate() {
        assert_eq!(frame["index"], i);
        assert_eq!(frame["render"]["samples"], 2);
        assert_eq!(frame["camera"]["altitude_m"], [2.0, 30.0, 50.0][i % 3]);
        assert_eq!(frame["fog"]["model"], ["none", "homogeneous"][i / 3]);
    }
    sweep(dir.path(), "out").ok();
    let index = fs::read_to_string(dir.path().join("out/index.csv")).unwrap();
    let rendered: Vec<_> = index.lines().skip(1).map(|line| line.split(',').nth(1).unwrap()).collect();
    assert!(rendered.iter().eq(&ids(dir.path())), "{index}");
}

#[test]
fn help_shows_examples() {
    let dir = tempfile::tempdir().unwrap();
    let help = run(&["--help"], dir.path()).ok().stdout;
    assert!(help.contains("Examples:\n  fogbank ") && help.contains("Exit codes:"), "{help}");
    for command in ["sweep", "render", "plan", "schema", "scene", "verify", "compare"] {
        let own = run(&[command, "--help"], dir.path()).ok().stdout;
        assert!(help.contains(command) && own.contains(&format!("fogbank {command}")), "{own}");
    }
}

#[test]
fn scenes_are_those_of_the_repository() {
    let dir = tempfile::tempdir().unwrap();
    for name in ["street", "runway"] {
        run(&["scene", name, "--out", "f.glb"], dir.path()).ok();
        let file = format!("{name}.glb");
        run(&["scene", name], dir.path()).ok();
        let shipped = fs::read(repository("scenes").join(&file)).unwrap();
        assert!(fs::read(dir.path().join("f.glb")).unwrap() == shipped, "{name} --out");
        assert!(fs::read(dir.path().join(&file)).unwrap() == shipped, "{name}");
    }
}

#[test]
fn verify_finds_a_flipped_byte() {
    let dir = folder(SWEEP);
    sweep(dir.path(), "out").ok();
    let good = run(&["verify", "out"], dir.path()).ok().stdout;
    assert_eq!(good, "out: 6 done, 0 failed, 0 missing\n");
    let id = &ids(dir.path())[4];
    let files = [
        format!("{id}.rgb.png"),
        format!("{id}.hdr.exr"),
        format!("{id}.gt.exr"),
        format!("{id}.json"),
        "config.resolved.yaml".to_owned(),
    ];
    for file in files {
        let path = dir.path().join("out").join(&file);
        let good = fs::read(&path).unwrap();
        let mut bad = good.clone();
        bad[good.len() / 2] ^= 1;
        fs::write(&path, bad).unwrap();
        let found = run(&["verify", "out"], dir.path());
        assert_eq!(found.code, Some(1), "{file}: {}{}", found.stdout, found.stderr);
        assert!(found.stdout.starts_with(&format!("{file}: ")), "{}", found.stdout);
        fs::write(&path, good).unwrap();
    }
    run(&["verify", "out"], dir.path()).ok();
}

#[test]
fn lost_and_cut_files_are_made_again() {
    let dir = folder(SWEEP);
    sweep(dir.path(), "out").ok();
    sweep(dir.path(), "good").ok();
    let ids = ids(dir.path());
    let file = |name: String| dir.path().join("out").join(name);
    fs::remove_file(file(format!("{}.rgb.png", ids[1]))).unwrap();
    fs::write(file(format!("{}.hdr.exr", ids[3])), "cut").unwrap();
    fs::remove_file(file("index.csv".to_owned())).unwrap();
    let said = sweep(dir.path(), "out").ok().stdout;
    assert!(said.contains("4 frames are done already, 2 to go"), "{said}");
    assert_same(&dir.path().join("out"), &dir.path().join("good"));
}

#[test]
fn verify_without_a_readable_plan_is_a_mistake() {
    let dir = folder("fog: none\n");
    sweep(dir.path(), "out").ok();
    fs::write(dir.path().join("out/plan.jsonl"), "no plan").unwrap();
    let found = run(&["verify", "out"], dir.path());
    assert_eq!(found.code, Some(2));
    assert!(found.stderr.starts_with("fogbank: out/plan.jsonl is damaged: line 1"), "{}", found.stderr);
    // The plan follows from the configuration: a rerun writes it again.
    sweep(dir.path(), "out").ok();
    run(&["verify", "out"], dir.path()).ok();
}

#[test]
fn shipped_configurations_are_valid() {
    for (config, frames) in [("quickstart", 12), ("approach", 78), ("robustness", 24), ("dehazing", 96)] {
        let plan = run(&["plan", &format!("configs/{config}.yaml"), "--json"], &repository("")).ok().stdout;
        let plan: Vec<_> = plan.lines().map(json).collect();
        assert!(plan.len() >= frames, "{config}: {}", plan.len());
        for frame in plan {
            let scene = frame["scene"]["file"].as_str();
            assert!(scene.is_none_or(|scene| repository(scene).is_file()), "{scene:?}");
        }
    }
}
