//! A sensor's channels beside the observer's.

use fog_core::Vec3A;
use fog_core::colour::Observer;
use fog_core::sensor_response::SensorResponse;
use fog_core::spectrum::Wavelengths;
use fog_film::Frame;
use fog_scene::LoadedScene;
use fog_scene::lamp::{Lamp, LightNames, PunctualLights};
use fog_scene::light::Environment;
use fog_scene::light_groups::{LightGroup, LightGroups, LightPattern};
use fog_scene::scene::Scene;
use fog_tests::scenes;
use fog_tracer::render_shared::{Variant, render_shared};
use fog_tracer::settings::Settings;
use std::sync::Arc;

const SETTINGS: Settings = Settings { samples: 8, stop: None, max_depth: None, wavelength_nm: None };

/// The street under an even sky, with a lamp in view, which no path finds.
fn street() -> Scene {
    let fog = scenes::coloured_fog(60.0, 0.02, 0.95);
    let lamps = vec![Lamp::even(Vec3A::new(0.5, 2.5, -8.0), [4.0, 6.0, 5.0])];
    let lights = PunctualLights { lamps, beams: vec![] };
    let light_names = LightNames { lamps: vec!["lamp".to_owned()], beams: vec![] };
    let loaded = Arc::new(LoadedScene { lights, light_names, ..(*scenes::load("street_night.glb")).clone() });
    Scene::new(loaded, Some(fog), Some(Environment { radiance: 1.0 }), None, true)
}

/// An observer with a sensor whose curves are its own.
fn with_own_curves() -> Observer {
    let observer = Observer::new();
    let curve = |nm: f64| {
        let response = observer.lane_response(&Wavelengths::monochromatic(nm as f32))[0];
        response.map(|v| f64::from(v) / (f64::from(observer.d65(nm as f32)) * nm))
    };
    let sensor = SensorResponse::new(&observer, curve).expect("green sees");
    observer.with_sensor(sensor)
}

fn render(scene: &Scene, observer: &Observer, settings: &Settings) -> Frame {
    let camera = scenes::camera(1.7, 0.0, 0.0, 24, 14, 60.0);
    fog_tracer::render::render(scene, &camera, observer, settings, 3, &|_| true)
        .expect("finite")
        .expect("not cancelled")
}

fn assert_channels_are_the_image(frame: &Frame) {
    assert_eq!(frame.sensor.len(), frame.pixel_count());
    for i in 0..frame.pixel_count() {
        let image = frame.image(i);
        let size = image.iter().fold(0.0f32, |a, v| a.max(v.abs())).max(1e-3);
        let close = (0..3).all(|c| (frame.sensor[i][c] - image[c]).abs() < 1e-5 * size);
        assert!(close, "pixel {i}: {:?} for {image:?}", frame.sensor[i]);
    }
}

#[test]
fn the_observers_curves_record_the_image_and_change_nothing() {
    let (plain, sensor) = (Observer::new(), with_own_curves());
    let groups = LightGroups::new(vec![LightGroup {
        name: "sky".into(),
        lights: vec![LightPattern::Environment],
        intensity: 1.0,
    }]);
    for scene in [street(), street().with_light_groups(groups)] {
        let without = render(&scene, &plain, &SETTINGS);
        let with = render(&scene, &sensor, &SETTINGS);
        assert_channels_are_the_image(&with);
        let lamp = with.sensor.iter().map(|rgb| rgb[1]).fold(0.0, f32::max);
        assert!(lamp > 10.0, "{lamp}");
        assert_eq!(Frame { sensor: Vec::new(), ..with }, without);
    }
    // One wavelength has no colours.
    let mono = Settings { wavelength_nm: Some(550.0), ..SETTINGS };
    assert!(render(&street(), &sensor, &mono).sensor.is_empty());
}

#[test]
fn frames_from_common_paths_have_them_too() {
    let camera = scenes::camera(1.7, 0.0, 0.0, 16, 9, 60.0);
    let groups = LightGroups::new(vec![LightGroup {
        name: "sky".into(),
        lights: vec![LightPattern::Environment],
        intensity: 1.0,
    }]);
    let thin = scenes::coloured_fog(60.0, 0.005, 0.95);
    let media = [street().medium.expect("fog"), thin];
    for scene in [street(), street().with_light_groups(groups)] {
        let variants = [Variant { fog: 0, factors: vec![] }, Variant { fog: 1, factors: vec![0.5, 2.0] }];
        let view = (&camera, &with_own_curves());
        let frames = render_shared(&scene, &media, &variants, view, &SETTINGS, 5, &|_| true);
        for frame in frames.expect("not cancelled") {
            assert_channels_are_the_image(&frame.expect("finite"));
        }
    }
}
