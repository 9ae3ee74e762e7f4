//! Truth per pixel is that of the centre ray, for every lens.

use super::yard::{self, YARD};
use crate::surface_truth::{SurfaceLayers, surface_truth};
use crate::truth::truth;
use fog_core::Vec3A;
use fog_scene::labels::ClassTable;

const ALL: SurfaceLayers = SurfaceLayers { normals: true, position: true, albedo: true };

#[test]
fn layers_are_those_of_centre_rays() {
    let scene = yard::scene(&YARD);
    let labels = yard::labels(&scene);
    for camera in yard::cameras(yard::pose(0.3, 0.0, 5.0)) {
        let surface = surface_truth(&scene, &camera, ALL, Some(&labels));
        let distances = truth(&scene, &camera, None).distance_m;
        let mut seen = std::collections::BTreeSet::new();
        for (i, &distance) in distances.iter().enumerate() {
            let centre = [(i % 160) as f64 + 0.5, (i / 160) as f64 + 0.5];
            let Some(ray) = camera.ray(centre[0], centre[1]) else {
                assert_eq!((surface.semantic[i], surface.instance[i]), (ClassTable::UNSEEN, 0));
                continue;
            };
            let [normal, position] = [surface.normal[i], surface.position[i]].map(Vec3A::from);
            if distance == f32::INFINITY {
                assert_eq!((surface.semantic[i], surface.instance[i]), (ClassTable::SKY, 0));
                assert!(position.is_nan() && normal == Vec3A::ZERO && surface.albedo[i] == [0.0; 3]);
                continue;
            }
            let hit = scene.intersect(ray.origin, ray.direction, f32::INFINITY).expect("a surface");
            let triangle = scene.loaded().geometry.triangles()[hit.triangle as usize];
            let (_, class, ..) = YARD[triangle.object as usize];
            assert_eq!(labels.table().name(surface.semantic[i]), class);
            assert_eq!(u32::from(surface.instance[i]), triangle.object + 1);
            seen.insert(surface.instance[i]);
            let side = triangle.normal();
            assert!((normal.length() - 1.0).abs() < 1e-5 && normal.dot(ray.direction) < 0.0);
            assert!((normal.dot(side).abs() - 1.0).abs() < 1e-5);
            assert!((position - ray.origin).length() / distance - 1.0 < 1e-5);
            let off_plane = (position - Vec3A::from(triangle.positions[0])).dot(side).abs();
            assert!(off_plane < 2e-5 * distance, "{off_plane} m at {distance} m");
            assert_eq!(surface.albedo[i], [0.2, 0.4, 0.6]);
            let [x, y] = camera.project(position).expect("an image point");
            assert!((x - centre[0]).hypot(y - centre[1]) < 0.01, "{x} {y} for {centre:?}");
        }
        assert!(seen.len() >= 5, "{:?} shows {seen:?}", camera.lens);
    }
}

#[test]
fn nothing_is_made_that_nobody_asked_for() {
    let scene = yard::scene(&YARD);
    let camera = yard::cameras(yard::pose(0.0, 0.0, 0.0))[0];
    let layers = SurfaceLayers { albedo: true, ..SurfaceLayers::default() };
    let surface = surface_truth(&scene, &camera, layers, None);
    assert_eq!(surface.albedo.len(), 160 * 90);
    assert!(surface.normal.is_empty() && surface.semantic.is_empty() && surface.flow.is_empty());
}
