//! What the air is made of, by altitude and wavelength.
//!
//! Air molecules: Rayleigh optical depth of Bodhaine et al. 1999 ("On Rayleigh optical depth calculations", Eq. 30), density of
//! the US Standard Atmosphere 1976. Ozone: cross sections of `tables/sky`, with the triangular profile of Bruneton's
//! "Precomputed atmospheric scattering" (2017 edition): from 10 to 40 km with its peak at 25 km. Aerosol: scale height 1.2 km (the
//! same source), Ångström exponent 1.3, Henyey–Greenstein with g = 0.7 and albedo 0.93, about the values that OPAC (Hess,
//! Koepke & Schult 1998) gives for continental aerosol: 0.70, and 0.89 where it is polluted.

use super::AtmosphereSettings;
use fog_core::bands::{BANDS, BandSpectrum};
use fog_core::math;

/// Bands, filled up to whole vectors.
pub(super) const WIDTH: usize = 24;
/// A value for each band; those behind the last repeat it.
pub(super) type Bands = [f32; WIDTH];

/// Radius of the ground in km.
pub(super) const GROUND_KM: f64 = 6371.0;
/// Altitude of the top of the air in km.
pub(super) const TOP_KM: f64 = 100.0;

/// Mean cosine of the aerosol's phase function.
pub(super) const AEROSOL_G: f32 = 0.7;
const AEROSOL_ALBEDO: f64 = 0.93;
const AEROSOL_SCALE_KM: f64 = 1.2;
const ANGSTROM_EXPONENT: f64 = 1.3;

/// Altitude in km and density in kg/m³ (US Standard Atmosphere 1976).
const DENSITY: [(f64, f64); 16] = [
    (0.0, 1.2250),
    (5.0, 0.736_43),
    (10.0, 0.413_51),
    (15.0, 0.194_76),
    (20.0, 0.088_910),
    (25.0, 0.040_084),
    (30.0, 0.018_410),
    (35.0, 0.008_463_4),
    (40.0, 0.003_995_7),
    (45.0, 0.001_966_3),
    (50.0, 0.001_026_9),
    (60.0, 3.0968e-4),
    (70.0, 8.2829e-5),
    (80.0, 1.8458e-5),
    (90.0, 3.416e-6),
    (100.0, 5.604e-7),
];

/// Ozone: bottom, peak and top of its triangle in km.
const OZONE_KM: [f64; 3] = [10.0, 25.0, 40.0];
/// Molecules per m² of one Dobson unit.
const DOBSON_1_M2: f64 = 2.687e20;

const SUN_OZONE: &str = include_str!("../../../../tables/sky/sun_ozone_10nm.csv");

/// Relative densities at one altitude: air over its density at sea level, aerosol the same, ozone over its peak.
#[derive(Clone, Copy, Debug)]
pub(super) struct Densities {
    pub(super) air: f32,
    pub(super) ozone: f32,
    pub(super) aerosol: f32,
}

/// Optical properties by band; coefficients in 1/km.
#[derive(Clone, Debug)]
pub(super) struct Air {
    /// Scattering of air at sea level.
    pub(super) rayleigh: Bands,
    /// Absorption of ozone at its peak.
    pub(super) ozone: Bands,
    /// Extinction of aerosol at sea level.
    pub(super) aerosol: Bands,
    /// Scattering of aerosol at sea level.
    pub(super) aerosol_scattering: Bands,
}

impl Air {
    pub(super) fn new(settings: &AtmosphereSettings) -> Self {
        // Column of air over its density at sea level, in km.
        let steps = 2000;
        let h = TOP_KM / f64::from(steps);
        let column: f64 = (0..steps).map(|i| relative_density((f64::from(i) + 0.5) * h) * h).sum();
        let per_nm = |f: &dyn Fn(f64) -> f64| bands(|nm| f(f64::from(nm)) as f32);
        let aerosol_depth =
            |nm: f64| settings.aerosol_optical_depth * math::f64::pow(nm / 550.0, -ANGSTROM_EXPONENT);
        let ozone_column = settings.ozone_du * DOBSON_1_M2;
        let cross_section = band_means(2);
        // Half of the triangle's width is the column over the peak, in km.
        let ozone_km = 0.5 * (OZONE_KM[2] - OZONE_KM[0]);
        Self {
            rayleigh: per_nm(&|nm| rayleigh_depth(nm) / column),
            ozone: padded(&BandSpectrum(cross_section.map(|c| (c * ozone_column / ozone_km) as f32))),
            aerosol: per_nm(&|nm| aerosol_depth(nm) / AEROSOL_SCALE_KM),
            aerosol_scattering: per_nm(&|nm| AEROSOL_ALBEDO * aerosol_depth(nm) / AEROSOL_SCALE_KM),
        }
    }
}

/// Relative densities at an altitude in km.
pub(super) fn densities(altitude_km: f64) -> Densities {
    let [bottom, peak, top] = OZONE_KM;
    let ozone = if altitude_km < peak {
        (altitude_km - bottom) / (peak - bottom)
    } else {
        (top - altitude_km) / (top - peak)
    };
    Densities {
        air: relative_density(altitude_km) as f32,
        ozone: ozone.max(0.0) as f32,
        aerosol: math::fast_exp((-altitude_km / AEROSOL_SCALE_KM) as f32),
    }
}

/// Density of air over that at sea level: exponential between the rows of [`DENSITY`].
fn relative_density(altitude_km: f64) -> f64 {
    let z = altitude_km.clamp(0.0, TOP_KM);
    let upper = DENSITY.partition_point(|row| row.0 <= z).clamp(1, DENSITY.len() - 1);
    let ((z0, d0), (z1, d1)) = (DENSITY[upper - 1], DENSITY[upper]);
    d0 / DENSITY[0].1 * math::f64::exp(math::f64::ln(d1 / d0) * (z - z0) / (z1 - z0))
}

/// Rayleigh optical depth of the whole air at sea level (Bodhaine et al. 1999, Eq. 30).
fn rayleigh_depth(nm: f64) -> f64 {
    let um2 = nm * nm * 1e-6;
    0.002_152 * (1.045_599_6 - 341.290_61 / um2 - 0.902_308_5 * um2)
        / (1.0 + 0.002_705_988_9 / um2 - 85.968_563 * um2)
}

/// The sun's irradiance outside the air by band, in W m⁻² nm⁻¹.
pub(super) fn solar_irradiance() -> [f64; BANDS] {
    band_means(1)
}

/// Means of a column of `tables/sky/sun_ozone_10nm.csv` over 20 nm around each band's centre.
fn band_means(column: usize) -> [f64; BANDS] {
    let rows: Vec<[f64; 3]> = SUN_OZONE
        .lines()
        .skip(1)
        .map(|line| {
            let mut cells = line.split(',').map(|cell| cell.parse().expect("embedded table is numeric"));
            core::array::from_fn(|_| cells.next().expect("three columns"))
        })
        .collect();
    core::array::from_fn(|band| {
        let centre = f64::from(BandSpectrum::centre_nm(band));
        let around = rows.iter().filter(|row| (row[0] - centre + 5.0).abs() < 7.0);
        let (sum, n) = around.fold((0.0, 0.0), |(sum, n), row| (sum + row[column], n + 1.0));
        sum / n
    })
}

/// Bands from a function of nm.
pub(super) fn bands(f: impl FnMut(f32) -> f32) -> Bands {
    padded(&BandSpectrum::from_fn(f))
}

fn padded(spectrum: &BandSpectrum) -> Bands {
    core::array::from_fn(|i| spectrum.0[i.min(BANDS - 1)])
}
