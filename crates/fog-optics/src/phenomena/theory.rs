//! What simpler theories say: ray optics, Airy's theory of the rainbow, Fraunhofer's diffraction by a disc.

use fog_core::math::PI;
use fog_core::math::f64::{asin, cbrt};

/// First zeros of Bessel's J₁ over π: dark rings of a disc of diameter d are at sin θ = these · λ/d (Airy's 1.22 first).
pub const DARK_RINGS: [f64; 3] = [1.219_670, 2.233_131, 3.238_315];

/// First maximum of Airy's function Ai(−s)² beyond s = 0: the zero of Ai′.
const AIRY_MAXIMUM: f64 = 1.018_793;

/// Scattering angle in degrees of the primary rainbow by ray optics (Descartes) for refractive index n, 1 < n < 2.
#[must_use]
pub fn descartes_bow_deg(n: f64) -> f64 {
    // Least deviation after one internal reflection: cos² i = (n² − 1)/3.
    let sin_i = ((4.0 - n * n) / 3.0).sqrt();
    let (i, r) = (asin(sin_i), asin(sin_i / n));
    180.0 + (2.0 * i - 4.0 * r) * 180.0 / PI
}

/// Angle in degrees by which one unit of the argument of Airy's function stretches at size parameter x = πd/λ.
///
/// The bow's intensity is Ai(−s)² with s = x^(2/3) h^(−1/3) (θ − θ_Descartes), h = (9/4) √((4 − n²)/(n² − 1)³) (van de
/// Hulst, *Light Scattering by Small Particles* (1957), Sec. 13.2, in terms of Ai).
#[must_use]
pub fn airy_scale_deg(n: f64, x: f64) -> f64 {
    let contrast = n * n - 1.0;
    let h = 2.25 * ((4.0 - n * n) / (contrast * contrast * contrast)).sqrt();
    cbrt(h / (x * x)) * 180.0 / PI
}

/// Scattering angle in degrees of the brightest direction of the primary bow by Airy's theory, for refractive index n and
/// size parameter x = πd/λ: beyond Descartes' angle, the more so the smaller the drop.
#[must_use]
pub fn airy_bow_deg(n: f64, x: f64) -> f64 {
    descartes_bow_deg(n) + AIRY_MAXIMUM * airy_scale_deg(n, x)
}

/// Angular radius in degrees of a dark ring (0 the first, up to 2) of the corona by diffraction at a disc of size parameter
/// x = πd/λ: sin θ = 1.22 λ/d for the first. 90 where there is none.
#[must_use]
pub fn dark_ring_deg(x: f64, ring: usize) -> f64 {
    asin((DARK_RINGS[ring.min(2)] * PI / x).min(1.0)) * 180.0 / PI
}
