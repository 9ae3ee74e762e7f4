//! Frames from common paths against the same frames one by one.

use fog_core::Vec3A;
use fog_core::colour::Observer;
use fog_film::Frame;
use fog_scene::LoadedScene;
use fog_scene::lamp::{Beam, PunctualLights};
use fog_scene::light::{Environment, Sun};
use fog_scene::light_groups::{LightGroup, LightGroups, LightPattern};
use fog_scene::medium::Medium;
use fog_scene::scene::Scene;
use fog_tests::scenes;
use fog_tracer::render_shared::{Variant, render_shared};
use fog_tracer::settings::{NoiseTarget, Settings, Stop};
use std::sync::Arc;

const SETTINGS: Settings = Settings { samples: 48, stop: None, max_depth: None, wavelength_nm: None };

fn shared(scene: &Scene, media: &[Medium], variants: &[Variant], settings: &Settings) -> Vec<Frame> {
    let camera = scenes::camera(1.7, 0.0, 4.0, 32, 18, 60.0);
    render_shared(scene, media, variants, (&camera, &Observer::new()), settings, 5, &|_| true)
        .expect("not cancelled")
        .into_iter()
        .map(|frame| frame.expect("finite"))
        .collect()
}

fn each(media: &[Medium]) -> Vec<Variant> {
    (0..media.len()).map(|fog| Variant { fog, factors: vec![] }).collect()
}

/// Insists that common paths give the light of separate ones in each of 4 × 2 blocks of each frame.
fn assert_unbiased(name: &str, scene: &Scene, media: &[Medium], settings: &Settings) {
    let camera = scenes::camera(1.7, 0.0, 4.0, 32, 18, 60.0);
    let frames = shared(scene, media, &each(media), settings);
    for (j, (frame, medium)) in frames.iter().zip(media).enumerate() {
        let mut alone = scene.clone();
        alone.medium = Some(medium.clone());
        let settings = Settings { samples: 4 * settings.samples, ..*settings };
        let alone = fog_tracer::render::render(&alone, &camera, &Observer::new(), &settings, 9, &|_| true)
            .expect("finite")
            .expect("not cancelled");
        assert_eq!(frame.truth, alone.truth);
        for block in 0..8 {
            let of = |frame: &Frame| {
                let inside = |&i: &usize| (i % 32) / 8 + (i / 32) / 9 * 4 == block;
                let pixels = (0..frame.pixel_count()).filter(inside);
                let sum = |i: usize| (frame.luminance(i), f64::from(frame.standard_error[i]).powi(2));
                pixels.map(sum).fold((0.0, 0.0), |a, b| (a.0 + b.0, a.1 + b.1))
            };
            let ((a, va), (b, vb)) = (of(frame), of(&alone));
            let z = (a - b) / (va + vb).sqrt();
            assert!(z.abs() < 4.5, "{name}: fog {j}, block {block}: {a} for {b}, {z} standard errors");
            assert!((va + vb).sqrt() < 0.2 * b, "{name}: fog {j}, block {block} is too noisy to tell");
        }
    }
}

fn grey(height_m: f64, factor: f64, g: f32, albedo: f64) -> Medium {
    let sigma = [0.004, 0.012, 0.01, 0.0].map(|s| s * factor);
    scenes::hg_fog(scenes::grey_profile(height_m, &sigma, albedo), g)
}

#[test]
fn fogs_by_day_and_in_the_sun() {
    let street = scenes::load("street_day.glb");
    let environment = Some(Environment { radiance: 0.5 });
    let sun = Sun::new(35.0, 20.0, 1.0, 3.0);
    let media = [
        grey(60.0, 1.0, 0.7, 1.0),
        grey(60.0, 1.3, 0.7, 0.95),
        grey(80.0, 0.8, 0.7, 1.0),
        grey(60.0, 1.0, 0.4, 1.0),
    ];
    let day = Scene::new(street.clone(), Some(media[0].clone()), environment, None, false);
    assert_unbiased("grey day", &day, &media, &SETTINGS);
    // Colours, of tables by altitude, in layers of different heights.
    let media = [
        scenes::coloured_fog(50.0, 0.01, 1.0),
        scenes::coloured_fog(70.0, 0.01, 0.9),
        scenes::coloured_fog(60.0, 0.014, 1.0),
    ];
    let sunny = Scene::new(street, Some(media[0].clone()), environment, Some(sun), false);
    assert_unbiased("coloured, in the sun", &sunny, &media, &SETTINGS);
    let mono = Settings { wavelength_nm: Some(620.0), max_depth: Some(5), ..SETTINGS };
    assert_unbiased("one wavelength", &sunny, &media, &mono);
}

#[test]
fn fogs_by_night() {
    let street = scenes::load("street_night.glb");
    let beam = Beam { direction: Vec3A::new(0.3, 0.9, 0.2).normalize(), illuminance: [0.3, 0.2, 0.2] };
    let lights = PunctualLights { lamps: vec![], beams: vec![beam] };
    let loaded = Arc::new(LoadedScene { lights, ..(*street).clone() });
    let media =
        [grey(60.0, 1.0, 0.7, 1.0), grey(90.0, 1.2, 0.8, 0.97), scenes::coloured_fog(50.0, 0.01, 1.0)];
    let night = Scene::new(loaded, Some(media[0].clone()), None, None, true);
    assert_unbiased("night", &night, &media, &SETTINGS);
}

#[test]
fn intensities_are_factors_of_groups() {
    let group = |name: &str, light| LightGroup { name: name.into(), lights: vec![light], intensity: 1.0 };
    let groups =
        LightGroups::new(vec![group("sky", LightPattern::Environment), group("sun", LightPattern::Sun)]);
    let media = [grey(60.0, 1.0, 0.7, 1.0), grey(60.0, 1.2, 0.7, 1.0)];
    let sun = Some(Sun::new(35.0, 20.0, 1.0, 3.0));
    let scene = Scene::new(
        scenes::load("street_day.glb"),
        Some(media[0].clone()),
        Some(Environment { radiance: 0.5 }),
        sun,
        false,
    )
    .with_light_groups(groups);
    let variant = |fog, factors: [f32; 3]| Variant { fog, factors: factors.to_vec() };
    let settings = Settings {
        samples: 16,
        stop: Some(Stop::Noise(NoiseTarget { noise: 0.3, max_samples: 24 })),
        ..SETTINGS
    };
    for media in [&media[..1], &media] {
        let last = media.len() - 1;
        let variants = [
            variant(0, [1.0; 3]),
            variant(last, [1.0; 3]),
            variant(last, [2.0, 0.0, 1.0]),
            variant(last, [0.5, 4.0, 1.0]),
        ];
        let frames = shared(&scene, media, &variants, &settings);
        for (frame, factors) in frames[1..].iter().zip([[1.0, 1.0], [2.0, 0.0], [0.5, 4.0]]) {
            assert_eq!(frame.samples, frames[0].samples);
            for i in 0..frame.pixel_count() {
                for c in 0..3 {
                    let own: [f32; 2] = [0, 1].map(|g| frame.groups[g].radiance[i][c]);
                    let one: [f32; 2] = [0, 1].map(|g| frames[1].groups[g].radiance[i][c]);
                    for g in 0..2 {
                        let want = one[g] * factors[g];
                        assert!((own[g] - want).abs() <= 1e-6 * want.abs(), "pixel {i}: {own:?} of {one:?}");
                    }
                    let sum = own[0] + own[1];
                    assert!((frame.image(i)[c] - sum).abs() <= 1e-5 * own.map(f32::abs).iter().sum::<f32>());
                }
            }
        }
        // The first frame's paths are those of a rendering alone, if there is one fog.
        if last == 0 {
            let camera = scenes::camera(1.7, 0.0, 4.0, 32, 18, 60.0);
            let settings = Settings { stop: None, ..settings };
            let alone =
                fog_tracer::render::render(&scene, &camera, &Observer::new(), &settings, 5, &|_| true);
            let alone = alone.expect("finite").expect("not cancelled");
            let frames = shared(&scene, media, &variants, &settings);
            for i in 0..alone.pixel_count() {
                let (a, b) = (alone.luminance(i), frames[0].luminance(i));
                assert!((a - b).abs() <= 1e-5 * b.abs(), "pixel {i}: {b} for {a}");
            }
        }
    }
}
