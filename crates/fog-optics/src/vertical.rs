//! Number of droplets by relative altitude, for any spectrum.
//!
//! A profile is relative: its mean over altitude is 1. "Number density" of a fog is therefore the mean over its layer,
//! and the number at a relative altitude ζ = z/H is that mean times [`VerticalProfile::at`].

use crate::advection::{AdvectionModel, polynomial};
use crate::csv::CsvTable;
use crate::error::{OpticsError, check_range};
use fog_core::math::f64::pow;

/// Altitudes that a layer is made of: enough for 1e-5 of σ_t in advection fog with linear interpolation.
pub(crate) const NODES: usize = 1025;

/// Exponents of the profile that thins.
const EXPONENT: [f64; 2] = [0.1, 10.0];
/// Greatest value of a row.
const MAX_ROW: f64 = 1e30;

/// Relative number density by relative altitude ζ in [0, 1], with mean 1.
#[derive(Clone, Debug, PartialEq)]
pub struct VerticalProfile {
    shape: Shape,
    /// Mean of the shape over ζ.
    mean: f64,
}

#[derive(Clone, Debug, PartialEq)]
enum Shape {
    Uniform,
    /// (1 − ζ)^p.
    Thinning(f64),
    /// (ζ, value), linear between.
    Rows(Vec<(f64, f64)>),
    /// c0, c1, … of a polynomial in ζ; 0 where it is negative.
    Polynomial(Vec<f64>),
}

impl VerticalProfile {
    /// The same number at every altitude: Shettle & Fenn's and most fogs of the literature.
    #[must_use]
    pub fn uniform() -> Self {
        Self { shape: Shape::Uniform, mean: 1.0 }
    }

    /// A fog that is densest at the ground and thins to nothing at its top, n ∝ (1 − ζ)^p with the exponent p in 0.1 to 10:
    /// a shallow radiation fog. In thin fog under stable air the water content is greatest at the ground and falls with
    /// height (Costabloz et al. 2025, *Atmos. Chem. Phys.* 25, 6539: "reverse trend"); it is there compared with a column in
    /// which water is linear in height, which p = 1 is for droplets of one spectrum. Other exponents are this library's own
    /// generalisation.
    ///
    /// # Errors
    /// If the exponent is out of range.
    pub fn thinning(exponent: f64) -> Result<Self, OpticsError> {
        check_range("thinning exponent", exponent, EXPONENT[0], EXPONENT[1])?;
        Self::from_shape(Shape::Thinning(exponent))
    }

    /// A profile from rows (ζ, number density in any unit): linear between rows, 0 below the first and above the last.
    ///
    /// # Errors
    /// If there are fewer than two rows, ζ does not ascend within 0 to 1, or a value is negative, not finite, or all are 0.
    pub fn rows(rows: &[(f64, f64)]) -> Result<Self, OpticsError> {
        check_range("number of rows of a vertical profile", rows.len() as f64, 2.0, 1e6)?;
        for (i, &(zeta, value)) in rows.iter().enumerate() {
            check_range("relative altitude of a vertical profile", zeta, 0.0, 1.0)?;
            check_range("number density in a vertical profile", value, 0.0, MAX_ROW)?;
            if i > 0 && zeta <= rows[i - 1].0 {
                return Err(OpticsError::Range {
                    what: "relative altitude of a vertical profile",
                    value: zeta,
                    valid: format!("more than that of the row before, {}", rows[i - 1].0),
                });
            }
        }
        Self::from_shape(Shape::Rows(rows.to_vec()))
    }

    /// A profile from CSV text with the header `relative_altitude,relative_number_density`; rows as in
    /// [`VerticalProfile::rows`]. `file_name` is used in messages alone.
    ///
    /// # Errors
    /// [`OpticsError::Csv`] with file, line, column and value.
    pub fn from_csv(text: &str, file_name: &str) -> Result<Self, OpticsError> {
        let table = CsvTable::read(text, file_name, &[&["relative_altitude", "relative_number_density"]])?;
        table.need_range(0, [0.0, 1.0], "")?;
        table.need_ascending(0)?;
        table.need_range(1, [0.0, MAX_ROW], "")?;
        table.need_rows(2)?;
        let rows: Vec<(f64, f64)> = table.rows.iter().map(|row| (row.cells[0], row.cells[1])).collect();
        if rows.iter().all(|row| row.1 == 0.0) {
            return Err(table.fault(table.rows[0].line, 1, "all rows are 0; expected some droplets"));
        }
        Self::rows(&rows)
    }

    /// The scaling matrix of an advection model (Sec. 4.3) at one fog height in m, and the mean number density in 1/m³ that
    /// was divided out.
    ///
    /// # Errors
    /// If the height is outside [`crate::advection::HEIGHT_RANGE_M`], or the model has no droplets there.
    pub fn advection(model: &AdvectionModel, height_m: f64) -> Result<(Self, f64), OpticsError> {
        model.check_height(height_m)?;
        let profile = Self::from_shape(Shape::Polynomial(model.number_polynomial(height_m)))?;
        let mean = profile.mean;
        Ok((profile, mean))
    }

    /// Relative number density at relative altitude ζ; 0 outside of 0 to 1.
    #[must_use]
    pub fn at(&self, zeta: f64) -> f64 {
        self.shape.at(zeta) / self.mean
    }

    fn from_shape(shape: Shape) -> Result<Self, OpticsError> {
        // The mean of what a layer is made of, so that mean number density and mean extinction belong together exactly.
        let last = NODES - 1;
        let sum: f64 = (0..=last)
            .map(|i| {
                let weight = if i == 0 || i == last { 0.5 } else { 1.0 };
                weight * shape.at(i as f64 / last as f64)
            })
            .sum();
        let mean = sum / last as f64;
        if mean > 0.0 && mean.is_finite() {
            return Ok(Self { shape, mean });
        }
        let valid = "above 0 (the profile has no droplets at any altitude)".to_owned();
        Err(OpticsError::Range { what: "mean of a vertical profile", value: mean, valid })
    }
}

impl Shape {
    fn at(&self, zeta: f64) -> f64 {
        if !(0.0..=1.0).contains(&zeta) {
            return 0.0;
        }
        match self {
            Self::Uniform => 1.0,
            Self::Thinning(exponent) => pow(1.0 - zeta, *exponent),
            Self::Rows(rows) => {
                let (first, last) = (rows[0].0, rows[rows.len() - 1].0);
                if !(first..=last).contains(&zeta) {
                    return 0.0;
                }
                let i = rows.partition_point(|row| row.0 <= zeta).clamp(1, rows.len() - 1);
                let ((z0, n0), (z1, n1)) = (rows[i - 1], rows[i]);
                n0 + (n1 - n0) * ((zeta - z0) / (z1 - z0))
            }
            Self::Polynomial(c) => polynomial(c, zeta).max(0.0),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn mean(profile: &VerticalProfile) -> f64 {
        let n = 1 << 16;
        (0..n).map(|i| profile.at((f64::from(i) + 0.5) / f64::from(n))).sum::<f64>() / f64::from(n)
    }

    #[test]
    fn every_profile_has_mean_one_and_ends_at_its_layer() {
        let model = AdvectionModel::arcata().unwrap();
        for profile in [
            VerticalProfile::uniform(),
            VerticalProfile::thinning(1.0).unwrap(),
            VerticalProfile::thinning(3.0).unwrap(),
            VerticalProfile::rows(&[(0.0, 3.0), (0.25, 9.0), (1.0, 0.0)]).unwrap(),
            VerticalProfile::advection(&model, 180.0).unwrap().0,
        ] {
            assert!((mean(&profile) - 1.0).abs() < 1e-5, "{profile:?}: {}", mean(&profile));
            for outside in [-1e-9, 1.0 + 1e-9, f64::NAN] {
                assert_eq!(profile.at(outside), 0.0);
            }
        }
    }

    #[test]
    fn thinning_is_densest_at_the_ground() {
        let profile = VerticalProfile::thinning(2.0).unwrap();
        assert!((profile.at(0.0) - 3.0).abs() < 1e-5 && profile.at(1.0) == 0.0);
        assert!((0..100).all(|i| profile.at(f64::from(i) / 100.0) > profile.at(f64::from(i + 1) / 100.0)));
        for bad in [0.0, -1.0, 11.0, f64::NAN] {
            assert!(VerticalProfile::thinning(bad).is_err(), "{bad}");
        }
    }

    #[test]
    fn the_advection_models_numbers_come_back() {
        let model = AdvectionModel::arcata().unwrap();
        for height in [50.0, 100.0, 260.0] {
            let (profile, mean) = VerticalProfile::advection(&model, height).unwrap();
            for zeta in [0.0, 0.1, 0.5, 0.77, 1.0] {
                let n = mean * profile.at(zeta);
                assert!((n / model.number_density_1_m3(zeta, height) - 1.0).abs() < 1e-13, "{height} {zeta}");
            }
        }
        for bad in [0.0, -10.0, 5000.0, f64::NAN] {
            assert!(VerticalProfile::advection(&model, bad).is_err(), "{bad}");
        }
    }

    #[test]
    fn wrong_rows_are_refused() {
        for (rows, word) in [
            (vec![(0.0, 1.0)], "number of rows"),
            (vec![(0.0, 1.0), (1.5, 1.0)], "relative altitude of a vertical profile is 1.5"),
            (vec![(0.5, 1.0), (0.2, 1.0)], "more than that of the row before, 0.5"),
            (vec![(0.0, 1.0), (1.0, -1.0)], "is -1"),
            (vec![(0.0, 0.0), (1.0, 0.0)], "no droplets"),
        ] {
            let message = VerticalProfile::rows(&rows).unwrap_err().to_string();
            assert!(message.contains(word), "{message}");
        }
        let head = "relative_altitude,relative_number_density\n";
        let read = |rows: &str| VerticalProfile::from_csv(&format!("{head}{rows}"), "v.csv");
        assert_eq!(read("0,2\n1, 0\n").unwrap(), VerticalProfile::rows(&[(0.0, 2.0), (1.0, 0.0)]).unwrap());
        for (rows, place) in [
            ("0,1\n1,thin\n", "v.csv:3: column `relative_number_density`: found `thin`"),
            ("0,1\n7,1\n", "v.csv:3: column `relative_altitude`: found 7; expected 0 to 1"),
            ("0,0\n1,0\n", "v.csv:2: column `relative_number_density`: all rows are 0"),
        ] {
            let message = read(rows).unwrap_err().to_string();
            assert!(message.starts_with(place), "{message}");
        }
    }
}
