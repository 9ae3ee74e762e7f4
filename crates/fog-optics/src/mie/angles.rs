//! Sums of the Mie series over scattering angles.
//!
//! Angular functions π_n and τ_n come from Wiscombe's form of the upward recursion (Applied Optics 19, 1505 (1980)):
//! s = μ π_n, t = s − π_{n−1}, τ_n = n t − π_{n−1}, π_{n+1} = s + t (n+1)/n.
//!
//! Every loop runs over a fixed number of lanes, in a fixed order and without fused operations, so that the versions that
//! the compiler makes for different instruction sets give the same bits.
#![allow(unsafe_code)] // SAFETY: only in the dispatch that `multiversion` generates, after it detected the features

use super::{Amplitudes, MieSeries};
use multiversion::{multiversion, target::match_target};
use num_complex::Complex64;

/// Angles that one step of the recursion advances together.
pub(crate) const LANES: usize = 8;
/// Vectors of angles in one block of [`mixture_block`].
pub(crate) const BLOCK: usize = 8;
/// Spheres whose sums run side by side over one reading of the angular functions.
pub(crate) const GROUP: usize = 4;

type Lanes = [f64; LANES];

/// π_n + τ_n and π_n − τ_n of one vector of angles.
type Functions = [Lanes; 2];

/// Four numbers of one order n, with f_n = (2n+1)/(n(n+1)): f_n (a_n + b_n) and f_n (a_n − b_n), each as re, im.
pub(crate) type KernelTerm = [f64; 4];

/// Terms of [`GROUP`] spheres by order.
pub(crate) type GroupTerms = Vec<[KernelTerm; GROUP]>;

/// S1 and S2 at each cosine, summed as B&H Eq. 4.74.
pub(super) fn amplitudes(a: &[Complex64], b: &[Complex64], cosines: &[f64]) -> Vec<Amplitudes> {
    let terms: Vec<[f64; 4]> = (a.iter().zip(b).enumerate())
        .map(|(i, (a, b))| {
            let f = factor(i + 1);
            [f * a.re, f * a.im, f * b.re, f * b.im]
        })
        .collect();
    let mut out = Vec::with_capacity(cosines.len());
    for chunk in cosines.chunks(LANES) {
        let mut mu = [1.0; LANES];
        for (slot, c) in mu.iter_mut().zip(chunk) {
            *slot = c.clamp(-1.0, 1.0);
        }
        let s = sum_amplitudes(&mu, &terms);
        out.extend((0..chunk.len()).map(|l| Amplitudes {
            s1: Complex64::new(s[0][l], s[1][l]),
            s2: Complex64::new(s[2][l], s[3][l]),
        }));
    }
    out
}

/// Terms of at most [`GROUP`] series; shorter ones are filled up with zeros, which add nothing to a sum.
pub(crate) fn group_terms(group: &[MieSeries]) -> GroupTerms {
    let longest = group.iter().map(|s| s.a.len()).max().unwrap_or(0);
    let mut terms = vec![[[0.0; 4]; GROUP]; longest];
    for (slot, series) in group.iter().enumerate() {
        for (i, (a, b)) in series.a.iter().zip(&series.b).enumerate() {
            let (plus, minus) = ((a + b) * factor(i + 1), (a - b) * factor(i + 1));
            terms[i][slot] = [plus.re, plus.im, minus.re, minus.im];
        }
    }
    terms
}

/// (n, (n+1)/n) for n = 1 … `last`: what the recursion needs.
pub(crate) fn orders(last: usize) -> Vec<[f64; 2]> {
    (1..=last).map(|n| [n as f64, (n + 1) as f64 / n as f64]).collect()
}

/// f_n = (2n+1)/(n(n+1)).
fn factor(n: usize) -> f64 {
    let n = n as f64;
    (2.0 * n + 1.0) / (n * (n + 1.0))
}

#[multiversion(targets("x86_64+avx512f", "x86_64+avx2"))]
fn sum_amplitudes(mu: &Lanes, terms: &[[f64; 4]]) -> [Lanes; 4] {
    sum_amplitudes_body(mu, terms)
}

#[inline(always)]
fn sum_amplitudes_body(mu: &Lanes, terms: &[[f64; 4]]) -> [Lanes; 4] {
    let (mut previous, mut pi) = ([0.0; LANES], [1.0; LANES]);
    let mut s = [[0.0; LANES]; 4];
    for (i, &[a_re, a_im, b_re, b_im]) in terms.iter().enumerate() {
        let n = (i + 1) as f64;
        let ratio = (n + 1.0) / n;
        let (p, tau) = step(mu, &mut previous, &mut pi, n, ratio);
        for l in 0..LANES {
            s[0][l] += a_re * p[l] + b_re * tau[l];
            s[1][l] += a_im * p[l] + b_im * tau[l];
            s[2][l] += a_re * tau[l] + b_re * p[l];
            s[3][l] += a_im * tau[l] + b_im * p[l];
        }
    }
    s
}

/// Advances π_{n−1}, π_n to π_n, π_{n+1}; returns π_n and τ_n.
#[inline(always)]
fn step(mu: &Lanes, previous: &mut Lanes, pi: &mut Lanes, n: f64, ratio: f64) -> (Lanes, Lanes) {
    let (now, mut tau) = (*pi, [0.0; LANES]);
    for l in 0..LANES {
        let s = mu[l] * now[l];
        let t = s - previous[l];
        tau[l] = n * t - previous[l];
        pi[l] = s + ratio * t;
        previous[l] = now[l];
    }
    (now, tau)
}

/// π_n ± τ_n at a vector of cosines for every order.
#[inline(always)]
fn angular_functions(mu: &Lanes, orders: &[[f64; 2]], out: &mut Vec<Functions>) {
    let (mut previous, mut pi) = ([0.0; LANES], [1.0; LANES]);
    out.clear();
    for &[n, ratio] in orders {
        let (now, tau) = step(mu, &mut previous, &mut pi, n, ratio);
        let (mut plus, mut minus) = ([0.0; LANES], [0.0; LANES]);
        for l in 0..LANES {
            plus[l] = now[l] + tau[l];
            minus[l] = now[l] - tau[l];
        }
        out.push([plus, minus]);
    }
}

/// |S1|² + |S2|² of a group of spheres, from S± = S1 ± S2 = Σ f_n (a_n ± b_n)(π_n ± τ_n).
///
/// `SPHERES` of them and `WIDTH` angles are summed at a time, as many as the registers of an instruction set hold: that
/// changes which sums run side by side, never the order within one.
#[inline(always)]
fn group_intensities<const SPHERES: usize, const WIDTH: usize>(
    functions: &[Functions],
    group: &[[KernelTerm; GROUP]],
) -> [Lanes; GROUP] {
    let mut out = [[0.0; LANES]; GROUP];
    for sphere in (0..GROUP).step_by(SPHERES) {
        for lane in (0..LANES).step_by(WIDTH) {
            let part = part_intensities::<SPHERES, WIDTH>(functions, group, sphere, lane);
            for d in 0..SPHERES {
                out[sphere + d][lane..lane + WIDTH].copy_from_slice(&part[d]);
            }
        }
    }
    out
}

/// The part of [`group_intensities`] from one sphere and one lane on.
#[inline(always)]
fn part_intensities<const SPHERES: usize, const WIDTH: usize>(
    functions: &[Functions],
    group: &[[KernelTerm; GROUP]],
    sphere: usize,
    lane: usize,
) -> [[f64; WIDTH]; SPHERES] {
    let mut s = [[[0.0; WIDTH]; 4]; SPHERES];
    for (functions, terms) in functions.iter().zip(group) {
        let plus: [f64; WIDTH] = core::array::from_fn(|l| functions[0][lane + l]);
        let minus: [f64; WIDTH] = core::array::from_fn(|l| functions[1][lane + l]);
        for d in 0..SPHERES {
            let c = terms[sphere + d];
            for l in 0..WIDTH {
                s[d][0][l] += c[0] * plus[l];
                s[d][1][l] += c[1] * plus[l];
                s[d][2][l] += c[2] * minus[l];
                s[d][3][l] += c[3] * minus[l];
            }
        }
    }
    s.map(|s| {
        let mut out = [0.0; WIDTH];
        for l in 0..WIDTH {
            let sum = s[0][l] * s[0][l] + s[1][l] * s[1][l];
            out[l] = 0.5 * (sum + (s[2][l] * s[2][l] + s[3][l] * s[3][l]));
        }
        out
    })
}

/// Adds Σ_d weight\[row\]\[d\] (|S1|² + |S2|²)_d at a block of angles to each row of a mixture.
///
/// `mu`: cosines; `groups`: terms of [`GROUP`] spheres each; `orders`: of [`orders`], at least as many as the longest
/// group; `weights`: \[row\]\[sphere\], rows × (GROUP · groups); `out`: \[row\]\[angle\]. The sum runs over the spheres
/// in their order, whatever the block or the instruction set.
#[multiversion(targets("x86_64+avx512f", "x86_64+avx2"))]
pub(crate) fn mixture_block(
    mu: &[Lanes; BLOCK],
    groups: &[&[[KernelTerm; GROUP]]],
    orders: &[[f64; 2]],
    weights: &[f64],
    out: &mut [[Lanes; BLOCK]],
) {
    match_target! {
        "x86_64+avx512f" => mixture_block_body::<4, 8>(mu, groups, orders, weights, out),
        "x86_64+avx2" => mixture_block_body::<1, 8>(mu, groups, orders, weights, out),
        _ => mixture_block_body::<1, 4>(mu, groups, orders, weights, out),
    }
}

#[inline(always)]
fn mixture_block_body<const SPHERES: usize, const WIDTH: usize>(
    mu: &[Lanes; BLOCK],
    groups: &[&[[KernelTerm; GROUP]]],
    orders: &[[f64; 2]],
    weights: &[f64],
    out: &mut [[Lanes; BLOCK]],
) {
    let spheres = groups.len() * GROUP;
    let mut functions = Vec::with_capacity(orders.len());
    for v in 0..BLOCK {
        angular_functions(&mu[v], orders, &mut functions);
        for (g, group) in groups.iter().enumerate() {
            let intensity = group_intensities::<SPHERES, WIDTH>(&functions, group);
            for (row, sum) in out.iter_mut().enumerate() {
                let w: [f64; GROUP] = core::array::from_fn(|d| weights[row * spheres + g * GROUP + d]);
                for l in 0..LANES {
                    let mut x = sum[v][l];
                    for d in 0..GROUP {
                        x += w[d] * intensity[d][l];
                    }
                    sum[v][l] = x;
                }
            }
        }
    }
}

/// |S1|² + |S2|² of each sphere of a group at a vector of cosines.
#[multiversion(targets("x86_64+avx512f", "x86_64+avx2"))]
pub(super) fn intensities(
    mu: &Lanes,
    groups: &[GroupTerms],
    orders: &[[f64; 2]],
    functions: &mut Vec<Functions>,
    mut sink: impl FnMut(usize, &[Lanes; GROUP]),
) {
    angular_functions(mu, orders, functions);
    for (g, group) in groups.iter().enumerate() {
        sink(
            g,
            &match_target! {
                "x86_64+avx512f" => group_intensities::<4, 8>(functions, group),
                "x86_64+avx2" => group_intensities::<1, 8>(functions, group),
            _ => group_intensities::<1, 4>(functions, group),
            },
        );
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_instruction_set_gives_the_same_bits() {
        // The bodies below are compiled for the build's baseline; the multiversioned functions for what this CPU has.
        let m = Complex64::new(1.333, 1.96e-9);
        let series: Vec<MieSeries> =
            (0..GROUP).map(|i| MieSeries::new(m, 40.0 + 30.7 * i as f64).unwrap()).collect();
        let group = group_terms(&series);
        let orders = orders(group.len());
        let mut mu = [[0.0; LANES]; BLOCK];
        for (i, c) in mu.as_flattened_mut().iter_mut().enumerate() {
            *c = 1.0 - 2.0 * i as f64 / 63.0;
        }
        let weights: Vec<f64> = (0..4 * GROUP).map(|i| 0.1 + 0.37 * i as f64).collect();
        let (mut fast, mut plain) = ([[[0.0; LANES]; BLOCK]; 2], [[[0.0; LANES]; BLOCK]; 2]);
        mixture_block(&mu, &[&group, &group], &orders, &weights, &mut fast);
        mixture_block_body::<1, 1>(&mu, &[&group, &group], &orders, &weights, &mut plain);
        assert_eq!(
            fast.map(|r| r.map(|v| v.map(f64::to_bits))),
            plain.map(|r| r.map(|v| v.map(f64::to_bits)))
        );
        let terms: Vec<[f64; 4]> = group.iter().map(|g| g[1]).collect();
        for mu in &mu {
            let (fast, plain) = (sum_amplitudes(mu, &terms), sum_amplitudes_body(mu, &terms));
            assert_eq!(fast.map(|v| v.map(f64::to_bits)), plain.map(|v| v.map(f64::to_bits)));
        }
    }
}
