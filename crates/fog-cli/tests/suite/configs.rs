//! The configurations of `configs/`: each runs on a fresh machine, here in a few pixels.

use super::common::{cache, json, read_json, repository, run};
use std::path::Path;

/// Renders the frame at an index of a configuration into `dir` in 24 × 14 pixels with 2 samples; its record.
fn record(dir: &Path, config: &str, index: usize, sets: &[&str]) -> serde_json::Value {
    let path = repository(&format!("configs/{config}.yaml")).to_string_lossy().into_owned();
    let mut args = vec!["plan", path.as_str(), "--json"];
    let small = ["sensor.width_px=24", "sensor.height_px=14", "render.samples=2"];
    let sets: Vec<&str> = small.iter().chain(sets).flat_map(|set| ["--set", *set]).collect();
    args.extend(&sets);
    let plan = run(&args, dir).ok().stdout;
    let frame = json(plan.lines().nth(index).expect("a frame"));
    let id = frame["id"].as_str().expect("id").to_owned();
    let (cache, out) = (cache(), format!("{config}-{index}"));
    let mut args = vec!["render", path.as_str(), "--frame", &id, "--out", &out, "--cache-dir", &cache];
    args.extend(&sets);
    let done = run(&args, dir);
    assert_eq!(done.code, Some(0), "{config}: {}", done.stderr);
    read_json(&dir.join(format!("{out}/{id}.json")))
}

#[test]
fn an_approach_tells_what_is_in_sight() {
    let dir = tempfile::tempdir().expect("temporary folder");
    // 26 frames of each thickness, 13 of each light; the first is 3000 m before the aiming point, the last 120 m.
    let far = record(dir.path(), "approach", 26 + 13, &[]);
    let aviation = &far["aviation"];
    let number = |value: &serde_json::Value| value.as_f64().unwrap_or(f64::NAN);
    let close = |value: &serde_json::Value, want: f64| {
        let value = number(value);
        assert!((value - want).abs() < 2e-3, "{value} for {want}");
    };
    close(&aviation["runway"]["length_m"], 2500.0);
    close(&aviation["position"]["along_track_m"], 3000.0 - 311.0);
    close(&aviation["position"]["cross_track_m"], 0.0);
    close(&aviation["position"]["height_above_threshold_m"], 157.223);
    close(&aviation["position"]["glide_path_angle_deg"], 3.0);
    assert_eq!(aviation["runway_in_sight"], false);
    assert_eq!(aviation["visual_range"]["threshold"]["name"], "night");
    let groups = aviation["lights"].as_array().expect("groups");
    let names: Vec<_> = groups.iter().map(|g| g["name"].as_str().expect("a name")).collect();
    for name in ["approach", "side_rows", "threshold", "edge", "centre_line", "touchdown_zone", "papi"] {
        assert!(names.contains(&name), "{names:?}");
    }

    let near = record(dir.path(), "approach", 26 + 13 + 12, &[]);
    let aviation = &near["aviation"];
    assert_eq!(aviation["runway_in_sight"], true, "{aviation:#}");
    let decided = &aviation["visual_range"]["decision_heights"];
    assert_eq!((&decided[0]["reached"], &decided[1]["reached"]), (&true.into(), &true.into()));

    // Lights that are switched off are not seen, and in clear air the markings are.
    let clear = record(dir.path(), "approach", 0, &["sweep=~", "fog=none", "lighting=day"]);
    let aviation = &clear["aviation"];
    assert_eq!(aviation["visual_range"]["rvr_reported"], "P2000");
    assert_eq!(
        (&aviation["runway_in_sight"], &aviation["approach_lights_in_sight"]),
        (&true.into(), &false.into())
    );
}

#[test]
fn a_runway_must_have_a_place() {
    let dir = tempfile::tempdir().expect("temporary folder");
    let text = super::common::config("scene: none\nfog: none\nrunway: {glide_slope_deg: 3}\n");
    super::common::write(dir.path(), "c.yaml", text);
    let run = super::common::sweep(dir.path(), "out");
    assert_eq!(run.code, Some(2));
    assert!(run.stderr.contains("runway: the scene does not say where it is"), "{}", run.stderr);
}

#[test]
fn robustness_runs() {
    let dir = tempfile::tempdir().expect("temporary folder");
    let frame = record(dir.path(), "robustness", 3, &["scene.length_m=80"]);
    assert_eq!(
        (&frame["lighting"]["preset"], &frame["fog"]["visibility"]["mor_m"]),
        (&"overcast".into(), &75.0.into())
    );
    assert!(frame.get("aviation").is_none());
    let night = record(dir.path(), "robustness", 23, &["scene.length_m=80"]);
    assert_eq!(night["lighting"]["preset"], "night_street");
    // The names of the preset are those of the made scene.
    let sets = ["scene.length_m=80", "sweep=~", "lighting=headlamps"];
    let counts = record(dir.path(), "robustness", 0, &sets)["lighting"]["lights_in_group"].clone();
    let count = |group: &str| counts[group].as_u64().unwrap_or(0);
    assert!(count("vehicles") >= 4, "{counts}");
}

#[test]
fn dehazing_runs_in_pairs() {
    let dir = tempfile::tempdir().expect("temporary folder");
    let [clear, foggy] = [0, 2].map(|i| record(dir.path(), "dehazing", i, &["scene.length_m=80"]));
    assert_eq!(
        (&clear["fog"]["model"], &foggy["fog"]["visibility"]["mor_m"]),
        (&"none".into(), &120.0.into())
    );
    assert_eq!(clear["pair_id"], foggy["pair_id"]);
    assert_eq!(clear["scene"], foggy["scene"]);
}
