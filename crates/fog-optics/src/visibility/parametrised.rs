//! Visibility from liquid water by regressions on measurements, for comparison with the integral over droplets. They know
//! nothing of the size of the droplets but what their data had: expect a factor of two.

use crate::error::{OpticsError, check_range};
use fog_core::math::f64::pow;

/// Kunkel 1984 (J. Climate Appl. Meteor. 23, 34): extinction coefficient in 1/m, 144.7 W^0.88 per km, from the liquid
/// water content W in g/m³, 0 to 100. (As used by NOAA's Unified Post Processor, `CALVIS.f`, with which the coefficients
/// were compared. Kunkel's visibility is at 2 % contrast.)
///
/// # Errors
/// If the water content is out of range.
pub fn kunkel_1984_sigma_t(liquid_water_content_g_m3: f64) -> Result<f64, OpticsError> {
    check_range("liquid water content (g/m³)", liquid_water_content_g_m3, 0.0, 100.0)?;
    Ok(144.7e-3 * pow(liquid_water_content_g_m3, 0.88))
}

/// Inverse of [`kunkel_1984_sigma_t`]: liquid water content in g/m³ from an extinction coefficient in 1/m, 0 to 10.
///
/// # Errors
/// If the extinction coefficient is out of range.
pub fn kunkel_1984_water_g_m3(sigma_t_1_m: f64) -> Result<f64, OpticsError> {
    check_range("sigma_t (1/m)", sigma_t_1_m, 0.0, 10.0)?;
    Ok(pow(sigma_t_1_m / 144.7e-3, 1.0 / 0.88))
}

/// Gultepe, Müller & Boybeyi 2006 (J. Appl. Meteor. Climatol. 45, 1469): visibility in m, 1.002 (W N)^−0.6473 km, from the
/// liquid water content W in g/m³ and the number N of droplets per *cm³* (here given per m³). It is a visibility at 2 %
/// contrast; +inf for no droplets. The coefficients are quoted as commonly reprinted.
///
/// # Errors
/// If the water content is not in 0 to 100 g/m³, or the number not in 0 to 1e13 1/m³.
pub fn gultepe_2006_visibility_m(
    liquid_water_content_g_m3: f64,
    number_density_1_m3: f64,
) -> Result<f64, OpticsError> {
    check_range("liquid water content (g/m³)", liquid_water_content_g_m3, 0.0, 100.0)?;
    check_range("number density (1/m³)", number_density_1_m3, 0.0, 1e13)?;
    let product = liquid_water_content_g_m3 * number_density_1_m3 * 1e-6;
    Ok(if product > 0.0 { 1002.0 * pow(product, -0.6473) } else { f64::INFINITY })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::parcel::{Amount, FogParcel};
    use crate::size::SizeDistribution;
    use crate::visibility::koschmieder_m;

    #[test]
    fn printed_numbers_come_out() {
        assert!((kunkel_1984_sigma_t(1.0).unwrap() - 0.1447).abs() < 1e-15);
        assert!((kunkel_1984_sigma_t(0.1).unwrap() / 0.019_075 - 1.0).abs() < 1e-4);
        assert!((kunkel_1984_water_g_m3(kunkel_1984_sigma_t(0.23).unwrap()).unwrap() - 0.23).abs() < 1e-12);
        assert!((gultepe_2006_visibility_m(0.01, 1e8).unwrap() - 1002.0).abs() < 1e-9);
        assert!((gultepe_2006_visibility_m(0.1, 1e8).unwrap() / 225.7 - 1.0).abs() < 1e-3);
        assert_eq!(gultepe_2006_visibility_m(0.0, 1e8).unwrap(), f64::INFINITY);
        assert!(kunkel_1984_sigma_t(-0.1).is_err() && gultepe_2006_visibility_m(0.1, f64::NAN).is_err());
    }

    #[test]
    fn they_agree_with_droplets_within_a_factor_of_two_and_a_half() {
        for water in [0.02, 0.1, 0.3] {
            let spectrum = SizeDistribution::gamma(7.0, 0.15).unwrap();
            let fog = FogParcel::new(spectrum, Amount::Water(water)).unwrap();
            let ours = koschmieder_m(fog.sigma_t_550_1_m());
            let kunkel = koschmieder_m(kunkel_1984_sigma_t(water).unwrap());
            let gultepe = gultepe_2006_visibility_m(water, fog.number_density_1_m3()).unwrap();
            for other in [kunkel, gultepe] {
                assert!(other / ours < 2.5 && ours / other < 2.5, "{water}: {ours} {kunkel} {gultepe}");
            }
        }
    }
}
