//! Moonlight: how much by phase, and in what colour.

use fog_core::bands::{BANDS, BandSpectrum};
use fog_core::math;

/// Mean angular diameter of the moon in degrees.
pub const DIAMETER_DEG: f64 = 0.518;
/// Visual magnitude of the full moon at its mean distance (Allen 1973, "Astrophysical Quantities", 3rd ed., sec. 67).
const FULL_MAGNITUDE: f64 = -12.73;
/// Illuminance of magnitude 0 in lx (the same, sec. 8).
const LUX_OF_MAGNITUDE_0: f64 = 2.54e-6;
/// Magnitudes by which the moon is fainter than full, by phase angle in degrees (Allen 1973, sec. 67); the last row is dark.
const PHASES: [(f64, f64); 20] = [
    (0.0, 0.0),
    (5.0, 0.08),
    (10.0, 0.23),
    (20.0, 0.51),
    (30.0, 0.79),
    (40.0, 1.06),
    (50.0, 1.35),
    (60.0, 1.62),
    (70.0, 1.91),
    (80.0, 2.24),
    (90.0, 2.63),
    (100.0, 3.04),
    (110.0, 3.48),
    (120.0, 3.93),
    (130.0, 4.44),
    (140.0, 5.07),
    (150.0, 5.9),
    (160.0, 7.5),
    (170.0, 11.0),
    (180.0, 20.0),
];
/// The moon is redder than the sun: its albedo grows as this power of the wavelength, which makes the colour index B − V 0.92
/// of its light from the sun's 0.65 (Allen 1973).
const REDDENING: f64 = 1.115;

/// Illuminance of the moon outside the air across its beam in lx, at a phase angle in degrees: 0 is full, 90 first or last
/// quarter, 180 new. Beyond 160° there are no measurements, and a steep fall is assumed.
#[must_use]
pub fn illuminance_lx(phase_deg: f64) -> f64 {
    let phase = phase_deg.abs().min(180.0);
    let upper = PHASES.partition_point(|row| row.0 <= phase).clamp(1, PHASES.len() - 1);
    let ((p0, m0), (p1, m1)) = (PHASES[upper - 1], PHASES[upper]);
    let fainter = m0 + (m1 - m0) * (phase - p0) / (p1 - p0);
    LUX_OF_MAGNITUDE_0 * math::f64::pow(10.0, -0.4 * (FULL_MAGNITUDE + fainter))
}

/// The moon's albedo by band, up to a factor.
#[must_use]
pub fn colour() -> [f64; BANDS] {
    core::array::from_fn(|band| math::f64::pow(f64::from(BandSpectrum::centre_nm(band)) / 550.0, REDDENING))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_full_moon_and_the_quarters() {
        // 0.31 lx before the air takes its part, of which about a quarter of a lux is left (0.27 lx in the zenith: Seidelmann 1992).
        assert!((illuminance_lx(0.0) - 0.314).abs() < 2e-3, "{}", illuminance_lx(0.0));
        // A half moon has a tenth of that.
        let half = illuminance_lx(90.0) / illuminance_lx(0.0);
        assert!((0.08..0.10).contains(&half) && illuminance_lx(-90.0) == illuminance_lx(90.0), "{half}");
        let all: Vec<f64> = (0..=180).map(|p| illuminance_lx(f64::from(p))).collect();
        assert!(all.is_sorted_by(|a, b| a > b));
        assert!(illuminance_lx(180.0) < 1e-8);
    }

    #[test]
    fn moonlight_is_redder_by_its_colour_index() {
        let albedo = |nm: f64| math::f64::pow(nm / 550.0, REDDENING);
        // B at 440 nm, V at 550 nm: 0.27 magnitudes.
        let index = -2.5 * math::f64::ln(albedo(440.0) / albedo(550.0)) / math::f64::ln(10.0);
        assert!((index - 0.27).abs() < 0.005, "{index}");
        assert!(colour().is_sorted());
    }
}
