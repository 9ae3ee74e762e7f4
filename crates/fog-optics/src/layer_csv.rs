//! Extinction by altitude from CSV text.

use crate::error::OpticsError;

const HEADER: [&str; 2] = ["altitude_m", "sigma_t_1_m"];

/// Rows (altitude in m, σ_t in 1/m) of a CSV text with the header `altitude_m,sigma_t_1_m`, altitudes ascending.
///
/// `file_name` is used in messages alone. A byte-order mark, spaces around cells, CRLF and empty lines are accepted.
///
/// # Errors
/// [`OpticsError::Csv`] with file, line, column and value if the header differs, a cell is no finite number, an altitude
/// is not above the one before it, σ_t is outside 0 to 1e6 1/m, or there are fewer than two rows.
pub fn parse_layers(text: &str, file_name: &str) -> Result<Vec<(f64, f64)>, OpticsError> {
    let fault = |line: usize, column: &str, problem: String| OpticsError::Csv {
        file: file_name.to_owned(),
        line,
        column: column.to_owned(),
        problem,
    };
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let mut lines =
        (text.lines().enumerate()).map(|(i, line)| (i + 1, line.trim())).filter(|(_, line)| !line.is_empty());

    let (line, header) = lines.next().unwrap_or((1, ""));
    if !header.split(',').map(str::trim).eq(HEADER) {
        let problem = format!("found the header `{header}`; expected `{}`", HEADER.join(","));
        return Err(fault(line, HEADER[0], problem));
    }

    let mut rows: Vec<(f64, f64)> = Vec::new();
    let mut last_line = line;
    for (line, content) in lines {
        let cells: Vec<&str> = content.split(',').map(str::trim).collect();
        if cells.len() != HEADER.len() {
            let problem = format!("found {} cells in `{content}`; expected {}", cells.len(), HEADER.len());
            return Err(fault(line, HEADER[cells.len().min(1)], problem));
        }
        let number = |i: usize| match cells[i].parse::<f64>() {
            Ok(x) if x.is_finite() => Ok(x),
            _ => Err(fault(line, HEADER[i], format!("found `{}`; expected a finite number", cells[i]))),
        };
        let (altitude, sigma) = (number(0)?, number(1)?);
        if rows.last().is_some_and(|&(below, _)| altitude <= below) {
            let problem = format!("found {altitude}; expected more than in the row before");
            return Err(fault(line, HEADER[0], problem));
        }
        if !(0.0..=1e6).contains(&sigma) {
            return Err(fault(line, HEADER[1], format!("found {sigma}; expected 0 to 1e6 1/m")));
        }
        rows.push((altitude, sigma));
        last_line = line;
    }
    if rows.len() < 2 {
        let problem = format!("found {} rows of numbers; expected at least 2", rows.len());
        return Err(fault(last_line, HEADER[0], problem));
    }
    Ok(rows)
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
