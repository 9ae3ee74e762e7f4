//! Complex refractive index of liquid water by wavelength, with the source, temperature and uncertainty of each table.

use crate::error::{OpticsError, check_range};
use fog_core::math::f64::{exp, ln};
use num_complex::Complex64;

/// The table of Hale & Querry, Applied Optics 12, 555 (1973), 25 °C: CSV text `wavelength_nm,n,k`.
pub const HALE_QUERRY_1973: &str = include_str!("../../../tables/water/hale_querry_1973.csv");

/// The table of Segelstein, *The complex refractive index of water* (thesis, University of Missouri–Kansas City, 1981),
/// 25 °C: CSV text `wavelength_nm,n,k`.
pub const SEGELSTEIN_1981: &str = include_str!("../../../tables/water/segelstein_1981.csv");

/// Temperature in °C for which both sources give their values. They have no dependence on temperature: what a colder fog
/// changes is below [`N_UNCERTAINTY`] for n (dn/dT is about −1e-4 per K; Daimon & Masumura 2007), and moves the flanks of
/// the absorption bands above 900 nm by a few nm.
pub const TEMPERATURE_C: f64 = 25.0;

/// Temperatures in °C of liquid fog for which the tables are used: warm fog down to weakly supercooled droplets.
pub const TEMPERATURE_RANGE_C: [f64; 2] = [-5.0, 30.0];

/// First and last wavelength of every table, in nm.
pub const WAVELENGTH_RANGE_NM: [f64; 2] = [200.0, 2600.0];

/// Where [`Table::Joined`] changes from Hale & Querry to Segelstein's resolution, in nm.
pub const HAND_OVER_NM: f64 = 1000.0;

/// Absolute uncertainty of n of [`Table::Joined`] from 450 nm on: the largest difference there from the dispersion formulae
/// of Kedenburg et al. 2012 (20 °C, 500–1600 nm) and Daimon & Masumura 2007 (24 °C, 182–1129 nm), 0.0028, rounded up.
/// Towards the ultraviolet Hale & Querry fall behind: 0.004 too low at 400 nm, 0.010 at 300 nm.
pub const N_UNCERTAINTY: f64 = 0.003;

/// Relative uncertainty of k of [`Table::Joined`]: the root mean square difference from Wang et al. 2017 (22 °C,
/// 1200–1900 nm, steps of 2 nm) is 0.155. Most of it comes from the steep flanks near 1350 and 1870 nm, where the two are
/// a few nm apart (up to a factor of 1.8 there); elsewhere they agree to 0.16 and mostly to 0.1.
pub const K_UNCERTAINTY: f64 = 0.16;

/// Which measurements the refractive index comes from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Table {
    /// Hale & Querry up to [`HAND_OVER_NM`], Segelstein's bands beyond; continuous. The default.
    ///
    /// Beyond the hand-over, rows of Hale & Querry are 200 nm apart and miss the bands at 1200, 1450 and 1940 nm. There k
    /// is Segelstein's (from the first row after 1000 nm on; ln k is linear from Hale & Querry's value at 1000 nm to it).
    /// Segelstein's n is 0.005 to 0.012 below all other measurements, so n keeps the level of Hale & Querry: it is
    /// Segelstein's plus a correction that is linear between the rows of Hale & Querry and exact at them.
    #[default]
    Joined,
    /// Hale & Querry 1973: rows 25 nm apart up to 1000 nm, 200 nm apart beyond.
    HaleQuerry1973,
    /// Segelstein 1981: rows about 1 % of the wavelength apart throughout.
    Segelstein1981,
}

impl Table {
    /// Every table, by the name that [`Table::named`] knows.
    pub const NAMES: [(&'static str, Self); 3] = [
        ("joined", Self::Joined),
        ("hale_querry_1973", Self::HaleQuerry1973),
        ("segelstein_1981", Self::Segelstein1981),
    ];

    /// The table of that name, if there is one.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        Self::NAMES.iter().find(|(known, _)| *known == name).map(|(_, table)| *table)
    }

    /// Refractive index m = n + ik of liquid water (k ≥ 0 absorbs) at a vacuum wavelength in nm.
    ///
    /// Between rows n is linear in the wavelength and ln k is linear in the wavelength.
    ///
    /// # Errors
    /// If the wavelength is outside [`WAVELENGTH_RANGE_NM`].
    pub fn refractive_index(self, wavelength_nm: f64) -> Result<Complex64, OpticsError> {
        check_range("wavelength_nm", wavelength_nm, WAVELENGTH_RANGE_NM[0], WAVELENGTH_RANGE_NM[1])?;
        let (hale, segelstein) = (|| rows(HALE_QUERRY_1973), || rows(SEGELSTEIN_1981));
        Ok(match self {
            Self::HaleQuerry1973 => interpolate(hale(), wavelength_nm),
            Self::Segelstein1981 => interpolate(segelstein(), wavelength_nm),
            Self::Joined if wavelength_nm <= HAND_OVER_NM => interpolate(hale(), wavelength_nm),
            Self::Joined => {
                let last = hale().filter(|r| r[0] <= HAND_OVER_NM).last();
                let k_rows = last.into_iter().chain(segelstein().filter(|r| r[0] > HAND_OVER_NM));
                let n = |nm: f64| interpolate(segelstein(), nm).re;
                let correction = around(hale(), wavelength_nm).map(|r| [r[0], r[1] - n(r[0]), 1.0]);
                let corrected = n(wavelength_nm) + interpolate(correction.into_iter(), wavelength_nm).re;
                Complex64::new(corrected, interpolate(k_rows, wavelength_nm).im)
            }
        })
    }
}

/// Refractive index of [`Table::Joined`]: m = n + ik of liquid water at 25 °C (k ≥ 0 absorbs) at a wavelength in nm, 200
/// to 2600.
///
/// # Errors
/// If the wavelength is outside [`WAVELENGTH_RANGE_NM`].
pub fn refractive_index(wavelength_nm: f64) -> Result<Complex64, OpticsError> {
    Table::Joined.refractive_index(wavelength_nm)
}

/// Rows (wavelength in nm, n, k), ascending.
fn rows(text: &str) -> impl Iterator<Item = [f64; 3]> {
    text.lines().skip(1).filter_map(|line| {
        let mut cells = line.split(',').map(str::parse::<f64>);
        Some([cells.next()?.ok()?, cells.next()?.ok()?, cells.next()?.ok()?])
    })
}

/// The row at or below a wavelength within the rows, and the one above it (the last row stands for both at the end).
fn around(rows: impl Iterator<Item = [f64; 3]>, wavelength_nm: f64) -> [[f64; 3]; 2] {
    let mut below = [0.0, 1.0, 1.0];
    for row in rows {
        if row[0] > wavelength_nm {
            return [below, row];
        }
        below = row;
    }
    [below, below]
}

/// n linear and ln k linear between the rows; the last row beyond them.
fn interpolate(rows: impl Iterator<Item = [f64; 3]>, wavelength_nm: f64) -> Complex64 {
    let [below, above] = around(rows, wavelength_nm);
    if wavelength_nm <= below[0] || below[0] == above[0] {
        return Complex64::new(below[1], below[2]);
    }
    let t = (wavelength_nm - below[0]) / (above[0] - below[0]);
    let n = below[1] + t * (above[1] - below[1]);
    let log_k = ln(below[2]) + t * (ln(above[2]) - ln(below[2]));
    Complex64::new(n, exp(log_k))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_line_is_a_row_and_rows_ascend() {
        for (text, count) in [(HALE_QUERRY_1973, 41), (SEGELSTEIN_1981, 323)] {
            let all: Vec<_> = rows(text).collect();
            assert_eq!(all.len(), text.lines().count() - 1);
            assert_eq!(all.len(), count);
            assert!(all[0][0] <= WAVELENGTH_RANGE_NM[0] && all[count - 1][0] >= WAVELENGTH_RANGE_NM[1]);
            assert!(all.windows(2).all(|w| w[0][0] < w[1][0]));
            assert!(all.iter().all(|r| r[1] > 1.2 && r[1] < 1.5 && r[2] > 0.0));
        }
    }

    #[test]
    fn rows_are_met_and_halfway_is_between() {
        assert_eq!(refractive_index(550.0).unwrap(), Complex64::new(1.333, 1.96e-9));
        assert_eq!(refractive_index(200.0).unwrap(), Complex64::new(1.396, 1.1e-7));
        let coarse = Table::HaleQuerry1973.refractive_index(2600.0).unwrap();
        assert_eq!(coarse, Complex64::new(1.242, 3.17e-3));
        let fine = Table::Segelstein1981.refractive_index(1548.8166).unwrap();
        assert_eq!(fine, Complex64::new(1.310923, 1.3483112e-4));
        let m = refractive_index(537.5).unwrap();
        assert!((m.re - 1.3335).abs() < 1e-12);
        assert!((m.im / (1.32e-9f64 * 1.96e-9).sqrt() - 1.0).abs() < 1e-12);
    }

    #[test]
    fn the_hand_over_is_continuous_and_keeps_what_is_below() {
        for step in 0..=800 {
            let nm = 200.0 + f64::from(step);
            let (joined, hale) = (refractive_index(nm), Table::HaleQuerry1973.refractive_index(nm));
            assert_eq!(joined, hale, "{nm}");
        }
        let (below, above) = (refractive_index(1000.0).unwrap(), refractive_index(1000.0 + 1e-6).unwrap());
        assert!((below.re - above.re).abs() < 1e-8 && (above.im / below.im - 1.0).abs() < 1e-7);
        // No jump anywhere: 1 nm changes n by less than 6e-4 (at 2600 nm) and k by less than 15 % (flank at 1130 nm).
        for step in 0..1600 {
            let nm = 1000.0 + f64::from(step);
            let (a, b) = (refractive_index(nm).unwrap(), refractive_index(nm + 1.0).unwrap());
            assert!((a.re - b.re).abs() < 6e-4 && ln(a.im / b.im).abs() < 0.15, "{nm}: {a} {b}");
        }
    }

    #[test]
    fn beyond_the_hand_over_n_meets_hale_and_querry_and_k_has_the_bands() {
        for row in rows(HALE_QUERRY_1973).filter(|r| r[0] > HAND_OVER_NM) {
            assert!((refractive_index(row[0]).unwrap().re - row[1]).abs() < 1e-12, "{}", row[0]);
        }
        // The maxima of absorption near 1450 and 1930 nm, which rows 200 nm apart do not show.
        let k = |nm: f64| refractive_index(nm).unwrap().im;
        for (peak, left, right) in [(1449.0, 1300.0, 1650.0), (1932.0, 1800.0, 2200.0)] {
            assert!(k(peak) > 3.0 * k(left) && k(peak) > 3.0 * k(right), "{peak}");
            let coarse = Table::HaleQuerry1973.refractive_index(peak).unwrap().im;
            assert!(k(peak) > 1.7 * coarse, "{peak}: {} {coarse}", k(peak));
        }
    }

    #[test]
    fn independent_measurements_agree_within_the_stated_uncertainty() {
        // Sellmeier fits n² = 1 + Σ B λ²/(λ² − C), λ in µm: Kedenburg et al. 2012 (20 °C), Daimon & Masumura 2007 (24 °C).
        let kedenburg: &[[f64; 2]] = &[[0.75831, 0.01007], [0.08495, 8.91377]];
        let daimon: &[[f64; 2]] = &[
            [5.666959820e-1, 5.084151894e-3],
            [1.731900098e-1, 1.818488474e-2],
            [2.095951857e-2, 2.625439472e-2],
            [1.125228406e-1, 1.073842352e1],
        ];
        let mut worst = 0.0f64;
        for (terms, from, to) in [(kedenburg, 500, 1600), (daimon, 450, 1129)] {
            for nm in from..=to {
                let l2 = f64::from(nm * nm) * 1e-6;
                let n = (1.0 + terms.iter().map(|[b, c]| b * l2 / (l2 - c)).sum::<f64>()).sqrt();
                worst = worst.max((refractive_index(f64::from(nm)).unwrap().re - n).abs());
            }
        }
        assert!(worst < N_UNCERTAINTY && worst > 0.8 * N_UNCERTAINTY, "{worst}");
        // k of Wang et al. 2017 (22 °C), every 50 nm but the two flanks, and the lidar wavelength.
        for (nm, k) in [
            (1200.0, 1.21924e-5),
            (1250.0, 1.11683e-5),
            (1300.0, 1.36126e-5),
            (1400.0, 1.70012e-4),
            (1450.0, 3.61322e-4),
            (1500.0, 2.59105e-4),
            (1550.0, 1.45780e-4),
            (1600.0, 9.80207e-5),
            (1650.0, 8.01967e-5),
            (1700.0, 7.83606e-5),
            (1750.0, 1.01252e-4),
            (1800.0, 1.29881e-4),
            (1900.0, 1.28449e-3),
        ] {
            let off = refractive_index(nm).unwrap().im / k - 1.0;
            assert!(off.abs() < K_UNCERTAINTY, "{nm}: {off}");
        }
    }

    #[test]
    fn names_find_their_tables() {
        assert_eq!(Table::named("segelstein_1981"), Some(Table::Segelstein1981));
        assert_eq!(Table::named("segelstein"), None);
        assert_eq!(Table::default(), Table::Joined);
    }

    #[test]
    fn outside_the_table_is_an_error() {
        for bad in [199.9, 2600.1, f64::NAN, -550.0, f64::INFINITY] {
            for (_, table) in Table::NAMES {
                let error = table.refractive_index(bad).unwrap_err();
                assert!(error.to_string().contains("200 to 2600"), "{error}");
            }
        }
    }
}
