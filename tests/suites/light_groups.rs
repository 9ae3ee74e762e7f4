//! Groups of lights: their layers add up to the image, which is the same to the bit as without them.

use fog_core::Vec3A;
use fog_core::colour::Observer;
use fog_core::moments::Moments;
use fog_film::Frame;
use fog_scene::LoadedScene;
use fog_scene::lamp::{Beam, Lamp, LightNames, PunctualLights};
use fog_scene::light::{Environment, Sun};
use fog_scene::light_groups::{LightGroup, LightGroups, LightPattern};
use fog_scene::scene::Scene;
use fog_tests::scenes;
use fog_tracer::settings::{NoiseTarget, Settings, Stop};
use std::sync::Arc;

/// The street by night with every kind of light.
fn street(environment: f32, intensities: Option<[f32; 5]>) -> Scene {
    let street = scenes::load("street_night.glb");
    let lamp = |x: f32| Lamp::even(Vec3A::new(x, 5.0, -12.0), [40.0, 60.0, 50.0]);
    let beam = Beam { direction: Vec3A::new(0.3, 0.9, 0.2).normalize(), illuminance: [0.2, 0.1, 0.1] };
    let lights = PunctualLights { lamps: vec![lamp(2.0), lamp(-2.0)], beams: vec![beam] };
    let names = |list: &[&str]| list.iter().map(|&s| s.to_owned()).collect();
    let light_names = LightNames { lamps: names(&["right", "left"]), beams: names(&["moon"]) };
    let loaded = Arc::new(LoadedScene { lights, light_names, ..(*street).clone() });
    let fog = scenes::coloured_fog(60.0, 0.02, 0.95);
    let sun = Sun::new(20.0, 30.0, 1.0, 2.0);
    let scene = Scene::new(loaded, Some(fog), Some(Environment { radiance: environment }), Some(sun), true);
    let Some(intensities) = intensities else { return scene };
    let patterns = [
        LightPattern::Sun,
        LightPattern::Environment,
        LightPattern::Node("left".into()),
        LightPattern::Emitters,
        LightPattern::Beams,
    ];
    let groups = patterns.into_iter().zip(intensities).enumerate();
    let group =
        |(i, (light, intensity))| LightGroup { name: format!("g{i}"), lights: vec![light], intensity };
    scene.with_light_groups(LightGroups::new(groups.map(group).collect()))
}

fn render(scene: &Scene, settings: &Settings) -> Frame {
    render_seed(scene, settings, 3)
}

fn render_seed(scene: &Scene, settings: &Settings, seed: u64) -> Frame {
    let camera = scenes::camera(1.7, 0.0, 0.0, 32, 18, 60.0);
    fog_tracer::render::render(scene, &camera, &Observer::new(), settings, seed, &|_| true)
        .expect("finite")
        .expect("not cancelled")
}

#[test]
fn layers_add_up_and_change_nothing() {
    let stop = Stop::Noise(NoiseTarget { noise: 0.3, max_samples: 64 });
    let by_noise = Settings { samples: 16, stop: Some(stop), max_depth: None, wavelength_nm: None };
    let mono = Settings { samples: 16, stop: None, max_depth: Some(6), wavelength_nm: Some(600.0) };
    for settings in [by_noise, mono] {
        let channels = if settings.wavelength_nm.is_some() { 1 } else { 3 };
        let plain = render(&street(0.2, None), &settings);
        let frame = render(&street(0.2, Some([1.0; 5])), &settings);
        assert!(plain.groups.is_empty());
        assert_eq!(
            (&frame.direct, &frame.airlight, &frame.samples),
            (&plain.direct, &plain.airlight, &plain.samples)
        );
        let names: Vec<&str> = frame.groups.iter().map(|g| g.name.as_str()).collect();
        assert_eq!(names, ["g0", "g1", "g2", "g3", "g4", "rest"]);
        for group in &frame.groups {
            let sum: f32 = group.radiance.iter().map(|rgb| rgb[0]).sum();
            assert!(sum > 0.0, "{} is dark", group.name);
        }
        for i in 0..frame.pixel_count() {
            for c in 0..channels {
                let parts: Vec<f64> = frame.groups.iter().map(|g| f64::from(g.radiance[i][c])).collect();
                let sum: f64 = parts.iter().sum();
                // Sums of f32 at eight wavelengths, whose responses have both signs.
                let size: f64 =
                    frame.groups.iter().flat_map(|g| g.radiance[i]).map(|v| f64::from(v.abs())).sum();
                let image = f64::from(frame.image(i)[c]);
                assert!((sum - image).abs() <= 2e-6 * size, "pixel {i}: {parts:?} for {image}");
            }
        }
    }
}

#[test]
fn intensities_scale_the_light_of_their_groups() {
    // No choice of a path depends on how bright the sky is, so its light is doubled to the bit.
    let settings = Settings { samples: 32, stop: None, max_depth: Some(3), wavelength_nm: None };
    let layer =
        |frame: &Frame, g: usize| frame.groups[g].radiance.iter().map(|rgb| f64::from(rgb[0])).sum::<f64>();
    let one = render(&street(0.2, Some([1.0; 5])), &settings);
    let two = render(&street(0.2, Some([1.0, 2.0, 1.0, 1.0, 1.0])), &settings);
    let layers: Vec<f64> = (0..6).map(|g| layer(&one, g)).collect();
    assert!(layers.iter().all(|&sum| sum > 0.0), "{layers:?}");
    assert_eq!(layer(&two, 1), 2.0 * layer(&one, 1));
    assert_eq!(layer(&two, 3), layer(&one, 3));
    assert_eq!(layer(&render(&street(0.2, Some([1.0, 1.0, 1.0, 0.0, 1.0])), &settings), 3), 0.0);
    // The sun's, halved, within its noise from frame to frame.
    let sun = |intensity: f32| {
        let scene = street(0.0, Some([intensity, 1.0, 1.0, 1.0, 1.0]));
        let mut sums = Moments::default();
        (0..8).for_each(|seed| sums.add(layer(&render_seed(&scene, &settings, seed), 0)));
        sums
    };
    let (full, half) = (sun(1.0), sun(0.5));
    let error = (0.25 * full.standard_error().powi(2) + half.standard_error().powi(2)).sqrt();
    let difference = 0.5 * full.mean() - half.mean();
    assert!(difference.abs() < 5.0 * error && error < 0.1 * half.mean(), "{difference} ± {error}");
}
