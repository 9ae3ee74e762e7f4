//! Complex refractive index of liquid water by wavelength.

use crate::error::{OpticsError, check_range};
use fog_core::math::f64::{exp, ln};
use num_complex::Complex64;

/// The table of Hale & Querry, Applied Optics 12, 555 (1973), 25 °C: CSV text `wavelength_nm,n,k`.
pub const HALE_QUERRY_1973: &str = include_str!("../../../tables/water/hale_querry_1973.csv");

/// Temperature at which [`HALE_QUERRY_1973`] was measured, in °C.
pub const TEMPERATURE_C: f64 = 25.0;

/// First and last wavelength of the table, in nm.
pub const WAVELENGTH_RANGE_NM: [f64; 2] = [200.0, 2600.0];

/// Rows (wavelength in nm, n, k), ascending.
fn rows() -> impl Iterator<Item = [f64; 3]> {
    HALE_QUERRY_1973.lines().skip(1).filter_map(|line| {
        let mut cells = line.split(',').map(str::parse::<f64>);
        Some([cells.next()?.ok()?, cells.next()?.ok()?, cells.next()?.ok()?])
    })
}

/// Refractive index m = n + ik of liquid water at 25 °C (k ≥ 0 absorbs) at a wavelength in nm, 200 to 2600.
///
/// Source: Hale & Querry 1973, rows 25 nm apart up to 1000 nm and 200 nm apart above. Between rows n is linear in the
/// wavelength and ln k is linear in the wavelength.
///
/// # Errors
/// If the wavelength is outside [`WAVELENGTH_RANGE_NM`].
pub fn refractive_index(wavelength_nm: f64) -> Result<Complex64, OpticsError> {
    check_range("wavelength_nm", wavelength_nm, WAVELENGTH_RANGE_NM[0], WAVELENGTH_RANGE_NM[1])?;
    let mut below = [0.0; 3];
    for row in rows() {
        if row[0] == wavelength_nm {
            return Ok(Complex64::new(row[1], row[2]));
        }
        if row[0] > wavelength_nm {
            let t = (wavelength_nm - below[0]) / (row[0] - below[0]);
            let n = below[1] + t * (row[1] - below[1]);
            let log_k = ln(below[2]) + t * (ln(row[2]) - ln(below[2]));
            return Ok(Complex64::new(n, exp(log_k)));
        }
        below = row;
    }
    Ok(Complex64::new(below[1], below[2]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_line_is_a_row_and_rows_ascend() {
        let all: Vec<_> = rows().collect();
        assert_eq!(all.len(), HALE_QUERRY_1973.lines().count() - 1);
        assert_eq!([all[0][0], all[all.len() - 1][0]], WAVELENGTH_RANGE_NM);
        assert!(all.windows(2).all(|w| w[0][0] < w[1][0]));
        assert!(all.iter().all(|r| r[1] > 1.2 && r[1] < 1.4 && r[2] > 0.0));
    }

    #[test]
    fn rows_are_met_and_halfway_is_between() {
        assert_eq!(refractive_index(550.0).unwrap(), Complex64::new(1.333, 1.96e-9));
        assert_eq!(refractive_index(200.0).unwrap(), Complex64::new(1.396, 1.1e-7));
        assert_eq!(refractive_index(2600.0).unwrap(), Complex64::new(1.242, 3.17e-3));
        let m = refractive_index(537.5).unwrap();
        assert!((m.re - 1.3335).abs() < 1e-12);
        assert!((m.im / (1.32e-9f64 * 1.96e-9).sqrt() - 1.0).abs() < 1e-12);
    }

    #[test]
    fn outside_the_table_is_an_error() {
        for bad in [199.9, 2600.1, f64::NAN, -550.0, f64::INFINITY] {
            let error = refractive_index(bad).unwrap_err();
            assert!(error.to_string().contains("200 to 2600"), "{error}");
        }
    }
}
