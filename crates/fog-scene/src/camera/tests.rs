use super::*;
use fog_core::lens::{Distortion, Equirectangular, Fisheye, Intrinsics, RadialTangential};

fn close(a: Vec3A, b: Vec3A) {
    assert!((a - b).length() < 1e-6, "{a} {b}");
}

fn direction(camera: &Camera, x: f64, y: f64) -> Vec3A {
    camera.ray(x, y).unwrap().direction
}

/// A pose that is turned about all axes.
fn turned() -> Pose {
    Pose::new(Vec3A::new(3.0, 2.0, -7.0), 33.0, -20.0, 10.0)
}

/// Cameras of all lenses, of 320×180 pixels.
fn cameras() -> Vec<Camera> {
    let camera = |lens| Camera { pose: turned(), width: 320, height: 180, lens, shutter: None };
    let intrinsics = Intrinsics { fx_px: 200.0, fy_px: 210.0, cx_px: 150.0, cy_px: 95.0 };
    let bent = Distortion { k: [-0.2, 0.03, 0.0, 0.0, 0.0, 0.0], p: [0.002, -0.003] };
    let round = Intrinsics { fx_px: 60.0, fy_px: 60.0, ..intrinsics };
    vec![
        Camera::new(turned(), 320, 180, 60.0),
        camera(Lens::Pinhole(Pinhole::new(intrinsics))),
        camera(Lens::RadialTangential(RadialTangential::new(intrinsics, bent, 320, 180).unwrap())),
        camera(Lens::Fisheye(Fisheye::new(round, [-0.01, 0.0, 0.0, 0.0], 200.0, 320, 180).unwrap())),
        camera(Lens::Equirectangular(Equirectangular::new(320, 180, 360.0, [-90.0, 90.0]))),
    ]
}

#[test]
fn field_of_view_spans_the_width() {
    let c = Camera::new(Pose::new(Vec3A::ZERO, 0.0, 0.0, 0.0), 320, 180, 60.0);
    let (left, right) = (direction(&c, 0.0, 90.0), direction(&c, 320.0, 90.0));
    assert!((left.dot(right) - 0.5).abs() < 1e-6);
    assert!(left.x < 0.0 && direction(&c, 160.0, 0.0).y > 0.0);
    close(direction(&c, 160.0, 90.0), -Vec3A::Z);
}

#[test]
fn intrinsics_have_pixel_centres_at_integers() {
    let c = Camera::new(Pose::new(Vec3A::ZERO, 0.0, 0.0, 0.0), 321, 181, 60.0);
    let intrinsics = c.lens.intrinsics().unwrap();
    assert_eq!([intrinsics.cx_px, intrinsics.cy_px], [160.0, 90.0]);
    let same = Camera { lens: Lens::Pinhole(Pinhole::new(intrinsics)), ..c };
    close(direction(&same, 20.0, 30.0), direction(&c, 20.0, 30.0));
}

#[test]
fn image_points_come_back_from_their_rays() {
    for camera in cameras() {
        for (x, y) in [(0.5, 0.5), (160.0, 90.0), (319.5, 0.5), (20.25, 177.75), (200.0, 150.0)] {
            let Some(ray) = camera.ray(x, y) else { continue };
            assert!((ray.direction.length() - 1.0).abs() < 1e-6);
            let [px, py] = camera.project(ray.origin + ray.direction * 8.0).unwrap();
            // Positions are of single precision.
            assert!((px - x).abs() < 1e-3 && (py - y).abs() < 1e-3, "{camera:?} ({x}, {y}): ({px}, {py})");
        }
    }
}

#[test]
fn points_behind_a_pinhole_camera_have_no_image() {
    let camera = Camera::new(turned(), 320, 180, 60.0);
    assert_eq!(camera.project(camera.pose.position - camera.pose.forward), None);
    let beside =
        camera.project(camera.pose.position + camera.pose.forward + 3.0 * camera.pose.right).unwrap();
    assert!(!camera.contains(beside) && camera.contains([0.0, 179.9]) && !camera.contains([0.0, 180.0]));
}

#[test]
fn depth_is_planar_but_for_equirectangular_images() {
    for camera in cameras() {
        let Some(ray) = camera.ray(40.0, 60.0) else { continue };
        let want = match camera.lens {
            Lens::Equirectangular(_) => 9.0,
            _ => camera.pose.to_camera(ray.origin + ray.direction * 9.0)[2] as f32,
        };
        assert!((camera.depth(40.0, 60.0, 9.0) - want).abs() < 1e-5, "{camera:?}");
        assert_eq!(camera.depth(40.0, 60.0, f32::INFINITY), f32::INFINITY);
    }
}

#[test]
fn rolling_shutters_move_row_by_row() {
    let end = Pose::new(Vec3A::new(3.5, 2.1, -7.4), 36.0, -19.0, 9.0);
    for camera in cameras() {
        let rolling = Camera { shutter: Some(Shutter::new(camera.pose, end)), ..camera };
        for (y, want) in [(0.0, camera.pose), (180.0, end)] {
            let pose = rolling.pose_at(y);
            close(pose.position, want.position);
            close(pose.right, want.right);
            close(pose.down, want.down);
            close(pose.forward, want.forward);
        }
        // Half of the way and half of the turn.
        let middle = rolling.pose_at(90.0);
        close(middle.position, 0.5 * (camera.pose.position + end.position));
        assert!((middle.forward.dot(camera.pose.forward) - middle.forward.dot(end.forward)).abs() < 1e-6);
        for (x, y) in [(10.5, 20.5), (160.0, 90.0), (300.0, 170.5)] {
            let Some(ray) = rolling.ray(x, y) else { continue };
            let [px, py] = rolling.project(ray.origin + ray.direction * 30.0).unwrap();
            assert!((px - x).abs() < 1e-3 && (py - y).abs() < 1e-3, "{rolling:?} ({x}, {y}): ({px}, {py})");
        }
    }
}
