use super::*;

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
    let camera = |lens| Camera { pose: turned(), width: 320, height: 180, lens };
    let intrinsics = Intrinsics { fx_px: 200.0, fy_px: 210.0, cx_px: 150.0, cy_px: 95.0 };
    vec![Camera::new(turned(), 320, 180, 60.0), camera(Lens::Pinhole(Pinhole::new(intrinsics)))]
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
    assert_eq!([c.intrinsics().cx_px, c.intrinsics().cy_px], [160.0, 90.0]);
    let same = Camera { lens: Lens::Pinhole(Pinhole::new(c.intrinsics())), ..c };
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

/// Solid angle of the triangle that three unit directions span (Van Oosterom & Strackee 1983, Eq. 8).
fn solid_angle([a, b, c]: [glam::DVec3; 3]) -> f64 {
    let below = 1.0 + a.dot(b) + b.dot(c) + c.dot(a);
    2.0 * fog_core::math::f64::atan2(a.dot(b.cross(c)).abs(), below)
}

#[test]
fn solid_angles_of_pixels_are_those_of_their_corners() {
    for camera in cameras() {
        for (x, y) in [(4.5, 10.5), (160.5, 90.5), (300.5, 20.5)] {
            let at = |dx: f64, dy: f64| {
                let ray = camera.ray(x + dx, y + dy)?;
                Some(ray.direction.as_dvec3().normalize())
            };
            // A square of a fifth of a pixel, that single precision can still tell.
            let corners: Option<Vec<_>> = [(-0.1, -0.1), (0.1, -0.1), (0.1, 0.1), (-0.1, 0.1)]
                .map(|(dx, dy)| at(dx, dy))
                .into_iter()
                .collect();
            let Some(c) = corners else { continue };
            let want = (solid_angle([c[0], c[1], c[2]]) + solid_angle([c[0], c[2], c[3]])) / 0.04;
            let found = camera.pixel_solid_angle(x, y);
            assert!((found / want - 1.0).abs() < 1e-3, "{camera:?} ({x}, {y}): {found} {want}");
        }
    }
}
