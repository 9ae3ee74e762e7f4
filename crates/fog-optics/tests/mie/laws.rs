//! Energy and momentum close: what the sums over the series say is what quadrature over the angles says.

use fog_core::math::PI;
use fog_optics::mie::{Complex64, MieSeries, batch};
use scatrs::special::gauss_legendre;

const INDICES: [Complex64; 6] = [
    Complex64::new(1.333, 0.0),
    Complex64::new(1.333, 1e-4),
    Complex64::new(0.75, 0.0),
    Complex64::new(1.5, 1.0),
    Complex64::new(0.1, 3.0),
    Complex64::new(10.0, 10.0),
];

#[test]
fn phase_functions_integrate_to_one_and_to_g() {
    for m in INDICES {
        for x in [1e-3, 0.5, 7.3, 60.0, 341.0] {
            // |S|² is a polynomial in μ of twice the order of the series: Gauss–Legendre is exact with as many nodes, plus
            // one for the factor μ.
            let series = MieSeries::new(m, x).unwrap();
            let rule = gauss_legendre::<f64>(series.a().len() + 2).unwrap();
            let one = batch(m, &[x], &rule.nodes).unwrap();
            let q = one.efficiencies[0];
            let (mut sum, mut cosine) = (0.0, 0.0);
            for ((mu, weight), i) in rule.nodes.iter().zip(&rule.weights).zip(&one.intensities) {
                // p = i / (π x² Q_sca) per steradian, 2π of which lie at each polar angle.
                let p = i / (PI * x * x * q.q_sca);
                sum += 2.0 * PI * weight * p;
                cosine += 2.0 * PI * weight * p * mu;
            }
            assert!((sum - 1.0).abs() < 1e-11, "m {m}, x {x}: ∫p = {sum}");
            assert!((cosine - q.g).abs() < 1e-11, "m {m}, x {x}: ∫p cos θ = {cosine}, g = {}", q.g);
        }
    }
}

#[test]
fn extinction_is_scattering_and_absorption_and_the_forward_amplitude() {
    for m in INDICES {
        for x in [1e-3, 0.5, 7.3, 60.0, 341.0, 5e3] {
            let q = MieSeries::new(m, x).unwrap().efficiencies();
            assert_eq!(q.q_ext, q.q_sca + q.q_abs);
            let summed = textbook_extinction(m, x);
            assert!((q.q_ext / summed - 1.0).abs() < 1e-9, "m {m}, x {x}: {} {summed}", q.q_ext);
        }
    }
}

/// Q_ext = (2/x²) Σ (2n+1) Re(a_n + b_n) (B&H Eq. 4.62) with a_n, b_n of B&H Eq. 4.88, as the book has them: logarithmic
/// derivatives, no identity for absorption, nothing of the kernel's. Loses digits at small x, where ψ_n is summed upward.
fn textbook_extinction(m: Complex64, x: f64) -> f64 {
    let z = m * x;
    let last = (x + 4.05 * fog_core::math::f64::cbrt(x) + 3.0) as usize;
    let start = last.max((z.norm_sqr().sqrt() * 1.1) as usize) + 60;
    let mut derivative = vec![Complex64::new(0.0, 0.0); start + 1];
    for n in (1..=start).rev() {
        let ratio = z.inv() * n as f64;
        derivative[n - 1] = ratio - (derivative[n] + ratio).inv();
    }
    // ψ by Miller's downward recursion, scaled by whichever of ψ_0 and ψ_1 is larger; χ upward.
    let top = (x as usize).max(last) + 60;
    let mut psi = vec![0.0; top + 2];
    psi[top] = 1e-250;
    for n in (1..=top).rev() {
        psi[n - 1] = (2 * n + 1) as f64 / x * psi[n] - psi[n + 1];
        if psi[n - 1].abs() > 1e200 {
            for value in &mut psi[n - 1..] {
                *value *= 1e-250;
            }
        }
    }
    let (sine, cosine) = (fog_core::math::f64::sin(x), fog_core::math::f64::cos(x));
    let scale = if sine.abs() > 0.5 || x < 0.6 { sine / psi[0] } else { (sine / x - cosine) / psi[1] };
    let mut chi = vec![cosine, cosine / x + sine];
    for n in 1..last {
        chi.push((2 * n + 1) as f64 / x * chi[n] - chi[n - 1]);
    }
    let mut sum = 0.0;
    for n in 1..=last {
        let (now, before) = (psi[n] * scale, psi[n - 1] * scale);
        let (xi, xi_before) = (Complex64::new(now, -chi[n]), Complex64::new(before, -chi[n - 1]));
        for factor in [derivative[n] / m + n as f64 / x, m * derivative[n] + n as f64 / x] {
            sum += (2 * n + 1) as f64 * ((factor * now - before) / (factor * xi - xi_before)).re;
        }
    }
    2.0 * sum / (x * x)
}
