//! Town and motorway measured.

use super::common::{Made, made, translation};
use fog_core::Vec3;
use fog_worlds::{Highway, Urban, World};
use serde_json::Value;

/// Size of the box around a node's mesh in its own axes.
fn size(made: &Made, node: &Value) -> Vec3 {
    let mesh = &made.json["meshes"][node["mesh"].as_u64().unwrap() as usize];
    let corner = |key: &str, pick: fn(Vec3, Vec3) -> Vec3| {
        let of = |primitive: &Value| {
            let accessor = primitive["attributes"]["POSITION"].as_u64().unwrap() as usize;
            let corner = &made.json["accessors"][accessor][key];
            Vec3::from_array([0, 1, 2].map(|i| corner[i].as_f64().unwrap() as f32))
        };
        mesh["primitives"].as_array().unwrap().iter().map(of).reduce(pick).unwrap()
    };
    corner("max", Vec3::max) - corner("min", Vec3::min)
}

fn of_class<'a>(made: &'a Made, class: &str) -> Vec<&'a Value> {
    let nodes = made.json["nodes"].as_array().unwrap().iter();
    nodes.filter(|n| n["extras"]["class"] == class && n.get("mesh").is_some()).collect()
}

/// Sizes that the things of the world have.
fn check_sizes(made: &Made) {
    let within = |class: &str, low: [f32; 3], high: [f32; 3]| {
        let nodes = of_class(made, class);
        for node in &nodes {
            let s = size(made, node);
            assert!(s.cmpge(low.into()).all() && s.cmple(high.into()).all(), "{class} {}: {s}", node["name"]);
        }
        nodes.len()
    };
    assert!(within("car", [1.9, 1.4, 4.0], [2.5, 2.1, 5.5]) > 5);
    assert!(within("truck", [2.4, 3.4, 8.0], [3.2, 4.0, 9.0]) > 0);
    within("bus", [2.4, 3.0, 11.9], [3.2, 3.5, 12.6]);
    within("person", [0.4, 1.45, 0.2], [0.9, 1.95, 1.2]);
    within("bicycle", [0.5, 1.0, 1.6], [0.7, 1.1, 1.8]);
    within("rider", [0.4, 1.4, 0.6], [0.9, 1.9, 1.2]);
    assert!(within("license plate", [0.3, 0.1, 0.01], [0.54, 0.17, 0.03]) > 5);
    // Plates are parts of their vehicles.
    for plate in of_class(made, "license plate") {
        let (name, instance) =
            (plate["name"].as_str().unwrap(), plate["extras"]["instance"].as_str().unwrap());
        assert_eq!(name.rsplit_once("_plate_").unwrap().0, instance);
        assert!(made.json["nodes"].as_array().unwrap().iter().any(|node| node["name"] == instance));
    }
}

#[test]
fn town_has_what_a_town_has() {
    let full = Urban { traffic: 1.0, ..Urban::default() };
    let made = made(&World::Urban(full));
    check_sizes(&made);
    let counts =
        ["building", "street light", "traffic light", "traffic sign", "person", "vegetation", "bicycle"]
            .map(|class| of_class(&made, class).len());
    assert!(counts[0] >= 20 && counts[1] >= 10 && counts[2] == 4 && counts[3] == 11, "{counts:?}");
    assert!(counts[4] >= 10 && counts[5] >= 6 && counts[6] >= 1, "{counts:?}");
    // Lane, parking strip, kerb and pavement from the middle outward, where nothing stands.
    assert_eq!(made.seen([1.6, 0.5, 0.0], [0.0, -1.0, 0.0]).0, "road");
    assert_eq!(made.seen([3.25, 0.05, 0.0], [0.0, -1.0, 0.0]).0, "marking");
    let (class, t) = made.seen([6.0, 1.0, -2.2], [0.0, -1.0, 0.0]);
    assert_eq!((class.as_str(), (t - 0.88).abs() < 1e-3), ("sidewalk", true));
    // No vehicle stands in another of its lane, or where the camera is.
    for x in [1.625f32, -1.625] {
        let mut spans: Vec<[f32; 2]> = ["car", "truck", "bus"]
            .into_iter()
            .flat_map(|class| of_class(&made, class))
            .filter(|n| (translation(n)[0] - x).abs() < 0.01)
            .map(|n| [translation(n)[2] - 0.5 * size(&made, n).z, translation(n)[2] + 0.5 * size(&made, n).z])
            .collect();
        spans.sort_by(|a, b| a[0].total_cmp(&b[0]));
        assert!(spans.windows(2).all(|p| p[0][1] + 2.0 < p[1][0]), "{spans:?}");
        assert!(x < 0.0 || spans.iter().all(|s| s[0] > 1.0 || s[1] < -5.0), "{spans:?}");
    }
    // Low beams are cut off a little under level: above it there is stray light alone.
    let beams: Vec<_> = made.scene.lights.lamps.iter().filter(|l| l.axis().unwrap().y > -0.9).collect();
    assert!(beams.len() >= 4);
    for lamp in beams {
        // The middle of the light is a little aside of straight on.
        let axis = lamp.axis().unwrap();
        let along_x = axis.x.abs() > axis.z.abs();
        let forward = fog_core::Vec3A::from(if along_x {
            Vec3::X * axis.x.signum()
        } else {
            Vec3::Z * axis.z.signum()
        });
        let candela =
            |rise: f32| lamp.intensity[1] * lamp.falloff((forward + fog_core::Vec3A::Y * rise).normalize());
        assert!(candela(0.01) < 300.0, "{}", candela(0.01));
        assert!(candela(-0.015) > 5_100.0, "{}", candela(-0.015));
        assert!(lamp.position.y > 0.5 && lamp.position.y < 1.1);
    }
}

#[test]
fn motorway_has_posts_every_50_m() {
    let made = made(&World::Highway(Highway { length_m: 400.0, traffic: 0.8, ..Highway::default() }));
    check_sizes(&made);
    let posts = made.nodes("post_right");
    assert_eq!(posts.len(), 13);
    for pair in posts.windows(2) {
        let (a, b) = (translation(pair[0]), translation(pair[1]));
        assert!((a[2] - b[2] - 50.0).abs() < 1e-3 && (a[0] - 17.0).abs() < 1e-3);
    }
    assert!(translation(posts[4])[2] == 0.0);
    assert_eq!(made.below(11.625, 0.0), "road");
    assert_eq!(made.below(0.1, -90.0), "wall");
    assert_eq!(made.nodes("gantry_sign").len(), 2);
}
