//! Records of things against the masks and against rays of their own.

use super::yard::{self, YARD};
use crate::objects::{Hidden, LabelledView, ObjectTruth, objects};
use crate::surface_truth::{SurfaceLayers, surface_truth};
use crate::truth::truth;
use fog_core::lens::Lens;
use fog_core::phase::HenyeyGreenstein;
use fog_core::profile::ExtinctionProfile;
use fog_core::{Vec3A, math};
use fog_film::{Channels, Frame};
use fog_scene::camera::Camera;
use fog_scene::medium::Medium;
use fog_scene::phase::Phase;
use fog_scene::scene::Scene;

/// Radiance of the yard's things, and of the sky, in clear air.
const RADIANCES: [f32; 7] = [0.5, 0.1, 0.3, 0.52, 0.9, 0.2, 1.0];

/// A frame of known radiances through fog whose airlight is 1, with an error of 1 % of each pixel.
fn frame(scene: &Scene, camera: &Camera) -> Frame {
    let labels = yard::labels(scene);
    let mut truth = truth(scene, camera, None);
    truth.surface = surface_truth(scene, camera, SurfaceLayers::default(), Some(&labels));
    let n = truth.tau.len();
    let own = |i: usize| match truth.surface.instance[i] {
        0 => RADIANCES[6],
        id => RADIANCES[usize::from(id) - 1],
    };
    let through = |i: usize| if truth.tau[i].is_nan() { 1.0 } else { truth.transmittance[i][1] };
    let direct: Vec<_> = (0..n).map(|i| [own(i) * through(i); 3]).collect();
    let airlight: Vec<_> = (0..n).map(|i| [1.0 - through(i); 3]).collect();
    let standard_error = (0..n).map(|i| 0.01 * (direct[i][0] + airlight[i][0])).collect();
    let samples = vec![1; n];
    let (width, height, channels) = (camera.width, camera.height, Channels::Rgb);
    Frame {
        width,
        height,
        channels,
        samples,
        direct,
        airlight,
        standard_error,
        groups: Vec::new(),
        sensor: Vec::new(),
        truth,
    }
}

fn records(scene: &Scene, camera: &Camera, frame: &Frame, clear: Option<&Frame>) -> Vec<ObjectTruth> {
    let labels = yard::labels(scene);
    objects(&LabelledView { scene, camera, labels: &labels, frame, clear })
}

fn fog(sigma: f64) -> Medium {
    let profile = ExtinctionProfile::new(0.0, vec![-50.0, 500.0], vec![550.0], vec![sigma; 2], vec![1.0; 2]);
    let phase = Phase::HenyeyGreenstein(HenyeyGreenstein::new(0.8).expect("g"));
    Medium::new(profile.expect("a profile"), phase)
}

#[test]
fn boxes_and_pixels_agree_with_the_masks() {
    let scene = yard::scene(&YARD);
    for camera in yard::cameras(yard::pose(0.3, 0.0, 5.0)) {
        let frame = frame(&scene, &camera);
        let all = records(&scene, &camera, &frame, None);
        let mask = &frame.truth.surface.instance;
        let in_mask: std::collections::BTreeSet<u16> = mask.iter().copied().filter(|&id| id > 0).collect();
        let recorded = all.iter().filter(|o| o.visible_pixels > 0).map(|o| o.instance).collect();
        assert_eq!(in_mask, recorded);
        let sum: u64 = all.iter().map(|o| o.visible_pixels).sum();
        assert_eq!(sum, mask.iter().filter(|&&id| id > 0).count() as u64);
        for o in &all {
            let alone = yard::scene(&YARD[usize::from(o.instance) - 1..usize::from(o.instance)]);
            let mut bounds = [f64::INFINITY, f64::INFINITY, f64::NEG_INFINITY, f64::NEG_INFINITY];
            let mut pixels = 0;
            for i in 0..160 * 90usize {
                let [x, y] = [(i % 160) as f64 + 0.5, (i / 160) as f64 + 0.5];
                let Some(ray) = camera.ray(x, y) else { continue };
                if alone.intersect(ray.origin, ray.direction, f32::INFINITY).is_some() {
                    pixels += 1;
                    bounds = [bounds[0].min(x), bounds[1].min(y), bounds[2].max(x), bounds[3].max(y)];
                }
            }
            assert_eq!(o.silhouette_pixels, pixels, "{:?} of {:?}", o.instance, camera.lens);
            let hidden = 1.0 - o.visible_pixels as f64 / pixels as f64;
            assert!(pixels == 0 || (o.occlusion.expect("pixels") - hidden).abs() < 1e-12);
            // The full box holds every pixel of the silhouette and reaches to less than a pixel beyond, if the image does.
            let [l, t, r, b] = o.full_box.sides;
            assert!(l <= bounds[0] && t <= bounds[1] && r >= bounds[2] && b >= bounds[3]);
            if o.truncation == 0.0 && pixels > 100 {
                let gaps = [bounds[0] - l, bounds[1] - t, r - bounds[2], b - bounds[3]];
                assert!(gaps.iter().all(|gap| *gap < 1.6), "{gaps:?} of {} {:?}", o.instance, camera.lens);
            }
            if let Some([l, t, r, b]) = o.visible_box {
                let shown = |x: u32, y: u32| mask[(y * 160 + x) as usize] == o.instance;
                let count = (t..b).flat_map(|y| (l..r).map(move |x| (x, y))).filter(|&(x, y)| shown(x, y));
                assert_eq!(count.count() as u64, o.visible_pixels);
                let row = |y: u32| (l..r).any(|x| shown(x, y));
                let column = |x: u32| (t..b).any(|y| shown(x, y));
                assert!(row(t) && row(b - 1) && column(l) && column(r - 1));
            }
        }
    }
}

#[test]
fn what_is_hidden_and_what_is_cut_off() {
    let scene = yard::scene(&YARD);
    let camera = yard::cameras(yard::pose(0.3, 0.0, 5.0))[0];
    let all = records(&scene, &camera, &frame(&scene, &camera), None);
    let of = |id: u16| all.iter().find(|o| o.instance == id).expect("a record");
    // The car hides a part of the van; nothing hides the car or the walker.
    assert!((0.05..0.95).contains(&of(3).occlusion.expect("pixels")), "{:?}", of(3).occlusion);
    assert_eq!((of(2).occlusion, of(4).occlusion), (Some(0.0), Some(0.0)));
    assert_eq!((of(2).truncation, of(4).truncation), (0.0, 0.0));
    // The same camera with a wider image sees the whole sign.
    let sign = of(5);
    let mut wide = camera;
    let Lens::Pinhole(lens) = camera.lens else { panic!("a pinhole") };
    wide.width = 400;
    wide.lens = Lens::Pinhole(lens);
    let whole = records(&scene, &wide, &frame(&scene, &wide), None);
    let whole = whole.iter().find(|o| o.instance == 5).expect("a record");
    assert_eq!(whole.truncation, 0.0);
    let share = 1.0 - sign.silhouette_pixels as f64 / whole.silhouette_pixels as f64;
    assert!(share > 0.1 && (sign.truncation - share).abs() < 1e-12, "{share} {}", sign.truncation);
    assert!(sign.full_box.sides.iter().zip(whole.full_box.sides).all(|(a, b)| (a - b).abs() < 1e-3));
    // The ground goes on behind the camera.
    assert!(of(1).full_box.is_cut && !sign.full_box.is_cut);
    // Behind the camera there is nothing to tell of.
    let back = yard::cameras(yard::pose(0.3, 0.0, 185.0))[0];
    let behind: Vec<u16> =
        records(&scene, &back, &frame(&scene, &back), None).iter().map(|o| o.instance).collect();
    assert_eq!(behind, [1]);
}

#[test]
fn boxes_in_the_world_distances_and_keypoints() {
    let scene = yard::scene(&YARD);
    let camera = yard::cameras(yard::pose(0.3, 0.0, 5.0))[0];
    let all = records(&scene, &camera, &frame(&scene, &camera), None);
    for o in &all {
        let (_, _, foot, size, heading) = YARD[usize::from(o.instance) - 1];
        let b = o.oriented_box;
        assert!(b.is_of_node);
        let near =
            |found: [f64; 3], want: [f64; 3]| found.iter().zip(want).all(|(f, w)| (f - w).abs() < 1e-4);
        assert!(near(b.size.to_array(), size), "{} for {size:?}", b.size);
        assert!(near(b.centre.to_array(), [foot[0], foot[1] + 0.5 * size[1], foot[2]]));
        let forward = -b.axes.z_axis;
        let found = math::f64::atan2(forward.x, -forward.z).to_degrees();
        assert!((found - heading).abs() < 1e-4, "{found} {heading}");
        // No pixel is nearer than the nearest point.
        assert!(o.nearest_m <= (b.centre - camera.pose.position.as_dvec3()).length());
    }
    assert!((all[0].nearest_m - 1.6).abs() < 1e-5, "{}", all[0].nearest_m);
    let names: Vec<_> = all[1].keypoints.iter().map(|k| (k.name.as_str(), k.is_visible)).collect();
    assert_eq!(names, [("roof", true), ("underside", false)]);
    let roof = &all[1].keypoints[0];
    let image = roof.image.expect("in view");
    let want = camera.project(Vec3A::new(-1.5, 1.5, -12.0)).expect("in view");
    assert!((image[0] - want[0]).hypot(image[1] - want[1]) < 1e-3 && roof.transmittance == 1.0);
}

#[test]
fn fog_hides_what_would_stand_out() {
    let clear_scene = yard::scene(&YARD);
    let camera = yard::cameras(yard::pose(0.3, 0.0, 5.0))[0];
    let clear = frame(&clear_scene, &camera);
    let verdicts = |sigma: f64, pair: bool| {
        let mut scene = yard::scene(&YARD);
        scene.medium = Some(fog(sigma));
        let frame = frame(&scene, &camera);
        let all = records(&scene, &camera, &frame, pair.then_some(&clear));
        all.iter().map(|o| (o.clone(), o.verdict(0.05, 10))).collect::<Vec<_>>()
    };
    for pair in [false, true] {
        let of = |sigma: f64, id: u16| {
            let all = verdicts(sigma, pair);
            all.into_iter().find(|(o, _)| o.instance == id).expect("a record")
        };
        // The dark car stands out until the fog takes it; the walker is as bright as the ground and the wall behind is not.
        let (car, verdict) = of(0.001, 2);
        assert_eq!((verdict.hidden, verdict.is_certain), (None, true), "{:?}", car.contrast);
        let (car, verdict) = of(0.5, 2);
        assert_eq!((verdict.hidden, verdict.is_certain), (Some(Hidden::Fog), true), "{:?}", car.contrast);
        assert_eq!(car.clear_contrast.is_some(), pair);
        // Too deep for its own light to tell: the fog it is.
        let (car, verdict) = of(2.0, 2);
        assert!(car.unveiled_contrast.is_none() && verdict.hidden == Some(Hidden::Fog));
        let mean = car.transmittance.expect("visible")[1];
        assert!(mean > 0.0 && mean < math::f64::exp(-2.0 * car.nearest_m) * 1.01, "{mean}");
    }
    // What the surfaces send off is what the clear view shows, whatever the fog; car, van and walker stand before others.
    for (o, _) in verdicts(0.05, true).iter().filter(|(o, _)| (2..5).contains(&o.instance)) {
        let (unveiled, clear) = (o.unveiled_contrast.expect("thin fog"), o.clear_contrast.expect("a pair"));
        assert!((unveiled - clear.value).abs() < 1e-4, "{unveiled} {clear:?}");
    }
    // Errors are those of means of independent pixels.
    let (car, _) = &verdicts(0.0001, false)[1];
    let contrast = car.contrast.expect("visible");
    let bound = 0.01 / (car.visible_pixels as f64).sqrt();
    assert!(contrast.standard_error > 0.1 * bound && contrast.standard_error < 2.0 * bound, "{contrast:?}");
}

#[test]
fn too_small_too_hidden_and_alike() {
    let scene = yard::scene(&YARD);
    let camera = yard::cameras(yard::pose(0.3, 0.0, 5.0))[0];
    let mut picture = frame(&scene, &camera);
    let of = |picture: &Frame, id: u16| {
        records(&scene, &camera, picture, None).into_iter().find(|o| o.instance == id).expect("a record")
    };
    let van = of(&picture, 3);
    let between = (van.visible_pixels + van.silhouette_pixels) / 2;
    assert_eq!(van.verdict(0.05, between).hidden, Some(Hidden::Occluded));
    assert_eq!(van.verdict(0.05, van.silhouette_pixels + 1).hidden, Some(Hidden::Small));
    for rgb in &mut picture.direct {
        *rgb = [0.3; 3];
    }
    let verdict = of(&picture, 3).verdict(0.05, 10);
    assert_eq!(verdict.hidden, Some(Hidden::LowContrast));
}

#[test]
fn records_are_the_same_for_any_number_of_threads() {
    let scene = yard::scene(&YARD);
    let camera = yard::cameras(yard::pose(0.3, 0.0, 5.0))[2];
    let picture = frame(&scene, &camera);
    let with = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
        pool.install(|| {
            (
                surface_truth(&scene, &camera, SurfaceLayers::default(), None),
                records(&scene, &camera, &picture, None),
            )
        })
    };
    assert!(with(1) == with(3));
}
