//! A replayed path is the one that was rendered: to the bit, for every pixel.

use fog_core::Vec3A;
use fog_core::colour::Observer;
use fog_core::patchiness::{Patchiness, PatchyField};
use fog_core::spectrum::Spectrum;
use fog_scene::LoadedScene;
use fog_scene::lamp::{Lamp, PunctualLights};
use fog_scene::light::{Environment, Sun};
use fog_scene::scene::Scene;
use fog_tests::scenes;
use fog_tracer::path::PathTracer;
use fog_tracer::settings::Settings;
use fog_tracer::watch::{Step, Visibility};
use std::sync::Arc;

#[test]
fn replays_are_what_the_film_got() {
    let environment = Some(Environment { radiance: 1.0 });
    let sun = Some(Sun::new(35.0, 150.0, 2.0, 0.53));
    let coloured = || Some(scenes::coloured_fog(40.0, 0.05, 0.9));
    let patches = Patchiness { density_sd: 0.5, top_sd_m: 2.0, length_m: 50.0, octaves: 2, seed: 1 };
    let field = PatchyField::new(patches).expect("parameters");
    let patchy = coloured().map(|fog| fog.with_patches(field).expect("thick enough"));
    let (mut collisions, mut free, mut blocked, mut roulette) = (0, 0, 0, 0);
    for (name, fog, environment, sun, emitters, wavelength_nm) in [
        ("street_day.glb", coloured(), environment, sun, true, None),
        ("street_grey_night.glb", coloured(), None, None, true, None),
        ("street_day.glb", Some(scenes::parcel(40.0, 0.05, true)), environment, None, false, Some(600.0)),
        ("street_grey_night.glb", None, None, sun, true, None),
        ("street_day.glb", patchy, environment, sun, true, None),
    ] {
        let scene = Scene::new(scenes::load(name), fog, environment, sun, emitters);
        let camera = scenes::camera(1.7, 10.0, -3.0, 32, 18, 60.0);
        let settings = Settings { samples: 1, max_depth: None, wavelength_nm, stop: None };
        let observer = Observer::new();
        let tracer = PathTracer::new(&scene, &observer, settings);
        let frame = scenes::render(&scene, &camera, 1, wavelength_nm, 9);
        for i in 0..frame.pixel_count() {
            let replay = tracer.replay(&camera, i, 9, 0).expect("seen");
            assert_eq!(replay.sample.direct, frame.direct[i], "{name}, pixel {i}");
            assert_eq!(replay.sample.airlight, frame.airlight[i], "{name}, pixel {i}");
            assert_eq!(replay.sample.value(), frame.image(i), "{name}, pixel {i}");
            let mut sum = Spectrum::ZERO;
            for step in &replay.steps {
                step.added().into_iter().for_each(|added| sum += added);
                match step {
                    Step::Collision { .. } => collisions += 1,
                    Step::Connection { visibility: Visibility::Free, .. } => free += 1,
                    Step::Connection { visibility: Visibility::Blocked, .. } => blocked += 1,
                    Step::Roulette { .. } => roulette += 1,
                    _ => {}
                }
            }
            assert_eq!(sum, replay.radiance, "{name}, pixel {i}");
        }
    }
    assert!(collisions.min(free).min(blocked).min(roulette) > 10, "{collisions} {free} {blocked} {roulette}");
}

#[test]
fn light_that_was_chosen_by_nearness_to_a_lamp_is_told() {
    let lamp = Lamp::even(Vec3A::new(1.0, 4.0, -12.0), [300.0; 3]);
    let street = scenes::load("street_day.glb");
    let lights = PunctualLights { lamps: vec![lamp], beams: Vec::new() };
    let lit = Arc::new(LoadedScene { lights, ..(*street).clone() });
    let scene = Scene::new(lit, Some(scenes::coloured_fog(40.0, 0.05, 0.9)), None, None, true);
    let camera = scenes::camera(1.7, 10.0, -3.0, 16, 9, 60.0);
    let settings = Settings { samples: 1, max_depth: None, wavelength_nm: None, stop: None };
    let observer = Observer::new();
    let tracer = PathTracer::new(&scene, &observer, settings);
    let frame = scenes::render(&scene, &camera, 1, None, 9);
    let (mut near, mut lamps) = (0, 0);
    for i in 0..frame.pixel_count() {
        let replay = tracer.replay(&camera, i, 9, 0).expect("seen");
        let direct = [0, 1, 2].map(|c| replay.sample.direct[c] + replay.lamps[c]);
        lamps += usize::from(replay.lamps != [0.0; 3]);
        assert_eq!((direct, replay.sample.airlight), (frame.direct[i], frame.airlight[i]), "{i}");
        let mut sum = Spectrum::ZERO;
        replay.steps.iter().filter_map(Step::added).for_each(|added| sum += added);
        // What lamps add along the first flight has a sum of its own, so that the order of additions differs.
        let most = replay.radiance.max_lane();
        let apart = (sum - replay.radiance).0.iter().fold(0.0f32, |a, d| a.max(d.abs()));
        assert!(apart <= 1e-5 * most, "{i}: {sum:?} {:?}", replay.radiance);
        near += replay.steps.iter().filter(|step| matches!(step, Step::NearLamp { .. })).count();
    }
    assert!(near > 100, "{near}");
    assert_eq!(lamps, 1, "the lamp stands in one pixel");
}
