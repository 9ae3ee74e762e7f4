//! Rays per second through the street: `cargo test --release -p fog-scene --test speed -- --ignored --nocapture`.

mod common;

use fog_core::random::PathRng;
use fog_core::warp::uniform_sphere;
use fog_scene::{Limits, load};
use glam::Vec3A;
use std::time::Instant;

#[test]
#[ignore = "a measurement"]
fn rays_per_second() {
    let geometry = load(&common::data("street_grey.glb"), &Limits::default()).unwrap().geometry;
    let mut rng = PathRng::new(1, 1, 1);
    // Where light scatters in the fog: anywhere in the street's air, in any direction.
    let mut origin =
        || Vec3A::new((rng.uniform() - 0.5) * 100.0, rng.uniform() * 100.0, -rng.uniform() * 420.0);
    let rays: Vec<(Vec3A, Vec3A)> = (0..1_000_000).map(|_| (origin(), Vec3A::ZERO)).collect();
    let mut rng = PathRng::new(2, 1, 1);
    let rays: Vec<(Vec3A, Vec3A)> =
        rays.into_iter().map(|(o, _)| (o, uniform_sphere(rng.uniform2()))).collect();
    for (name, t_max) in [("unlimited", f32::INFINITY), ("50 m", 50.0)] {
        for _ in 0..3 {
            let start = Instant::now();
            let hits = rays.iter().filter(|(o, d)| geometry.intersect(*o, *d, t_max).is_some()).count();
            let nearest = start.elapsed().as_secs_f64();
            let start = Instant::now();
            let blocked = rays.iter().filter(|(o, d)| geometry.occluded(*o, *d, t_max)).count();
            let any = start.elapsed().as_secs_f64();
            assert_eq!(hits, blocked);
            println!(
                "{name}: intersect {:.2}, occluded {:.2} Mrays/s, {hits} hits",
                1.0 / nearest,
                1.0 / any
            );
        }
    }
}
