//! Sums of the Mie series over scattering angles.
//!
//! Angular functions π_n and τ_n come from Wiscombe's form of the upward recursion (Applied Optics 19, 1505 (1980)):
//! s = μ π_n, t = s − π_{n−1}, τ_n = n t − π_{n−1}, π_{n+1} = s + t (n+1)/n.
//!
//! Every loop runs over a fixed number of lanes, in a fixed order and without fused operations, so that the versions that
//! the compiler makes for different instruction sets give the same bits.
#![allow(unsafe_code)] // SAFETY: only in the dispatch that `multiversion` generates, after it detected the features

use super::{Amplitudes, MieSeries};
use multiversion::multiversion;
use num_complex::Complex64;

/// Angles that one step of the recursion advances together.
pub(crate) const LANES: usize = 8;
/// Vectors of angles in one block of [`mixture_block`].
pub(crate) const BLOCK: usize = 8;
/// Spheres that share one run of the recursion.
pub(crate) const GROUP: usize = 4;

type Lanes = [f64; LANES];

/// Four numbers of one order n, with f_n = (2n+1)/(n(n+1)): f_n (a_n + b_n) and f_n (a_n − b_n), each as re, im.
pub(crate) type KernelTerm = [f64; 4];

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

/// Terms of a series for [`mixture_block`].
pub(crate) fn kernel_terms(series: &MieSeries) -> Vec<KernelTerm> {
    (series.a.iter().zip(&series.b).enumerate())
        .map(|(i, (a, b))| {
            let (plus, minus) = ((a + b) * factor(i + 1), (a - b) * factor(i + 1));
            [plus.re, plus.im, minus.re, minus.im]
        })
        .collect()
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

/// |S1|² + |S2|² of spheres that share the recursion, from S± = S1 ± S2 = Σ f_n (a_n ± b_n)(π_n ± τ_n).
#[inline(always)]
fn group_intensities(mu: &Lanes, terms: [&[KernelTerm]; GROUP], orders: &[[f64; 2]]) -> [Lanes; GROUP] {
    let (mut previous, mut pi) = ([0.0; LANES], [1.0; LANES]);
    let mut s = [[[0.0; LANES]; 4]; GROUP];
    let count = terms[0].len();
    let terms = terms.map(|t| &t[..count]);
    for (i, &[n, ratio]) in orders[..count].iter().enumerate() {
        let (now, tau) = step(mu, &mut previous, &mut pi, n, ratio);
        let (mut plus, mut minus) = ([0.0; LANES], [0.0; LANES]);
        for l in 0..LANES {
            plus[l] = now[l] + tau[l];
            minus[l] = now[l] - tau[l];
        }
        for d in 0..GROUP {
            let c = terms[d][i];
            for l in 0..LANES {
                s[d][0][l] += c[0] * plus[l];
                s[d][1][l] += c[1] * plus[l];
                s[d][2][l] += c[2] * minus[l];
                s[d][3][l] += c[3] * minus[l];
            }
        }
    }
    s.map(|s| {
        let mut out = [0.0; LANES];
        for l in 0..LANES {
            let sum = s[0][l] * s[0][l] + s[1][l] * s[1][l];
            out[l] = 0.5 * (sum + (s[2][l] * s[2][l] + s[3][l] * s[3][l]));
        }
        out
    })
}

/// Adds Σ_d weight\[row\]\[d\] (|S1|² + |S2|²)_d at a block of angles to each row of a mixture.
///
/// `mu`: cosines; `groups`: terms of [`GROUP`] spheres, padded with zeros to one length within the group; `orders`:
/// (n, (n+1)/n) for n = 1, 2, …; `weights`: \[row\]\[sphere\], rows × (GROUP · groups); `out`: \[row\]\[angle\]. The sum
/// runs over the spheres in their order, whatever the block or the instruction set.
#[multiversion(targets("x86_64+avx512f", "x86_64+avx2"))]
pub(crate) fn mixture_block(
    mu: &[Lanes; BLOCK],
    groups: &[&[Vec<KernelTerm>; GROUP]],
    orders: &[[f64; 2]],
    weights: &[f64],
    out: &mut [[Lanes; BLOCK]],
) {
    mixture_block_body(mu, groups, orders, weights, out);
}

#[inline(always)]
fn mixture_block_body(
    mu: &[Lanes; BLOCK],
    groups: &[&[Vec<KernelTerm>; GROUP]],
    orders: &[[f64; 2]],
    weights: &[f64],
    out: &mut [[Lanes; BLOCK]],
) {
    let spheres = groups.len() * GROUP;
    for (g, group) in groups.iter().enumerate() {
        let terms = [&group[0][..], &group[1][..], &group[2][..], &group[3][..]];
        let mut intensity = [[[0.0; LANES]; BLOCK]; GROUP];
        for v in 0..BLOCK {
            let lanes = group_intensities(&mu[v], terms, orders);
            for d in 0..GROUP {
                intensity[d][v] = lanes[d];
            }
        }
        for (row, sum) in out.iter_mut().enumerate() {
            let w: [f64; GROUP] = core::array::from_fn(|d| weights[row * spheres + g * GROUP + d]);
            for v in 0..BLOCK {
                for l in 0..LANES {
                    let mut x = sum[v][l];
                    for d in 0..GROUP {
                        x += w[d] * intensity[d][v][l];
                    }
                    sum[v][l] = x;
                }
            }
        }
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
        let longest = series.iter().map(|s| s.a.len()).max().unwrap();
        let group: [Vec<KernelTerm>; GROUP] = core::array::from_fn(|d| {
            let mut terms = kernel_terms(&series[d]);
            terms.resize(longest, [0.0; 4]);
            terms
        });
        let orders: Vec<[f64; 2]> = (1..=longest).map(|n| [n as f64, (n + 1) as f64 / n as f64]).collect();
        let mut mu = [[0.0; LANES]; BLOCK];
        for (i, c) in mu.as_flattened_mut().iter_mut().enumerate() {
            *c = 1.0 - 2.0 * i as f64 / 63.0;
        }
        let weights: Vec<f64> = (0..2 * GROUP).map(|i| 0.1 + 0.37 * i as f64).collect();
        let (mut fast, mut plain) = ([[[0.0; LANES]; BLOCK]; 2], [[[0.0; LANES]; BLOCK]; 2]);
        mixture_block(&mu, &[&group], &orders, &weights, &mut fast);
        mixture_block_body(&mu, &[&group], &orders, &weights, &mut plain);
        assert_eq!(
            fast.map(|r| r.map(|v| v.map(f64::to_bits))),
            plain.map(|r| r.map(|v| v.map(f64::to_bits)))
        );
        for mu in &mu {
            let (fast, plain) = (sum_amplitudes(mu, &group[1]), sum_amplitudes_body(mu, &group[1]));
            assert_eq!(fast.map(|v| v.map(f64::to_bits)), plain.map(|v| v.map(f64::to_bits)));
        }
    }
}
