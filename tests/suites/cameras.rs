//! Two views of one scene agree through their truth, whatever the lens and the shutter.

use fog_core::Vec3A;
use fog_core::lens::{Distortion, Equirectangular, Fisheye, Intrinsics, Lens, Pinhole, RadialTangential};
use fog_scene::camera::{Camera, Pose, Ray, Shutter};
use fog_scene::scene::Scene;
use fog_tests::scenes;
use fog_tracer::truth::truth;

const WIDTH: u32 = 96;
const HEIGHT: u32 = 64;

/// Lenses for an image of 96×64 pixels.
fn lenses() -> [(&'static str, Lens); 5] {
    let k = Intrinsics { fx_px: 70.0, fy_px: 72.0, cx_px: 45.0, cy_px: 33.0 };
    let bent = Distortion { k: [-0.2, 0.04, 0.0, 0.0, 0.0, 0.0], p: [0.002, -0.003] };
    let round = Intrinsics::centred(24.0, WIDTH, HEIGHT);
    [
        ("pinhole", Lens::Pinhole(Pinhole::new(k))),
        ("opencv", Lens::RadialTangential(RadialTangential::new(k, bent, WIDTH, HEIGHT).expect("no fold"))),
        (
            "fisheye",
            Lens::Fisheye(
                Fisheye::new(round, [-0.02, 0.001, 0.0, 0.0], 200.0, WIDTH, HEIGHT).expect("no fold"),
            ),
        ),
        ("panorama", Lens::Equirectangular(Equirectangular::new(WIDTH, HEIGHT, 360.0, [-90.0, 90.0]))),
        ("band", Lens::Equirectangular(Equirectangular::new(WIDTH, HEIGHT, 200.0, [-30.0, 20.0]))),
    ]
}

/// What a ray meets.
fn meets(scene: &Scene, ray: &Ray) -> Option<(Vec3A, f32)> {
    let hit = scene.intersect(ray.origin, ray.direction, f32::INFINITY)?;
    Some((ray.origin + ray.direction * hit.t, hit.t))
}

#[test]
fn two_views_close_through_depth() {
    let scene = Scene::new(scenes::load("street_day.glb"), None, None, None, false);
    let first = Pose::new(Vec3A::new(0.0, 1.7, 0.0), 5.0, -4.0, 2.0);
    let second = Pose::new(Vec3A::new(0.6, 2.0, -1.5), -3.0, -2.0, -1.0);
    let rolled = Pose::new(Vec3A::new(0.1, 1.7, -0.4), 7.0, -4.0, 2.5);
    for (name, lens) in lenses() {
        for (shutter, what) in [(None, "global"), (Some(Shutter::new(first, rolled)), "rolling")] {
            let a = Camera { pose: first, width: WIDTH, height: HEIGHT, lens, shutter };
            let b = Camera { pose: second, shutter: None, ..a };
            let truth = truth(&scene, &a, None);
            let (mut closed, mut worst) = (0, 0.0f64);
            for i in 0..(WIDTH * HEIGHT) as usize {
                let (x, y) = ((i as u32 % WIDTH) as f64 + 0.5, (i as u32 / WIDTH) as f64 + 0.5);
                let depth = truth.depth_m[i];
                if !depth.is_finite() {
                    assert_eq!(depth.is_nan(), lens.direction(x, y).is_none(), "{name}: pixel {i}");
                    continue;
                }
                // From the depth that the data set has, as its reader would: z along the axis, or the distance.
                let direction = lens.direction(x, y).expect("seen");
                let [dx, dy, dz] = direction;
                let length = (dx * dx + dy * dy + dz * dz).sqrt();
                let scale = match lens {
                    Lens::Equirectangular(_) => f64::from(depth) / length,
                    _ => f64::from(depth) / dz,
                };
                let pose = a.pose_at(y);
                let point = pose.position + pose.to_world(direction.map(|c| c * scale));
                let Some(seen) = b.project(point).filter(|p| b.contains(*p)) else { continue };
                // Unless something stands in front of it, the other view's ray ends there and comes back to the pixel.
                let ray = b.ray(seen[0], seen[1]).expect("projected");
                let Some((met, t)) = meets(&scene, &ray) else { continue };
                let far = (point - ray.origin).length();
                if (t - far).abs() > 1e-3 * far {
                    continue;
                }
                let [px, py] = a.project(met).expect("seen before");
                // Across the seam of a panorama columns jump by the width.
                let across = (px - x).abs().min((f64::from(WIDTH) - (px - x).abs()).abs());
                worst = worst.max(across).max((py - y).abs());
                closed += 1;
            }
            assert!(closed > 1000, "{name}, {what}: {closed} pixels are seen by both");
            assert!(worst < 0.01, "{name}, {what}: off by {worst} px");
        }
    }
}

#[test]
fn rectified_stereo_has_disparity_by_depth() {
    let scene = Scene::new(scenes::load("street_day.glb"), None, None, None, false);
    let (focal, base) = (80.0, 0.12f32);
    let lens = Lens::Pinhole(Pinhole::new(Intrinsics::centred(focal, WIDTH, HEIGHT)));
    let left = Pose::new(Vec3A::new(0.0, 1.7, 0.0), 20.0, -3.0, 0.0);
    let right = Pose { position: left.position + base * left.right, ..left };
    let camera = |pose| Camera { pose, width: WIDTH, height: HEIGHT, lens, shutter: None };
    let (a, b) = (camera(left), camera(right));
    let depth = truth(&scene, &a, None).depth_m;
    let mut seen = 0;
    for (i, z) in depth.iter().enumerate().filter(|(_, z)| z.is_finite()) {
        let (x, y) = ((i as u32 % WIDTH) as f64 + 0.5, (i as u32 / WIDTH) as f64 + 0.5);
        let (point, _) = meets(&scene, &a.ray(x, y).expect("seen")).expect("a surface");
        let [px, py] = b.project(point).expect("in front");
        let disparity = focal * f64::from(base) / f64::from(*z);
        assert!(
            (x - px - disparity).abs() < 1e-3 && (py - y).abs() < 1e-3,
            "pixel {i}: {} for {disparity}",
            x - px
        );
        seen += 1;
    }
    assert!(seen > 1000, "{seen}");
}
