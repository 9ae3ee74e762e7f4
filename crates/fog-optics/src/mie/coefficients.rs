//! Mie coefficients without cancellation, from ratios of Riccati–Bessel functions.
//!
//! With u_n(z) = ψ_{n+1}(z)/ψ_n(z), the logarithmic derivative of B&H Sec. 4.8 is D_n = (n+1)/z − u_n, and
//!
//! a_n = (w_a ψ_n + ψ_{n+1}) / (w_a ξ_n + ξ_{n+1}),  w_a = (1/m² − 1)(n+1)/x − u_n(mx)/m,
//! b_n = (w_b ψ_n + ψ_{n+1}) / (w_b ξ_n + ξ_{n+1}),  w_b = −m u_n(mx),
//!
//! equal to B&H Eq. 4.88, but free of the difference of nearly equal numbers that spoils it at small x. As ξ = ψ − iχ and
//! ψ_n χ_{n+1} − ψ_{n+1} χ_n = 1, absorption per multipole is exactly −Im w / |w ξ_n + ξ_{n+1}|².

use super::MieSeries;
use fog_core::math::f64::{cbrt, cos, sin};
use num_complex::Complex64;

/// Coefficients for arguments that were checked.
pub(super) fn series(m: Complex64, x: f64) -> MieSeries {
    // Terms fall below 1e-15 of the largest at x + 7 ∛x (Wiscombe 1980 stops at x + 4.05 ∛x, 2e-7 in amplitude).
    let terms = (x + 7.0 * cbrt(x)) as usize + 6;
    if m == Complex64::new(1.0, 0.0) {
        // No sphere at all: exactly nothing, instead of rounding errors around it.
        let nothing = vec![Complex64::new(0.0, 0.0); terms];
        return MieSeries { x, a: nothing.clone(), b: nothing, q_abs: 0.0 };
    }
    let z = m * x;
    let inside = ratios(z, terms);
    let (psi, chi) = riccati_bessel(x, terms);

    let inverse_m = m.inv();
    let contrast = inverse_m * inverse_m - 1.0;
    let (mut a, mut b) = (Vec::with_capacity(terms), Vec::with_capacity(terms));
    let mut absorbed = 0.0;
    for n in 1..=terms {
        let w_a = contrast * ((n + 1) as f64 / x) - inside[n] * inverse_m;
        let w_b = -(inside[n] * m);
        let (a_n, loss_a) = coefficient(w_a, psi[n], psi[n + 1], chi[n], chi[n + 1]);
        let (b_n, loss_b) = coefficient(w_b, psi[n], psi[n + 1], chi[n], chi[n + 1]);
        absorbed += (2 * n + 1) as f64 * (loss_a + loss_b);
        a.push(a_n);
        b.push(b_n);
    }
    MieSeries { x, a, b, q_abs: 2.0 * absorbed / (x * x) }
}

/// One coefficient N/(N − iM) with N = wψ_n + ψ_{n+1}, M = wχ_n + χ_{n+1}, and its Re − |·|², the multipole's absorption.
#[inline(always)]
fn coefficient(w: Complex64, psi: f64, psi_next: f64, chi: f64, chi_next: f64) -> (Complex64, f64) {
    let numerator = w * psi + psi_next;
    let other = w * chi + chi_next;
    let denominator = Complex64::new(numerator.re + other.im, numerator.im - other.re);
    let scale = 1.0 / denominator.norm_sqr();
    let loss = if w.im == 0.0 { 0.0 } else { -w.im * scale };
    let re = numerator.norm_sqr() * scale + loss;
    let im = (numerator.re * other.re + numerator.im * other.im) * scale;
    (Complex64::new(re, im), loss)
}

/// u_n(z) = ψ_{n+1}(z)/ψ_n(z) for n = 0 … `last`, by downward recursion u_{n−1} = 1/((2n+1)/z − u_n).
fn ratios(z: Complex64, last: usize) -> Vec<Complex64> {
    let inverse = z.inv();
    let start = start_order(z.norm_sqr().sqrt(), last);
    let mut u = z / (2 * start + 3) as f64;
    let mut all = vec![Complex64::new(0.0, 0.0); last + 1];
    for n in (1..=start).rev() {
        if n <= last {
            all[n] = u;
        }
        u = (inverse * (2 * n + 1) as f64 - u).inv();
    }
    all[0] = u;
    all
}

/// ψ_n(x) and χ_n(x) = −x y_n(x) for n = 0 … `last` + 1.
///
/// χ grows with n: upward recursion is stable. ψ oscillates up to n ≈ x, where upward recursion is neutral, then falls:
/// from there on it is a product of ratios from downward recursion.
fn riccati_bessel(x: f64, last: usize) -> (Vec<f64>, Vec<f64>) {
    let (sine, cosine) = (sin(x), cos(x));
    let (mut psi, mut chi) = (vec![0.0; last + 2], vec![0.0; last + 2]);
    (psi[0], chi[0]) = (sine, cosine);
    chi[1] = cosine / x + sine;
    for n in 1..=last {
        chi[n + 1] = (2 * n + 1) as f64 / x * chi[n] - chi[n - 1];
    }

    let turn = x as usize;
    if turn >= 1 {
        psi[1] = sine / x - cosine;
    }
    for n in 1..turn {
        psi[n + 1] = (2 * n + 1) as f64 / x * psi[n] - psi[n - 1];
    }
    // Ratios first go into the places of the values that they will become.
    let start = start_order(x, last);
    let mut u = x / (2 * start + 3) as f64;
    for n in (turn..=start).rev() {
        if n <= last {
            psi[n + 1] = u;
        }
        u = 1.0 / ((2 * n + 1) as f64 / x - u);
    }
    for n in turn..=last {
        psi[n + 1] *= psi[n];
    }
    (psi, chi)
}

/// Order from which a downward recursion of ratios has forgotten its first value when it reaches `last`.
fn start_order(modulus: f64, last: usize) -> usize {
    last.max((modulus + 8.0 * cbrt(modulus)) as usize) + 15
}

#[cfg(test)]
mod tests {
    use super::*;
    use fog_core::math::f64::exp;

    #[test]
    fn wronskian_closes_at_every_size() {
        for x in [1e-6, 1e-3, 0.3, 1.0, core::f64::consts::PI, 10.0, 100.3, 5e3, 1e5] {
            let last = (x + 7.0 * cbrt(x)) as usize + 6;
            let (psi, chi) = riccati_bessel(x, last);
            for n in 0..=last {
                let w = psi[n] * chi[n + 1] - psi[n + 1] * chi[n];
                assert!((w - 1.0).abs() < 1e-9, "x {x}, n {n}: {w}");
            }
        }
    }

    #[test]
    fn ratios_meet_closed_forms() {
        // ψ_0 = sin z, ψ_1 = sin z / z − cos z, so u_0 = 1/z − cot z.
        for z in [Complex64::new(2.0, 0.0), Complex64::new(30.0, 4.0), Complex64::new(700.0, 1e-3)] {
            let u = ratios(z, 5)[0];
            let (grow, decay) = (exp(2.0 * z.im), exp(-2.0 * z.im));
            let scale = 0.5 * (grow + decay) - cos(2.0 * z.re);
            let cotangent = Complex64::new(sin(2.0 * z.re), -0.5 * (grow - decay)) / scale;
            let exact = z.inv() - cotangent;
            assert!((u - exact).norm_sqr() < 1e-20 * exact.norm_sqr(), "{z}: {u} {exact}");
        }
    }
}
