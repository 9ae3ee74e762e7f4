//! A user's mistake: exit code 2, one clear message, nothing written.

use crate::common::{Run, cache, config, folder, names, repository, run, sweep, write};
use std::fs;
use std::path::Path;

/// Insists on exit code 2 and one line on stderr that holds all of `parts`.
fn refused(run: &Run, parts: &[&str]) {
    assert_eq!(run.code, Some(2), "{}\n{}", run.stdout, run.stderr);
    assert_eq!(run.stderr.lines().count(), 1, "{}", run.stderr);
    assert!(run.stderr.starts_with("fogbank: ") && !run.stderr.contains("panicked"), "{}", run.stderr);
    assert!(run.stderr.matches("os error").count() < 2, "said twice: {}", run.stderr);
    for part in parts {
        assert!(run.stderr.contains(part), "`{part}` is not in: {}", run.stderr);
    }
}

/// Sweeps the folder's configuration, which must be refused before anything is written.
fn sweep_refused(dir: &Path, parts: &[&str]) {
    refused(&sweep(dir, "out"), parts);
    assert!(!dir.join("out").exists());
}

#[test]
fn unknown_key() {
    let dir = folder("fog:\n  model: advection\n  heigth_m: 100\n");
    sweep_refused(dir.path(), &["c.yaml:10:3: fog.heigth_m: unknown key", "did you mean `height_m`?"]);
}

#[test]
fn wrong_type() {
    let dir = folder("fog: none\ncamera: {altitude_m: tall}\n");
    sweep_refused(dir.path(), &["c.yaml:9:22: camera.altitude_m", "expected a number (metres)", "\"tall\""]);
}

#[test]
fn out_of_range() {
    let dir = folder("fog: {model: advection, height_m: -5}\n");
    sweep_refused(dir.path(), &["c.yaml:8:35: fog.height_m: -5 m is out of range", "1 to 5000 m"]);
}

#[test]
fn unknown_lighting() {
    let dir = folder("fog: none\n");
    let text =
        fs::read_to_string(dir.path().join("c.yaml")).unwrap().replace("lighting: day", "lighting: niht");
    write(dir.path(), "c.yaml", text);
    sweep_refused(dir.path(), &["c.yaml:7:11: lighting", "\"niht\"", "did you mean `night`?"]);
}

#[test]
fn missing_configuration() {
    let dir = tempfile::tempdir().unwrap();
    sweep_refused(dir.path(), &["c.yaml: cannot read the configuration", "No such file"]);
}

#[test]
fn bad_override() {
    let dir = folder("fog: none\n");
    for (set, parts) in [
        ("camera.altitud_m=3", ["--set camera.altitud_m=3", "did you mean `altitude_m`?"]),
        ("render.samples=0", ["--set render.samples=0", "out of range"]),
        ("fog.height_m=3", ["--set fog.height_m=3", "cannot be set inside"]),
        ("camera", ["--set camera", "expected KEY=VALUE"]),
    ] {
        let args = ["sweep", "c.yaml", "--out", "out", "--cache-dir", &cache(), "--set", set];
        refused(&run(&args, dir.path()), &parts);
        assert!(!dir.path().join("out").exists());
    }
}

#[test]
fn frames_that_are_not_there() {
    let dir = folder("fog: none\nsweep: {axes: {camera.altitude_m: [2, 30]}}\n");
    let render = ["render", "c.yaml", "--out", "out", "--cache-dir", &cache()];
    refused(&run(&render, dir.path()), &["sweep of 2 frames", "--frame ID", "fogbank plan"]);
    for frame in ["7", "nonsense", ""] {
        let message = format!("no frame `{frame}`; it has 2 frames, for example `2-");
        refused(&run(&[&render[..], &["--frame", frame]].concat(), dir.path()), &[&message]);
    }
    assert!(!dir.path().join("out").exists());
}

#[test]
fn missing_scene() {
    let dir = tempfile::tempdir().unwrap();
    write(dir.path(), "c.yaml", config("scene: {file: no/where.glb}\nfog: none\nlighting: day\n"));
    sweep_refused(dir.path(), &["no/where.glb: cannot be read", "No such file"]);
}

#[test]
fn truncated_scene() {
    let dir = tempfile::tempdir().unwrap();
    write(dir.path(), "c.yaml", config("scene: {file: cut.glb}\nfog: none\nlighting: day\n"));
    let whole = fs::read(repository("scenes/street.glb")).unwrap();
    for length in [whole.len() - 1, 1000, 15] {
        write(dir.path(), "cut.glb", &whole[..length]);
        sweep_refused(dir.path(), &["cut.glb: is truncated", &format!("there are {length}")]);
    }
}

#[test]
fn uri_that_leaves_the_folder() {
    let dir = tempfile::tempdir().unwrap();
    write(dir.path(), "c.yaml", config("scene: {file: inside/s.gltf}\nfog: none\nlighting: day\n"));
    fs::create_dir(dir.path().join("inside")).unwrap();
    let scene = |uri: &str| {
        format!(
            r#"{{"asset": {{"version": "2.0"}}, "scene": 0, "scenes": [{{"nodes": [0]}}], "nodes": [{{"mesh": 0}}],
            "meshes": [{{"primitives": [{{"attributes": {{"POSITION": 0}}}}]}}],
            "accessors": [{{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0],
            "max": [1, 1, 0]}}], "bufferViews": [{{"buffer": 0, "byteLength": 36}}],
            "buffers": [{{"uri": "{uri}", "byteLength": 36}}]}}"#
        )
    };
    let triangle = [0f32, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0].map(f32::to_le_bytes);
    // The bytes are there and right, but not to be had from outside.
    for place in ["secret.bin", "inside/own.bin"] {
        write(dir.path(), place, triangle.as_flattened());
    }
    let secret = dir.path().join("secret.bin");
    for uri in ["../secret.bin", "%2e%2e/secret.bin", secret.to_str().unwrap()] {
        write(dir.path(), "inside/s.gltf", scene(uri));
        sweep_refused(dir.path(), &["inside/s.gltf", "URI"]);
    }
    write(dir.path(), "inside/s.gltf", scene("own.bin"));
    sweep(dir.path(), "out").ok();
}

#[test]
fn layer_files() {
    let dir = folder("fog: {model: layered, file: layers.csv, phase: {hg: 0.8}}\n");
    sweep_refused(dir.path(), &["cannot read layers.csv", "No such file"]);
    write(dir.path(), "layers.csv", "altitude_m,sigma_t_1_m\n0,0.1\n5,thick\n");
    sweep_refused(dir.path(), &["layers.csv:3", "`sigma_t_1_m`", "found `thick`; expected a finite number"]);
}

#[test]
fn unwritable_output() {
    let dir = folder("fog: none\n");
    write(dir.path(), "file", "in the way");
    for out in ["file", "file/out"] {
        refused(&sweep(dir.path(), out), &["cannot create", out]);
    }
    assert_eq!(fs::read(dir.path().join("file")).unwrap(), b"in the way");
}

#[test]
fn folder_of_something_else() {
    let dir = folder("fog: none\n");
    let out = dir.path().join("photos");
    fs::create_dir(&out).unwrap();
    write(&out, "cat.jpg", "miaow");
    refused(&sweep(dir.path(), "photos"), &["photos", "holds no Fogbank data set", "`cat.jpg`"]);
    assert_eq!(names(&out), ["cat.jpg"]);
}

#[test]
fn folder_of_another_configuration() {
    let dir = folder("fog: none\n");
    sweep(dir.path(), "out").ok();
    let before = crate::common::contents(&dir.path().join("out"));
    let other = ["render", "c.yaml", "--out", "out", "--cache-dir", &cache(), "--set", "render.samples=5"];
    let run = run(&other, dir.path());
    refused(&run, &["out holds a data set of another configuration", "render.samples: was 3, is now 5"]);
    assert!(!run.stderr.contains("sensor"), "only what changed: {}", run.stderr);
    assert!(before == crate::common::contents(&dir.path().join("out")), "the folder is as it was");
}

#[test]
fn wrong_arguments() {
    let dir = folder("fog: none\n");
    for (args, part) in [
        (vec!["sweep", "c.yaml"], "--out"),
        (vec!["sweep", "c.yaml", "--out", "out", "--threads", "0"], "0 is not in 1..=1024"),
        (vec!["swep", "c.yaml"], "'sweep'"),
        (vec!["scene", "stret"], "'street'"),
    ] {
        let run = run(&args, dir.path());
        assert_eq!(run.code, Some(2), "{args:?}");
        assert!(run.stderr.contains(part) && !run.stderr.contains("panicked"), "{args:?}: {}", run.stderr);
    }
    refused(&run(&["verify", "nowhere"], dir.path()), &["nowhere/dataset.json: entity not found\n"]);
    refused(&run(&["scene", "street", "--out", "no/where.glb"], dir.path()), &["cannot write no/where.glb"]);
    assert_eq!(names(dir.path()), ["c.yaml"]);
}
