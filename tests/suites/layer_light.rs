//! Paths that know the light of the layer by itself, over an open plain, where it is nearly all of the light.

use fog_core::colour::Observer;
use fog_core::moments::Moments;
use fog_core::random::PathRng;
use fog_core::spectrum::Wavelengths;
use fog_scene::light::Environment;
use fog_scene::medium::Medium;
use fog_scene::scene::Scene;
use fog_tests::scenes;
use fog_tracer::path::PathTracer;
use fog_tracer::settings::Settings;

/// Moments of both integrators along a ray close to level.
fn moments(fog: Medium, samples: u64) -> [Moments; 2] {
    let scene = Scene::new(
        scenes::lambertian_ground(0.3),
        Some(fog),
        Some(Environment { radiance: 1.0 }),
        None,
        false,
    );
    let observer = Observer::new();
    let settings = Settings { samples, max_depth: None, wavelength_nm: Some(600.0), stop: None };
    let tracer = PathTracer::new(&scene, &observer, settings);
    let ray = scenes::camera(2.0, 0.0, 3.0, 2, 2, 1.0).ray(1.0, 1.0).expect("seen");
    let mut out = [Moments::default(); 2];
    for s in 0..samples {
        let mut rng = PathRng::new(5, 0, s);
        let first = rng.uniform();
        let fast = tracer.radiance(ray, &Wavelengths::monochromatic(600.0), first, &mut rng).radiance[0];
        out[0].add(f64::from(fast));
        out[1].add(f64::from(tracer.analog_radiance(ray, 600.0, &mut PathRng::new(6, 0, s))));
    }
    out
}

/// Means agree within 4.5 standard errors, and the error is less than this fraction of the analog one.
fn assert_known(name: &str, fog: Medium, samples: u64, fraction: f64) {
    let [fast, analog] = moments(fog, samples);
    let (got, want) = (fast.standard_error(), analog.standard_error());
    let difference = fast.mean() - analog.mean();
    assert!(difference.abs() < 4.5 * got.hypot(want), "{name}: {} for {}", fast.mean(), analog.mean());
    assert!(got < fraction * want, "{name}: error {got}, analog {want}");
}

#[test]
fn grey_layer() {
    let profile = scenes::grey_profile(60.0, &[0.02, 0.08, 0.05, 0.01], 1.0);
    assert_known("grey", scenes::hg_fog(profile, 0.7), 20_000, 0.7);
}

#[test]
fn mean_cosine_by_altitude_and_wavelength() {
    assert_known("coloured", scenes::coloured_fog(80.0, 0.05, 1.0), 20_000, 0.7);
}

#[test]
fn what_the_fog_absorbs_is_missing() {
    assert_known("absorbing", scenes::coloured_fog(80.0, 0.05, 0.97), 20_000, 0.8);
}
