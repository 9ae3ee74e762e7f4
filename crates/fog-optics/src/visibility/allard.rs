//! Allard's law: point lights, whose illuminance at distance R is E = I e^(−σR) / R² (Allard 1876, *Mémoire sur
//! l'intensité et la portée des phares*).

use fog_core::math::f64::{exp, ln};

/// Luminous intensities of Fig. 11 of Kolářová, Lachiver & Wilkie 2024, in cd.
pub const PAPER_INTENSITIES_CD: [f64; 3] = [100.0, 1000.0, 10_000.0];

/// Distance in m at which a light of `intensity_cd` (cd) gives the illuminance `threshold_lx` (lx) through an extinction
/// coefficient `sigma_t_1_m` (1/m): the R of E_T = I e^(−σR) / R².
///
/// In closed form R = (2/σ) W(½ σ √(I/E_T)) with Lambert's W; √(I/E_T) for σ = 0. To within a few 1e-16 for all
/// positive numbers that do not overflow. 0 for a dark light (I = 0) or opaque air (σ = +inf), +inf for a threshold of 0.
/// NaN if an argument is negative or not a number.
#[must_use]
pub fn allard_m(intensity_cd: f64, threshold_lx: f64, sigma_t_1_m: f64) -> f64 {
    let valid = |x: f64| x >= 0.0;
    if !(valid(intensity_cd) && valid(threshold_lx) && valid(sigma_t_1_m)) {
        return f64::NAN;
    }
    if intensity_cd == 0.0 || sigma_t_1_m == f64::INFINITY {
        return 0.0;
    }
    // Square root of the law: R e^w = R₀ with w = σR/2, R₀ = √(I/E_T), so that w e^w = σR₀/2.
    let clear = intensity_cd.sqrt() / threshold_lx.sqrt();
    if sigma_t_1_m == 0.0 || clear == f64::INFINITY {
        return clear;
    }
    let w = lambert_w_of_exp(ln(0.5 * sigma_t_1_m) + ln(clear));
    // Either form is exact; the first does not amplify the error of w where w is large.
    if w > 1.0 { 2.0 * w / sigma_t_1_m } else { clear * exp(-w) }
}

/// Extinction coefficient in 1/m through which a light of `intensity_cd` is just seen at `range_m`:
/// σ = ln(I / (E_T R²)) / R. Negative where the light is seen less far than through clear air: no fog explains that.
#[must_use]
pub fn sigma_t_from_allard(intensity_cd: f64, threshold_lx: f64, range_m: f64) -> f64 {
    (ln(intensity_cd) - ln(threshold_lx) - 2.0 * ln(range_m)) / range_m
}

/// W(e^l), the w > 0 of w e^w = e^l, as w = e^u with u + e^u = l. The left side is convex and rises, and the first guess
/// lies beyond the root, so that Newton's steps go down to it without a safeguard.
fn lambert_w_of_exp(l: f64) -> f64 {
    let mut u = if l > 1.0 { ln(l) } else { l };
    for _ in 0..64 {
        let w = exp(u);
        let next = u - (u + w - l) / (1.0 + w);
        if next >= u {
            break;
        }
        u = next;
    }
    exp(u)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Independent of the above: bisection of illuminance over distance.
    fn by_bisection(intensity: f64, threshold: f64, sigma: f64) -> f64 {
        let (mut low, mut high) = (0.0, (intensity / threshold).sqrt());
        for _ in 0..200 {
            let r = 0.5 * (low + high);
            let seen = intensity * exp(-sigma * r) / (r * r) >= threshold;
            (low, high) = if seen { (r, high) } else { (low, r) };
        }
        0.5 * (low + high)
    }

    #[test]
    fn equals_bisection() {
        for intensity in [1e-3, 1.0, 100.0, 1e4, 1e9] {
            for threshold in [1e-9, 8e-7, 1e-4, 1e-3, 10.0] {
                for sigma in [1e-12, 1e-6, 1e-3, 0.03, 1.0, 50.0] {
                    let (r, wanted) =
                        (allard_m(intensity, threshold, sigma), by_bisection(intensity, threshold, sigma));
                    assert!(
                        (r / wanted - 1.0).abs() < 1e-13,
                        "{intensity} {threshold} {sigma}: {r} {wanted}"
                    );
                }
            }
        }
    }

    #[test]
    fn meets_the_law_and_inverts() {
        for (intensity, threshold, sigma) in [(100.0, 8e-7, 0.01), (1e4, 1e-4, 0.06), (1.0, 1e-3, 1e-4)] {
            let r = allard_m(intensity, threshold, sigma);
            assert!((sigma_t_from_allard(intensity, threshold, r) / sigma - 1.0).abs() < 1e-9);
            assert!((intensity * exp(-sigma * r) / (r * r) / threshold - 1.0).abs() < 1e-12);
        }
    }

    #[test]
    fn limits_are_met_and_nothing_is_nan_without_need() {
        assert_eq!(allard_m(100.0, 1e-4, 0.0), 1000.0);
        assert!((allard_m(100.0, 1e-4, 1e-300) - 1000.0).abs() < 1e-9);
        assert_eq!(allard_m(0.0, 1e-4, 0.1), 0.0);
        assert_eq!(allard_m(1.0, 1e-4, f64::INFINITY), 0.0);
        assert_eq!(allard_m(1.0, 0.0, 0.1), f64::INFINITY);
        for bad in [-1.0, f64::NAN] {
            assert!(allard_m(bad, 1e-4, 0.1).is_nan());
            assert!(allard_m(1.0, bad, 0.1).is_nan());
            assert!(allard_m(1.0, 1e-4, bad).is_nan());
        }
        let extremes = [1e-300, 1e-150, 1e-10, 1.0, 1e10, 1e150, 1e300];
        for i in extremes {
            for e in extremes {
                let mut before = f64::INFINITY;
                for s in extremes {
                    let r = allard_m(i, e, s);
                    assert!(r >= 0.0 && r <= before, "{i} {e} {s}: {r} after {before}");
                    before = r;
                }
            }
        }
    }
}
