//! Lamps that the camera sees, against Allard's law.

use fog_core::colour::{Observer, luminance, upsample};
use fog_core::lens::{Distortion, Fisheye, Intrinsics, Lens, RadialTangential};
use fog_core::phase::HenyeyGreenstein;
use fog_core::profile::ExtinctionProfile;
use fog_core::{Vec3A, math};
use fog_film::Frame;
use fog_scene::camera::Camera;
use fog_scene::lamp::{Cone, Lamp, LightNames, Measured, Pattern, PunctualLights};
use fog_scene::light_groups::{LightGroup, LightGroups, LightPattern};
use fog_scene::medium::Medium;
use fog_scene::phase::Phase;
use fog_scene::photometry::Photometry;
use fog_scene::scene::Scene;
use fog_scene::{AlphaMode, Geometry, LoadedScene, Material, Opacity, Triangle};
use fog_tests::scenes;
use fog_tracer::render_shared::{Variant, render_shared};
use fog_tracer::settings::Settings;
use glam::{Mat3A, Vec3};
use std::sync::Arc;

const EYE: Vec3A = Vec3A::new(0.0, 2.0, 0.0);

fn lit(lamps: Vec<Lamp>) -> Arc<LoadedScene> {
    Arc::new(LoadedScene { lights: PunctualLights { lamps, beams: vec![] }, ..(*scenes::empty()).clone() })
}

/// A layer that dims red more than blue.
fn fog() -> Medium {
    let sigma = vec![0.01, 0.005, 0.03, 0.02, 0.01, 0.008];
    let profile =
        ExtinctionProfile::new(0.0, vec![0.0, 10.0, 40.0], vec![400.0, 700.0], sigma, vec![1.0; 6]).unwrap();
    Medium::new(profile, Phase::HenyeyGreenstein(HenyeyGreenstein::new(0.5).unwrap()))
}

fn spot(at: Vec3A, towards: Vec3A) -> Lamp {
    let cone = Cone { axis: (towards - at).normalize(), cos_inner: 0.95, cos_outer: 0.8 };
    Lamp::spot(at, [500.0, 400.0, 300.0], cone)
}

/// Narrow upward, with its axis level: a beam that only a table can have.
fn measured(at: Vec3A) -> Lamp {
    let photometry = Photometry::new(
        vec![0.0, 10.0, 30.0],
        &[0.0, 90.0, 180.0],
        &[90.0, 80.0, 5.0, 90.0, 40.0, 0.0, 90.0, 70.0, 1.0],
    );
    // The node turned by half about +Y: −Z, the axis, looks along +Z.
    let lamp_from_world = Mat3A::from_cols(Vec3A::NEG_X, Vec3A::Y, Vec3A::NEG_Z);
    let pattern = Pattern::Measured(Measured { photometry: Arc::new(photometry.unwrap()), lamp_from_world });
    Lamp { pattern, ..Lamp::even(at, [90.0, 45.0, 9.0]) }
}

/// Sum of direct radiance times solid angle over all pixels.
fn illuminance(frame: &Frame, camera: &Camera) -> [f64; 3] {
    let mut sum = [0.0; 3];
    for (i, rgb) in frame.direct.iter().enumerate() {
        let (x, y) = (i as u32 % frame.width, i as u32 / frame.width);
        let solid_angle = camera.pixel_solid_angle(f64::from(x) + 0.5, f64::from(y) + 0.5);
        (0..3).for_each(|c| sum[c] += f64::from(rgb[c]) * solid_angle);
    }
    sum
}

fn render(scene: &Scene, camera: &Camera, wavelength_nm: Option<f32>) -> Frame {
    scenes::render(scene, camera, 1, wavelength_nm, 1)
}

fn camera() -> Camera {
    scenes::camera(2.0, 0.0, 0.0, 64, 36, 60.0)
}

/// I T / d² of a lamp at one wavelength.
fn allard(lamp: &Lamp, fog: Option<&Medium>, nm: f64) -> f64 {
    let observer = Observer::new();
    let basis = observer.lane_basis(&fog_core::spectrum::Wavelengths::monochromatic(nm as f32));
    let offset = lamp.position.as_dvec3() - EYE.as_dvec3();
    let d = offset.length();
    let intensity = f64::from(upsample(lamp.intensity, &basis)[0]);
    let falloff = f64::from(lamp.falloff((-offset / d).as_vec3a()));
    let depth = fog.map_or(0.0, |f| f.profile().optical_depth_at(2.0, offset.y / d, d, nm));
    intensity * falloff * math::f64::exp(-depth) / (d * d)
}

#[test]
fn radiances_sum_up_to_allards_law() {
    for lamp in [
        Lamp::even(Vec3A::new(3.0, 4.0, -40.0), [200.0, 100.0, 50.0]),
        Lamp::even(Vec3A::new(-9.0, 1.0, -17.0), [1e-3; 3]),
        spot(Vec3A::new(2.0, 9.0, -30.0), Vec3A::new(1.0, 1.0, 3.0)),
        measured(Vec3A::new(0.0, 0.5, -20.0)),
        measured(Vec3A::new(2.0, 0.0, -20.0)),
        Lamp { radius_m: 0.6, ..spot(Vec3A::new(2.0, 5.0, -15.0), Vec3A::new(1.0, 1.0, 3.0)) },
        Lamp { radius_m: 0.3, ..Lamp::even(Vec3A::new(1.0, 2.0, -6.0), [7.0, 8.0, 9.0]) },
    ] {
        for fog in [None, Some(fog())] {
            let scene = Scene::new(lit(vec![lamp.clone()]), fog.clone(), None, None, true);
            let mono = illuminance(&render(&scene, &camera(), Some(600.0)), &camera())[0];
            let want = allard(&lamp, fog.as_ref(), 600.0);
            assert!(want > 0.0 && (mono / want - 1.0).abs() < 1e-4, "{lamp:?}: {mono} for {want}");
            let rgb = illuminance(&render(&scene, &camera(), None), &camera());
            let want = Observer::new().rgb_of(|nm| allard(&lamp, fog.as_ref(), f64::from(nm)) as f32);
            let size = luminance(want);
            for c in 0..3 {
                assert!((rgb[c] - want[c]).abs() < 1e-4 * size, "{lamp:?}: {rgb:?} for {want:?}");
            }
        }
    }
}

#[test]
fn every_lens_keeps_the_sum() {
    let intrinsics = Intrinsics { fx_px: 40.0, fy_px: 44.0, cx_px: 30.0, cy_px: 18.0 };
    let distortion = Distortion { k: [-0.1, 0.02, 0.0, 0.0, 0.0, 0.0], p: [0.01, -0.005] };
    let lenses = [
        Lens::RadialTangential(RadialTangential::new(intrinsics, distortion, 64, 36).unwrap()),
        Lens::Fisheye(Fisheye::new(intrinsics, [0.01, 0.0, 0.0, 0.0], 150.0, 64, 36).unwrap()),
    ];
    let lamp = Lamp { radius_m: 1.5, ..Lamp::even(Vec3A::new(6.0, 5.0, -14.0), [80.0; 3]) };
    let scene = Scene::new(lit(vec![lamp.clone()]), None, None, None, true);
    for lens in lenses {
        let camera = Camera { lens, ..camera() };
        let frame = render(&scene, &camera, Some(550.0));
        let [got, ..] = illuminance(&frame, &camera);
        let want = allard(&lamp, None, 550.0);
        assert!((got / want - 1.0).abs() < 1e-4, "{got} for {want}");
        let [x, y] = camera.project(lamp.position).unwrap().map(|c| c as u32);
        assert!(frame.direct[(y * 64 + x) as usize][0] > 0.0);
    }
}

#[test]
fn lamps_that_are_not_seen() {
    for (why, lamp) in [
        ("behind", Lamp::even(Vec3A::new(0.0, 2.0, 5.0), [100.0; 3])),
        ("beside", Lamp::even(Vec3A::new(20.0, 2.0, -5.0), [100.0; 3])),
        ("looks away", spot(Vec3A::new(0.0, 2.0, -10.0), Vec3A::new(0.0, 2.0, -20.0))),
        ("here", Lamp::even(EYE, [100.0; 3])),
    ] {
        for radius_m in [0.0, 0.2] {
            let scene = Scene::new(lit(vec![Lamp { radius_m, ..lamp.clone() }]), None, None, None, true);
            let frame = render(&scene, &camera(), None);
            assert!(frame.direct.iter().all(|rgb| *rgb == [0.0; 3]), "{why}");
        }
    }
    let off =
        Scene::new(lit(vec![Lamp::even(Vec3A::new(0.0, 2.0, -5.0), [1.0; 3])]), None, None, None, false);
    assert!(render(&off, &camera(), None).direct.iter().all(|rgb| *rgb == [0.0; 3]), "switched off");
}

/// A black square of some coverage across the view at this distance.
fn screen(lamps: Vec<Lamp>, coverage: f32, distance: f32) -> LoadedScene {
    let [a, b, c, d] =
        [(-9.0, -9.0), (9.0, -9.0), (9.0, 9.0), (-9.0, 9.0)].map(|(x, y)| Vec3::new(x, y, -distance));
    let triangles = vec![Triangle::flat([a, b, c]), Triangle::flat([a, c, d])];
    let black = Material {
        base_color: [0.0, 0.0, 0.0, coverage],
        alpha_mode: AlphaMode::Blend,
        specular: 0.0,
        ..Material::default()
    };
    let opacities = vec![Opacity::new(&black, &Arc::from([]))];
    let geometry = Geometry::new(triangles, opacities);
    LoadedScene { geometry, materials: vec![black], ..(*lit(lamps)).clone() }
}

#[test]
fn surfaces_hide_what_they_cover() {
    let lamp = Lamp::even(Vec3A::new(0.5, 3.0, -20.0), [60.0; 3]);
    let want = allard(&lamp, None, 550.0);
    for (coverage, distance, share) in [(1.0, 10.0, 0.0), (0.3, 10.0, 0.7), (1.0, 30.0, 1.0)] {
        let loaded = Arc::new(screen(vec![lamp.clone()], coverage, distance));
        let scene = Scene::new(loaded, None, None, None, true);
        let camera = camera();
        // What the lamp throws on the screen is seen too: of black, the Fresnel reflection of nothing.
        let [got, ..] = illuminance(&render(&scene, &camera, Some(550.0)), &camera);
        assert!((got - share * want).abs() < 1e-4 * want, "{coverage} at {distance} m: {got} of {want}");
    }
}

#[test]
fn discs_have_the_luminance_of_their_intensity() {
    // 400 cd of a disc of 0.5 m, 30° off its axis and 5 m away: I / (A cos) wherever it fills a pixel.
    let cone = Cone { axis: Vec3A::new(0.5, 0.0, 0.866_025_4), cos_inner: 0.8, cos_outer: 0.0 };
    let lamp = Lamp { radius_m: 0.5, ..Lamp::spot(Vec3A::new(0.0, 2.0, -5.0), [400.0; 3], cone) };
    let scene = Scene::new(lit(vec![lamp]), None, None, None, true);
    let frame = render(&scene, &camera(), None);
    let filled = f64::from(frame.direct[18 * 64 + 32][1]);
    let want = 400.0 / (core::f64::consts::PI * 0.25 * 0.866);
    assert!((filled / want - 1.0).abs() < 0.04, "{filled} for {want}");
    let covered = frame.direct.iter().filter(|rgb| rgb[1] > 0.0).count();
    // π r² cos over the pixels' solid angle: 0.027 sr of 3.3e-4 sr each, and the rim.
    assert!((80..140).contains(&covered), "{covered}");
}

#[test]
fn layers_and_shared_frames_have_their_lamps() {
    let lamps = vec![
        Lamp::even(Vec3A::new(3.0, 4.0, -40.0), [200.0, 100.0, 50.0]),
        Lamp::even(Vec3A::new(-3.0, 4.0, -40.0), [20.0, 100.0, 50.0]),
    ];
    let names = ["right", "left"].map(str::to_owned).to_vec();
    let light_names = LightNames { lamps: names, beams: vec![] };
    let loaded = Arc::new(LoadedScene { light_names, ..(*lit(lamps.clone())).clone() });
    let group = |name: &str| LightGroup {
        name: name.into(),
        lights: vec![LightPattern::Node(name.into())],
        intensity: 1.0,
    };
    let groups = LightGroups::new(vec![group("left")]);
    let scene = Scene::new(loaded, Some(fog()), None, None, true).with_light_groups(groups);
    let settings = Settings { samples: 2, stop: None, max_depth: Some(1), wavelength_nm: Some(550.0) };
    let thin = scenes::hg_fog(scenes::grey_profile(40.0, &[0.001, 0.001], 1.0), 0.5);
    let fogs = [fog(), thin];
    let variants =
        [(0, [1.0, 1.0]), (1, [3.0, 0.5])].map(|(fog, factors)| Variant { fog, factors: factors.to_vec() });
    let frames =
        render_shared(&scene, &fogs, &variants, (&camera(), &Observer::new()), &settings, 1, &|_| true);
    for (variant, frame) in variants.iter().zip(frames.unwrap()) {
        let frame = frame.unwrap();
        let [right, left] = [0, 1].map(|k| allard(&lamps[k], Some(&fogs[variant.fog]), 550.0));
        let [on_left, rest] = [0, 1].map(|g| f64::from(variant.factors[g]));
        let [got, ..] = illuminance(&frame, &camera());
        let want = left * on_left + right * rest;
        assert!((got / want - 1.0).abs() < 1e-4, "{got} for {want}");
        let layer = Frame { direct: frame.groups[0].radiance.clone(), ..frame };
        let [got, ..] = illuminance(&layer, &camera());
        assert!((got / (left * on_left) - 1.0).abs() < 1e-4, "{got} for {left}");
    }
}
