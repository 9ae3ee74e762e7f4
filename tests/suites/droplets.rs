//! Single droplets against their mixtures: other estimators of the same light.

use fog_core::colour::Observer;
use fog_core::moments::Moments;
use fog_core::random::PathRng;
use fog_core::spectrum::{LANES, Wavelengths};
use fog_scene::light::Sun;
use fog_scene::scene::Scene;
use fog_tests::scenes;
use fog_tracer::path::PathTracer;
use fog_tracer::settings::Settings;
use rayon::prelude::*;

/// Red, green and blue along a ray, or three times its radiance at one wavelength.
fn colour(
    scene: &Scene,
    ray: (f64, f64),
    nm: Option<f32>,
    max_depth: Option<u32>,
    paths: u64,
) -> [Moments; 3] {
    let observer = Observer::new();
    let settings = Settings { samples: paths, max_depth, wavelength_nm: nm, stop: None };
    let tracer = PathTracer::new(scene, &observer, settings);
    let ray = scenes::camera(1.7, ray.0, ray.1, 2, 2, 1.0).ray(1.0, 1.0).expect("seen");
    (0..64u64)
        .into_par_iter()
        .map(|chunk| {
            let mut sums = [Moments::default(); 3];
            for s in 0..paths / 64 {
                let mut rng = PathRng::new(71, chunk, s);
                // The wavelengths run evenly through the spectrum, as a pixel's samples do.
                let u = (s as f32 + rng.uniform()) / (paths / 64) as f32;
                let wavelengths = nm.map_or_else(
                    || observer.sample_wavelengths(u.min(0.999_999)),
                    Wavelengths::monochromatic,
                );
                let first = rng.uniform();
                let seen = tracer.radiance(ray, &wavelengths, first, &mut rng).radiance;
                let response = observer.lane_response(&wavelengths);
                for c in 0..3 {
                    let value = match nm {
                        Some(_) => seen[0],
                        None => (0..LANES).map(|lane| seen[lane] * response[lane][c]).sum(),
                    };
                    sums[c].add(f64::from(value));
                }
            }
            sums
        })
        .reduce(Default::default, |a, b| core::array::from_fn(|c| a[c].merge(b[c])))
}

/// Both ways agree along a few rays, and a difference of `resolution` of the light would show.
fn assert_same_light(
    name: &str,
    scenes: &[Scene; 2],
    nm: Option<f32>,
    depth: Option<u32>,
    paths: u64,
    resolution: f64,
) {
    for ray in [(150.0, 10.0), (160.0, 45.0), (120.0, 25.0)] {
        let [mixtures, single] = scenes.each_ref().map(|s| colour(s, ray, nm, depth, paths));
        for c in 0..3 {
            let (a, b) = (mixtures[c].mean(), single[c].mean());
            let sigma = mixtures[c].standard_error().hypot(single[c].standard_error());
            // 36 comparisons over all tests: 4.5 standard errors leave a chance of 2e-4 of a false alarm.
            assert!((a - b).abs() < 4.5 * sigma, "{name}, {ray:?}, channel {c}: {a} and {b} ± {sigma}");
            assert!(
                sigma < resolution / 3.0 * a,
                "{name}, {ray:?}, channel {c}: too noisy to tell, {a} ± {sigma}"
            );
        }
    }
}

fn sunny() -> [Scene; 2] {
    [false, true].map(|single| {
        let (fog, sun) = (scenes::parcel(80.0, 0.02, single), Sun::new(35.0, 150.0, 2.0, 2.0));
        Scene::new(scenes::empty(), Some(fog), None, Some(sun), false)
    })
}

#[test]
fn at_one_wavelength() {
    let scenes = sunny();
    assert_same_light("single scattering, 600 nm", &scenes, Some(600.0), Some(2), 200_000, 0.02);
    assert_same_light("three scatterings, 600 nm", &scenes, Some(600.0), Some(4), 200_000, 0.03);
}

#[test]
fn over_the_spectrum() {
    let scenes = sunny();
    assert_same_light("single scattering", &scenes, None, Some(2), 200_000, 0.02);
    assert_same_light("three scatterings", &scenes, None, Some(4), 200_000, 0.03);
}
