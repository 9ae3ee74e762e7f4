//! Maps of uniform numbers to directions and points, each with its density.

use crate::math;
use glam::{Mat3A, Vec3A};

/// Direction from the cosine of its polar angle about +Z and its azimuth.
#[inline]
#[must_use]
pub fn spherical(cos_theta: f32, sin_theta: f32, phi: f32) -> Vec3A {
    Vec3A::new(sin_theta * math::f32::cos(phi), sin_theta * math::f32::sin(phi), cos_theta)
}

/// Cosine-weighted direction about +Z; density cos θ / π.
#[inline]
#[must_use]
pub fn cosine_hemisphere(u: [f32; 2]) -> Vec3A {
    let r = u[0].sqrt();
    let phi = math::TAU_F32 * u[1];
    Vec3A::new(r * math::f32::cos(phi), r * math::f32::sin(phi), (1.0 - u[0]).max(0.0).sqrt())
}

/// Uniform direction; density 1 / 4π.
#[inline]
#[must_use]
pub fn uniform_sphere(u: [f32; 2]) -> Vec3A {
    let z = 1.0 - 2.0 * u[0];
    spherical(z, (1.0 - z * z).max(0.0).sqrt(), math::TAU_F32 * u[1])
}

/// Uniform direction in the cone about +Z whose 1 − cos(half-angle) is `one_minus_cos`; density
/// [`uniform_cone_pdf`].
#[inline]
#[must_use]
pub fn uniform_cone(u: [f32; 2], one_minus_cos: f32) -> Vec3A {
    let m = u[0] * one_minus_cos;
    spherical(1.0 - m, (m * (2.0 - m)).max(0.0).sqrt(), math::TAU_F32 * u[1])
}

/// Density of [`uniform_cone`] in 1/sr.
#[inline]
#[must_use]
pub fn uniform_cone_pdf(one_minus_cos: f32) -> f32 {
    1.0 / (math::TAU_F32 * one_minus_cos)
}

/// Barycentric weights (of vertices 1 and 2), uniform over a triangle; density 1 / area.
#[inline]
#[must_use]
pub fn uniform_triangle(u: [f32; 2]) -> [f32; 2] {
    let r = u[0].sqrt();
    [r * (1.0 - u[1]), r * u[1]]
}

/// Right-handed orthonormal frame whose columns are (tangent, bitangent, `n`); `n` of unit length
/// (Duff et al. 2017, "Building an orthonormal basis, revisited").
#[inline]
#[must_use]
pub fn frame(n: Vec3A) -> Mat3A {
    let sign = 1.0f32.copysign(n.z);
    let a = -1.0 / (sign + n.z);
    let b = n.x * n.y * a;
    Mat3A::from_cols(
        Vec3A::new(1.0 + sign * n.x * n.x * a, sign * b, -sign * n.x),
        Vec3A::new(b, sign + n.y * n.y * a, -n.y),
        n,
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::PathRng;

    #[test]
    fn frames_are_orthonormal() {
        let mut rng = PathRng::new(1, 1, 1);
        for _ in 0..1000 {
            let n = uniform_sphere(rng.uniform2());
            let f = frame(n);
            assert!((f.determinant() - 1.0).abs() < 1e-5);
            assert!(f.x_axis.dot(f.y_axis).abs() < 1e-6 && f.x_axis.dot(n).abs() < 1e-6);
        }
    }

    /// Means of a few spherical moments against their integrals, within 5 standard errors.
    fn mean(mut f: impl FnMut(&mut PathRng) -> f32, expected: f64) {
        let mut rng = PathRng::new(5, 0, 0);
        let mut m = crate::moments::Moments::default();
        for _ in 0..100_000 {
            m.add(f64::from(f(&mut rng)));
        }
        assert!((m.mean() - expected).abs() < 5.0 * m.standard_error() + 1e-7, "{} for {expected}", m.mean());
    }

    #[test]
    fn moments_match_densities() {
        mean(|r| cosine_hemisphere(r.uniform2()).z, 2.0 / 3.0);
        mean(|r| cosine_hemisphere(r.uniform2()).x, 0.0);
        mean(|r| uniform_sphere(r.uniform2()).y, 0.0);
        mean(|r| uniform_sphere(r.uniform2()).y.powi(2), 1.0 / 3.0);
        mean(|r| 1.0 - uniform_cone(r.uniform2(), 0.3).z, 0.15);
        mean(|r| uniform_triangle(r.uniform2())[0], 1.0 / 3.0);
        mean(|r| uniform_triangle(r.uniform2())[1], 1.0 / 3.0);
    }
}
