//! Sampling by noise on the street at night: the same greatest error from fewer samples, and the same light.

use fog_core::moments::Moments;
use fog_film::Frame;
use fog_scene::scene::Scene;
use fog_tests::scenes;
use fog_tracer::settings::{NoiseTarget, Settings, Stop};

fn render(scene: &Scene, samples: u64, stop: Option<Stop>, seed: u64) -> Frame {
    let camera = scenes::camera(1.7, 0.0, 0.0, 64, 36, 60.0);
    let settings = Settings { samples, max_depth: None, wavelength_nm: None, stop };
    let observer = fog_core::colour::Observer::new();
    fog_tracer::render::render(scene, &camera, &observer, &settings, seed, &|_| true)
        .expect("finite")
        .expect("not cancelled")
}

/// Root mean square of the largest hundredth of the pixels' relative errors.
fn worst(frame: &Frame) -> f64 {
    let floor = frame.pixel_noise(1.0).floor;
    let relative = |i| f64::from(frame.standard_error[i]) / frame.luminance(i).max(floor);
    let mut all: Vec<f64> = (0..frame.pixel_count()).map(relative).collect();
    all.sort_by(f64::total_cmp);
    let tail = &all[all.len() * 99 / 100..];
    (tail.iter().map(|e| e * e).sum::<f64>() / tail.len() as f64).sqrt()
}

#[test]
fn fewer_samples_for_the_same_greatest_error() {
    let fog = scenes::hg_fog(scenes::grey_profile(60.0, &[0.03, 0.02, 0.01], 1.0), 0.83);
    let scene = Scene::new(scenes::load("street_grey_night.glb"), Some(fog), None, None, true);
    let stop = Stop::Noise(NoiseTarget { noise: 0.2, max_samples: 4096 });
    let by_noise = render(&scene, 16, Some(stop), 1);
    let samples = by_noise.mean_samples();
    let uniform = render(&scene, samples.ceil() as u64, None, 2);
    // Errors go with the root of the number of samples.
    let (a, b) = (worst(&by_noise), worst(&uniform));
    let gain = (b / a).powi(2);
    println!("{samples:.0} samples per pixel: worst pixels {a:.3} by noise, {b:.3} alike: gain {gain:.1}");
    println!("by noise {:?}, alike {:?}", by_noise.pixel_noise(0.2), uniform.pixel_noise(0.2));
    assert!(gain > 2.0, "{gain}");
    assert!(by_noise.pixel_noise(0.2).within > 0.99);

    // Both have the same light: pixels differ by their errors, and not on the whole.
    let mut differences = Moments::default();
    let mut light = 0.0;
    for i in 0..by_noise.pixel_count() {
        differences.add(by_noise.luminance(i) - uniform.luminance(i));
        light += uniform.luminance(i) / uniform.pixel_count() as f64;
    }
    let (off, error) = (differences.mean() / light, differences.standard_error() / light);
    println!("mean off by {:+.2} % ± {:.2} %", 100.0 * off, 100.0 * error);
    assert!(off.abs() < 3.0 * error, "{off} ± {error}");
}
