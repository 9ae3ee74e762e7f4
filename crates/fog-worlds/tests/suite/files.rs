//! Bytes, labels and bad options.

use super::common::{json, repository};
use fog_worlds::{ApproachLights, CLASSES, Highway, Runway, Style, Targets, Urban, World};

/// `FOGBANK_BLESS=1` writes the files.
#[test]
fn shipped_scenes_are_what_the_generators_write() {
    for (name, world) in [("street", World::Street), ("runway", World::Runway(Runway::default()))] {
        let bytes = world.glb(1).unwrap();
        let path = repository("scenes").join(format!("{name}.glb"));
        if std::env::var_os("FOGBANK_BLESS").is_some_and(|v| v == "1") {
            std::fs::write(&path, &bytes).unwrap();
        }
        let same = std::fs::read(&path).unwrap() == bytes;
        assert!(same, "{} differs: FOGBANK_BLESS=1 rewrites it", path.display());
        assert!(bytes.len() < 1_500_000);
    }
}

/// Small worlds of every kind.
fn worlds() -> Vec<World> {
    let urban = Urban { length_m: 80.0, traffic: 1.0, ..Urban::default() };
    vec![
        World::Urban(Urban { style: Style::Mutcd, ..urban }),
        World::Highway(Highway { length_m: 200.0, ..Highway::default() }),
        World::Runway(Runway { length_m: 1200.0, approach: ApproachLights::Malsr, ..Runway::default() }),
        World::Targets(Targets::default()),
    ]
}

#[test]
fn a_seed_decides_every_byte() {
    for world in worlds() {
        let first = world.glb(3).unwrap();
        assert!(first == world.glb(3).unwrap());
        let other = world.glb(4).unwrap();
        // Targets leave nothing to chance.
        assert_eq!(first == other, matches!(world, World::Targets(_)), "{world:?}");
    }
}

#[test]
fn every_node_has_a_known_class_and_an_instance() {
    for world in worlds() {
        let root = json(&world.glb(1).unwrap());
        let mut names = std::collections::BTreeSet::new();
        for node in root["nodes"].as_array().unwrap() {
            let class = node["extras"]["class"].as_str().unwrap();
            assert!(CLASSES.contains(&class), "{node}");
            assert!(!node["extras"]["instance"].as_str().unwrap().is_empty(), "{node}");
            assert!(names.insert(node["name"].as_str().unwrap().to_owned()), "two nodes: {node}");
        }
    }
}

#[test]
fn bad_options_say_what_is_valid() {
    let message = |world: World| world.glb(1).unwrap_err().to_string();
    let runway = Runway { designator: "37".into(), ..Runway::default() };
    assert_eq!(
        message(World::Runway(runway)),
        "designator is 37; valid: 01 to 36, with L, C, R or no letter"
    );
    let runway = Runway { width_m: 31.0, ..Runway::default() };
    assert_eq!(message(World::Runway(runway)), "width of the runway is 31; valid: 30, 45 or 60 m");
    let urban = Urban { length_m: f32::NAN, ..Urban::default() };
    assert_eq!(message(World::Urban(urban)), "length of the street is NaN; valid: 80 to 600 m");
    let highway = Highway { traffic: 1.5, ..Highway::default() };
    assert_eq!(message(World::Highway(highway)), "traffic is 1.5; valid: 0 to 1");
    let targets = Targets { boards_m: Vec::new(), ..Targets::default() };
    assert_eq!(message(World::Targets(targets)), "boards is a list of 0; valid: 1 to 5 distances");
}
