//! Targets lie where their nodes say.

use super::common::{made, translation};
use fog_core::Vec3A;
use fog_worlds::{Targets, World};
use serde_json::Value;

fn point(value: &Value) -> Vec3A {
    Vec3A::from_array([0, 1, 2].map(|i| value[i].as_f64().unwrap() as f32))
}

#[test]
fn boards_and_markers_are_where_they_say() {
    let made = made(&World::Targets(Targets::default()));
    let eye = Vec3A::new(0.0, 2.0, 0.0);
    // Reflectance of what the eye sees in the direction of a point, and the distance to it.
    let seen = |p: Vec3A| {
        let geometry = &made.scene.geometry;
        let hit = geometry.intersect(eye, (p - eye).normalize(), 1e4).unwrap();
        let surface = geometry.surface(&hit);
        let material = &made.scene.materials[surface.material as usize];
        (material.evaluate(&made.scene.textures, &surface.uv).base_color[0], hit.t)
    };
    for board in made.nodes("checkerboard") {
        let facts = &board["extras"];
        let (first, along, down) =
            (point(&facts["first_corner_m"]), point(&facts["along_m"]), point(&facts["down_m"]));
        let distance = Vec3A::from_array(translation(board)).with_y(0.0).length();
        assert!((distance - facts["distance_m"].as_f64().unwrap() as f32).abs() < 1e-3);
        let n = |i: usize| facts["inner_corners"][i].as_u64().unwrap();
        for i in 0..n(0) {
            for j in 0..n(1) {
                let corner = first + along * i as f32 + down * j as f32;
                assert!((seen(corner).1 - (corner - eye).length()).abs() < 1e-3);
                // Four squares meet: the upper left and lower right ones have the colour that the others have not.
                let square = |a: f32, b: f32| seen(corner + a * along + b * down).0 < 0.4;
                let black = (i + j) % 2 == 0;
                assert_eq!([square(-0.1, -0.1), square(0.1, 0.1)], [black; 2], "{i} {j}");
                assert_eq!([square(0.1, -0.1), square(-0.1, 0.1)], [!black; 2], "{i} {j}");
            }
        }
    }
    let markers = made.nodes("aruco");
    assert_eq!(markers.len(), 8);
    for marker in markers {
        let facts = &marker["extras"];
        let corners: Vec<Vec3A> = facts["corners_m"].as_array().unwrap().iter().map(point).collect();
        let middle = corners.iter().copied().sum::<Vec3A>() / 4.0;
        let size = facts["size_m"].as_f64().unwrap() as f32;
        assert!(((corners[1] - corners[0]).length() - size).abs() < 1e-4);
        for corner in corners {
            assert!(seen(middle + 0.98 * (corner - middle)).0 < 0.1);
            assert!(seen(middle + 1.02 * (corner - middle)).0 > 0.7);
        }
    }
}

#[test]
fn black_targets_stand_against_the_sky() {
    let options = Targets { black_m: vec![30.0, 3000.0], ..Targets::default() };
    let made = made(&World::Targets(options));
    for target in made.nodes("black") {
        let facts = &target["extras"];
        let number = |key: &str| facts[key].as_f64().unwrap() as f32;
        let [x, _, z] = translation(target);
        assert!(((x * x + z * z).sqrt() - number("distance_m")).abs() < 1e-3 * number("distance_m"));
        // Seen at the horizon from the eye, and higher up by half of its width.
        let (_, t) = made.seen([0.0, 2.0, 0.0], [x, 0.0, z]);
        assert!((t / number("distance_m") - 1.0).abs() < 1e-4);
        let subtends = 2.0 * fog_core::math::f32::atan2(0.5 * number("width_m"), number("distance_m"));
        assert!((subtends.to_degrees() - 2.0).abs() < 1e-3);
        assert!((number("height_m") - 2.0 - number("width_m")).abs() < 1e-3);
    }
}
