//! Measured droplet spectra: rows of a measurement, checked, and merged into one spectrum for each height and altitude.

use crate::advection::HEIGHT_RANGE_M;
use crate::error::OpticsError;

/// Largest diameter in µm that a bin may reach.
const DIAMETER_MAX_UM: f64 = 1000.0;
/// Largest sampled volume in m³ of one row.
const VOLUME_MAX_M3: f64 = 1000.0;
/// Largest measured value of a row, in any quantity; fog holds about 1e8 droplets per m³.
const VALUE_MAX: f64 = 1e15;

/// What the values of a measurement are; in a CSV text the name of the value's column says so.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    /// `count`: droplets counted in the bin, a whole number; needs the sampled volume.
    Count,
    /// `number_per_bin_1_m3`: droplets of the bin per m³ of air.
    NumberPerBin,
    /// `density_1_m3_um`: droplets per m³ of air and per µm of diameter, mean over the bin.
    Density,
}

impl Quantity {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Count, Self::NumberPerBin, Self::Density];

    /// Name of the column in a CSV text.
    #[must_use]
    pub const fn column(self) -> &'static str {
        match self {
            Self::Count => "count",
            Self::NumberPerBin => "number_per_bin_1_m3",
            Self::Density => "density_1_m3_um",
        }
    }
}

/// One row of a measurement.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Observation {
    /// Line of the file that it stands in, for messages.
    pub line: usize,
    /// Thickness of the fog layer at the time, in m.
    pub fog_height_m: f64,
    /// Altitude over the layer's base in m, 0 to the height.
    pub altitude_m: f64,
    /// Least diameter of the bin in µm.
    pub low_um: f64,
    /// Greatest diameter of the bin in µm.
    pub high_um: f64,
    /// The value, as the measurement's [`Quantity`] says.
    pub value: f64,
    /// Volume of air in m³ that was sampled for this value; `None` if it is not known.
    pub sample_volume_m3: Option<f64>,
}

/// A bin of a merged spectrum.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bin {
    /// Least diameter in µm.
    pub low_um: f64,
    /// Greatest diameter in µm.
    pub high_um: f64,
    /// Droplets: those that were counted, or that the sampled volume held; per m³ of air where no volume is known.
    pub droplets: f64,
    /// Volume of air in m³ that held them; 1 where none is known.
    pub volume_m3: f64,
    /// Line of the first row that it was made from.
    pub line: usize,
    /// Number of rows that were merged into it.
    pub rows: usize,
}

impl Bin {
    /// Mean density over the bin in m⁻³ µm⁻¹.
    #[must_use]
    pub fn density_1_m3_um(&self) -> f64 {
        self.droplets / self.volume_m3 / self.width_um()
    }

    /// Width in µm.
    #[must_use]
    pub fn width_um(&self) -> f64 {
        self.high_um - self.low_um
    }
}

/// Droplet spectrum of one altitude in fog of one height.
#[derive(Clone, Debug, PartialEq)]
pub struct Spectrum {
    /// Thickness of the fog layer in m.
    pub fog_height_m: f64,
    /// Altitude over the layer's base in m.
    pub altitude_m: f64,
    /// Bins by ascending diameter, not overlapping; there may be gaps between them.
    pub bins: Vec<Bin>,
}

impl Spectrum {
    /// Relative altitude ζ = z/H in [0, 1].
    #[must_use]
    pub fn zeta(&self) -> f64 {
        self.altitude_m / self.fog_height_m
    }

    /// Sum of the droplets over the bins.
    #[must_use]
    pub fn droplets(&self) -> f64 {
        self.bins.iter().map(|bin| bin.droplets).sum()
    }
}

/// Droplet spectra by fog height and altitude.
#[derive(Clone, Debug, PartialEq)]
pub struct Measurements {
    source: String,
    counting_noise_known: bool,
    spectra: Vec<Spectrum>,
}

impl Measurements {
    /// Checks rows and merges those of equal height, altitude and bin: counts and volumes are added; densities are
    /// averaged, weighted by their volumes where these are known. A bin without a row is a gap, not a zero.
    ///
    /// `source` names the file in messages. Heights must lie in [`HEIGHT_RANGE_M`], altitudes in 0 to the height, diameters
    /// in 0 to 1000 µm.
    ///
    /// # Errors
    /// [`OpticsError::Csv`] with line, column and value of the first row that makes no sense: numbers outside their ranges,
    /// a negative value, a count that is no whole number or has no volume, a bin that overlaps another one of its altitude.
    pub fn new(source: &str, quantity: Quantity, rows: &[Observation]) -> Result<Self, OpticsError> {
        let fault = |line: usize, (column, problem): (&str, String)| OpticsError::Csv {
            file: source.to_owned(),
            line,
            column: column.to_owned(),
            problem,
        };
        for row in rows {
            check_row(quantity, row).map_err(|why| fault(row.line, why))?;
        }
        let volumes = rows.iter().filter(|row| row.sample_volume_m3.is_some()).count();
        if volumes > 0 && volumes < rows.len() {
            let line = rows.iter().find(|row| row.sample_volume_m3.is_none()).map_or(1, |row| row.line);
            return Err(fault(
                line,
                ("sample_volume_m3", "found none; expected one in every row or in none".into()),
            ));
        }
        let spectra = merge(quantity, rows);
        for spectrum in &spectra {
            for pair in spectrum.bins.windows(2) {
                if pair[1].low_um < pair[0].high_um {
                    let problem = format!(
                        "found the bin {} to {} µm; expected no overlap with {} to {} µm of line {} (fog height {} m, altitude {} m)",
                        pair[1].low_um,
                        pair[1].high_um,
                        pair[0].low_um,
                        pair[0].high_um,
                        pair[0].line,
                        spectrum.fog_height_m,
                        spectrum.altitude_m
                    );
                    return Err(fault(pair[1].line, ("diameter_low_um", problem)));
                }
            }
        }
        Ok(Self { source: source.to_owned(), counting_noise_known: volumes > 0, spectra })
    }

    /// Name of the file or generator that they came from.
    #[must_use]
    pub fn source(&self) -> &str {
        &self.source
    }

    /// True if the sampled volumes are known, so that a droplet number has the counting noise √n.
    #[must_use]
    pub fn counting_noise_known(&self) -> bool {
        self.counting_noise_known
    }

    /// The spectra, by ascending height, then altitude.
    #[must_use]
    pub fn spectra(&self) -> &[Spectrum] {
        &self.spectra
    }

    /// The fog heights in m, ascending.
    #[must_use]
    pub fn heights_m(&self) -> Vec<f64> {
        let mut heights: Vec<f64> = self.spectra.iter().map(|s| s.fog_height_m).collect();
        heights.dedup();
        heights
    }
}

fn check_row(quantity: Quantity, row: &Observation) -> Result<(), (&'static str, String)> {
    let within = |column, value: f64, low: f64, high: f64, unit: &str| {
        if (low..=high).contains(&value) {
            return Ok(());
        }
        Err((column, format!("found {value}; expected {low} to {high}{unit}")))
    };
    within("fog_height_m", row.fog_height_m, HEIGHT_RANGE_M[0], HEIGHT_RANGE_M[1], " m")?;
    within("altitude_m", row.altitude_m, 0.0, row.fog_height_m, " m, the fog's height")?;
    within("diameter_low_um", row.low_um, 0.0, DIAMETER_MAX_UM, " µm")?;
    within("diameter_high_um", row.high_um, 0.0, DIAMETER_MAX_UM, " µm")?;
    if row.high_um <= row.low_um {
        return Err((
            "diameter_high_um",
            format!("found {}; expected more than diameter_low_um, {}", row.high_um, row.low_um),
        ));
    }
    within(quantity.column(), row.value, 0.0, VALUE_MAX, "")?;
    if quantity == Quantity::Count && row.value.fract() != 0.0 {
        let problem = format!(
            "found {}; expected a whole number of droplets (means belong into a column {} or {})",
            row.value,
            Quantity::NumberPerBin.column(),
            Quantity::Density.column()
        );
        return Err((quantity.column(), problem));
    }
    match row.sample_volume_m3 {
        Some(volume) if volume > 0.0 && volume <= VOLUME_MAX_M3 => Ok(()),
        Some(volume) => {
            Err(("sample_volume_m3", format!("found {volume}; expected above 0 to {VOLUME_MAX_M3} m³")))
        }
        None if quantity == Quantity::Count => Err((
            "sample_volume_m3",
            "found none; counts need the volume of air that they were taken from".into(),
        )),
        None => Ok(()),
    }
}

/// Spectra by height and altitude, rows of the same bin merged.
fn merge(quantity: Quantity, rows: &[Observation]) -> Vec<Spectrum> {
    let mut sorted: Vec<&Observation> = rows.iter().collect();
    let key = |row: &Observation| [row.fog_height_m, row.altitude_m, row.low_um, row.high_um];
    sorted.sort_by(|a, b| {
        let pairs = key(a).into_iter().zip(key(b));
        pairs.fold(std::cmp::Ordering::Equal, |order, (a, b)| order.then(a.total_cmp(&b)))
    });
    let mut spectra: Vec<Spectrum> = Vec::new();
    for row in sorted {
        let new = Bin {
            low_um: row.low_um,
            high_um: row.high_um,
            droplets: droplets(quantity, row),
            volume_m3: row.sample_volume_m3.unwrap_or(1.0),
            line: row.line,
            rows: 1,
        };
        let same_place = |s: &Spectrum| s.fog_height_m == row.fog_height_m && s.altitude_m == row.altitude_m;
        let Some(spectrum) = spectra.last_mut().filter(|s| same_place(s)) else {
            let (fog_height_m, altitude_m) = (row.fog_height_m, row.altitude_m);
            spectra.push(Spectrum { fog_height_m, altitude_m, bins: vec![new] });
            continue;
        };
        match spectrum.bins.last_mut().filter(|b| b.low_um == new.low_um && b.high_um == new.high_um) {
            Some(bin) => {
                bin.droplets += new.droplets;
                bin.volume_m3 += new.volume_m3;
                bin.line = bin.line.min(new.line);
                bin.rows += 1;
            }
            None => spectrum.bins.push(new),
        }
    }
    if rows.iter().all(|row| row.sample_volume_m3.is_none()) {
        // Each row stood for 1 m³: back to the mean per m³.
        for bin in spectra.iter_mut().flat_map(|s| &mut s.bins) {
            bin.droplets /= bin.volume_m3;
            bin.volume_m3 = 1.0;
        }
    }
    spectra
}

/// Droplets of a row in its sampled volume, or per m³.
fn droplets(quantity: Quantity, row: &Observation) -> f64 {
    let volume = row.sample_volume_m3.unwrap_or(1.0);
    match quantity {
        Quantity::Count => row.value,
        Quantity::NumberPerBin => row.value * volume,
        Quantity::Density => row.value * (row.high_um - row.low_um) * volume,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(line: usize, altitude_m: f64, low_um: f64, value: f64, volume: Option<f64>) -> Observation {
        Observation {
            line,
            fog_height_m: 100.0,
            altitude_m,
            low_um,
            high_um: low_um + 3.0,
            value,
            sample_volume_m3: volume,
        }
    }

    #[test]
    fn approaches_are_merged() {
        let v = Some(1e-4);
        let rows = [
            row(2, 50.0, 5.0, 10.0, v),
            row(3, 20.0, 2.0, 1.0, v),
            row(4, 50.0, 2.0, 7.0, v),
            row(5, 50.0, 5.0, 30.0, v),
        ];
        let counts = Measurements::new("a", Quantity::Count, &rows).unwrap();
        assert!(counts.counting_noise_known());
        let [low, high] = counts.spectra() else { panic!("{counts:?}") };
        assert_eq!((low.altitude_m, high.altitude_m, low.zeta()), (20.0, 50.0, 0.2));
        assert_eq!(high.bins.len(), 2);
        assert_eq!((high.bins[1].droplets, high.bins[1].volume_m3, high.bins[1].rows), (40.0, 2e-4, 2));
        assert!((high.bins[1].density_1_m3_um() - 40.0 / 2e-4 / 3.0).abs() < 1e-6);

        // Densities without volumes are averaged; with volumes, the mean is weighted by them.
        let mean = |volumes: [Option<f64>; 2]| {
            let rows = [row(2, 50.0, 5.0, 1e7, volumes[0]), row(3, 50.0, 5.0, 3e7, volumes[1])];
            let merged = Measurements::new("a", Quantity::Density, &rows).unwrap();
            merged.spectra()[0].bins[0].density_1_m3_um()
        };
        assert!((mean([None, None]) / 2e7 - 1.0).abs() < 1e-12);
        assert!((mean([Some(3e-4), Some(1e-4)]) / 1.5e7 - 1.0).abs() < 1e-12);
    }

    #[test]
    fn rows_that_make_no_sense_are_refused_with_their_place() {
        let good = row(7, 50.0, 5.0, 10.0, Some(1e-4));
        let message = |quantity, bad: Observation| {
            Measurements::new("f.csv", quantity, &[good, bad]).unwrap_err().to_string()
        };
        let refuse = |bad: Observation, column: &str, value: &str| {
            let text = message(Quantity::Count, bad);
            assert!(text.starts_with(&format!("f.csv:{}: column `{column}`", bad.line)), "{text}");
            assert!(text.contains(value), "{text}");
        };
        let bad = Observation { line: 8, low_um: 20.0, high_um: 23.0, ..good };
        refuse(Observation { fog_height_m: 0.0, ..bad }, "fog_height_m", "found 0; expected 1 to 2000 m");
        refuse(Observation { fog_height_m: 5000.0, ..bad }, "fog_height_m", "found 5000");
        refuse(Observation { fog_height_m: f64::NAN, ..bad }, "fog_height_m", "found NaN");
        refuse(Observation { altitude_m: 101.0, ..bad }, "altitude_m", "found 101; expected 0 to 100 m");
        refuse(Observation { altitude_m: -1.0, ..bad }, "altitude_m", "found -1");
        refuse(Observation { low_um: -2.0, ..bad }, "diameter_low_um", "found -2");
        refuse(Observation { high_um: 1001.0, ..bad }, "diameter_high_um", "found 1001");
        refuse(Observation { high_um: 20.0, ..bad }, "diameter_high_um", "more than diameter_low_um, 20");
        refuse(Observation { value: -3.0, ..bad }, "count", "found -3");
        refuse(Observation { value: f64::INFINITY, ..bad }, "count", "found inf");
        refuse(Observation { value: 2.5, ..bad }, "count", "found 2.5; expected a whole number");
        refuse(Observation { sample_volume_m3: Some(0.0), ..bad }, "sample_volume_m3", "found 0");
        refuse(Observation { sample_volume_m3: None, ..bad }, "sample_volume_m3", "counts need the volume");
        refuse(Observation { low_um: 6.0, high_um: 9.0, ..bad }, "diameter_low_um", "5 to 8 µm of line 7");
        let text = message(Quantity::Density, Observation { sample_volume_m3: None, ..bad });
        assert!(text.contains("f.csv:8") && text.contains("in every row or in none"), "{text}");
        let text = message(Quantity::NumberPerBin, Observation { value: -1.0, ..bad });
        assert!(text.contains("number_per_bin_1_m3"), "{text}");
    }
}
