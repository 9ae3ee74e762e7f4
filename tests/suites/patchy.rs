//! Patchy fog in the renderer, against null collisions that know nothing of waves along rays, and against what must not
//! change.

use crate::analog::assert_agree;
use crate::furnace::assert_white;
use fog_core::patchiness::{Patchiness, PatchyField};
use fog_core::random::PathRng;
use fog_core::spectrum::Wavelengths;
use fog_core::{Vec3A, math};
use fog_scene::LoadedScene;
use fog_scene::lamp::{Lamp, PunctualLights};
use fog_scene::light::{Environment, Sun};
use fog_scene::medium::Medium;
use fog_scene::scene::Scene;
use fog_tests::chi_square::assert_follows;
use fog_tests::scenes;
use std::sync::Arc;

fn patchy(fog: Medium, density_sd: f64, top_sd_m: f64, octaves: u32) -> Medium {
    let parameters = Patchiness { density_sd, top_sd_m, length_m: 40.0, octaves, seed: 3 };
    fog.with_patches(PatchyField::new(parameters).expect("parameters")).expect("thick enough")
}

fn grey() -> Medium {
    scenes::hg_fog(scenes::grey_profile(60.0, &[0.01, 0.03, 0.02, 0.005], 1.0), 0.7)
}

fn coloured() -> Medium {
    scenes::coloured_fog(60.0, 0.02, 0.95)
}

#[test]
fn flights_follow_the_transmittance() {
    let fog = patchy(scenes::hg_fog(scenes::grey_profile(60.0, &[0.02, 0.04, 0.01], 1.0), 0.7), 0.8, 5.0, 3);
    let view = fog.view();
    let walks = view.patchy.as_ref().expect("patches");
    let lanes = view.lanes(&Wavelengths::monochromatic(550.0)).profile;
    let rays = [(5.0, 0.3), (58.0, -0.4), (30.0, 0.0), (75.0, -0.8)];
    for (y, dy) in rays {
        let origin = Vec3A::new(3.0, y, -8.0);
        let direction = Vec3A::new(0.8, dy, 0.5).normalize();
        const CELLS: usize = 40;
        let (length, n) = (150.0, 200_000);
        let survive = |k: usize| {
            let t = length * k as f64 / CELLS as f64;
            math::f64::exp(-fog.optical_depths_at(origin, direction, t, [550.0])[0])
        };
        let mut expected: Vec<f64> =
            (0..CELLS).map(|k| (survive(k) - survive(k + 1)) * f64::from(n)).collect();
        expected.push(survive(CELLS) * f64::from(n));
        let mut observed = vec![0u64; CELLS + 1];
        let mut rng = PathRng::new(31, 0, 0);
        for _ in 0..n {
            let flown = walks.fly(origin, direction, length, math::neg_ln(1.0 - rng.uniform_f64()), &lanes);
            let cell = ((flown.t / length * CELLS as f64) as usize).min(CELLS - 1);
            observed[if flown.collided { cell } else { CELLS }] += 1;
        }
        assert_follows(&format!("flight from {y} at {dy}"), &observed, &expected, rays.len());
    }
}

#[test]
fn agrees_with_null_collisions() {
    let environment = Some(Environment { radiance: 1.0 });
    let sun = Some(Sun::new(35.0, 150.0, 2.0, 10.0));
    let rays = [(0.0, 0.0), (20.0, 8.0), (160.0, 45.0)];
    let day = Scene::new(
        scenes::load("street_day.glb"),
        Some(patchy(grey(), 0.6, 4.0, 1)),
        environment,
        None,
        false,
    );
    assert_agree("grey patches", &day, &rays, None, 40_000);
    let night =
        Scene::new(scenes::load("street_night.glb"), Some(patchy(coloured(), 0.6, 4.0, 1)), None, sun, true);
    assert_agree("coloured patches", &night, &rays[1..], None, 100_000);
}

#[test]
fn lamps_in_patches() {
    let lamp = Lamp::even(Vec3A::new(1.0, 4.0, -12.0), [300.0; 3]);
    let lights = PunctualLights { lamps: vec![lamp], beams: Vec::new() };
    let lit = Arc::new(LoadedScene { lights, ..(*scenes::load("street_day.glb")).clone() });
    let scene = Scene::new(lit, Some(patchy(coloured(), 0.6, 4.0, 1)), None, None, true);
    assert_agree("a lamp in patches", &scene, &[(5.0, 5.0)], None, 100_000);
}

#[test]
fn white_patches_are_invisible() {
    for (name, fog) in [("grey patches", grey()), ("coloured patches", scenes::coloured_fog(60.0, 0.03, 1.0))]
    {
        let environment = Some(Environment { radiance: 1.0 });
        let scene = Scene::new(scenes::empty(), Some(patchy(fog, 1.0, 6.0, 2)), environment, None, false);
        assert_white(name, &scene, 30.0, 0.0, 256);
    }
}

#[test]
fn even_fog_is_the_limit_and_patches_are_seen() {
    let camera = scenes::camera(1.7, 10.0, 2.0, 32, 18, 60.0);
    let frame = |fog: Medium, threads: usize| {
        let environment = Some(Environment { radiance: 1.0 });
        let scene = Scene::new(scenes::load("street_day.glb"), Some(fog), environment, None, false);
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        pool.install(|| scenes::render(&scene, &camera, 16, None, 9))
    };
    let (even, still) = (frame(coloured(), 2), frame(patchy(coloured(), 0.0, 0.0, 2), 2));
    // Depths that differ by rounding, but even fog knows its own light, which patchy fog does not.
    let error = scenes::standard_error(&even).hypot(scenes::standard_error(&still));
    for c in 0..3 {
        let (a, b) = (scenes::mean(&even, c), scenes::mean(&still, c));
        assert!((a - b).abs() < 5.0 * error, "channel {c}: {a} and {b} ± {error}");
    }
    assert_eq!(even.truth.distance_m, still.truth.distance_m);
    let (one, two) = (frame(patchy(coloured(), 0.8, 4.0, 2), 1), frame(patchy(coloured(), 0.8, 4.0, 2), 2));
    assert_eq!(one, two, "threads");
    let tau = |frame: &fog_film::Frame| frame.truth.tau.clone();
    let differing = tau(&even).iter().zip(&tau(&one)).filter(|(a, b)| (*a - *b).abs() > 0.05 * **a).count();
    assert!(differing > 200, "{differing} of 576 pixels see patches");
    assert_eq!(tau(&one).iter().filter(|t| t.is_nan() || **t < 0.0).count(), 0);
}
