//! White furnaces: in a uniform environment of radiance 1, nothing that only scatters can be seen.

use fog_core::math;
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
        let mean = scenes::mean(&frame, c);
        assert!(
            (mean - 1.0).abs() < 4.0 * scenes::standard_error(&frame).max(1e-4),
            "{name}: channel {c} is {mean}"
        );
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
