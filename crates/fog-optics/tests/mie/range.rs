//! Nothing breaks anywhere in the kernel's range: no NaN, no overflow, nothing unphysical.

use fog_optics::mie::{Complex64, Efficiencies, MieSeries, batch, efficiencies};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;

const ANGLES: [f64; 7] = [1.0, 0.999, 0.4, 0.0, -0.7, -0.999, -1.0];

/// Everything that must hold for any sphere.
fn check(m: Complex64, x: f64) -> Result<Efficiencies, String> {
    let series = MieSeries::new(m, x).map_err(|e| e.to_string())?;
    let q = series.efficiencies();
    let name = || format!("m = {m:e}, x = {x:e}: {q:?}");
    let all = [q.q_ext, q.q_sca, q.q_abs, q.q_back, q.g];
    if !all.iter().all(|v| v.is_finite()) {
        return Err(format!("not finite: {}", name()));
    }
    if !(q.q_sca >= 0.0 && q.q_abs >= 0.0 && q.q_back >= 0.0 && q.q_ext >= q.q_sca && q.g.abs() <= 1.0) {
        return Err(format!("unphysical: {}", name()));
    }
    if (m.im == 0.0) != (q.q_abs == 0.0) && !(q.q_abs == 0.0 && m.im < 1e-290) {
        return Err(format!("absorbs without k, or not with it: {}", name()));
    }
    // Unitarity: no multipole can scatter more than comes in, |2a − 1| ≤ 1.
    let passive = |c: &Complex64| (2.0 * c.re - 1.0).powi(2) + 4.0 * c.im * c.im <= 1.0 + 1e-14;
    if !series.a().iter().chain(series.b()).all(passive) {
        return Err(format!("a multipole gains energy: {}", name()));
    }
    if !series.amplitudes(&ANGLES).iter().all(|s| s.s1.norm_sqr().is_finite() && s.s2.norm_sqr().is_finite())
    {
        return Err(format!("amplitudes: {}", name()));
    }
    Ok(q)
}

#[test]
fn corners_and_edges_hold() {
    let sizes = [1e-6, 1e-4, 0.02, 0.7, 1.0, core::f64::consts::PI, 10.0, 99.9, 3e3];
    let n = [0.1, 0.5, 0.9999999, 1.0, 1.0 + 1e-15, 1.0001, 1.333, 2.0, 10.0];
    let k = [0.0, 1e-300, 1e-30, 1e-12, 1e-3, 1.0, 10.0];
    for x in sizes {
        for n in n {
            for k in k {
                check(Complex64::new(n, k), x).unwrap();
            }
        }
    }
    for (n, k) in [(0.1, 0.0), (0.1, 10.0), (1.333, 0.0), (1.333, 1e-7), (10.0, 0.0), (10.0, 10.0)] {
        check(Complex64::new(n, k), 1e5).unwrap();
    }
}

#[test]
fn no_sphere_scatters_nothing() {
    for x in [1e-6, 1.0, 1e3] {
        let nothing = Efficiencies { q_ext: 0.0, q_sca: 0.0, q_abs: 0.0, q_back: 0.0, g: 0.0 };
        assert_eq!(check(Complex64::new(1.0, 0.0), x), Ok(nothing));
    }
}

#[test]
fn large_spheres_remove_twice_their_shadow() {
    for (n, k) in [(1.333, 0.0), (1.333, 1e-6), (1.5, 0.1), (10.0, 10.0), (0.75, 0.0)] {
        let q = efficiencies(Complex64::new(n, k), 1e5).unwrap();
        // Q_ext → 2 + O(x^(−2/3)): the extinction paradox (B&H Sec. 4.4.3).
        assert!((q.q_ext - 2.0).abs() < 3e-3, "{n} {k}: {q:?}");
    }
}

#[test]
fn batches_are_single_spheres() {
    let m = Complex64::new(1.33, 1e-5);
    let sizes = [50.0, 0.01, 333.3, 7.7, 1e3, 12.0]; // unordered, and more than one group
    let all = batch(m, &sizes, &ANGLES).unwrap();
    for (i, &x) in sizes.iter().enumerate() {
        let series = MieSeries::new(m, x).unwrap();
        assert_eq!(all.efficiencies[i], series.efficiencies());
        let typical = 0.25 * x * x * all.efficiencies[i].q_sca;
        for (j, s) in series.amplitudes(&ANGLES).iter().enumerate() {
            let want = 0.5 * (s.s1.norm_sqr() + s.s2.norm_sqr());
            let got = all.intensities[i * ANGLES.len() + j];
            assert!((got - want).abs() < 1e-12 * want.max(typical), "x {x}, μ {}: {got} {want}", ANGLES[j]);
        }
    }
    let empty = batch(m, &[], &ANGLES).unwrap();
    assert!(empty.efficiencies.is_empty() && empty.intensities.is_empty());
    let blind = batch(m, &[2.0], &[]).unwrap();
    assert!(blind.efficiencies.len() == 1 && blind.intensities.is_empty());
    let error = batch(m, &[1.0, -3.0], &ANGLES).unwrap_err().to_string();
    assert!(error.contains("size parameter is -3") && error.contains("1e-6 to 100000"), "{error}");
}

/// Even in the logarithm.
fn log_uniform(low: f64, high: f64) -> impl Strategy<Value = f64> {
    use fog_core::math::f64::{exp, ln};
    (0.0..=1.0).prop_map(move |u| (low * exp(u * ln(high / low))).clamp(low, high))
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 4000,
        rng_seed: RngSeed::Fixed(1),
        failure_persistence: None,
        ..ProptestConfig::default()
    })]

    #[test]
    fn any_sphere_is_physical(
        x in prop_oneof![40 => log_uniform(1e-6, 500.0), 1 => log_uniform(500.0, 1e5)],
        n in prop_oneof![log_uniform(0.1, 10.0), (-1.0..1.0f64).prop_map(|d| 1.0 + 1e-6 * d)],
        k in prop_oneof![Just(0.0), log_uniform(1e-200, 10.0), log_uniform(1e-9, 10.0), 0.0..=10.0f64],
    ) {
        if let Err(problem) = check(Complex64::new(n, k), x) {
            return Err(TestCaseError::fail(problem));
        }
    }
}
