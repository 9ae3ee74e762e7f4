//! Flow against rays of the next camera.

use super::yard::{self, Block, YARD};
use crate::flow::{NextView, add_flow};
use crate::truth::truth;
use fog_film::SurfaceTruth;
use fog_scene::camera::Camera;
use fog_scene::scene::Scene;

/// The yard after the walker has gone on and turned.
fn later() -> Vec<Block> {
    let mut blocks = YARD.to_vec();
    blocks[3].2 = [1.6, 0.2, -8.5];
    blocks[3].4 = 60.0;
    blocks
}

fn flow(now: &Scene, camera: &Camera, then: &Scene, next: &Camera) -> SurfaceTruth {
    let mut surface = SurfaceTruth::default();
    let geometry = &then.loaded().geometry;
    add_flow(&mut surface, now, camera, Some(NextView { camera: next, geometry }));
    surface
}

#[test]
fn flow_is_reprojection_through_distance() {
    let scene = yard::scene(&YARD);
    let views = [yard::pose(0.3, 0.0, 5.0), yard::pose(0.0, -1.2, 2.0)].map(yard::cameras);
    for (camera, next) in views[0].iter().zip(&views[1]) {
        let surface = flow(&scene, camera, &scene, next);
        let distances = truth(&scene, camera, None).distance_m;
        let (mut valid, mut hidden, mut checked) = (0, 0, 0);
        for (i, &distance) in distances.iter().enumerate() {
            let centre = [(i % 160) as f64 + 0.5, (i / 160) as f64 + 0.5];
            let Some(ray) = camera.ray(centre[0], centre[1]) else {
                assert!(surface.flow[i][0].is_nan() && surface.flow_valid[i] == 0.0);
                continue;
            };
            if distance == f32::INFINITY {
                continue;
            }
            let point = ray.origin + distance * ray.direction;
            let Some(image) = next.project(point) else {
                assert!(surface.flow[i][0].is_nan() && surface.flow_valid[i] == 0.0);
                continue;
            };
            let found = [0, 1].map(|c: usize| centre[c] + f64::from(surface.flow[i][c]));
            let error = (found[0] - image[0]).hypot(found[1] - image[1]);
            assert!(error < 0.01, "pixel {i}: {found:?}, not {image:?}");
            checked += 1;
            let inside = next.contains(image);
            if surface.flow_valid[i] == 1.0 {
                valid += 1;
                assert!(inside);
                // The next camera meets the same point, which lies where this camera saw it.
                let back = next.ray(image[0], image[1]).expect("a ray");
                let hit = scene.intersect(back.origin, back.direction, f32::INFINITY).expect("a surface");
                let there = back.origin + hit.t * back.direction;
                let d = (there - point).length();
                let slack = 2e-3 * hit.t + 0.01;
                // At a grazing angle a little of the image is much of the surface.
                if d > slack {
                    let [x, y] = camera.project(there).expect("an image point");
                    assert!((x - centre[0]).hypot(y - centre[1]) < 0.05, "pixel {i}: {d} m apart");
                }
            } else if inside {
                hidden += 1;
                let d = (point - next.pose.position).length();
                let way = (point - next.pose.position) / d;
                let hit =
                    scene.intersect(next.pose.position, way, f32::INFINITY).expect("something in front");
                assert!(hit.t < d);
            }
        }
        assert!(valid > checked / 2 && hidden > 5, "{valid} and {hidden} of {checked}");
    }
}

#[test]
fn things_that_move_take_their_pixels_along() {
    let (now, then) = (yard::scene(&YARD), yard::scene(&later()));
    for camera in yard::cameras(yard::pose(0.3, 0.0, 5.0)) {
        let surface = flow(&now, &camera, &then, &camera);
        let (mut moved, mut still) = (0, 0);
        for i in 0..160 * 90 {
            let centre = [(i % 160) as f64 + 0.5, (i / 160) as f64 + 0.5];
            let Some(ray) = camera.ray(centre[0], centre[1]) else { continue };
            let hit = now.intersect(ray.origin, ray.direction, f32::INFINITY);
            let object = hit.map(|hit| now.loaded().geometry.surface(&hit).object);
            let [dx, dy] = surface.flow[i].map(f64::from);
            if object != Some(3) {
                // What stands still stays, hidden by the walker or not; so does the sky.
                assert!(dx.hypot(dy) < 0.01, "pixel {i}: {dx} {dy}");
                still += 1;
                continue;
            }
            moved += 1;
            // The point in the walker's own axes, carried along by them.
            let hit = hit.expect("the walker");
            let nodes = [&now, &then].map(|scene| scene.loaded().nodes[3].world);
            let point = (ray.origin + hit.t * ray.direction).as_dvec3();
            let carried = nodes[1].transform_point3(nodes[0].inverse().transform_point3(point));
            let [x, y] = camera.project(carried.as_vec3a()).expect("an image point");
            let error = (centre[0] + dx - x).hypot(centre[1] + dy - y);
            assert!(error < 0.01 && dx < -1.0, "pixel {i}: {error}, {dx}");
        }
        assert!(moved > 5 && still > 5000, "{moved} {still}");
    }
}

#[test]
fn without_a_next_frame_nothing_is_known() {
    let scene = yard::scene(&YARD);
    let camera = yard::cameras(yard::pose(0.0, 0.0, 0.0))[0];
    let mut surface = SurfaceTruth::default();
    add_flow(&mut surface, &scene, &camera, None);
    assert!(surface.flow.iter().all(|f| f[0].is_nan() && f[1].is_nan()));
    assert!(surface.flow_valid.iter().all(|&v| v == 0.0));
    // A scene with other triangles is no next frame.
    let other = yard::scene(&YARD[..2]);
    let surface = flow(&scene, &camera, &other, &camera);
    assert!(surface.flow_valid.iter().all(|&v| v == 0.0));
    // Turned round, the camera has no image of what it saw.
    let back = yard::cameras(yard::pose(0.0, 0.0, 180.0))[0];
    let surface = flow(&scene, &camera, &scene, &back);
    assert!(surface.flow.iter().all(|f| f[0].is_nan()));
}
