//! `scene`: options reach the generators, mistakes are explained.

use super::common::run;
use std::fs;

#[test]
fn options_change_the_scene() {
    let dir = tempfile::tempdir().unwrap();
    let bytes = |args: &[&str]| {
        let args: Vec<&str> = ["scene"].iter().chain(args).chain(&["--out", "f.glb"]).copied().collect();
        run(&args, dir.path()).ok();
        fs::read(dir.path().join("f.glb")).unwrap()
    };
    let town = bytes(&["urban", "--length-m", "80"]);
    assert!(town == bytes(&["urban", "--length-m", "80", "--seed", "1", "--limit", "30"]));
    for other in
        [["--seed", "2"], ["--style", "mutcd"], ["--traffic", "1"], ["--people", "0"], ["--limit", "50"]]
    {
        assert!(town != bytes(&[["urban", "--length-m", "80"].as_slice(), &other].concat()), "{other:?}");
    }
    let targets = bytes(&["targets", "--boards-m", "4,8", "--black-m", "60"]);
    let text = String::from_utf8_lossy(&targets).into_owned();
    assert!(text.contains("checkerboard_1") && !text.contains("checkerboard_2") && !text.contains("black_1"));
    let runway = bytes(&["runway", "--designator", "09L", "--approach", "malsr", "--length-m", "1500"]);
    assert!(String::from_utf8_lossy(&runway).contains(r#""designators":["9L","27R"]"#));
}

#[test]
fn every_scene_has_its_own_help() {
    let dir = tempfile::tempdir().unwrap();
    let help = run(&["scene", "--help"], dir.path()).ok().stdout;
    for name in ["street", "urban", "highway", "runway", "targets"] {
        let own = run(&["scene", name, "--help"], dir.path()).ok().stdout;
        assert!(
            help.contains(name) && own.contains(&format!("fogbank scene {name}")) && own.contains("--seed")
        );
    }
}

#[test]
fn mistakes_are_explained() {
    let dir = tempfile::tempdir().unwrap();
    for (args, message) in [
        (["runway", "--papi-deg", "9"], "scene runway: angle of the PAPI is 9; valid: 2 to 5 degrees"),
        (
            ["highway", "--length-m", "20"],
            "scene highway: length of the motorway is 20; valid: 200 to 5000 m",
        ),
    ] {
        let failed = run(&[&["scene"], args.as_slice()].concat(), dir.path());
        assert_eq!((failed.code, failed.stderr.trim()), (Some(2), format!("fogbank: {message}").as_str()));
    }
}
