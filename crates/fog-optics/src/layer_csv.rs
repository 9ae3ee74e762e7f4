//! Extinction by altitude from CSV text.

use crate::csv::CsvTable;
use crate::error::OpticsError;

/// Rows (altitude in m, σ_t in 1/m) of a CSV text with the header `altitude_m,sigma_t_1_m`, altitudes ascending.
///
/// `file_name` is used in messages alone. A byte-order mark, spaces around cells, CRLF and empty lines are accepted.
///
/// # Errors
/// [`OpticsError::Csv`] with file, line, column and value if the header differs, a cell is no finite number, an altitude
/// is not above the one before it, σ_t is outside 0 to 1e6 1/m, or there are fewer than two rows.
pub fn parse_layers(text: &str, file_name: &str) -> Result<Vec<(f64, f64)>, OpticsError> {
    let table = CsvTable::read(text, file_name, &[&["altitude_m", "sigma_t_1_m"]])?;
    table.need_ascending(0)?;
    table.need_range(1, [0.0, 1e6], " 1/m")?;
    table.need_rows(2)?;
    Ok(table.rows.iter().map(|row| (row.cells[0], row.cells[1])).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn good_text_is_read() {
        let rows =
            parse_layers("\u{feff}altitude_m, sigma_t_1_m\r\n0,0.01\r\n\r\n 10 , 2e-2\r\n", "a.csv").unwrap();
        assert_eq!(rows, [(0.0, 0.01), (10.0, 0.02)]);
    }

    #[test]
    fn every_mistake_has_file_line_column_and_value() {
        let head = "altitude_m,sigma_t_1_m\n";
        for (text, place, value) in [
            (String::new(), "f.csv:1: column `altitude_m`", "``"),
            ("z,sigma\n0,1\n".into(), "f.csv:1: column `altitude_m`", "`z,sigma`"),
            (format!("{head}0,0.1\n5,thick\n"), "f.csv:3: column `sigma_t_1_m`", "`thick`"),
            (format!("{head}0,0.1\nx,0.1\n"), "f.csv:3: column `altitude_m`", "`x`"),
            (format!("{head}0,0.1\n5,\n"), "f.csv:3: column `sigma_t_1_m`", "``"),
            (format!("{head}0,0.1\n5\n"), "f.csv:3: column `sigma_t_1_m`", "1 cells"),
            (format!("{head}0,0.1\n5,1,2\n"), "f.csv:3: column `sigma_t_1_m`", "3 cells"),
            (format!("{head}0,0.1\n\n0,0.1\n"), "f.csv:4: column `altitude_m`", "found 0"),
            (format!("{head}0,0.1\n5,-1\n"), "f.csv:3: column `sigma_t_1_m`", "found -1"),
            (format!("{head}0,0.1\n5,inf\n"), "f.csv:3: column `sigma_t_1_m`", "`inf`"),
            (format!("{head}0,0.1\n"), "f.csv:2: column `altitude_m`", "1 rows"),
        ] {
            let message = parse_layers(&text, "f.csv").unwrap_err().to_string();
            assert!(message.contains(place) && message.contains(value), "{message}");
        }
    }
}
