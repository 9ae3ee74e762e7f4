//! The angles at which tabulated phase functions are stored.
//!
//! The variable is m = 1 − cos θ, which single precision resolves near 0, where fog droplets send half of their light.
//! Forward nodes (θ ≤ 90°) are uniform in v = (m/2)^¼ = √sin(θ/2), the root of the angle; rear nodes are uniform in
//! c = √(1 − m/2) = cos(θ/2), half the angle from backward. Both need only square roots to find. Between nodes a phase
//! function is linear in m, so that its integral is quadratic and inverts in closed form.

use crate::math::PI;

/// Intervals from 0° to 90°.
pub const FRONT: usize = 768;
/// Intervals from 90° to 180°.
pub const REAR: usize = 384;
/// Number of nodes.
pub const NODES: usize = FRONT + REAR + 1;

const V_MAX: f64 = 0.840_896_415_253_714_6; // (1/2)^¼
const C_MAX: f64 = core::f64::consts::FRAC_1_SQRT_2;

/// The nodes' m = 1 − cos θ, ascending from 0 to 2.
#[must_use]
pub fn nodes() -> Vec<f64> {
    (0..NODES)
        .map(|i| {
            if i <= FRONT {
                let v = V_MAX * i as f64 / FRONT as f64;
                2.0 * v * v * v * v
            } else {
                let c = C_MAX * (NODES - 1 - i) as f64 / REAR as f64;
                2.0 - 2.0 * c * c
            }
        })
        .collect()
}

/// cos θ of each node (descending from 1 to −1).
#[must_use]
pub fn cosines() -> Vec<f64> {
    nodes().iter().map(|m| 1.0 - m).collect()
}

/// Interval that holds m, found without a search.
#[inline(always)]
#[must_use]
pub fn interval(m: f32) -> usize {
    let half = 0.5 * m;
    let x = if half < 0.5 {
        half.sqrt().sqrt() * (FRONT as f32 / V_MAX as f32)
    } else {
        NODES as f32 - 1.0 - (1.0 - half).max(0.0).sqrt() * (REAR as f32 / C_MAX as f32)
    };
    (x as usize).min(NODES - 2)
}

/// ∫ over the sphere of a phase function given at the nodes (1/sr): 1 when normalised.
#[must_use]
pub fn integral(nodes: &[f64], p: impl Fn(usize) -> f64) -> f64 {
    (0..NODES - 1).map(|i| PI * (p(i) + p(i + 1)) * (nodes[i + 1] - nodes[i])).sum()
}

/// Mean cosine of a normalised phase function given at the nodes, exact for the linear interpolation.
#[must_use]
pub fn mean_cosine(nodes: &[f64], p: impl Fn(usize) -> f64) -> f64 {
    // ∫ (1 − m) p dm over an interval with p linear in m
    let first: f64 = (0..NODES - 1)
        .map(|i| {
            let (m0, h) = (nodes[i], nodes[i + 1] - nodes[i]);
            let (a, b) = (p(i), p(i + 1));
            (1.0 - m0) * 0.5 * (a + b) * h - h * h * (a / 6.0 + b / 3.0)
        })
        .sum();
    2.0 * PI * first
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_point_falls_into_its_interval() {
        let nodes = nodes();
        assert_eq!(nodes[0], 0.0);
        assert!((nodes[FRONT] - 1.0).abs() < 1e-14 && nodes[NODES - 1] == 2.0);
        for i in 0..NODES - 1 {
            assert!(nodes[i] < nodes[i + 1]);
            let middle = (0.5 * (nodes[i] + nodes[i + 1])) as f32;
            assert_eq!(interval(middle), i, "m = {middle}");
        }
        assert_eq!(interval(0.0), 0);
        assert_eq!(interval(2.0), NODES - 2);
        assert_eq!(interval(2.5), NODES - 2);
    }

    #[test]
    fn henyey_greenstein_integrates() {
        let nodes = nodes();
        for g in [0.0f64, 0.5, 0.83, 0.95] {
            let p = |i: usize| {
                let c = 1.0 - nodes[i];
                let d = 1.0 + g * g - 2.0 * g * c;
                (1.0 - g * g) / (4.0 * PI * d * d.sqrt())
            };
            assert!((integral(&nodes, p) - 1.0).abs() < 1e-4, "g {g}: {}", integral(&nodes, p));
            assert!((mean_cosine(&nodes, p) - g).abs() < 1e-4, "g {g}");
        }
    }
}
