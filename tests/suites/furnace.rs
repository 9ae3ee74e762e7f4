//! Furnaces. White: in a uniform environment of radiance 1, nothing that only scatters can be seen. Closed: among walls that
//! emit E and reflect a, everything shines with E / (1 − a), whatever only scatters between them.

use fog_core::colour::{Observer, Rgb, upsample};
use fog_core::math;
use fog_core::moments::Moments;
use fog_core::spectrum::Wavelengths;
use fog_optics::jendersie_deon;
use fog_scene::light::Environment;
use fog_scene::medium::Medium;
use fog_scene::phase::Phase;
use fog_scene::scene::Scene;
use fog_tests::scenes;

const WHITE: Option<Environment> = Some(Environment { radiance: 1.0 });

/// Every pixel is 1 within its own noise, and so is the mean.
pub(crate) fn assert_white(name: &str, scene: &Scene, camera_altitude: f32, pitch: f64, samples: u64) {
    let camera = scenes::camera(camera_altitude, 30.0, pitch, 32, 18, 90.0);
    let frame = scenes::render(scene, &camera, samples, None, 5);
    let n = frame.pixel_count();
    for i in 0..n {
        let rgb = frame.image(i);
        let error = (frame.luminance(i) - 1.0).abs();
        // 576 pixels: 5 standard errors are exceeded once in 3000 such frames; 1e-3 covers a pixel without any noise.
        let allowed = 5.0 * f64::from(frame.standard_error[i]) + 1e-3;
        assert!(error < allowed, "{name}, pixel {i}: {rgb:?}, off by {error} of {allowed}");
    }
    for c in 0..3 {
        // All pixels should be the same: their spread is the error of a channel.
        let mut channel = Moments::default();
        (0..n).for_each(|i| channel.add(f64::from(frame.image(i)[c])));
        let (mean, error) = (channel.mean(), channel.standard_error());
        assert!((mean - 1.0).abs() < 4.0 * error.max(1e-4), "{name}: channel {c} is {mean} ± {error}");
    }
}

/// Fogs of albedo 1, from thin to so dense that light scatters hundreds of times.
fn fogs() -> Vec<(String, Medium)> {
    let mut fogs = Vec::new();
    for sigma in [1e-3, 0.03, 0.5] {
        let profile = scenes::grey_profile(100.0, &[sigma, 2.0 * sigma, 0.5 * sigma], 1.0);
        fogs.push((format!("grey fog {sigma}"), scenes::hg_fog(profile, 0.83)));
        fogs.push((format!("coloured fog {sigma}"), scenes::coloured_fog(100.0, sigma, 1.0)));
    }
    fogs
}

#[test]
fn fog_alone() {
    for (name, fog) in fogs() {
        let scene = Scene::new(scenes::empty(), Some(fog), WHITE, None, false);
        assert_white(&name, &scene, 30.0, 0.0, 256);
    }
}

#[test]
fn single_droplets_and_closed_forms() {
    let fit = jendersie_deon::phase_function(12.0).unwrap();
    let grey = scenes::grey_profile(100.0, &[0.03, 0.06, 0.015], 1.0);
    for (name, fog) in [
        ("single droplets", scenes::parcel(100.0, 0.05, true)),
        ("jendersie_deon", Medium::new(grey, Phase::HgDraine(fit))),
    ] {
        let scene = Scene::new(scenes::empty(), Some(fog), WHITE, None, false);
        assert_white(name, &scene, 30.0, 0.0, 256);
    }
}

#[test]
fn fog_over_white_ground_and_buildings() {
    let loaded = scenes::white_street();
    for (name, fog) in fogs().into_iter().filter(|(name, _)| !name.ends_with("0.5")) {
        let scene = Scene::new(loaded.clone(), Some(fog), WHITE, None, false);
        assert_white(&format!("{name} over a white street"), &scene, 20.0, -5.0, 256);
    }
    let clear = Scene::new(loaded, None, WHITE, None, false);
    assert_white("white street in clear air", &clear, 20.0, -5.0, 256);
}

#[test]
fn absorbing_fog_follows_its_closed_form() {
    // Forward-only scattering does not exist, but pure absorption does: albedo 0 leaves exp(-tau) of the environment.
    let profile = scenes::grey_profile(100.0, &[0.01, 0.01], 0.0);
    let scene = Scene::new(scenes::empty(), Some(scenes::hg_fog(profile, 0.5)), WHITE, None, false);
    let camera = scenes::camera(0.0, 0.0, 90.0, 8, 8, 10.0);
    let frame = scenes::render(&scene, &camera, 4096, None, 3);
    let want = (0..frame.pixel_count()).map(|i| math::f64::exp(f64::from(-frame.truth.tau[i]))).sum::<f64>()
        / frame.pixel_count() as f64;
    let got = scenes::mean(&frame, 1);
    assert!((got - want).abs() < 4.0 * scenes::standard_error(&frame), "{got} for {want}");
}

/// The whole image has one expected colour; its pixels' scatter tells the error of their mean.
fn assert_colour(name: &str, scene: &Scene, samples: u64, want: [f64; 3], resolution: f64) {
    let camera = scenes::camera(1.7, 30.0, -5.0, 24, 16, 80.0);
    let frame = scenes::render(scene, &camera, samples, None, 9);
    for c in 0..3 {
        let mut pixels = Moments::default();
        (0..frame.pixel_count()).for_each(|i| pixels.add(f64::from(frame.image(i)[c])));
        let (got, error) = (pixels.mean(), pixels.standard_error());
        // 1e-4 covers single precision where nothing is noisy.
        let off = (got - want[c]).abs();
        assert!(off < 4.5 * error + 1e-4 * want[c], "{name}, channel {c}: {got} ± {error} for {}", want[c]);
        assert!(error < resolution * want[c], "{name}, channel {c}: too noisy to tell, {got} ± {error}");
    }
}

/// E / (1 − a) at every wavelength, seen by the observer.
fn enclosed(reflectance: Rgb, emission: Rgb) -> [f64; 3] {
    let observer = Observer::new();
    observer.rgb_of(|nm| {
        let basis = observer.lane_basis(&Wavelengths::monochromatic(nm));
        upsample(emission, &basis)[0] / (1.0 - upsample(reflectance, &basis)[0])
    })
}

#[test]
fn closed_furnace_shines_with_its_sum() {
    for reflectance in [0.0, 0.5, 0.8, 0.95] {
        let scene = Scene::new(scenes::enclosure([reflectance; 3], [1.0; 3]), None, None, None, true);
        // 1 of sRGB is 1 at every wavelength within 0.3 %; the sum over reflections makes 20 times as much of it.
        let want = enclosed([reflectance; 3], [1.0; 3]);
        let sum = 1.0 / (1.0 - f64::from(reflectance));
        assert!((want[1] / sum - 1.0).abs() < 0.01, "{want:?} for {sum}");
        assert_colour(&format!("walls of {reflectance}"), &scene, 256, want, 0.01);
    }
}

#[test]
fn coloured_furnaces() {
    let (reflectance, emission) = ([0.8, 0.5, 0.2], [0.2, 0.5, 0.3]);
    let want = enclosed(reflectance, emission);
    let grey = scenes::hg_fog(scenes::grey_profile(6.0, &[0.05, 0.2], 1.0), 0.83);
    for (name, fog) in [
        ("clear air", None),
        ("grey fog", Some(grey)),
        ("coloured fog", Some(scenes::coloured_fog(6.0, 0.1, 1.0))),
        ("single droplets", Some(scenes::parcel(6.0, 0.1, true))),
    ] {
        let scene = Scene::new(scenes::enclosure(reflectance, emission), fog, None, None, true);
        assert_colour(&format!("coloured walls in {name}"), &scene, 512, want, 0.01);
    }
    // Of a white environment, a convex surface shows its own reflectance in every channel.
    let mut ground = (*scenes::lambertian_ground(0.0)).clone();
    ground.materials[0].base_color = [0.9, 0.4, 0.1, 1.0];
    let scene = Scene::new(ground.into(), None, WHITE, None, false);
    let camera = scenes::camera(2.0, 0.0, -90.0, 24, 16, 60.0);
    let frame = scenes::render(&scene, &camera, 256, None, 4);
    for (c, want) in [0.9, 0.4, 0.1].into_iter().enumerate() {
        let mut pixels = Moments::default();
        (0..frame.pixel_count()).for_each(|i| pixels.add(f64::from(frame.image(i)[c])));
        let (got, error) = (pixels.mean(), pixels.standard_error());
        assert!((got - want).abs() < 4.5 * error + 1e-4, "ground, channel {c}: {got} ± {error} for {want}");
    }
}
