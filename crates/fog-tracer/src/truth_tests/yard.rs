//! A small world of boxes, and cameras of every lens.

use fog_core::lens::{Distortion, Equirectangular, Fisheye, Intrinsics, Lens, Pinhole, RadialTangential};
use fog_core::{DMat4, DVec3, Vec3A, math};
use fog_scene::camera::{Camera, Pose};
use fog_scene::labels::Labels;
use fog_scene::scene::Scene;
use fog_scene::{Geometry, LoadedScene, Material, SceneNode, SceneObject, Triangle};
use std::sync::Arc;

/// A box: name, class, middle of its foot, size, heading in degrees.
pub(super) type Block = (&'static str, &'static str, [f64; 3], [f64; 3], f64);

/// A ground with a car, a van that it hides in part, a person, a sign beside the image, and a wall behind all.
pub(super) const YARD: [Block; 6] = [
    ("ground", "terrain", [0.0, -1.0, -30.0], [80.0, 1.0, 100.0], 0.0),
    ("car", "car", [-1.5, 0.0, -12.0], [1.8, 1.5, 4.2], 30.0),
    ("van", "truck", [0.0, 0.0, -17.0], [2.2, 2.6, 5.0], -20.0),
    ("walker", "person", [2.5, 0.0, -9.0], [0.5, 1.8, 0.4], 10.0),
    ("sign", "traffic sign", [6.6, 0.0, -9.5], [2.0, 2.4, 0.1], 0.0),
    ("wall", "wall", [0.0, 0.0, -40.0], [60.0, 16.0, 0.5], 0.0),
];

/// World from the axes of a node at a place, facing a heading.
fn place(at: [f64; 3], heading_deg: f64) -> DMat4 {
    let (sin, cos) = (math::f64::sin(heading_deg.to_radians()), math::f64::cos(heading_deg.to_radians()));
    let right = DVec3::new(cos, 0.0, sin).extend(0.0);
    let back = DVec3::new(-sin, 0.0, cos).extend(0.0);
    DMat4::from_cols(right, DVec3::Y.extend(0.0), back, DVec3::from(at).extend(1.0))
}

fn faces(world: &DMat4, size: [f64; 3], object: u32) -> Vec<Triangle> {
    let corner = |i: usize| {
        let share = |axis: usize| f64::from(u8::from(i >> axis & 1 == 1));
        let local = DVec3::new((share(0) - 0.5) * size[0], share(1) * size[1], (share(2) - 0.5) * size[2]);
        world.transform_point3(local).as_vec3()
    };
    let sides = [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];
    let halves = sides.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]);
    halves.map(|t| Triangle { object, ..Triangle::flat(t.map(corner)) }).collect()
}

/// The scene of some blocks, the car with two keypoints.
pub(super) fn scene(blocks: &[Block]) -> Scene {
    let (mut triangles, mut nodes, mut objects) = (Vec::new(), Vec::new(), Vec::new());
    for (&(name, class, at, size, heading), i) in blocks.iter().zip(0u32..) {
        let world = place(at, heading);
        triangles.extend(faces(&world, size, i));
        let keypoints = match name {
            "car" => vec![
                ("roof".to_owned(), DVec3::new(0.0, size[1], 0.0)),
                ("underside".to_owned(), DVec3::new(0.0, 0.1, 0.0)),
            ],
            _ => Vec::new(),
        };
        let class = Some(class.to_owned());
        let (name, mesh) = (name.to_owned(), None);
        objects.push(SceneObject { node: i, name: name.clone(), mesh, class: class.clone(), instance: None });
        nodes.push(SceneNode { name, parent: None, class, instance: None, keypoints, world });
    }
    let material = Material { base_color: [0.2, 0.4, 0.6, 1.0], metallic: 0.0, ..Material::default() };
    let geometry = Geometry::new(triangles, Vec::new());
    let loaded =
        LoadedScene { geometry, nodes, objects, materials: vec![material], ..LoadedScene::default() };
    Scene::new(Arc::new(loaded), None, None, None, false)
}

pub(super) fn labels(scene: &Scene) -> Labels {
    Labels::new(scene.loaded(), &[]).expect("few instances")
}

/// The position, heading, pitch and roll of a driver's eye.
pub(super) fn pose(x: f32, z: f32, heading_deg: f64) -> Pose {
    Pose::new(Vec3A::new(x, 1.6, z), heading_deg, -3.0, 2.0)
}

/// Cameras of every lens, 160 × 90.
pub(super) fn cameras(pose: Pose) -> Vec<Camera> {
    let (width, height) = (160, 90);
    let intrinsics = |f: f64| Intrinsics { fx_px: f, fy_px: 1.03 * f, cx_px: 81.0, cy_px: 43.5 };
    let distortion = Distortion { k: [-0.2, 0.05, 0.0, 0.0, 0.0, 0.0], p: [1e-3, -5e-4] };
    let lenses = [
        Lens::Pinhole(Pinhole::from_fov(width, height, 60.0)),
        Lens::RadialTangential(
            RadialTangential::new(intrinsics(120.0), distortion, width, height).expect("a lens"),
        ),
        Lens::Fisheye(
            Fisheye::new(intrinsics(55.0), [-0.01, 0.0, 0.0, 0.0], 170.0, width, height).expect("a lens"),
        ),
        Lens::Equirectangular(Equirectangular::new(width, height, 360.0, [-90.0, 90.0])),
    ];
    lenses.into_iter().map(|lens| Camera { pose, width, height, lens, shutter: None }).collect()
}
