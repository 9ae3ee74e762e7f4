//! Koschmieder's law: dark objects by day, with contrast thresholds of 5 % and 2 %.

/// −ln 0.05: optical depth at the meteorological optical range (WMO No. 8, contrast or flux falls to 5 %).
pub const MOR_OPTICAL_DEPTH: f64 = 2.995_732_273_553_991;

/// Optical depth at Koschmieder's visual range with a 2 % contrast threshold (−ln 0.02, conventionally printed 3.912).
pub const KOSCHMIEDER_OPTICAL_DEPTH: f64 = 3.912;

/// Meteorological optical range in m, −ln 0.05 / σ, for an extinction coefficient σ > 0 in 1/m; +inf for σ = 0.
#[must_use]
pub fn mor_m(sigma_t_1_m: f64) -> f64 {
    MOR_OPTICAL_DEPTH / sigma_t_1_m
}

/// Extinction coefficient in 1/m whose meteorological optical range is `mor_m` > 0.
#[must_use]
pub fn sigma_t_from_mor(mor_m: f64) -> f64 {
    MOR_OPTICAL_DEPTH / mor_m
}

/// Koschmieder's visual range at the 2 % threshold in m, 3.912 / σ, for σ > 0 in 1/m; +inf for σ = 0.
#[must_use]
pub fn koschmieder_m(sigma_t_1_m: f64) -> f64 {
    KOSCHMIEDER_OPTICAL_DEPTH / sigma_t_1_m
}

/// Extinction coefficient in 1/m whose Koschmieder range (2 %) is `range_m` > 0.
#[must_use]
pub fn sigma_t_from_koschmieder(range_m: f64) -> f64 {
    KOSCHMIEDER_OPTICAL_DEPTH / range_m
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_laws_round_trip() {
        assert!((MOR_OPTICAL_DEPTH + fog_core::math::f64::ln(0.05)).abs() < 1e-15);
        for sigma in [1e-5, 0.003, 0.05, 2.0] {
            assert!((sigma_t_from_mor(mor_m(sigma)) / sigma - 1.0).abs() < 1e-15);
            assert!((sigma_t_from_koschmieder(koschmieder_m(sigma)) / sigma - 1.0).abs() < 1e-15);
            assert!(koschmieder_m(sigma) > mor_m(sigma));
        }
        assert_eq!(mor_m(0.0), f64::INFINITY);
    }
}
