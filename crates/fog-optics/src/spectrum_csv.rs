//! A measured droplet spectrum from CSV text. The header says what the numbers are; nothing is guessed.

use crate::csv::CsvTable;
use crate::error::OpticsError;
use crate::size::SizeDistribution;

/// Least and greatest diameter in µm.
const DIAMETER_UM: [f64; 2] = [1e-3, 5e3];
/// Greatest density or count of a row, in any of the units.
const MAX_NUMBER: f64 = 1e30;

/// What the second column of a density, or the third of counts, is given in: factor to 1/m³ if it is absolute.
const HEADERS: [(&[&str], Option<f64>); 6] = [
    (&["diameter_um", "density_1_um"], None),
    (&["diameter_um", "density_1_m3_um"], Some(1.0)),
    (&["diameter_um", "density_1_cm3_um"], Some(1e6)),
    (&["lower_um", "upper_um", "count"], None),
    (&["lower_um", "upper_um", "number_1_m3"], Some(1.0)),
    (&["lower_um", "upper_um", "number_1_cm3"], Some(1e6)),
];

/// A spectrum that was read.
#[derive(Clone, Debug, PartialEq)]
pub struct MeasuredSpectrum {
    /// Its shape.
    pub distribution: SizeDistribution,
    /// Number of droplets per m³, if the file gives numbers per volume.
    pub number_density_1_m3: Option<f64>,
}

/// Reads a spectrum from CSV text with one of these headers, diameters in µm ascending within 0.001 to 5000:
///
/// | header | a row is |
/// |---|---|
/// | `diameter_um,density_1_um` | density at a diameter, in droplets per µm up to a factor |
/// | `diameter_um,density_1_m3_um` | density in m⁻³ µm⁻¹ |
/// | `diameter_um,density_1_cm3_um` | density in cm⁻³ µm⁻¹ |
/// | `lower_um,upper_um,count` | number of droplets counted in a bin, not divided by its width |
/// | `lower_um,upper_um,number_1_m3` | droplets per m³ in a bin |
/// | `lower_um,upper_um,number_1_cm3` | droplets per cm³ in a bin |
///
/// Densities are linear between rows and 0 outside; bins are even inside, may leave gaps (no droplets) and must not
/// overlap. `file_name` is used in messages alone.
///
/// # Errors
/// [`OpticsError::Csv`] with file, line, column and value for another header, a cell that is no finite number or out of
/// range, diameters that do not ascend, too few rows, or a spectrum without droplets.
pub fn parse_spectrum(text: &str, file_name: &str) -> Result<MeasuredSpectrum, OpticsError> {
    let headers = HEADERS.map(|(header, _)| header);
    let table = CsvTable::read(text, file_name, &headers)?;
    let per_m3 = HEADERS.iter().find(|(header, _)| *header == table.header).and_then(|(_, factor)| *factor);
    let value = table.header.len() - 1;
    table.need_range(value, [0.0, MAX_NUMBER], "")?;
    for column in 0..value {
        table.need_range(column, DIAMETER_UM, " µm")?;
    }
    let (distribution, number) =
        if table.header[0] == "diameter_um" { by_density(&table)? } else { by_bins(&table)? };
    Ok(MeasuredSpectrum { distribution, number_density_1_m3: per_m3.map(|factor| factor * number) })
}

/// The spectrum and its integral in the file's unit.
fn by_density(table: &CsvTable<'_>) -> Result<(SizeDistribution, f64), OpticsError> {
    table.need_ascending(0)?;
    table.need_rows(2)?;
    let rows: Vec<(f64, f64)> = table.rows.iter().map(|row| (row.cells[0], row.cells[1])).collect();
    let number = rows.windows(2).map(|w| 0.5 * (w[0].1 + w[1].1) * (w[1].0 - w[0].0)).sum();
    need_droplets(table, number)?;
    Ok((SizeDistribution::tabulated(&rows)?, number))
}

fn by_bins(table: &CsvTable<'_>) -> Result<(SizeDistribution, f64), OpticsError> {
    table.need_rows(1)?;
    let (mut edges, mut counts) = (vec![table.rows[0].cells[0]], Vec::new());
    let mut below = edges[0];
    for row in &table.rows {
        let [lower, upper, count] = [row.cells[0], row.cells[1], row.cells[2]];
        if lower < below {
            let problem = format!("found {lower}; expected at least {below}, where the bin before ends");
            return Err(table.fault(row.line, 0, problem));
        }
        if upper <= lower {
            let problem = format!("found {upper}; expected more than the bin's lower_um, {lower}");
            return Err(table.fault(row.line, 1, problem));
        }
        if lower > below {
            edges.push(lower);
            counts.push(0.0);
        }
        edges.push(upper);
        counts.push(count);
        below = upper;
    }
    let number = counts.iter().sum();
    need_droplets(table, number)?;
    Ok((SizeDistribution::binned(&edges, &counts)?, number))
}

fn need_droplets(table: &CsvTable<'_>, number: f64) -> Result<(), OpticsError> {
    if number > 0.0 {
        return Ok(());
    }
    let value = table.header.len() - 1;
    Err(table.fault(table.rows[0].line, value, "all rows are 0; expected some droplets"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn densities_and_bins_of_one_spectrum_agree() {
        let density = "diameter_um,density_1_cm3_um\n2,0\n4, 10\n8,10\r\n\n12,0\n";
        let spectrum = parse_spectrum(density, "d.csv").unwrap();
        assert!((spectrum.number_density_1_m3.unwrap() / 7e7 - 1.0).abs() < 1e-12);
        assert!((spectrum.distribution.density_1_um(6.0) - 10.0 / 70.0).abs() < 1e-4);

        let mut bins = String::from("\u{feff}lower_um,upper_um,number_1_m3\n");
        for i in 0..100 {
            let (lower, upper) = (2.0 + 0.1 * f64::from(i), 2.0 + 0.1 * f64::from(i + 1));
            let middle = 0.5 * (lower + upper);
            let density = 1e7 * (0.5 * (middle - 2.0)).min(0.25 * (12.0 - middle)).min(1.0);
            bins.push_str(&format!("{lower},{upper},{}\n", 0.1 * density));
        }
        let binned = parse_spectrum(&bins, "b.csv").unwrap();
        assert!((binned.number_density_1_m3.unwrap() / 7e7 - 1.0).abs() < 1e-6);
        let (a, b) = (spectrum.distribution.moments(), binned.distribution.moments());
        assert!((a.effective_radius_um / b.effective_radius_um - 1.0).abs() < 1e-3, "{a:?} {b:?}");
        assert!((a.mass_g / b.mass_g - 1.0).abs() < 2e-3, "{a:?} {b:?}");

        let counts = "lower_um,upper_um,count\n2,5,30\n8,10,10\n";
        let spectrum = parse_spectrum(counts, "c.csv").unwrap();
        assert_eq!((spectrum.number_density_1_m3, spectrum.distribution.density_1_um(6.5)), (None, 0.0));
        assert!((spectrum.distribution.density_1_um(3.0) - 0.25).abs() < 1e-2);
    }

    #[test]
    fn every_mistake_has_file_line_column_and_value() {
        let (density, bins) = ("diameter_um,density_1_um\n", "lower_um,upper_um,count\n");
        for (text, place, words) in [
            (String::new(), "f.csv:1: column `diameter_um`", "or `lower_um,upper_um,count`"),
            ("d,n\n1,2\n".into(), "f.csv:1: column `diameter_um`", "`d,n`"),
            (format!("{density}1,0\n5,many\n"), "f.csv:3: column `density_1_um`", "`many`"),
            (format!("{density}big,0\n"), "f.csv:2: column `diameter_um`", "`big`"),
            (format!("{density}5,1\n1,1\n"), "f.csv:3: column `diameter_um`", "found 1;"),
            (format!("{density}0,1\n5,1\n"), "f.csv:2: column `diameter_um`", "0.001 to 5000 µm"),
            (format!("{density}1,1\n5,-2\n"), "f.csv:3: column `density_1_um`", "found -2"),
            (format!("{density}1,1\n"), "f.csv:2: column `diameter_um`", "1 rows"),
            (format!("{density}1,0\n5,0\n"), "f.csv:2: column `density_1_um`", "some droplets"),
            (format!("{bins}2,5\n"), "f.csv:2: column `count`", "2 cells"),
            (format!("{bins}5,2,9\n"), "f.csv:2: column `upper_um`", "found 2"),
            (format!("{bins}2,5,9\n4,6,9\n"), "f.csv:3: column `lower_um`", "at least 5"),
            (format!("{bins}2,5,9\n6,inf,9\n"), "f.csv:3: column `upper_um`", "`inf`"),
            (bins.into(), "f.csv:1: column `lower_um`", "0 rows"),
        ] {
            let message = parse_spectrum(&text, "f.csv").unwrap_err().to_string();
            assert!(message.contains(place) && message.contains(words), "{message}");
        }
    }
}
