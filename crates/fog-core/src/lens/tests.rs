use super::*;
use std::f64::consts::PI;

const WIDTH: u32 = 1280;
const HEIGHT: u32 = 720;
const INTRINSICS: Intrinsics = Intrinsics { fx_px: 700.0, fy_px: 710.0, cx_px: 630.25, cy_px: 355.5 };

fn plane(k: [f64; 6], p: [f64; 2]) -> Result<RadialTangential, LensError> {
    RadialTangential::new(INTRINSICS, Distortion { k, p }, WIDTH, HEIGHT)
}

fn fisheye(k: [f64; 4], fov: f64) -> Result<Fisheye, LensError> {
    Fisheye::new(INTRINSICS, k, fov, WIDTH, HEIGHT)
}

/// One lens of each kind and then some.
fn lenses() -> Vec<Lens> {
    let plane = |k, p| Lens::RadialTangential(plane(k, p).unwrap());
    let fisheye = |k, fov| Lens::Fisheye(fisheye(k, fov).unwrap());
    vec![
        Lens::Pinhole(Pinhole::new(INTRINSICS)),
        Lens::Pinhole(Pinhole::from_fov(WIDTH, HEIGHT, 120.0)),
        plane([0.0; 6], [0.0; 2]),
        plane([-0.28, 0.07, -0.006, 0.0, 0.0, 0.0], [0.0; 2]),
        plane([0.12, 0.03, 0.002, 0.0, 0.0, 0.0], [0.0004, -0.0007]),
        plane([-0.15, 0.02, 0.0, 0.0, 0.0, 0.0], [0.004, -0.006]),
        plane([3.2, 1.4, 0.05, 3.55, 2.4, 0.3], [0.0006, -0.0003]),
        fisheye([0.0; 4], 360.0),
        fisheye([-0.02, 0.004, -0.0008, 0.0001], 100.0),
        fisheye([0.08, -0.03, 0.012, -0.002], 140.0),
        Lens::Equirectangular(Equirectangular::new(WIDTH, HEIGHT, 360.0, [-90.0, 90.0])),
        Lens::Equirectangular(Equirectangular::new(WIDTH, HEIGHT, 200.0, [-30.0, 20.0])),
    ]
}

/// Points all over the image, its borders and its middle among them.
fn image_points() -> impl Iterator<Item = [f64; 2]> {
    let along = |n: u32, size: u32| f64::from(n) / 16.0 * f64::from(size);
    (0..=16).flat_map(move |j| (0..=16).map(move |i| [along(i, WIDTH), along(j, HEIGHT)]))
}

#[test]
fn opencv_shows_points_at_the_same_places() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../tests/data/lens_opencv.csv");
    let text = std::fs::read_to_string(path).unwrap();
    let mut rows = 0;
    for line in text.lines().filter(|line| !line.starts_with('#')) {
        let cells: Vec<&str> = line.split(',').collect();
        let v: Vec<f64> = cells[2..].iter().map(|cell| cell.parse().unwrap()).collect();
        let lens = if cells[0] == "plane" {
            Lens::RadialTangential(plane([v[0], v[1], v[4], v[5], v[6], v[7]], [v[2], v[3]]).unwrap())
        } else {
            Lens::Fisheye(fisheye([v[0], v[1], v[2], v[3]], 160.0).unwrap())
        };
        let [x, y] = lens.image_point([v[8], v[9], v[10]]).unwrap();
        let error = (x - 0.5 - v[11]).abs().max((y - 0.5 - v[12]).abs());
        assert!(error < 1e-9, "{line}: {x} {y}");
        rows += 1;
    }
    assert_eq!(rows, 8 * 35);
}

#[test]
fn directions_are_exact_inverses() {
    let mut worst = 0.0f64;
    for lens in lenses() {
        let mut seen = 0;
        for [x, y] in image_points() {
            let Some(direction) = lens.direction(x, y) else { continue };
            // At a pole all columns are one direction, and the seam of an image of 360 degrees is both of its edges.
            let pole = direction[0].hypot(direction[2]) < 1e-9;
            let seam = matches!(lens, Lens::Equirectangular(_)) && (x == 0.0 || x == f64::from(WIDTH));
            if pole || seam {
                continue;
            }
            let [px, py] = lens.image_point(direction.map(|c| c * 3.0)).unwrap();
            worst = worst.max((px - x).abs()).max((py - y).abs());
            seen += 1;
        }
        assert!(seen > 200, "{lens:?}: {seen}");
    }
    assert!(worst < 1e-9, "{worst}");
}

#[test]
fn solid_angles_are_those_of_the_directions() {
    let normal = |[x, y, z]: [f64; 3]| glam::DVec3::new(x, y, z).normalize();
    for lens in lenses() {
        for [x, y] in image_points() {
            let at = |dx: f64, dy: f64| lens.direction(x + dx, y + dy).map(normal);
            let h = 1e-3;
            let [Some(left), Some(right), Some(up), Some(down)] =
                [at(-h, 0.0), at(h, 0.0), at(0.0, -h), at(0.0, h)]
            else {
                continue;
            };
            let found = lens.solid_angle(x, y);
            let want = (right - left).cross(down - up).length() / (4.0 * h * h);
            assert!((found - want).abs() <= 1e-5 * want + 1e-13, "{lens:?} ({x}, {y}): {found} {want}");
        }
    }
}

#[test]
fn solid_angles_add_up_to_what_is_seen() {
    let sum = |lens: &Lens, width: u32, height: u32| -> f64 {
        let pixels =
            (0..height).flat_map(|y| (0..width).map(move |x| [f64::from(x) + 0.5, f64::from(y) + 0.5]));
        pixels.map(|[x, y]| lens.solid_angle(x, y)).sum()
    };
    let sphere = Lens::Equirectangular(Equirectangular::new(256, 128, 360.0, [-90.0, 90.0]));
    assert!((sum(&sphere, 256, 128) / (4.0 * PI) - 1.0).abs() < 1e-4);
    // An equidistant fisheye whose circle of 220 degrees lies inside the image.
    let intrinsics = Intrinsics::centred(100.0, 400, 400);
    let lens = Lens::Fisheye(Fisheye::new(intrinsics, [0.0; 4], 220.0, 400, 400).unwrap());
    let want = 2.0 * PI * (1.0 - crate::math::f64::cos(110.0f64.to_radians()));
    assert!((sum(&lens, 400, 400) / want - 1.0).abs() < 2e-3);
    assert_eq!((lens.direction(5.0, 5.0), lens.solid_angle(5.0, 5.0)), (None, 0.0));
    assert!(lens.direction(200.0, 10.0).is_some_and(|[_, _, z]| z < 0.0));
}

#[test]
fn what_is_not_seen_has_no_image_point() {
    let pinhole = Lens::Pinhole(Pinhole::new(INTRINSICS));
    assert_eq!(pinhole.image_point([0.1, 0.2, -1.0]), None);
    // r (1 − 0.12 r²) grows up to r = 5/3 and falls beyond: from there points would come back into the image.
    let barrel = Lens::RadialTangential(plane([-0.12, 0.0, 0.0, 0.0, 0.0, 0.0], [0.0; 2]).unwrap());
    assert!(barrel.image_point([1.66, 0.0, 1.0]).is_some());
    assert_eq!(barrel.image_point([1.67, 0.0, 1.0]), None);
    let narrow = Lens::Fisheye(fisheye([0.0; 4], 90.0).unwrap());
    assert!(narrow.image_point([0.99, 0.0, 1.0]).is_some());
    assert_eq!(narrow.image_point([1.01, 0.0, 1.0]), None);
}

#[test]
fn distortion_that_folds_inside_the_image_is_refused() {
    // d/dr (r − 0.5 r³) = 0 at r = √(2/3), where the image radius is 2/3 of that.
    let error = plane([-0.5, 0.0, 0.0, 0.0, 0.0, 0.0], [0.0; 2]).unwrap_err();
    let LensError::Folds { radius, image_radius_px, .. } = error else { panic!("{error}") };
    assert!((radius - (2.0f64 / 3.0).sqrt()).abs() < 1e-12);
    assert!((image_radius_px / (700.0f64 * 710.0).sqrt() - 2.0 / 3.0 * radius).abs() < 1e-12);
    assert!(
        error.to_string().starts_with("the distortion folds back at 0.8165 (tangent of the angle)"),
        "{error}"
    );
    // d/dθ (θ − 0.5 θ³) = 0 at the same place, in radians: 46.8 degrees.
    let error = fisheye([-0.5, 0.0, 0.0, 0.0], 180.0).unwrap_err();
    assert!(error.to_string().starts_with("the distortion folds back at 46.7818 degrees"), "{error}");
    // Within a field of view that ends before, it is as good as any.
    assert!(fisheye([-0.5, 0.0, 0.0, 0.0], 90.0).is_ok());
    // A denominator with a zero is no fold: the image grows without bound before it. Tangential distortion may turn the
    // image over.
    let pole = Lens::RadialTangential(plane([0.0, 0.0, 0.0, -2.0, 0.0, 0.0], [0.0; 2]).unwrap());
    assert!(pole.direction(0.0, 0.0).is_some_and(|[x, y, _]| x * x + y * y < 0.5));
    assert_eq!(pole.image_point([0.8, 0.0, 1.0]), None);
    assert!(matches!(plane([0.0; 6], [0.6, 0.0]), Err(LensError::NoInverse { .. })));
}
