use super::*;
use crate::random::PathRng;

fn bumpy() -> ExtinctionProfile {
    let n = 129;
    let z: Vec<f64> = (0..n).map(|i| 180.0 * i as f64 / (n - 1) as f64).collect();
    let (mut s, mut a) = (Vec::new(), Vec::new());
    for &z in &z {
        for l in 0..3 {
            let x = z / 180.0;
            s.push((0.004 + 0.05 * x * (1.2 - x)) * (1.0 + 0.1 * l as f64));
            a.push(1.0 - 0.1 * x);
        }
    }
    ExtinctionProfile::new(10.0, z, vec![400.0, 500.0, 700.0], s, a).unwrap()
}

#[test]
fn depth_equals_brute_force_at_every_slope() {
    let p = bumpy();
    for &dy in &[1.0, -1.0, 0.3, -0.01, 1e-4, 1e-9, 0.0, -1e-14] {
        for &(y0, t_max) in &[(12.0, 100.0), (150.0, 700.0), (80.0, 3.0), (5.0, 400.0), (250.0, 600.0)] {
            let n = 200_000;
            let brute: f64 = (0..n)
                .map(|i| p.sigma_t_at(y0 + dy * t_max * (i as f64 + 0.5) / n as f64, 450.0))
                .sum::<f64>()
                * t_max
                / n as f64;
            let exact = p.optical_depth_at(y0, dy, t_max, 450.0);
            assert!((exact - brute).abs() < 1e-4 * (1e-3 + brute), "{dy} {y0} {t_max}: {exact} {brute}");
            let lanes = p.lanes(&Wavelengths::monochromatic(450.0));
            let lane = p.optical_depth(y0, dy, t_max, &lanes)[3];
            assert!((f64::from(lane) - exact).abs() <= 1e-6 * exact);
        }
    }
}

#[test]
fn free_flight_inverts_depth() {
    let p = bumpy();
    let lanes = p.lanes(&Wavelengths::monochromatic(460.0));
    let mut rng = PathRng::new(9, 0, 0);
    let (mut hits, mut misses) = (0, 0);
    for _ in 0..50_000 {
        let dy = 2.0 * rng.uniform_f64() - 1.0;
        let dy = if rng.uniform() < 0.3 { dy * 1e-5 } else { dy };
        let y0 = 300.0 * rng.uniform_f64() - 20.0;
        let tau = -crate::math::f64::ln(1.0 - rng.uniform_f64());
        let t_max = 2000.0 * rng.uniform_f64();
        match p.free_flight(y0, dy, t_max, tau, &lanes) {
            Some(t) => {
                hits += 1;
                let depth = p.optical_depth_at(y0, dy, t, 460.0);
                assert!((depth - tau).abs() < 1e-8 * (1.0 + tau), "{y0} {dy} {tau}: {depth}");
            }
            None => {
                misses += 1;
                let depth = p.optical_depth_at(y0, dy, t_max, 460.0);
                assert!(depth <= tau * (1.0 + 1e-9) + 1e-9, "{y0} {dy} {t_max} {tau}: {depth}");
            }
        }
    }
    assert!(hits > 1000 && misses > 1000);
}

#[test]
fn infinite_rays_end_at_the_top_or_never() {
    let p = bumpy();
    assert!(p.optical_depth_at(20.0, 0.5, f64::INFINITY, 500.0).is_finite());
    assert_eq!(p.optical_depth_at(20.0, 0.0, f64::INFINITY, 500.0), f64::INFINITY);
    assert_eq!(p.optical_depth_at(200.0, 0.5, f64::INFINITY, 500.0), 0.0);
    let lanes = p.lanes(&Wavelengths::monochromatic(500.0));
    assert!(p.free_flight(20.0, 0.0, f64::INFINITY, 30.0, &lanes).is_some());
}

#[test]
fn thinned_fog_keeps_its_absorption() {
    let p = bumpy();
    let thin = p.thinned(0.3);
    let lanes = p.lanes(&Wavelengths::monochromatic(460.0));
    let (mut rng, mut hits) = (PathRng::new(10, 0, 0), 0);
    for y in [15.0, 80.0, 170.0] {
        let absorbed = |p: &ExtinctionProfile| p.sigma_t(y, &lanes)[0] * (1.0 - p.albedo(y, &lanes)[0]);
        assert!((absorbed(&thin) - absorbed(&p)).abs() < 1e-6 * absorbed(&p) + 1e-9);
        for dy in [0.7, -0.2, 0.0] {
            let [whole, part] = [&p, &thin].map(|p| p.optical_depth_at(y, dy, 90.0, 460.0));
            assert!((part - 0.3 * whole).abs() < 1e-12 * whole);
            let tau = rng.uniform_f64();
            let [whole, part] = [(&p, tau / 0.3), (&thin, tau)]
                .map(|(p, tau)| p.free_flight(y, dy, f64::INFINITY, tau, &lanes));
            assert_eq!(whole.is_some(), part.is_some());
            if let (Some(whole), Some(part)) = (whole, part) {
                assert!((whole - part).abs() < 1e-9 * whole);
                hits += 1;
            }
        }
    }
    assert!(hits > 3, "{hits}");
    assert!((thin.least_albedo() - (1.0 - 0.1 / 0.3)).abs() < 1e-12);
}

#[test]
fn bad_rows_are_refused() {
    let make = |z: &[f64], s: &[f64]| {
        ExtinctionProfile::new(0.0, z.to_vec(), vec![550.0], s.to_vec(), vec![1.0; s.len()])
    };
    assert_eq!(make(&[0.0], &[1.0]).unwrap_err(), ProfileError::TooShort);
    assert!(matches!(make(&[0.0, 0.0], &[1.0, 1.0]), Err(ProfileError::Order { row: 1, .. })));
    assert!(matches!(make(&[0.0, 1.0], &[1.0, -1.0]), Err(ProfileError::Value { .. })));
    assert!(matches!(make(&[0.0, 1.0], &[1.0, f64::NAN]), Err(ProfileError::Value { .. })));
}
