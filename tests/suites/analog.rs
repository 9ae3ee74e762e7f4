//! The fast integrator against the analog one on small scenes: different estimators, the same light.

use fog_core::colour::Observer;
use fog_core::moments::Moments;
use fog_core::random::PathRng;
use fog_core::spectrum::Wavelengths;
use fog_scene::light::{Environment, Sun};
use fog_scene::medium::Medium;
use fog_scene::scene::Scene;
use fog_tests::scenes;
use fog_tracer::path::PathTracer;
use fog_tracer::settings::Settings;
use rayon::prelude::*;

/// Means of both integrators along a few rays at one wavelength agree within their noise.
pub(crate) fn assert_agree(
    name: &str,
    scene: &Scene,
    rays: &[(f64, f64)],
    max_depth: Option<u32>,
    samples: u64,
) {
    let observer = Observer::new();
    let settings = Settings { samples, max_depth, wavelength_nm: Some(600.0), stop: None };
    let tracer = PathTracer::new(scene, &observer, settings);
    let wavelengths = Wavelengths::monochromatic(600.0);
    for (k, &(heading, pitch)) in rays.iter().enumerate() {
        let ray = scenes::camera(1.7, heading, pitch, 2, 2, 1.0).ray(1.0, 1.0).expect("seen");
        let (fast, analog) = (0..64u64)
            .into_par_iter()
            .map(|chunk| {
                let (mut fast, mut analog) = (Moments::default(), Moments::default());
                for s in 0..samples / 64 {
                    let mut rng = PathRng::new(k as u64, chunk, s);
                    let first = rng.uniform();
                    let path = tracer.radiance(ray, &wavelengths, first, &mut rng);
                    fast.add(f64::from(path.radiance[0] + path.glow[0]));
                    let mut rng = PathRng::new(k as u64 + 1000, chunk, s);
                    analog.add(f64::from(tracer.analog_radiance(ray, 600.0, &mut rng)));
                }
                (fast, analog)
            })
            .reduce(Default::default, |a, b| (a.0.merge(b.0), a.1.merge(b.1)));
        let sigma = fast.standard_error().hypot(analog.standard_error());
        let difference = fast.mean() - analog.mean();
        // About 30 rays over all tests: 4.5 standard errors leave a chance of 2e-4 of a false alarm.
        assert!(
            difference.abs() <= 4.5 * sigma + 1e-9,
            "{name}, ray {k}: fast {} ± {}, analog {} ± {}",
            fast.mean(),
            fast.standard_error(),
            analog.mean(),
            analog.standard_error()
        );
        assert!(sigma < 0.05 * analog.mean().max(0.02), "{name}, ray {k}: too noisy to tell ({sigma})");
    }
}

fn grey_fog(albedo: f64) -> Medium {
    scenes::hg_fog(scenes::grey_profile(60.0, &[0.01, 0.03, 0.02, 0.005], albedo), 0.7)
}

const RAYS: [(f64, f64); 4] = [(0.0, 0.0), (20.0, 8.0), (-35.0, -4.0), (160.0, 45.0)];

#[test]
fn environment_and_surfaces() {
    let env = Some(Environment { radiance: 1.0 });
    for (name, fog) in [
        ("clear air", None),
        ("grey fog", Some(grey_fog(1.0))),
        ("absorbing fog", Some(grey_fog(0.9))),
        ("coloured fog", Some(scenes::coloured_fog(80.0, 0.02, 1.0))),
    ] {
        let scene = Scene::new(scenes::load("street_day.glb"), fog, env, None, false);
        assert_agree(name, &scene, &RAYS, None, 60_000);
    }
}

#[test]
fn sun_disc() {
    // A wide disc, so that the analog integrator meets it.
    let sun = Some(Sun::new(35.0, 150.0, 2.0, 10.0));
    for fog in [None, Some(grey_fog(1.0)), Some(scenes::coloured_fog(80.0, 0.02, 1.0))] {
        let foggy = fog.is_some();
        let scene = Scene::new(scenes::load("street_day.glb"), fog, None, sun, false);
        let rays: &[(f64, f64)] = if foggy { &RAYS } else { &RAYS[2..3] };
        assert_agree("sun", &scene, rays, None, 1_000_000);
    }
}

#[test]
fn emitting_surfaces() {
    for fog in [None, Some(grey_fog(1.0)), Some(scenes::coloured_fog(80.0, 0.02, 0.95))] {
        let scene = Scene::new(scenes::load("street_night.glb"), fog, None, None, true);
        assert_agree("night", &scene, &RAYS[..3], None, 200_000);
    }
}

#[test]
fn single_droplets() {
    let fog = Some(scenes::parcel(80.0, 0.02, true));
    let sun = Some(Sun::new(35.0, 150.0, 2.0, 10.0));
    let scene = Scene::new(scenes::load("street_night.glb"), fog, None, sun, true);
    assert_agree("droplets", &scene, &RAYS[..2], None, 300_000);
}

#[test]
fn everything_with_limited_depth() {
    let env = Some(Environment { radiance: 0.2 });
    let sun = Some(Sun::new(50.0, 20.0, 1.0, 10.0));
    let scene = Scene::new(scenes::load("street_night.glb"), Some(grey_fog(0.97)), env, sun, true);
    for depth in [1, 2, 4] {
        assert_agree(&format!("depth {depth}"), &scene, &RAYS[..2], Some(depth), 400_000);
    }
}
