//! The independent crate `scatrs` (University of Saskatchewan) at random spheres of its validated domain.

use fog_core::math::f64::{exp, ln};
use fog_core::random::PathRng;
use fog_optics::mie::{Complex64, MieSeries};
use scatrs::mie::{AmplitudeBuffers, Mie, MieOptions, VALIDATED_DOMAIN};

/// A number between the ends, even in its logarithm.
fn log_uniform(rng: &mut PathRng, low: f64, high: f64) -> f64 {
    low * exp(rng.uniform_f64() * ln(high / low))
}

#[test]
fn scatrs_agrees() {
    let mut rng = PathRng::new(1, 0, 0);
    let mut peer = Mie::<f64>::new();
    let mu = [1.0, 0.99, 0.5, 0.0, -0.3, -0.78, -0.999, -1.0];
    let (mut s1, mut s2) = ([Complex64::default(); 8], [Complex64::default(); 8]);
    let mut worst = [0.0f64; 3];
    for i in 0..3000 {
        let x = log_uniform(&mut rng, 1e-6, if i % 50 == 0 { 2e4 } else { 500.0 });
        let n = log_uniform(&mut rng, 0.1, 10.0);
        let k = match i % 3 {
            0 => 0.0,
            1 => log_uniform(&mut rng, 1e-12, 10.0),
            _ => 10.0 * rng.uniform_f64(),
        };
        let m = Complex64::new(n, k);
        assert!(VALIDATED_DOMAIN.contains(x, m));
        let ours = MieSeries::new(m, x).unwrap();
        let q = ours.efficiencies();
        let theirs = peer.compute(x, m, &MieOptions::new()).unwrap();
        let p = theirs.efficiencies();

        // Both round 2^-53 of phases |m| x, and lose 1/|m − 1| where the sphere hardly differs from its surroundings.
        let rounding =
            2e-16 * (1.0 + m.norm_sqr().sqrt().max(1.0) * x) * (1.0 + 1.0 / (m - 1.0).norm_sqr().sqrt());
        let relative = |a: f64, b: f64| if b == 0.0 { a.abs() } else { (a / b - 1.0).abs() };
        let efficiency = [(q.q_ext, p.q_ext), (q.q_sca, p.q_sca), (q.q_abs, p.q_abs)]
            .map(|(a, b)| relative(a, b))
            .into_iter()
            .fold((q.g - p.g).abs(), f64::max);
        assert!(efficiency < 1e-11 + 30.0 * rounding, "m {m}, x {x}: {q:?} {p:?}");
        worst[0] = worst[0].max(efficiency);
        let back = (q.q_back - p.q_back).abs() / p.q_back.max(p.q_sca);
        assert!(back < 1e-10 + 30.0 * rounding, "m {m}, x {x}: {q:?} {p:?}");
        worst[1] = worst[1].max(back);

        theirs.amplitudes(&mu, AmplitudeBuffers { s1: &mut s1, s2: &mut s2 }).unwrap();
        let typical = 0.5 * x * p.q_sca.sqrt();
        for (s, (p1, p2)) in ours.amplitudes(&mu).iter().zip(s1.iter().zip(&s2)) {
            for (a, b) in [(s.s1, p1), (s.s2, p2)] {
                let error = ((a - b).norm_sqr() / b.norm_sqr().max(typical * typical)).sqrt();
                assert!(error < 1e-11 + 30.0 * rounding, "m {m}, x {x}: {a} {b}");
                worst[2] = worst[2].max(error);
            }
        }
    }
    println!(
        "worst difference: efficiencies and g {:e}, q_back {:e}, amplitudes {:e}",
        worst[0], worst[1], worst[2]
    );
}
