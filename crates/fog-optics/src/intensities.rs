//! What one sphere scatters into given directions.

use crate::error::{OpticsError, check_range};
use crate::mie::MieSeries;
use fog_core::math::PI;
use fog_core::math::f64::cos;

/// Scattering by one sphere into one direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Intensity {
    /// Scattering angle in degrees.
    pub angle_deg: f64,
    /// |S1|², perpendicular to the scattering plane (Bohren & Huffman 1983, Eq. 4.74).
    pub s1_sq: f64,
    /// |S2|², parallel to the scattering plane.
    pub s2_sq: f64,
    /// Phase function of unpolarised light in 1/sr, (|S1|² + |S2|²) / (2π x² Q_sca): its integral over the sphere is 1; 0
    /// for a sphere that scatters nothing.
    pub phase_function_1_sr: f64,
}

/// Intensities at scattering angles in degrees, in their order.
///
/// # Errors
/// If an angle is not in 0 to 180.
pub fn at_degrees(series: &MieSeries, angles_deg: &[f64]) -> Result<Vec<Intensity>, OpticsError> {
    angles_deg.iter().try_for_each(|&a| check_range("scattering angle (degrees)", a, 0.0, 180.0))?;
    let cosines: Vec<f64> = angles_deg.iter().map(|a| cos(a * PI / 180.0)).collect();
    let x = series.size_parameter();
    let q_sca = series.efficiencies().q_sca;
    let scale = if q_sca > 0.0 { 1.0 / (2.0 * PI * x * x * q_sca) } else { 0.0 };
    Ok((angles_deg.iter().zip(series.amplitudes(&cosines)))
        .map(|(&angle_deg, s)| {
            let (s1_sq, s2_sq) = (s.s1.norm_sqr(), s.s2.norm_sqr());
            Intensity { angle_deg, s1_sq, s2_sq, phase_function_1_sr: (s1_sq + s2_sq) * scale }
        })
        .collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mie::Complex64;
    use fog_core::math::f64::sin;

    #[test]
    fn phase_functions_integrate_to_one_and_rayleigh_is_met() {
        let series = MieSeries::new(Complex64::new(1.5, 0.01), 5.0).unwrap();
        let degrees: Vec<f64> = (0..=1800).map(|i| 0.1 * f64::from(i)).collect();
        let step = PI / 1800.0;
        let sum: f64 = at_degrees(&series, &degrees)
            .unwrap()
            .iter()
            .map(|s| 2.0 * PI * s.phase_function_1_sr * sin(s.angle_deg * PI / 180.0) * step)
            .sum();
        assert!((sum - 1.0).abs() < 1e-5, "{sum}");

        let small = MieSeries::new(Complex64::new(1.333, 0.0), 1e-4).unwrap();
        for s in at_degrees(&small, &[0.0, 45.0, 90.0, 180.0]).unwrap() {
            let mu = cos(s.angle_deg * PI / 180.0);
            let rayleigh = 3.0 / (16.0 * PI) * (1.0 + mu * mu);
            assert!((s.phase_function_1_sr / rayleigh - 1.0).abs() < 1e-6, "{s:?}");
        }
        let none = MieSeries::new(Complex64::new(1.0, 0.0), 1.0).unwrap();
        assert_eq!(at_degrees(&none, &[30.0]).unwrap()[0].phase_function_1_sr, 0.0);
        for bad in [-1.0, 180.1, f64::NAN] {
            assert!(at_degrees(&small, &[0.0, bad]).is_err());
        }
    }
}
