use super::*;
use crate::layer::{homogeneous, layered, linear_gradient};
use fog_core::random::PathRng;

const LIGHT: Law = Law::Allard { intensity_cd: 1000.0, threshold_lx: 8e-7 };

fn close(got: f64, want: f64) -> bool {
    (got / want - 1.0).abs() < 1e-9
}

#[test]
fn even_fog_has_the_horizontal_range_in_every_direction_that_stays_inside() {
    let sight = Sight::new(&homogeneous(2000.0, 0.02, 1.0).unwrap()).unwrap();
    for law in [Law::Mor, Law::Koschmieder, LIGHT] {
        let level = sight.horizontal_m(&law, 1000.0).unwrap();
        assert!(close(level, law.range_m(0.02)));
        for elevation in [-90.0, -30.0, -3.0, -1e-6, 0.0, 1e-9, 2.0, 90.0] {
            let slant = sight.along_m(&law, 1000.0, elevation).unwrap();
            assert!(close(slant, level), "{law:?} {elevation}: {slant} {level}");
        }
    }
}

#[test]
fn flat_slants_tend_to_the_horizontal_range() {
    let sight = Sight::new(&linear_gradient(200.0, 0.01, 0.05, 1.0).unwrap()).unwrap();
    for law in [Law::Mor, LIGHT] {
        let level = sight.horizontal_m(&law, 80.0).unwrap();
        let mut last = f64::INFINITY;
        for elevation in [-3.0, -0.3, -0.03, -0.003] {
            let off = (sight.along_m(&law, 80.0, elevation).unwrap() / level - 1.0).abs();
            assert!(off < last, "{elevation}: {off}");
            last = off;
        }
        assert!(last < 1e-3);
    }
}

#[test]
fn vertical_range_in_a_gradient_is_the_root_of_a_square() {
    // From the ground up, σ = a + b z: a z + b z²/2 = τ.
    let (a, b) = (0.01, 0.04 / 200.0);
    let sight = Sight::new(&linear_gradient(200.0, a, a + 200.0 * b, 1.0).unwrap()).unwrap();
    let z = (-a + (a * a + 2.0 * b * MOR_OPTICAL_DEPTH).sqrt()) / b;
    assert!(close(sight.along_m(&Law::Mor, 0.0, 90.0).unwrap(), z));
    // At 30° it is twice as far for half the altitude's rate: a s/2 … by substitution z = s/2.
    let s = (-a + (a * a + 2.0 * b * 0.5 * MOR_OPTICAL_DEPTH).sqrt()) / (b * 0.5);
    assert!(close(sight.along_m(&Law::Mor, 0.0, 30.0).unwrap(), s));
}

#[test]
fn lights_meet_their_threshold_through_fog_and_clear_air() {
    let sight = Sight::new(&layered(&[(0.0, 0.01), (20.0, 0.06), (60.0, 0.002)], 1.0).unwrap()).unwrap();
    for (altitude, elevation) in [(50.0, -3.0), (200.0, -10.0), (2.5, 1.0), (10.0, 0.0), (100.0, 5.0)] {
        let r = sight.along_m(&LIGHT, altitude, elevation).unwrap();
        let tau = sight.optical_depth(altitude, elevation, r).unwrap();
        assert!((1000.0 * exp(-tau) / (r * r) / 8e-7 - 1.0).abs() < 1e-9, "{altitude} {elevation}");
    }
}

#[test]
fn sight_of_the_ground_follows_the_mean_extinction() {
    let sight = Sight::new(&linear_gradient(100.0, 0.0, 0.1, 1.0).unwrap()).unwrap();
    // Depth from 40 m to the ground: 0.5 · 0.04 · 40 = 0.8, so that the mean is 0.02.
    assert!(close(sight.mean_sigma_t(40.0, 0.0).unwrap(), 0.02));
    assert!(close(sight.mean_sigma_t(0.0, 40.0).unwrap(), 0.02));
    let r = sight.to_altitude_m(&Law::Mor, 40.0, 0.0).unwrap().unwrap();
    assert!(close(r, MOR_OPTICAL_DEPTH / 0.02));
    let across = (r * r - 1600.0).sqrt();
    assert!(close(sight.optical_depth_between(40.0, 0.0, across).unwrap(), MOR_OPTICAL_DEPTH));
    // From 90 m the ground is not seen even straight below: 0.5 · 0.09 · 90 = 4.05 > 3.
    assert_eq!(sight.to_altitude_m(&Law::Mor, 90.0, 0.0).unwrap(), None);
    assert!(sight.to_altitude_m(&LIGHT, 90.0, 0.0).unwrap().is_some());
    // At equal altitudes it is the horizontal range.
    let level = sight.to_altitude_m(&LIGHT, 40.0, 40.0).unwrap().unwrap();
    assert!(close(level, sight.horizontal_m(&LIGHT, 40.0).unwrap()));
}

#[test]
fn above_the_fog_nothing_ends_the_sight() {
    let sight = Sight::new(&homogeneous(50.0, 0.02, 1.0).unwrap()).unwrap();
    assert_eq!(sight.horizontal_m(&Law::Mor, 60.0).unwrap(), f64::INFINITY);
    assert_eq!(sight.along_m(&Law::Mor, 60.0, 10.0).unwrap(), f64::INFINITY);
    assert_eq!(
        sight.along_m(&Law::Mor, 60.0, -90.0).unwrap(),
        f64::INFINITY,
        "50 m are an optical depth of 1"
    );
    assert!(close(sight.along_m(&LIGHT, 60.0, 10.0).unwrap(), (1000.0f64 / 8e-7).sqrt()));
    assert!(close(distance_to_altitude_m(60.0, 0.0, -30.0).unwrap().unwrap(), 120.0));
    assert_eq!(distance_to_altitude_m(60.0, 0.0, 30.0).unwrap(), None);
    assert_eq!(distance_to_altitude_m(60.0, 0.0, 0.0).unwrap(), None);
    assert_eq!(distance_to_altitude_m(60.0, 60.0, 5.0).unwrap(), Some(0.0));
    assert!(sight.along_m(&Law::Mor, 60.0, -91.0).is_err());
    assert!(sight.along_m(&Law::Mor, f64::NAN, 0.0).is_err());
    let dark = Law::Allard { intensity_cd: 0.0, threshold_lx: 1e-6 };
    assert!(sight.horizontal_m(&dark, 1.0).is_err());
}

#[test]
fn random_layers_never_give_nonsense_and_depth_grows_with_distance() {
    let mut rng = PathRng::new(11, 0, 0);
    for _ in 0..200 {
        let (mut z, mut rows) = (0.0, vec![]);
        for _ in 0..2 + (20.0 * rng.uniform_f64()) as usize {
            rows.push((z, (0.2 * rng.uniform_f64() - 0.05).max(0.0)));
            z += 0.01 + 30.0 * rng.uniform_f64();
        }
        let sight = Sight::new(&layered(&rows, 1.0).unwrap()).unwrap();
        for _ in 0..20 {
            let altitude = 1.2 * z * rng.uniform_f64();
            let elevation = (180.0 * rng.uniform_f64() - 90.0) * rng.uniform_f64();
            let mut last = 0.0;
            for i in 0..50 {
                let depth = sight.optical_depth(altitude, elevation, 7.0 * f64::from(i)).unwrap();
                assert!(depth >= last - 1e-12 * last && depth.is_finite(), "{rows:?} {altitude} {elevation}");
                last = depth;
            }
            let [five, two] =
                [Law::Mor, Law::Koschmieder].map(|l| sight.along_m(&l, altitude, elevation).unwrap());
            assert!(five > 0.0 && two >= five, "{rows:?} {altitude} {elevation}: {five} {two}");
            let weak = Law::Allard { intensity_cd: 10.0, threshold_lx: 8e-7 };
            let [near, far] = [weak, LIGHT].map(|l| sight.along_m(&l, altitude, elevation).unwrap());
            assert!(near > 0.0 && far > near && far.is_finite(), "{rows:?} {altitude} {elevation}");
        }
    }
}
