//! Spectra of one shape and any size: two amounts fix the size.

use super::{Amount, FogParcel};
use crate::error::{OpticsError, check_range};
use crate::layer::REFERENCE_NM;
use crate::size::{LognormalMode, SizeDistribution};
use crate::visibility::sigma_t_from_mor;
use fog_core::math::f64::{cbrt, exp, ln};

/// Effective radii in µm that are looked for: there extinction per water falls with size and extinction per droplet
/// rises, so that there is one answer.
const RADIUS_RANGE_UM: [f64; 2] = [0.8, 60.0];

/// A shape of spectrum, whose size is open.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Family {
    /// Gamma distribution of Hansen & Travis 1974.
    Gamma {
        /// Effective variance, 0.001 to 0.33. 1/9 is n(r) ∝ r⁶ e^(−br), as in Deirmendjian's cloud model C1 (1969).
        effective_variance: f64,
    },
    /// One lognormal.
    Lognormal {
        /// Geometric standard deviation, 1.02 to 4.
        geometric_sd: f64,
    },
}

impl Family {
    /// Member of an effective radius in µm.
    ///
    /// # Errors
    /// If the radius or the shape is out of its range.
    pub fn with_effective_radius(&self, radius_um: f64) -> Result<SizeDistribution, OpticsError> {
        match *self {
            Self::Gamma { effective_variance } => SizeDistribution::gamma(radius_um, effective_variance),
            Self::Lognormal { geometric_sd } => {
                check_range("lognormal's geometric_sd", geometric_sd, 1.02, 4.0)?;
                // r_eff = r_median exp(5/2 s²).
                let s = ln(geometric_sd);
                let median_diameter_um = 2.0 * radius_um * exp(-2.5 * s * s);
                SizeDistribution::lognormals(&[LognormalMode {
                    share: 1.0,
                    median_diameter_um,
                    geometric_sd,
                }])
            }
        }
    }

    /// The fog that has both amounts: number and water, number and extinction (or MOR), or water and extinction (or MOR).
    ///
    /// # Errors
    /// If both amounts are of the same kind, one is out of range, or no effective radius of 0.8 to 60 µm has both.
    pub fn fog(&self, first: Amount, second: Amount) -> Result<FogParcel, OpticsError> {
        first.check()?;
        second.check()?;
        match (first, second) {
            (Amount::Mor(m), other) => self.fog(Amount::SigmaT(sigma_t_from_mor(m)), other),
            (other, Amount::Mor(m)) => self.fog(other, Amount::SigmaT(sigma_t_from_mor(m))),
            (Amount::Number(n), Amount::Water(w)) | (Amount::Water(w), Amount::Number(n)) => {
                self.solve(first, |spectrum| {
                    let m = spectrum.moments();
                    Ok(cbrt(w / n * m.share_in_range / m.mass_g))
                })
            }
            (Amount::Number(n), Amount::SigmaT(s)) | (Amount::SigmaT(s), Amount::Number(n)) => {
                self.solve(first, |spectrum| {
                    let per_droplet = spectrum.optics(REFERENCE_NM)?.c_ext_m2 / spectrum.share_in_range();
                    Ok((s / n / per_droplet).sqrt())
                })
            }
            (Amount::Water(w), Amount::SigmaT(s)) | (Amount::SigmaT(s), Amount::Water(w)) => self
                .solve(first, |spectrum| {
                    Ok(spectrum.optics(REFERENCE_NM)?.c_ext_m2 / spectrum.mass_g() * w / s)
                }),
            _ => Err(OpticsError::Settings(
                "two different amounts fix a fog: number, water, or extinction (or MOR)".to_owned(),
            )),
        }
    }

    /// Finds the radius by its next guess's factor, which is 1 at the solution and would lead there at once if extinction
    /// were twice the droplets' shadow.
    fn solve(
        &self,
        amount: Amount,
        factor: impl Fn(&SizeDistribution) -> Result<f64, OpticsError>,
    ) -> Result<FogParcel, OpticsError> {
        let [least, most] = RADIUS_RANGE_UM;
        let mut radius_um = 6.0f64;
        let mut at_bound = 0;
        for _ in 0..60 {
            let spectrum = self.with_effective_radius(radius_um)?;
            let factor = factor(&spectrum)?;
            if (factor - 1.0).abs() < 1e-9 {
                return FogParcel::new(spectrum, amount);
            }
            let next = (radius_um * factor).clamp(least, most);
            at_bound = if next == least || next == most { at_bound + 1 } else { 0 };
            if at_bound > 2 {
                break;
            }
            radius_um = next;
        }
        Err(OpticsError::Range {
            what: "effective radius that fits both amounts (µm)",
            value: radius_um,
            valid: format!("within {least} to {most}: check the amounts and their units"),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn any_two_amounts_give_the_fog_back() {
        for family in
            [Family::Gamma { effective_variance: 1.0 / 9.0 }, Family::Lognormal { geometric_sd: 1.5 }]
        {
            for radius in [2.0, 5.0, 11.0] {
                let spectrum = family.with_effective_radius(radius).unwrap();
                assert!((spectrum.effective_radius_um() / radius - 1.0).abs() < 1e-4);
                let fog = FogParcel::new(spectrum, Amount::Number(8e7)).unwrap();
                let number = Amount::Number(8e7);
                let water = Amount::Water(fog.liquid_water_content_g_m3());
                let (sigma, mor) = (Amount::SigmaT(fog.sigma_t_550_1_m()), Amount::Mor(fog.mor_m()));
                for (a, b) in [(number, water), (sigma, number), (number, mor), (water, mor), (mor, water)] {
                    let again = family.fog(a, b).unwrap();
                    let got = again.distribution().effective_radius_um();
                    assert!((got / radius - 1.0).abs() < 2e-4, "{family:?} {a:?} {b:?}: {got} {radius}");
                    assert!((again.mor_m() / fog.mor_m() - 1.0).abs() < 1e-6, "{family:?} {a:?} {b:?}");
                    assert!((again.number_density_1_m3() / 8e7 - 1.0).abs() < 1e-6, "{family:?} {a:?} {b:?}");
                }
            }
        }
    }

    #[test]
    fn impossible_pairs_are_refused() {
        let family = Family::Gamma { effective_variance: 0.1 };
        // A gram of water in a million droplets per m³: radii of 60 µm and more.
        let error = family.fog(Amount::Water(10.0), Amount::Number(1e6)).unwrap_err().to_string();
        assert!(error.contains("within 0.8 to 60"), "{error}");
        assert!(family.fog(Amount::Water(1e-6), Amount::Number(1e9)).is_err());
        assert!(family.fog(Amount::Water(0.1), Amount::Water(0.2)).is_err());
        assert!(family.fog(Amount::Mor(100.0), Amount::SigmaT(0.03)).is_err());
        assert!(family.fog(Amount::Mor(100.0), Amount::Mor(100.0)).is_err());
        assert!(Family::Gamma { effective_variance: 0.5 }.with_effective_radius(5.0).is_err());
        assert!(Family::Lognormal { geometric_sd: 0.5 }.with_effective_radius(5.0).is_err());
    }
}
