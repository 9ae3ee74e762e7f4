//! Renderings that are not exact: how far off, and by how many fewer scatterings.

use fog_core::colour::Observer;
use fog_core::moments::Moments;
use fog_scene::light::Environment;
use fog_scene::medium::{LateMedium, Medium};
use fog_scene::scene::Scene;
use fog_tests::scenes;
use fog_tracer::path::PathTracer;
use fog_tracer::settings::Settings;
use fog_tracer::watch::Step;
use std::sync::Arc;

/// What `docs/performance.md` says that a picture is off by at most.
const MOST_OFF: f64 = 0.01;

#[test]
fn similar_fog_spreads_light_alike() {
    // Extinction times 1 − g at all altitudes and wavelengths, of one function and of a table.
    let profile = || scenes::grey_profile(60.0, &[0.02, 0.08, 0.05, 0.01], 1.0);
    for medium in [scenes::hg_fog(profile(), 0.83), scenes::coloured_fog(80.0, 0.05, 1.0)] {
        let Some(late) = LateMedium::similar(&medium) else {
            // Functions of g below the share that goes straight on have no like.
            let least = medium.view().phase.mean_cosines().expect("cosines").at(0.0, 400.0);
            assert!(least < LateMedium::STRAIGHT + 0.01, "{least}");
            continue;
        };
        let spread = |medium: &Medium, y: f64, nm: f64| {
            let (view, zeta) = (medium.view(), f64::from(medium.profile().zeta(y)));
            medium.profile().sigma_t_at(y, nm)
                * (1.0 - view.phase.mean_cosines().expect("cosines").at(zeta, nm))
        };
        for (y, nm) in [(1.0, 450.0), (20.0, 550.0), (39.0, 650.0)] {
            let (want, got) = (spread(&medium, y, nm), spread(&late.medium, y, nm));
            assert!((got / want - 1.0).abs() < 1e-4, "{y} m, {nm} nm: {got} for {want}");
        }
    }
    let profile = scenes::grey_profile(60.0, &[0.05, 0.05], 1.0);
    assert!(LateMedium::similar(&scenes::hg_fog(profile, 0.3)).is_none());
    // Clear air is clear however often a path has scattered.
    let fog = scenes::hg_fog(scenes::grey_profile(60.0, &[0.05, 0.05], 1.0), 0.83);
    let scene = Scene::new(Arc::default(), Some(fog), None, None, false).with_similar_fog();
    assert!(scene.late.is_some());
    let clear = scene.without_fog();
    assert!(clear.medium.is_none() && clear.late.is_none());
}

/// Moments of paths straight ahead and their mean number of collisions.
fn moments(scene: &Scene, samples: u64, pitch_deg: f64) -> (Moments, f64) {
    let observer = Observer::new();
    let settings = Settings { samples, max_depth: None, wavelength_nm: Some(550.0), stop: None };
    let tracer = PathTracer::new(scene, &observer, settings);
    let camera = scenes::camera(2.0, 0.0, pitch_deg, 1, 1, 1.0);
    let (mut light, mut collisions) = (Moments::default(), 0);
    for sample in 0..samples {
        let replay = tracer.replay(&camera, 0, 3, sample).expect("seen");
        light.add(f64::from(replay.radiance[0]));
        collisions += replay.steps.iter().filter(|step| matches!(step, Step::Collision { .. })).count();
    }
    (light, collisions as f64 / samples as f64)
}

#[test]
fn similar_fog_is_near_the_fog() {
    // Optical depth 24 under a uniform sky, over a grey plain.
    let fog = scenes::hg_fog(scenes::grey_profile(200.0, &[0.12, 0.12], 1.0), 0.85);
    let sky = Some(Environment { radiance: 1.0 });
    let scene = Scene::new(scenes::lambertian_ground(0.3), Some(fog), sky, None, false);
    let (exact, of_exact) = moments(&scene, 12_000, 40.0);
    let (near, of_near) = moments(&scene.with_similar_fog(), 12_000, 40.0);
    let off = near.mean() / exact.mean() - 1.0;
    let error = near.standard_error().hypot(exact.standard_error()) / exact.mean();
    println!(
        "off by {:+.2} % ± {:.2} %, {of_near:.1} collisions for {of_exact:.1}",
        100.0 * off,
        100.0 * error
    );
    assert!(error < 0.005 && off.abs() < MOST_OFF + 4.0 * error, "{off} ± {error}");
    assert!(of_near < 0.7 * of_exact, "{of_near} collisions for {of_exact}");
}
