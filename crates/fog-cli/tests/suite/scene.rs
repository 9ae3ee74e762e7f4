//! `scene`: options reach the generators, mistakes are explained.

use super::common::{config, ids, read_json, run, sweep, write};
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

#[test]
fn a_configuration_makes_its_scene() {
    let dir = tempfile::tempdir().expect("temporary folder");
    let text = config(
        "scene: {generate: targets, boards_m: [5]}\nfog: none\nlighting: day\ncamera: {altitude_m: 2}\noutputs: [image, hdr]\n",
    );
    write(dir.path(), "c.yaml", &text);
    sweep(dir.path(), "out").ok();
    let record = read_json(&dir.path().join(format!("out/{}.json", ids(dir.path())[0])));
    assert_eq!(record["scene"]["generate"], "targets");
    // It is the file that `scene` writes.
    run(&["scene", "targets", "--boards-m", "5", "--out", "t.glb"], dir.path()).ok();
    let bytes = std::fs::read(dir.path().join("t.glb")).expect("read");
    assert_eq!(record["scene"]["blake3"], blake3::hash(&bytes).to_hex().as_str());

    let limited = |limits: &str| {
        let scene = format!("scene: {{generate: targets, limits: {limits}}}");
        write(dir.path(), "c.yaml", text.replace("scene: {generate: targets, boards_m: [5]}", &scene));
        let run = sweep(dir.path(), "limited");
        assert_eq!(run.code, Some(2), "{}", run.stderr);
        run.stderr
    };
    assert!(
        limited("{triangles: 10}").contains("POSITION has 102 elements; the limit on triangles allows 32")
    );
    assert!(limited("{nodes: 3}").contains("at most 3 are read (scene.limits.nodes)"));
    assert!(limited("{texture_px: 9}").contains("more than 9 pixels together (scene.limits.texture_px)"));
    assert!(limited("{file_bytes: 9}").contains("larger than 9 bytes together (scene.limits.file_bytes)"));
}
