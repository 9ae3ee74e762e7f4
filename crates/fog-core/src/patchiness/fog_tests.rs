use super::*;
use crate::math;
use crate::patchiness::Patchiness;
use crate::random::PathRng;

/// A smooth profile in colour, and one of few straight parts with jumps, both over 100 m.
fn profiles() -> [ExtinctionProfile; 2] {
    let z: Vec<f64> = (0..=64).map(|i| 100.0 * f64::from(i) / 64.0).collect();
    let smooth: Vec<f64> =
        z.iter().flat_map(|z| [1.0, 1.2].map(|c| c * (0.004 + 5e-4 * z * (1.2 - 0.01 * z)))).collect();
    let albedo = vec![1.0; smooth.len()];
    let smooth = ExtinctionProfile::new(5.0, z, vec![400.0, 700.0], smooth, albedo).unwrap();
    let rows = vec![0.0, 30.0, 30.01, 60.0, 60.01, 100.0];
    let steps = vec![0.04, 0.04, 0.0, 0.01, 0.05, 0.03];
    [smooth, ExtinctionProfile::new(5.0, rows, vec![550.0], steps, vec![1.0; 6]).unwrap()]
}

fn field(density_sd: f64, top_sd_m: f64, octaves: u32) -> PatchyField {
    PatchyField::new(Patchiness { density_sd, top_sd_m, length_m: 80.0, octaves, seed: 5 }).unwrap()
}

fn rays(n: usize) -> Vec<(Vec3A, Vec3A, f64)> {
    let mut rng = PathRng::new(3, 0, 0);
    (0..n)
        .map(|_| {
            let origin = [1000.0 * rng.uniform(), 140.0 * rng.uniform() - 10.0, 1000.0 * rng.uniform()];
            let up = 2.0 * rng.uniform() - 1.0;
            let (sin, cos) = math::sin_cos_turns(rng.uniform());
            let flat = (1.0 - up * up).sqrt();
            let direction = Vec3A::new(flat * cos, up, flat * sin).normalize();
            (Vec3A::from_array(origin), direction, 200.0 * rng.uniform_f64())
        })
        .collect()
}

#[test]
fn truth_is_the_integral_over_points() {
    for profile in profiles() {
        for (sd, top, octaves) in [(0.5, 5.0, 3), (1.0, 8.0, 1), (1.5, 0.0, 2)] {
            let field = field(sd, top, octaves);
            let fog = PatchyFog::new(&profile, &field).unwrap();
            let lanes = profile.lanes(&Wavelengths::monochromatic(600.0));
            for (origin, direction, length) in rays(12) {
                let n = 20_000;
                let step = length / f64::from(n);
                let sigma = |y: f64| {
                    let inside = (profile.base_y()..=profile.top_y()).contains(&y);
                    if inside { f64::from(profile.sigma_t(y, &lanes)[0]) } else { 0.0 }
                };
                let at = |k: i32| {
                    let t = (f64::from(k) + 0.5) * step;
                    fog.layer().sigma_t((origin.as_dvec3() + direction.as_dvec3() * t).to_array(), sigma)
                };
                let brute = (0..n).map(at).sum::<f64>() * step;
                let [exact] = fog.optical_depths_at(origin, direction, length, [600.0]);
                // A jump of the profile moves the sum over points by up to one step of it.
                assert!((exact - brute).abs() < 1e-4 + 0.2 * step, "{sd} {top}: {exact} for {brute}");
            }
        }
    }
}

#[test]
fn walks_of_paths_are_near_the_truth() {
    for profile in profiles() {
        for (sd, top, octaves) in [(0.5, 5.0, 3), (1.0, 8.0, 1), (1.5, 0.0, 2)] {
            let field = field(sd, top, octaves);
            let fog = PatchyFog::new(&profile, &field).unwrap();
            let lanes = profile.lanes(&Wavelengths::monochromatic(600.0));
            let (mut square, mut sum, n) = (0.0, 0.0, 400);
            for (origin, direction, length) in rays(n) {
                let [exact] = fog.optical_depths_at(origin, direction, length, [600.0]);
                let walked = fog.fly(origin, direction, length, f64::INFINITY, &lanes);
                let error = f64::from(math::fast_exp(-walked.depth[0])) - math::f64::exp(-exact);
                (sum, square) = (sum + error, square + error * error);
            }
            let (rms, mean) = ((square / n as f64).sqrt(), sum / n as f64);
            assert!(rms < 3e-3 && mean.abs() < 3e-4, "{sd} {top} {octaves}: {rms:e}, mean {mean:e}");
        }
    }
}

#[test]
fn flights_end_where_their_depth_is_used_up() {
    let mut rng = PathRng::new(8, 0, 0);
    let mut ends = [0; 2];
    for profile in profiles() {
        let field = field(0.8, 6.0, 3);
        let fog = PatchyFog::new(&profile, &field).unwrap();
        let lanes = profile.lanes(&Wavelengths::monochromatic(600.0));
        for (origin, direction, length) in rays(1000) {
            let tau = math::neg_ln(1.0 - rng.uniform_f64());
            let flown = fog.fly(origin, direction, length, tau, &lanes);
            let again = fog.fly(origin, direction, flown.t, f64::INFINITY, &lanes);
            let depth = f64::from(flown.depth[0]);
            assert!((f64::from(again.depth[0]) - depth).abs() < 1e-5 * (1.0 + depth), "{flown:?} {again:?}");
            ends[usize::from(flown.collided)] += 1;
            if flown.collided {
                assert!((depth - tau).abs() < 1e-6 * (1.0 + tau) && flown.t <= length, "{tau}: {flown:?}");
                // Both see the same droplets at the end.
                assert!((again.even_y - flown.even_y).abs() < 1e-6, "{flown:?} {again:?}");
                assert!((again.density - flown.density).abs() < 1e-9 * flown.density, "{flown:?} {again:?}");
            } else {
                assert!(depth <= tau * (1.0 + 1e-6) && flown.t == length, "{tau}: {flown:?}");
            }
        }
    }
    assert!(ends[0].min(ends[1]) > 300, "{ends:?}");
}

#[test]
fn without_amplitude_it_is_the_even_layer() {
    for profile in profiles() {
        let field = field(0.0, 0.0, 2);
        let fog = PatchyFog::new(&profile, &field).unwrap();
        let lanes = profile.lanes(&Wavelengths::monochromatic(600.0));
        for (origin, direction, length) in rays(300) {
            let (y, dy) = (f64::from(origin.y), f64::from(direction.y));
            let even = profile.optical_depth(y, dy, length, &lanes)[0];
            let walked = fog.fly(origin, direction, length, f64::INFINITY, &lanes).depth[0];
            assert!((walked - even).abs() < 1e-5 * (1.0 + even), "{walked} for {even}");
            let [exact] = fog.optical_depths_at(origin, direction, length, [600.0]);
            assert!((exact - profile.optical_depth_at(y, dy, length, 600.0)).abs() < 1e-6 * (1.0 + exact));
        }
    }
}

#[test]
fn rays_without_end() {
    let [profile, _] = profiles();
    let field = field(0.5, 5.0, 2);
    let fog = PatchyFog::new(&profile, &field).unwrap();
    let depth = |y: f32, direction: Vec3A| {
        fog.optical_depths_at(Vec3A::new(0.0, y, 0.0), direction.normalize(), f64::INFINITY, [600.0])[0]
    };
    assert_eq!(depth(50.0, Vec3A::X), f64::INFINITY);
    assert_eq!(depth(300.0, Vec3A::X), 0.0);
    assert_eq!(depth(300.0, Vec3A::Y), 0.0);
    let up = depth(0.0, Vec3A::Y);
    assert!(up > 0.5 && up < 10.0, "{up}");
    let lanes = profile.lanes(&Wavelengths::monochromatic(600.0));
    let level = fog.fly(Vec3A::Y * 50.0, Vec3A::X, f64::INFINITY, 3.0, &lanes);
    assert!(level.collided && level.t.is_finite());
    let grazing = fog.fly(Vec3A::Y * 127.0, Vec3A::X, f64::INFINITY, 30.0, &lanes);
    assert!(!grazing.collided, "{grazing:?}");
}
