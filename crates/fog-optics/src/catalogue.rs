//! Droplet spectra of the literature by name.
//!
//! - **Shettle & Fenn**, *Models for the Aerosols of the Lower Atmosphere and the Effects of Humidity Variations on Their
//!   Optical Properties*, AFGL-TR-79-0214 (1979): four fog models after the measurements that Silverman & Sprague (1970)
//!   collected, modified gamma with γ = 1.
//! - **Deirmendjian**, *Electromagnetic Scattering on Spherical Polydispersions* (1969), clouds C.1 to C.3 and hazes M, L
//!   and H; and *Far-Infrared and Submillimeter Scattering: II. Attenuation by Clouds and Rain*, J. Appl. Meteorol. 14
//!   (1975), clouds C.5 and C.6.
//!
//! The sources print a, α, γ and b of n(r) = a r^α exp(−b r^γ), r in µm and n in cm⁻³ µm⁻¹. Here number density, α, γ and b
//! are kept; that they agree with the printed a is a test. The reports were not at hand when this was written: the numbers
//! are those that later literature and codes quote, and a, N and water content were checked against each other. Clouds and fogs are of water. The hazes were drawn up for other
//! substances too (M over sea, L over land, H in the stratosphere): here they are droplets of water.
//!
//! Deirmendjian's rain models are left out: drops of millimetres need Mie series of 10⁴ terms for each of thousands of
//! diameters, and do not hang in the air.

use crate::error::OpticsError;
use crate::size::{ModifiedGamma, SizeDistribution};

/// A spectrum of the catalogue.
#[derive(Clone, Debug, PartialEq)]
pub struct Named {
    /// Its name in [`NAMES`].
    pub name: &'static str,
    /// What it stands for.
    pub description: &'static str,
    /// Where its numbers come from.
    pub source: &'static str,
    /// Number of droplets per m³ in the source.
    pub number_density_1_m3: f64,
    /// Parameters of the modified gamma distribution.
    pub parameters: ModifiedGamma,
    /// Its shape.
    pub distribution: SizeDistribution,
}

/// A row of the catalogue: numbers as printed, per cm³.
struct Entry {
    name: &'static str,
    description: &'static str,
    source: &'static str,
    number_1_cm3: f64,
    alpha: f64,
    b: f64,
    gamma: f64,
}

const SHETTLE_FENN: &str = "Shettle & Fenn 1979, AFGL-TR-79-0214";
const DEIRMENDJIAN_1969: &str = "Deirmendjian 1969";
const DEIRMENDJIAN_1975: &str = "Deirmendjian 1975, J. Appl. Meteorol. 14";

#[rustfmt::skip] // one row per spectrum
const ENTRIES: [Entry; 12] = [
    Entry { name: "shettle_fenn_advection_heavy", description: "heavy advection fog (model 1), about 136 m of visibility at 2 % contrast", source: SHETTLE_FENN, number_1_cm3: 20.0, alpha: 3.0, b: 0.3, gamma: 1.0 },
    Entry { name: "shettle_fenn_advection_moderate", description: "moderate advection fog (model 2), about 212 m of visibility at 2 % contrast", source: SHETTLE_FENN, number_1_cm3: 20.0, alpha: 3.0, b: 0.375, gamma: 1.0 },
    Entry { name: "shettle_fenn_radiation_heavy", description: "heavy radiation fog (model 3), about 235 m of visibility at 2 % contrast", source: SHETTLE_FENN, number_1_cm3: 100.0, alpha: 6.0, b: 1.5, gamma: 1.0 },
    Entry { name: "shettle_fenn_radiation_moderate", description: "moderate radiation fog (model 4), about 453 m of visibility at 2 % contrast", source: SHETTLE_FENN, number_1_cm3: 200.0, alpha: 6.0, b: 3.0, gamma: 1.0 },
    Entry { name: "deirmendjian_cloud_c1", description: "cumulus cloud C.1, mode radius 4 µm", source: DEIRMENDJIAN_1969, number_1_cm3: 100.0, alpha: 6.0, b: 1.5, gamma: 1.0 },
    Entry { name: "deirmendjian_cloud_c2", description: "cloud C.2 that shows a corona, mode radius 4 µm, narrow", source: DEIRMENDJIAN_1969, number_1_cm3: 100.0, alpha: 8.0, b: 1.0 / 24.0, gamma: 3.0 },
    Entry { name: "deirmendjian_cloud_c3", description: "cloud C.3 like mother of pearl, mode radius 2 µm, narrow", source: DEIRMENDJIAN_1969, number_1_cm3: 100.0, alpha: 8.0, b: 1.0 / 3.0, gamma: 3.0 },
    Entry { name: "deirmendjian_cloud_c5", description: "cloud C.5, mode radius 6 µm", source: DEIRMENDJIAN_1975, number_1_cm3: 100.0, alpha: 4.0, b: 2.0 / 3.0, gamma: 1.0 },
    Entry { name: "deirmendjian_cloud_c6", description: "large-drop tail of a cloud C.6, mode radius 20 µm", source: DEIRMENDJIAN_1975, number_1_cm3: 0.1, alpha: 2.0, b: 0.1, gamma: 1.0 },
    Entry { name: "deirmendjian_haze_m", description: "maritime and coastal haze M, of water here", source: DEIRMENDJIAN_1969, number_1_cm3: 100.0, alpha: 1.0, b: 8.9443, gamma: 0.5 },
    Entry { name: "deirmendjian_haze_l", description: "continental haze L, of water here", source: DEIRMENDJIAN_1969, number_1_cm3: 100.0, alpha: 2.0, b: 15.1186, gamma: 0.5 },
    Entry { name: "deirmendjian_haze_h", description: "stratospheric haze H, of water here", source: DEIRMENDJIAN_1969, number_1_cm3: 100.0, alpha: 2.0, b: 20.0, gamma: 1.0 },
];

/// Names of the spectra, fogs first.
pub const NAMES: [&str; ENTRIES.len()] = {
    let mut names = [""; ENTRIES.len()];
    let mut i = 0;
    while i < ENTRIES.len() {
        names[i] = ENTRIES[i].name;
        i += 1;
    }
    names
};

/// The spectrum of a name in [`NAMES`].
///
/// ```
/// let fog = fog_optics::catalogue::named("shettle_fenn_radiation_heavy")?;
/// assert_eq!(fog.number_density_1_m3, 1e8);
/// assert!((fog.distribution.effective_radius_um() - 6.0).abs() < 1e-3);
/// # Ok::<(), fog_optics::error::OpticsError>(())
/// ```
///
/// # Errors
/// [`OpticsError::UnknownName`] with the names there are.
pub fn named(name: &str) -> Result<Named, OpticsError> {
    let Some(entry) = ENTRIES.iter().find(|entry| entry.name == name) else {
        return Err(OpticsError::UnknownName {
            what: "droplet spectrum",
            name: name.to_owned(),
            known: NAMES.join(", "),
        });
    };
    let parameters = ModifiedGamma { alpha: entry.alpha, b: entry.b, gamma: entry.gamma };
    Ok(Named {
        name: entry.name,
        description: entry.description,
        source: entry.source,
        number_density_1_m3: 1e6 * entry.number_1_cm3,
        parameters,
        distribution: SizeDistribution::modified_gamma(parameters)?,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use fog_core::math::f64::{exp, ln, ln_gamma};

    /// a of the sources, in cm⁻³ µm^−(α+1).
    const PRINTED_A: [f64; 12] =
        [0.027, 0.06592, 2.37305, 607.5, 2.373, 1.0851e-2, 5.5556, 0.5481, 0.5e-4, 5.3333e4, 4.9757e6, 4.0e5];

    fn extinction_1_km(name: &str, wavelength_nm: f64) -> f64 {
        let fog = named(name).unwrap();
        1e3 * fog.number_density_1_m3 * fog.distribution.optics(wavelength_nm).unwrap().c_ext_m2
    }

    #[test]
    fn number_densities_agree_with_the_printed_factors() {
        for (entry, a) in ENTRIES.iter().zip(PRINTED_A) {
            let order = (entry.alpha + 1.0) / entry.gamma;
            let n = a / entry.gamma * exp(ln_gamma(order) - order * ln(entry.b));
            assert!((n / entry.number_1_cm3 - 1.0).abs() < 2e-3, "{}: {n} per cm³", entry.name);
        }
    }

    #[test]
    fn every_spectrum_is_whole_and_finite() {
        for name in NAMES {
            let fog = named(name).unwrap();
            let moments = fog.distribution.moments();
            assert!((moments.share_in_range - 1.0).abs() < 1e-4, "{name}: {moments:?}");
            let optics = fog.distribution.optics(550.0).unwrap();
            assert!(optics.c_ext_m2 > 0.0 && optics.g > 0.7 && optics.g < 0.9, "{name}: {optics:?}");
        }
    }

    #[test]
    fn fogs_have_the_extinction_and_water_of_their_source() {
        // Shettle & Fenn's extinction at 0.55 µm in 1/km as it is quoted; ours differs by 2 % at most.
        for (name, printed) in [
            ("shettle_fenn_advection_heavy", 28.74),
            ("shettle_fenn_advection_moderate", 18.65),
            ("shettle_fenn_radiation_moderate", 8.74),
        ] {
            let ours = extinction_1_km(name, 550.0);
            assert!((ours / printed - 1.0).abs() < 0.02, "{name}: {ours}");
        }
        // Water in g/m³: 4/3 π N Γ(α+4)/Γ(α+1)/b³; the 1975 paper prints 0.297 and 0.0251.
        for (name, water) in [
            ("shettle_fenn_advection_heavy", 0.372),
            ("shettle_fenn_radiation_moderate", 0.0156),
            ("deirmendjian_cloud_c5", 0.297),
            ("deirmendjian_cloud_c6", 0.0251),
        ] {
            let fog = named(name).unwrap();
            let ours = fog.number_density_1_m3 * fog.distribution.mass_g();
            assert!((ours / water - 1.0).abs() < 3e-3, "{name}: {ours}");
        }
    }

    #[test]
    fn mean_cosines_agree_with_published_expansions() {
        // First moments of Haze L and Cloud C.1 at 0.7 µm, m = 1.33: Garcia & Siewert 1985 (test problems 4 and 5 of
        // DISORT, 2.41260 / 3 and 2.544 / 3).
        for (name, g) in [("deirmendjian_haze_l", 0.8042), ("deirmendjian_cloud_c1", 0.848)] {
            let ours = named(name).unwrap().distribution.optics(700.0).unwrap().g;
            assert!((ours - g).abs() < 1.5e-3, "{name}: {ours}");
        }
    }

    #[test]
    fn an_unknown_name_is_told_the_known_ones() {
        let message = named("shettle_fen_radiation_heavy").unwrap_err().to_string();
        assert!(message.contains("`shettle_fen_radiation_heavy`"), "{message}");
        assert!(message.contains("shettle_fenn_radiation_heavy, "), "{message}");
    }
}
