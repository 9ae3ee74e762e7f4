//! A replayed path is the one that was rendered: to the bit, for every pixel.

use fog_core::colour::Observer;
use fog_core::spectrum::Spectrum;
use fog_scene::light::{Environment, Sun};
use fog_scene::scene::Scene;
use fog_tests::scenes;
use fog_tracer::path::PathTracer;
use fog_tracer::settings::Settings;
use fog_tracer::watch::{Step, Visibility};

#[test]
fn replays_are_what_the_film_got() {
    let environment = Some(Environment { radiance: 1.0 });
    let sun = Some(Sun::new(35.0, 150.0, 2.0, 0.53));
    let coloured = || Some(scenes::coloured_fog(40.0, 0.05, 0.9));
    let (mut collisions, mut free, mut blocked, mut roulette) = (0, 0, 0, 0);
    for (name, fog, environment, sun, emitters, wavelength_nm) in [
        ("street_day.glb", coloured(), environment, sun, true, None),
        ("street_grey_night.glb", coloured(), None, None, true, None),
        ("street_day.glb", Some(scenes::parcel(40.0, 0.05, true)), environment, None, false, Some(600.0)),
        ("street_grey_night.glb", None, None, sun, true, None),
    ] {
        let scene = Scene::new(scenes::load(name), fog, environment, sun, emitters);
        let camera = scenes::camera(1.7, 10.0, -3.0, 32, 18, 60.0);
        let settings = Settings { samples: 1, max_depth: None, wavelength_nm, stop: None };
        let observer = Observer::new();
        let tracer = PathTracer::new(&scene, &observer, settings);
        let frame = scenes::render(&scene, &camera, 1, wavelength_nm, 9);
        for i in 0..frame.pixel_count() {
            let replay = tracer.replay(&camera, i, 9, 0);
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
