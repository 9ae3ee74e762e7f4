//! The model of a measured spectrum: shares of the droplets in bins, their derivatives, and how far counts are from them.

use super::measurements::Bin;
use crate::distribution::SpectrumShape;
use fog_core::math::f64::{erf, exp, ln, ln_1p};
use std::f64::consts::FRAC_1_SQRT_2;

/// Number of shape parameters.
pub(super) const SHAPES: usize = 5;

/// μ_L, σ_L, μ_G (µm), σ_G (µm) and the logarithm of the area ratio G : L, as in a model file.
pub(super) type Shape = [f64; SHAPES];

pub(super) fn spectrum_shape(shape: &Shape) -> SpectrumShape {
    let [mu_l, sigma_l, mu_g, sigma_g, ln_gl] = *shape;
    SpectrumShape { mu_l, sigma_l, mu_g, sigma_g, gl_ratio: exp(ln_gl) }
}

/// Share of all droplets in a bin, and its derivatives by the shape parameters.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Share {
    pub(super) value: f64,
    pub(super) by_shape: Shape,
}

/// Number of droplets below an edge for each part, and what the derivatives need.
#[derive(Clone, Copy)]
struct Edge {
    /// Share of the part below the edge.
    below: [f64; 2],
    /// Its derivatives by the part's centre and width.
    by_centre: [f64; 2],
    by_width: [f64; 2],
}

impl Edge {
    fn new(shape: &Shape, d_um: f64) -> Self {
        let [mu_l, sigma_l, mu_g, sigma_g, _] = *shape;
        let t = [if d_um > 0.0 { (ln(d_um) - mu_l) / sigma_l } else { -40.0 }, (d_um - mu_g) / sigma_g];
        let width = [sigma_l, sigma_g];
        let bell = t.map(|t| 0.398_942_280_401_432_7 * exp(-0.5 * t * t)); // 1/√(2π)
        Self {
            below: t.map(|t| 0.5 * (1.0 + erf(t * FRAC_1_SQRT_2))),
            by_centre: [-bell[0] / width[0], -bell[1] / width[1]],
            by_width: [-bell[0] * t[0] / width[0], -bell[1] * t[1] / width[1]],
        }
    }
}

/// Shares of the bins, the densities of Eq. 1–3 integrated from edge to edge (not taken at the bins' centres).
///
/// A part of a million millionth is added to each, so that no measured droplet is impossible.
pub(super) fn shares(shape: &Shape, bins: &[Bin], shares: &mut Vec<Share>) {
    shares.clear();
    let ratio = exp(shape[4]);
    let part = [1.0 / (1.0 + ratio), ratio / (1.0 + ratio)];
    let mut last: Option<(f64, Edge)> = None;
    for bin in bins {
        let low = match last {
            Some((edge_um, edge)) if edge_um == bin.low_um => edge,
            _ => Edge::new(shape, bin.low_um),
        };
        let high = Edge::new(shape, bin.high_um);
        last = Some((bin.high_um, high));
        let difference = |of: fn(&Edge) -> &[f64; 2], i: usize| of(&high)[i] - of(&low)[i];
        let inside = [difference(|e| &e.below, 0), difference(|e| &e.below, 1)];
        shares.push(Share {
            value: part[0] * inside[0] + part[1] * inside[1] + 1e-12,
            by_shape: [
                part[0] * difference(|e| &e.by_centre, 0),
                part[0] * difference(|e| &e.by_width, 0),
                part[1] * difference(|e| &e.by_centre, 1),
                part[1] * difference(|e| &e.by_width, 1),
                part[0] * part[1] * (inside[1] - inside[0]),
            ],
        });
    }
}

/// Deviance residual of a Poisson count `n` whose expectation is `mean` > 0, and its derivative by `mean`:
/// sign(n − mean) √(2 (n ln(n/mean) − n + mean)).
///
/// The sum of the squares of these residuals is least where the likelihood of the counts is greatest: counting noise is
/// weighted exactly, empty bins included, and without the bias of 1/n weights.
pub(super) fn deviance_residual(n: f64, mean: f64) -> (f64, f64) {
    if n <= 0.0 {
        let residual = -(2.0 * mean).sqrt();
        return (residual, 1.0 / residual);
    }
    let u = (mean - n) / n;
    // (u − ln(1 + u)) / u², by its series where the difference would cancel.
    let g = if u.abs() < 1e-2 {
        0.5 - u * (1.0 / 3.0 - u * (0.25 - u * (0.2 - u * (1.0 / 6.0 - u / 7.0))))
    } else {
        (u - ln_1p(u)) / (u * u)
    };
    let root = (2.0 * g).sqrt();
    (-u * n.sqrt() * root, -n.sqrt() / (mean * root))
}

/// Residual that grows with the logarithm of a large one, so that a few bad counts do not pull the fit (Cauchy's loss with
/// the given scale), and its derivative by the plain residual.
pub(super) fn tamed(residual: f64, scale: f64) -> (f64, f64) {
    let square = (residual / scale) * (residual / scale);
    let tame = scale * ln_1p(square).sqrt();
    if tame < 1e-6 * scale {
        return (residual, 1.0);
    }
    (tame.copysign(residual), residual.abs() / (tame * (1.0 + square)))
}

#[cfg(test)]
mod tests {
    use super::*;

    const SHAPE: Shape = [2.1, 0.75, 8.8, 2.2, 0.6];

    fn bins(edges: &[f64]) -> Vec<Bin> {
        let bin =
            |w: &[f64]| Bin { low_um: w[0], high_um: w[1], droplets: 0.0, volume_m3: 1.0, line: 0, rows: 1 };
        edges.windows(2).map(bin).collect()
    }

    #[test]
    fn shares_are_integrals_of_the_density() {
        let mut found = Vec::new();
        shares(&SHAPE, &bins(&[0.0, 2.0, 5.0, 8.0, 11.0, 60.0, 1e6]), &mut found);
        let below_zero = 0.5 * (1.0 - erf(8.8 / 2.2 * FRAC_1_SQRT_2)) * exp(0.6) / (1.0 + exp(0.6));
        let total: f64 = found.iter().map(|share| share.value).sum();
        assert!((total + below_zero - 1.0).abs() < 1e-10, "{total}");
        let density = |d| spectrum_shape(&SHAPE).density_1_um(d);
        let simpson = |a: f64, b: f64| {
            let h = (b - a) / 200.0;
            let weight = |i| {
                if i == 0 || i == 200 {
                    1.0
                } else if i % 2 == 1 {
                    4.0
                } else {
                    2.0
                }
            };
            (0..=200).map(|i| weight(i) * density(a + h * f64::from(i))).sum::<f64>() * h / 3.0
        };
        assert!((found[1].value - simpson(2.0, 5.0)).abs() < 1e-9);
        assert!((found[3].value - simpson(8.0, 11.0)).abs() < 1e-9);
    }

    #[test]
    fn derivatives_are_those_of_the_shares() {
        let bins = bins(&[0.0, 2.0, 5.0, 8.0, 20.0]);
        let (mut at, mut above, mut below) = (Vec::new(), Vec::new(), Vec::new());
        shares(&SHAPE, &bins, &mut at);
        for p in 0..SHAPES {
            let mut moved = SHAPE;
            moved[p] += 1e-5;
            shares(&moved, &bins, &mut above);
            moved[p] -= 2e-5;
            shares(&moved, &bins, &mut below);
            for i in 0..bins.len() {
                let slope = (above[i].value - below[i].value) / 2e-5;
                assert!((slope - at[i].by_shape[p]).abs() < 1e-8, "parameter {p}, bin {i}");
            }
        }
    }

    #[test]
    fn deviance_is_that_of_poisson() {
        for (n, mean) in
            [(0.0, 3.0), (4.0, 7.0), (7.0, 4.0), (1000.0, 1001.0), (5.0, 5.049), (5.0, 5.051), (9.0, 9.0)]
        {
            let (r, slope) = deviance_residual(n, mean);
            let log = if n > 0.0 { n * ln(n / mean) } else { 0.0 };
            assert!((r * r - 2.0 * (log - n + mean)).abs() < 1e-12 * (1.0 + n), "{n} {mean}");
            assert!(r == 0.0 || (r > 0.0) == (n > mean));
            let h = 1e-5 * mean;
            let numeric = (deviance_residual(n, mean + h).0 - deviance_residual(n, mean - h).0) / (2.0 * h);
            assert!((numeric / slope - 1.0).abs() < 1e-6, "{n} {mean}: {numeric} {slope}");
        }
    }

    #[test]
    fn tamed_residuals_keep_small_ones() {
        let (r, slope) = tamed(0.01, 3.0);
        assert!((r - 0.01).abs() < 1e-6 && (slope - 1.0).abs() < 1e-4);
        assert_eq!(tamed(0.0, 3.0), (0.0, 1.0));
        let (r, slope) = tamed(-30.0, 3.0);
        assert!(r < -6.0 && r > -7.0 && slope > 0.0 && slope < 0.1, "{r} {slope}");
        let numeric = (tamed(-29.999, 3.0).0 - tamed(-30.001, 3.0).0) / 0.002;
        assert!((numeric / slope - 1.0).abs() < 1e-6);
    }
}
