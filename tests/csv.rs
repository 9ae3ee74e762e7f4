//! Reference tables.

use std::collections::HashMap;

/// Rows of a CSV with a header line; lines that start with `#` are skipped. Cells that are no numbers are left out.
///
/// # Panics
/// If the file cannot be read or is empty.
#[must_use]
pub fn rows(name: &str) -> Vec<HashMap<String, f64>> {
    let text = std::fs::read_to_string(crate::data(name)).unwrap_or_else(|e| panic!("{name}: {e}"));
    let mut lines = text.lines().filter(|l| !l.starts_with('#'));
    let header: Vec<&str> = lines.next().expect("header").split(',').collect();
    lines
        .map(|line| {
            header
                .iter()
                .zip(line.split(','))
                .filter_map(|(key, cell)| Some(((*key).to_owned(), cell.parse().ok()?)))
                .collect()
        })
        .collect()
}

/// Column names whose values are text.
#[must_use]
pub fn text_column(name: &str, column: &str) -> Vec<String> {
    let text = std::fs::read_to_string(crate::data(name)).unwrap_or_else(|e| panic!("{name}: {e}"));
    let mut lines = text.lines().filter(|l| !l.starts_with('#'));
    let at = lines.next().expect("header").split(',').position(|c| c == column).expect("column");
    lines.map(|l| l.split(',').nth(at).unwrap_or_default().to_owned()).collect()
}
