//! Lorenz–Mie scattering by one homogeneous sphere.
//!
//! Conventions are those of Bohren & Huffman, *Absorption and Scattering of Light by Small Particles* (1983): time factor
//! exp(−iωt), refractive index relative to the medium m = n + ik with k ≥ 0 for absorption, size parameter x = πd/λ,
//! amplitudes S1 (perpendicular) and S2 (parallel), for which dC_sca/dΩ = (|S1|² + |S2|²) / (2 k₀²) in unpolarised
//! light, k₀ = 2π/λ.
//!
//! Valid for x from 1e-6 to 1e5, n from 0.1 to 10 and k from 0 to 10: nothing overflows there, 0 ≤ q_abs and q_sca ≤ q_ext,
//! |g| ≤ 1. Accuracy against sums in 60 and more digits over that range (`tests/data/mie_corners.csv`): efficiencies and g
//! to 1e-12, q_back to 1e-10 up to x = 1e4 and 2e-9 beyond (it is a small rest of a large sum). Where the sphere hardly
//! differs from its surroundings, all are good to about 2e-16 / |m − 1|.

mod angles;
mod batch;
mod coefficients;

pub(crate) use angles::{BLOCK, GROUP, GroupTerms, KernelTerm, LANES, group_terms, mixture_block, orders};

use crate::error::{OpticsError, check_range};
pub use batch::{Batch, batch};
pub use num_complex::Complex64;

/// What a sphere does to a plane wave, as fractions of its geometric cross section πd²/4.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Efficiencies {
    /// Extinction, q_sca + q_abs.
    pub q_ext: f64,
    /// Scattering (B&H Eq. 4.61).
    pub q_sca: f64,
    /// Absorption: exactly 0 for k = 0.
    pub q_abs: f64,
    /// Backscattering as Bohren & Huffman and miepython define it: 4 |S1(180°)|² / x² (4π times the radar convention of
    /// a differential cross section over the geometric one).
    pub q_back: f64,
    /// Asymmetry parameter, the mean cosine of the scattering angle (B&H Sec. 4.5); 0 where nothing is scattered.
    pub g: f64,
}

/// Scattering amplitudes at one angle, dimensionless (B&H Eq. 4.74).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Amplitudes {
    /// S1: field perpendicular to the scattering plane.
    pub s1: Complex64,
    /// S2: field parallel to the scattering plane.
    pub s2: Complex64,
}

/// The series of one sphere, from which efficiencies and amplitudes follow.
#[derive(Clone, Debug, PartialEq)]
pub struct MieSeries {
    x: f64,
    a: Vec<Complex64>,
    b: Vec<Complex64>,
    q_abs: f64,
}

impl MieSeries {
    /// Coefficients a_n and b_n of a sphere of relative refractive index `m` and size parameter `x`.
    ///
    /// # Errors
    /// If x, n or k is outside the range of the module.
    pub fn new(m: Complex64, x: f64) -> Result<Self, OpticsError> {
        check_range("size parameter", x, 1e-6, 1e5)?;
        check_range("refractive index n", m.re, 0.1, 10.0)?;
        check_range("refractive index k", m.im, 0.0, 10.0)?;
        Ok(coefficients::series(m, x))
    }

    /// Size parameter πd/λ.
    #[must_use]
    pub fn size_parameter(&self) -> f64 {
        self.x
    }

    /// a_1, a_2, …: electric multipoles.
    #[must_use]
    pub fn a(&self) -> &[Complex64] {
        &self.a
    }

    /// b_1, b_2, …: magnetic multipoles.
    #[must_use]
    pub fn b(&self) -> &[Complex64] {
        &self.b
    }

    /// Sums of B&H Eq. 4.61, 4.62 and Sec. 4.5.
    #[must_use]
    pub fn efficiencies(&self) -> Efficiencies {
        let (a, b) = (&self.a, &self.b);
        let (mut sca, mut cosine, mut back) = (0.0, 0.0, Complex64::new(0.0, 0.0));
        let dot = |p: Complex64, q: Complex64| p.re * q.re + p.im * q.im;
        for i in 0..a.len() {
            let n = (i + 1) as f64;
            let weight = 2.0 * n + 1.0;
            sca += weight * (a[i].norm_sqr() + b[i].norm_sqr());
            cosine += weight / (n * (n + 1.0)) * dot(a[i], b[i]);
            if i + 1 < a.len() {
                cosine += n * (n + 2.0) / (n + 1.0) * (dot(a[i], a[i + 1]) + dot(b[i], b[i + 1]));
            }
            back += (a[i] - b[i]) * if i % 2 == 0 { weight } else { -weight };
        }
        let q_sca = 2.0 * sca / (self.x * self.x);
        Efficiencies {
            q_ext: q_sca + self.q_abs,
            q_sca,
            q_abs: self.q_abs,
            q_back: back.norm_sqr() / (self.x * self.x),
            g: if sca > 0.0 { (2.0 * cosine / sca).clamp(-1.0, 1.0) } else { 0.0 },
        }
    }

    /// S1 and S2 at the given cosines of the scattering angle, in their order; values beyond [−1, 1] are clamped to it.
    #[must_use]
    pub fn amplitudes(&self, cosines: &[f64]) -> Vec<Amplitudes> {
        angles::amplitudes(&self.a, &self.b, cosines)
    }
}

/// Efficiencies of a sphere: [`MieSeries::new`] and [`MieSeries::efficiencies`] in one call.
///
/// ```
/// use fog_optics::mie::{Complex64, efficiencies};
/// let q = efficiencies(Complex64::new(1.5, 0.0), 10.0)?;
/// assert!((q.q_ext - 2.881999).abs() < 1e-6); // Wiscombe 1979, test case of MIEV0
/// # Ok::<(), fog_optics::error::OpticsError>(())
/// ```
///
/// # Errors
/// As [`MieSeries::new`].
pub fn efficiencies(m: Complex64, x: f64) -> Result<Efficiencies, OpticsError> {
    Ok(MieSeries::new(m, x)?.efficiencies())
}
