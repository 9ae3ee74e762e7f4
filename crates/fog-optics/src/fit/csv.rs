//! Measurements as CSV text.

use super::measurements::{Measurements, Observation, Quantity};
use crate::error::OpticsError;
use std::fmt::Write;

const PLACE: [&str; 4] = ["fog_height_m", "altitude_m", "diameter_low_um", "diameter_high_um"];
const VOLUME: &str = "sample_volume_m3";
const APPROACH: &str = "approach";

/// Where the columns stand in a row.
struct Header {
    columns: Vec<String>,
    place: [usize; 4],
    quantity: Quantity,
    value: usize,
    volume: Option<usize>,
}

/// Reads measurements from CSV text, one row for each height, altitude and bin:
///
/// ```csv
/// # lines that begin with # are comments
/// fog_height_m,altitude_m,diameter_low_um,diameter_high_um,count,sample_volume_m3
/// 100,50,2,5,812,5.7e-5
/// ```
///
/// Columns in any order; the first four as above, and exactly one of `count`, `number_per_bin_1_m3` and `density_1_m3_um`,
/// whose name is what the value means ([`Quantity`]). `sample_volume_m3` is needed for `count`; for the others it is
/// optional and gives the counting noise. A column `approach` is accepted and ignored: rows of equal height, altitude and bin
/// are merged ([`Measurements::new`]). A byte-order mark, spaces around cells, CRLF and empty lines are accepted.
///
/// `file_name` is used in messages alone.
///
/// # Errors
/// [`OpticsError::Csv`] with file, line, column and value: a column that is missing, unknown or there twice, two columns of
/// values, a cell that is no finite number, a row of another length, no rows, and all that [`Measurements::new`] refuses.
pub fn parse(text: &str, file_name: &str) -> Result<Measurements, OpticsError> {
    let fault = |line: usize, column: &str, problem: String| OpticsError::Csv {
        file: file_name.to_owned(),
        line,
        column: column.to_owned(),
        problem,
    };
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let mut lines = (text.lines().enumerate())
        .map(|(i, line)| (i + 1, line.trim()))
        .filter(|(_, line)| !line.is_empty() && !line.starts_with('#'));
    let (first, line) = lines.next().unwrap_or((1, ""));
    let header = header(line).map_err(|(column, problem)| fault(first, &column, problem))?;

    let mut rows = Vec::new();
    for (line, content) in lines {
        let cells: Vec<&str> = content.split(',').map(str::trim).collect();
        if cells.len() != header.columns.len() {
            let column = &header.columns[cells.len().min(header.columns.len() - 1)];
            let problem = format!("found {} cells; expected {}", cells.len(), header.columns.len());
            return Err(fault(line, column, problem));
        }
        let number = |i: usize| match cells[i].parse::<f64>() {
            Ok(x) if x.is_finite() => Ok(x),
            _ => {
                let problem = format!("found `{}`; expected a finite number", excerpt(cells[i]));
                Err(fault(line, &header.columns[i], problem))
            }
        };
        rows.push(Observation {
            line,
            fog_height_m: number(header.place[0])?,
            altitude_m: number(header.place[1])?,
            low_um: number(header.place[2])?,
            high_um: number(header.place[3])?,
            value: number(header.value)?,
            sample_volume_m3: header.volume.map(number).transpose()?,
        });
    }
    if rows.is_empty() {
        return Err(fault(first, PLACE[0], "found no rows below the header; expected measurements".into()));
    }
    Measurements::new(file_name, header.quantity, &rows)
}

/// The beginning of a text that may be of any length, for a message.
fn excerpt(text: &str) -> String {
    let start: String = text.chars().take(80).collect();
    if start.len() < text.len() { start + "…" } else { start }
}

/// Finds the columns; the error is a column and what is wrong with it.
fn header(line: &str) -> Result<Header, (String, String)> {
    if line.is_empty() {
        return Err((PLACE[0].to_owned(), format!("found no header; expected {}, …", PLACE.join(", "))));
    }
    let columns: Vec<String> = line.split(',').map(|cell| cell.trim().to_owned()).collect();
    let values = Quantity::ALL.map(Quantity::column);
    for (i, column) in columns.iter().enumerate() {
        if columns[..i].contains(column) {
            return Err((column.clone(), "found twice in the header; expected once".into()));
        }
        let known = PLACE.iter().chain(&values).any(|name| name == column);
        if !known && column != VOLUME && column != APPROACH {
            let problem = format!(
                "found the header `{}`; expected {}, one of {}, and {VOLUME} (needed for count)",
                excerpt(line),
                PLACE.join(", "),
                values.join(", ")
            );
            return Err((excerpt(column), problem));
        }
    }
    let find = |name: &str| columns.iter().position(|column| column == name);
    let mut place = [0; 4];
    for (index, name) in place.iter_mut().zip(PLACE) {
        *index = find(name)
            .ok_or_else(|| (name.to_owned(), format!("not found in the header `{}`", excerpt(line))))?;
    }
    let found: Vec<(Quantity, usize)> =
        Quantity::ALL.into_iter().filter_map(|q| find(q.column()).map(|i| (q, i))).collect();
    let [(quantity, value)] = found[..] else {
        let problem = format!(
            "found {} columns of values in the header; expected exactly one of {}, whose name says what it means",
            found.len(),
            values.join(", ")
        );
        return Err((values[0].to_owned(), problem));
    };
    let volume = find(VOLUME);
    if quantity == Quantity::Count && volume.is_none() {
        return Err((
            VOLUME.to_owned(),
            "not found in the header; counts need the volume of air that they were taken from".into(),
        ));
    }
    Ok(Header { columns, place, quantity, value, volume })
}

/// CSV text of rows of counts, that [`parse`] reads; each of the comment's lines is marked with `#`.
#[must_use]
pub fn write_counts(rows: &[Observation], comment: &str) -> String {
    let mut text = String::new();
    for line in comment.lines() {
        let _ = writeln!(text, "# {line}");
    }
    let _ = writeln!(text, "{},{},{VOLUME}", PLACE.join(","), Quantity::Count.column());
    for row in rows {
        let _ = write!(
            text,
            "{},{},{},{},{}",
            row.fog_height_m, row.altitude_m, row.low_um, row.high_um, row.value
        );
        let _ = writeln!(text, ",{:e}", row.sample_volume_m3.unwrap_or(0.0));
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    const HEAD: &str = "fog_height_m,altitude_m,diameter_low_um,diameter_high_um,count,sample_volume_m3\n";

    #[test]
    fn good_text_is_read_in_any_order_of_columns() {
        let text = "\u{feff}# a flight\r\napproach, density_1_m3_um,altitude_m,fog_height_m,diameter_high_um,diameter_low_um\r\n\
                    one,2e7,50,100,5,2\r\n\r\ntwo, 4e7 ,50,100,5,2\r\n";
        let data = parse(text, "a.csv").unwrap();
        assert!(!data.counting_noise_known());
        let bin = &data.spectra()[0].bins[0];
        assert_eq!((bin.low_um, bin.high_um, bin.rows, bin.line), (2.0, 5.0, 2, 3));
        assert!((bin.density_1_m3_um() / 3e7 - 1.0).abs() < 1e-12);
    }

    #[test]
    fn counts_are_written_and_read_back() {
        let row = |line, low_um| Observation {
            line,
            fog_height_m: 180.0,
            altitude_m: 12.5,
            low_um,
            high_um: low_um + 0.7,
            value: 321.0,
            sample_volume_m3: Some(5.7e-5),
        };
        let rows = [row(4, 2.1), row(5, 3.0)];
        let text = write_counts(&rows, "synthetic\nseed 1");
        let read = parse(&text, "x").unwrap();
        assert_eq!(read, Measurements::new("x", Quantity::Count, &rows).unwrap());
    }

    #[test]
    fn every_mistake_has_file_line_column_and_value() {
        for (text, place, value) in [
            (String::new(), "f.csv:1: column `fog_height_m`", "found no header"),
            ("x".repeat(1000), "f.csv:1: column", "xxx…`; expected fog_height_m"),
            ("height,alt\n1,2\n".into(), "f.csv:1: column `height`", "`height,alt`"),
            (HEAD.replace("altitude_m,", ""), "f.csv:1: column `altitude_m`", "not found"),
            (
                HEAD.replace("count", "number"),
                "f.csv:1: column `number`",
                "one of count, number_per_bin_1_m3",
            ),
            (HEAD.replace("count,", ""), "f.csv:1: column `count`", "found 0 columns of values"),
            (
                HEAD.replace("count", "count,density_1_m3_um"),
                "f.csv:1: column `count`",
                "found 2 columns of values",
            ),
            (HEAD.replace("altitude_m", "fog_height_m"), "f.csv:1: column `fog_height_m`", "found twice"),
            (HEAD.replace(",sample_volume_m3", ""), "f.csv:1: column `sample_volume_m3`", "not found"),
            (HEAD.into(), "f.csv:1: column `fog_height_m`", "no rows"),
            (format!("#\n{HEAD}100,50,2,5,many,1e-4\n"), "f.csv:3: column `count`", "found `many`"),
            (format!("{HEAD}100,50,2,5,,1e-4\n"), "f.csv:2: column `count`", "found ``"),
            (format!("{HEAD}100,50,2,5,NaN,1e-4\n"), "f.csv:2: column `count`", "found `NaN`"),
            (
                format!("{HEAD}100,50,2,5,1\n"),
                "f.csv:2: column `sample_volume_m3`",
                "found 5 cells; expected 6",
            ),
            (format!("{HEAD}100,50,2,5,1,1,1\n"), "f.csv:2: column `sample_volume_m3`", "found 7 cells"),
            (format!("{HEAD}100,500,2,5,1,1\n"), "f.csv:2: column `altitude_m`", "found 500"),
            (format!("{HEAD}100,50,2,5,-1,1\n"), "f.csv:2: column `count`", "found -1"),
            (
                format!("{HEAD}100,50,2,5,1,1\n\n100,50,4,6,1,1\n"),
                "f.csv:4: column `diameter_low_um`",
                "of line 2",
            ),
        ] {
            let message = parse(&text, "f.csv").unwrap_err().to_string();
            assert!(message.starts_with(place) && message.contains(value), "{message}");
        }
    }
}
