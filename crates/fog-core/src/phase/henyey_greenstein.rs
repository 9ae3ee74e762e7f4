//! Henyey & Greenstein, Astrophysical Journal 93, 70 (1941).

use super::{PhaseError, check};
use crate::math::{INV_PI_F32, PI};

/// p(m) = (1 − g²) / (4π (1 + g² − 2g cos θ)^{3/2}), whose mean cosine is g.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HenyeyGreenstein {
    g: f64,
}

impl HenyeyGreenstein {
    /// The function with mean cosine `g`.
    ///
    /// # Errors
    /// Unless −1 < g < 1.
    pub fn new(g: f64) -> Result<Self, PhaseError> {
        check(g > -1.0 && g < 1.0, "mean cosine g", g, "above -1, below 1")?;
        Ok(Self { g })
    }

    /// Mean cosine of the scattering angle.
    #[must_use]
    pub fn mean_cosine(self) -> f64 {
        self.g
    }

    /// Value in 1/sr for m = 1 − cos θ. The denominator is written in m, which keeps its precision near forward.
    #[must_use]
    pub fn eval(self, m: f64) -> f64 {
        let g = self.g;
        let d = (1.0 - g) * (1.0 - g) + 2.0 * g * m;
        (1.0 - g * g) / (4.0 * PI * d * d.sqrt())
    }

    /// [`HenyeyGreenstein::eval`] in single precision, for a renderer's inner loop.
    #[inline(always)]
    #[must_use]
    pub fn eval_single(self, m: f32) -> f32 {
        let g = self.g as f32;
        let d = (1.0 - g) * (1.0 - g) + 2.0 * g * m;
        (1.0 - g * g) * 0.25 * INV_PI_F32 / (d * d.sqrt())
    }

    /// Density of [`HenyeyGreenstein::sample`] in 1/sr: the value itself.
    #[must_use]
    pub fn pdf(self, m: f64) -> f64 {
        self.eval(m)
    }

    /// Samples m for `u` uniform in [0, 1), by inversion. These bits are part of rendered data sets.
    #[inline]
    #[must_use]
    pub fn sample(self, u: f64) -> f64 {
        let g = self.g;
        if g.abs() < 1e-6 {
            // First order in g, where the closed form loses its digits.
            return (2.0 * u - 6.0 * g * u * (1.0 - u)).clamp(0.0, 2.0);
        }
        // Mirrored in u, so that u = 0 is forward as in the tables.
        let s = (1.0 - g * g) / (1.0 + g - 2.0 * g * u);
        (1.0 - (1.0 + g * g - s * s) / (2.0 * g)).clamp(0.0, 2.0)
    }

    /// The m below which a share `u` in [0, 1] is scattered, without cancellation and at any g. With
    /// s = √(1 + g² − 2g cos θ) and f = 1 − g its value forward, m = (s − f)(s + f) / 2g, and s − f has a factor g.
    pub(super) fn quantile(self, u: f64) -> f64 {
        let g = self.g;
        let f = 1.0 - g;
        let denominator = f + 2.0 * g * (1.0 - u);
        let s = f * (1.0 + g) / denominator;
        (f * u * (s + f) / denominator).clamp(0.0, 2.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_inversions_agree_and_both_precisions() {
        for g in [-0.95, -0.4, 0.0, 1e-7, 1e-5, 0.3, 0.83, 0.99] {
            let p = HenyeyGreenstein::new(g).unwrap();
            for i in 0..=100 {
                let u = f64::from(i) / 100.0;
                let (a, b) = (p.sample(u), p.quantile(u));
                assert!((a - b).abs() < 1e-9, "g {g}, u {u}: {a} {b}");
                let single = f64::from(p.eval_single(b as f32));
                assert!((single / p.eval(b) - 1.0).abs() < 1e-3, "g {g}, m {b}: {single} {}", p.eval(b));
            }
            assert_eq!((p.quantile(0.0), p.mean_cosine()), (0.0, g));
        }
    }

    #[test]
    fn parameters_are_checked() {
        for g in [1.0, -1.0, 1.5, f64::NAN] {
            let message = HenyeyGreenstein::new(g).unwrap_err().to_string();
            assert!(message.contains("mean cosine g") && message.contains("valid"), "{message}");
        }
    }
}
