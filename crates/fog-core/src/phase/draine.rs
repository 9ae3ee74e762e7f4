//! Draine, Astrophysical Journal 598, 1017 (2003): Henyey–Greenstein times 1 + α cos²θ. α = 0 is Henyey–Greenstein,
//! g = 0 with α = 1 is Rayleigh, α = 1 is Cornette & Shanks.

use super::{HenyeyGreenstein, PhaseError, check};
use crate::math::{PI, TAU};

/// p(m) = N (1 + α cos²θ) / s³ with s = √(1 + g² − 2g cos θ) and N = (1 − g²) / (4π (1 + α (1 + 2g²)/3)).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Draine {
    g: f64,
    alpha: f64,
    norm: f64,
    envelope: HenyeyGreenstein,
}

/// Steps of the inversion at most: as many halvings leave no bit of the interval.
const MAX_STEPS: usize = 64;

impl Draine {
    /// The function with these parameters; `g` is its mean cosine only for α = 0.
    ///
    /// # Errors
    /// Unless −1 < g < 1 and 0 ≤ α ≤ 1e6.
    pub fn new(g: f64, alpha: f64) -> Result<Self, PhaseError> {
        check(g > -1.0 && g < 1.0, "Draine's g", g, "above -1, below 1")?;
        check((0.0..=1e6).contains(&alpha), "Draine's alpha", alpha, "0 to 1e6")?;
        let norm = (1.0 - g * g) / (4.0 * PI * (1.0 + alpha * (1.0 + 2.0 * g * g) / 3.0));
        Ok(Self { g, alpha, norm, envelope: HenyeyGreenstein::new(g)? })
    }

    /// Mean cosine of the scattering angle: with the moments of Henyey–Greenstein, ⟨cos²⟩ = (1 + 2g²)/3 and
    /// ⟨cos³⟩ = (3g + 2g³)/5, it is g (1 + α (3 + 2g²)/5) / (1 + α (1 + 2g²)/3).
    #[must_use]
    pub fn mean_cosine(&self) -> f64 {
        let (g, a) = (self.g, self.alpha);
        g * (1.0 + a * (3.0 + 2.0 * g * g) / 5.0) / (1.0 + a * (1.0 + 2.0 * g * g) / 3.0)
    }

    /// Value in 1/sr for m = 1 − cos θ.
    #[must_use]
    pub fn eval(&self, m: f64) -> f64 {
        let d = self.s_squared(m);
        let mu = 1.0 - m;
        self.norm * (1.0 + self.alpha * mu * mu) / (d * d.sqrt())
    }

    /// Density of [`Draine::sample`] in 1/sr: the value itself.
    #[must_use]
    pub fn pdf(&self, m: f64) -> f64 {
        self.eval(m)
    }

    fn s_squared(&self, m: f64) -> f64 {
        (1.0 - self.g) * (1.0 - self.g) + 2.0 * self.g * m
    }

    /// Share of the light that is turned by less than m = 1 − cos θ, 2π ∫₀^m p.
    ///
    /// cos² is 1 − 2m + m², and ∫₀^m mᵏ s⁻³ dm has a closed form in s, in which every power of the small s − f with
    /// f = 1 − g takes a factor 2gm/(s + f) out: with r = m/(s + f) the three integrals are 2r/(s f), 2r²/s and
    /// 2r³ (s + 3f)/(3s). Nothing is divided by g, so that small g needs no case of its own.
    #[must_use]
    pub fn cumulative(&self, m: f64) -> f64 {
        let (f, s) = (1.0 - self.g, self.s_squared(m).sqrt());
        let (a, r) = (self.alpha, m / (s + f));
        let sum = (1.0 + a) / f - 2.0 * a * r + a * r * r * (s + 3.0 * f) / 3.0;
        TAU * self.norm * 2.0 * r / s * sum
    }

    /// Samples m for `u` uniform in [0, 1), by inversion of [`Draine::cumulative`].
    ///
    /// Newton's method runs over the share h of the Henyey–Greenstein function with the same g, over which the cumulative
    /// function has the bounded slope (1 + α cos²θ)/(1 + α ⟨cos²⟩); steps that leave the bracket are halvings of it.
    #[must_use]
    pub fn sample(&self, u: f64) -> f64 {
        let slope_norm = 1.0 / (1.0 + self.alpha * (1.0 + 2.0 * self.g * self.g) / 3.0);
        let (mut low, mut high) = (0.0, 1.0);
        let mut h = u.clamp(0.0, 1.0);
        let mut m = self.envelope.quantile(h);
        for _ in 0..MAX_STEPS {
            let excess = self.cumulative(m) - u;
            if excess.abs() <= 4.0 * f64::EPSILON * u {
                break;
            }
            if excess > 0.0 {
                high = h
            } else {
                low = h
            }
            let mu = 1.0 - m;
            let newton = h - excess / (slope_norm * (1.0 + self.alpha * mu * mu));
            let next = if newton > low && newton < high { newton } else { 0.5 * (low + high) };
            if next == h {
                break;
            }
            h = next;
            m = self.envelope.quantile(h);
        }
        m
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const CASES: [(f64, f64); 9] = [
        (0.0, 0.0),
        (0.0, 1.0),
        (1e-9, 250.0),
        (0.3, 250.0),
        (0.6, 30.0),
        (0.97, 3.0),
        (-0.5, 10.0),
        (0.83, 0.0),
        (-0.8, 1e6),
    ];

    /// ∫₀^m of the density by Simpson's rule over steps that are even in the fourth root.
    fn integral(p: &Draine, m: f64, weight: impl Fn(f64) -> f64) -> f64 {
        let n = 40_000;
        let top = m.sqrt().sqrt();
        let f = |v: f64| {
            let x = v.powi(4);
            TAU * p.eval(x) * weight(x) * 4.0 * v.powi(3)
        };
        let h = top / f64::from(n);
        (0..n)
            .map(|i| {
                let v = h * f64::from(i);
                h / 6.0 * (f(v) + 4.0 * f(v + 0.5 * h) + f(v + h))
            })
            .sum()
    }

    #[test]
    fn closed_forms_equal_quadrature() {
        for (g, alpha) in CASES {
            let p = Draine::new(g, alpha).unwrap();
            assert!((p.cumulative(2.0) - 1.0).abs() < 1e-13, "{g} {alpha}: {}", p.cumulative(2.0));
            for m in [1e-6, 1e-3, 0.1, 0.9, 1.7, 2.0] {
                let want = integral(&p, m, |_| 1.0);
                assert!((p.cumulative(m) - want).abs() < 1e-8 * (want + 1e-4), "{g} {alpha} {m}");
            }
            let mean = integral(&p, 2.0, |m| 1.0 - m);
            assert!((p.mean_cosine() - mean).abs() < 1e-8, "{g} {alpha}: {} {mean}", p.mean_cosine());
        }
    }

    #[test]
    fn sampling_inverts_the_cumulative_function() {
        for (g, alpha) in CASES {
            let p = Draine::new(g, alpha).unwrap();
            let mut last = 0.0;
            for i in 0..=2000 {
                let u = f64::from(i) / 2000.0;
                let m = p.sample(u);
                assert!((p.cumulative(m) - u).abs() < 1e-13, "{g} {alpha} {u}: {m}");
                assert!((0.0..=2.0).contains(&m) && m >= last, "{g} {alpha} {u}: {m} after {last}");
                last = m;
            }
            let tail = 1.0 - f64::EPSILON;
            assert!((p.cumulative(p.sample(tail)) - tail).abs() < 1e-13, "{g} {alpha}");
        }
    }

    #[test]
    fn special_cases() {
        let rayleigh = Draine::new(0.0, 1.0).unwrap();
        assert!((rayleigh.eval(1.0) - 3.0 / (16.0 * PI)).abs() < 1e-15);
        assert!((rayleigh.eval(0.0) - 3.0 / (8.0 * PI)).abs() < 1e-15);
        let (draine, hg) = (Draine::new(0.7, 0.0).unwrap(), HenyeyGreenstein::new(0.7).unwrap());
        for m in [0.0, 0.01, 0.5, 2.0] {
            assert!((draine.eval(m) / hg.eval(m) - 1.0).abs() < 1e-14);
        }
        assert!(Draine::new(1.0, 1.0).is_err() && Draine::new(0.5, -1.0).is_err());
        assert!(Draine::new(0.5, f64::INFINITY).is_err());
    }
}
