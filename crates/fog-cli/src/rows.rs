//! Rows of numbers as a table for people, as JSON or as CSV for programs.

use serde_json::{Map, Number, Value};
use std::io::{self, Write};

/// How rows are printed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Form {
    /// Aligned columns, six significant digits.
    Table,
    /// One object per line, full precision; what is infinite or not defined is `null`.
    Json,
    /// A header and rows, full precision; what is not defined is an empty cell.
    Csv,
}

/// One cell.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Cell {
    Number(f64),
    Text(String),
    /// Yes or no.
    Answer(bool),
    /// Not defined here.
    Nothing,
}

impl From<f64> for Cell {
    fn from(x: f64) -> Self {
        Self::Number(x)
    }
}

impl From<Option<f64>> for Cell {
    fn from(x: Option<f64>) -> Self {
        x.map_or(Self::Nothing, Self::Number)
    }
}

impl From<&str> for Cell {
    fn from(text: &str) -> Self {
        Self::Text(text.to_owned())
    }
}

impl Cell {
    pub(crate) fn json(&self) -> Value {
        match self {
            Self::Number(x) => Number::from_f64(*x).map_or(Value::Null, Value::Number),
            Self::Text(text) => Value::String(text.clone()),
            Self::Answer(yes) => Value::Bool(*yes),
            Self::Nothing => Value::Null,
        }
    }

    fn csv(&self) -> String {
        match self {
            // As JSON writes it: the shortest digits that read back as the same number.
            Self::Number(x) => Number::from_f64(*x).map_or_else(|| x.to_string(), |n| n.to_string()),
            Self::Text(text) if text.contains([',', '"', '\n']) => {
                format!("\"{}\"", text.replace('"', "\"\""))
            }
            Self::Text(text) => text.clone(),
            Self::Answer(yes) => yes.to_string(),
            Self::Nothing => String::new(),
        }
    }

    pub(crate) fn plain(&self) -> String {
        match self {
            Self::Number(x) => significant(*x),
            Self::Text(text) => text.clone(),
            Self::Answer(yes) => if *yes { "yes" } else { "no" }.to_owned(),
            Self::Nothing => "-".to_owned(),
        }
    }
}

/// A number with six significant digits, without trailing zeros.
pub(crate) fn significant(x: f64) -> String {
    let short = |text: &str| match text.contains('.') {
        true => text.trim_end_matches('0').trim_end_matches('.').to_owned(),
        false => text.to_owned(),
    };
    let a = x.abs();
    if x == 0.0 || !x.is_finite() {
        return x.to_string();
    }
    if !(1e-4..1e7).contains(&a) {
        let text = format!("{x:.5e}");
        let (mantissa, exponent) = text.split_once('e').unwrap_or((&text, "0"));
        return format!("{}e{exponent}", short(mantissa));
    }
    let mut decimals = 5;
    let mut bound = 10.0;
    while decimals > 0 && a >= bound {
        decimals -= 1;
        bound *= 10.0;
    }
    // Below 1 the leading zeros are not significant.
    let mut below = 1.0;
    while a < below {
        decimals += 1;
        below /= 10.0;
    }
    short(&format!("{x:.decimals$}"))
}

/// Prints rows under their columns' names.
pub(crate) fn print(
    form: Form,
    columns: &[&str],
    rows: &[Vec<Cell>],
    out: &mut impl Write,
) -> io::Result<()> {
    match form {
        Form::Table => print_table(columns, rows, out),
        Form::Json => {
            for row in rows {
                writeln!(out, "{}", object(columns, row))?;
            }
            Ok(())
        }
        Form::Csv => {
            writeln!(out, "{}", columns.join(","))?;
            for row in rows {
                writeln!(out, "{}", row.iter().map(Cell::csv).collect::<Vec<_>>().join(","))?;
            }
            Ok(())
        }
    }
}

/// Most rows that a tall table puts side by side.
const MAX_TALL: usize = 6;

/// As [`print()`], but a table of few rows is turned: a line per column, which many columns read better in.
pub(crate) fn print_tall(
    form: Form,
    columns: &[&str],
    rows: &[Vec<Cell>],
    out: &mut impl Write,
) -> io::Result<()> {
    if form != Form::Table || rows.len() > MAX_TALL {
        return print(form, columns, rows, out);
    }
    let texts: Vec<Vec<String>> = rows.iter().map(|row| row.iter().map(Cell::plain).collect()).collect();
    let name_width = columns.iter().map(|c| c.chars().count()).max().unwrap_or(0);
    let widths: Vec<usize> =
        texts.iter().map(|row| row.iter().map(|c| c.chars().count()).max().unwrap_or(0)).collect();
    for (i, name) in columns.iter().enumerate() {
        write!(out, "{name:<name_width$}")?;
        for (row, width) in texts.iter().zip(&widths) {
            write!(out, "  {:>width$}", row[i])?;
        }
        writeln!(out)?;
    }
    Ok(())
}

/// A row as a JSON object.
pub(crate) fn object(columns: &[&str], row: &[Cell]) -> Value {
    let members = columns.iter().zip(row).map(|(name, cell)| ((*name).to_owned(), cell.json()));
    Value::Object(members.collect::<Map<_, _>>())
}

fn print_table(columns: &[&str], rows: &[Vec<Cell>], out: &mut impl Write) -> io::Result<()> {
    let texts: Vec<Vec<String>> = rows.iter().map(|row| row.iter().map(Cell::plain).collect()).collect();
    let width = |i: usize| {
        let cells = texts.iter().map(|row| row[i].chars().count());
        cells.max().unwrap_or(0).max(columns[i].chars().count())
    };
    let widths: Vec<usize> = (0..columns.len()).map(width).collect();
    let line = |cells: &[String]| {
        let padded: Vec<String> = cells.iter().zip(&widths).map(|(c, &w)| format!("{c:>w$}")).collect();
        padded.join("  ")
    };
    let header: Vec<String> = columns.iter().map(|c| (*c).to_owned()).collect();
    writeln!(out, "{}", line(&header))?;
    for row in &texts {
        writeln!(out, "{}", line(row))?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn six_digits_are_kept() {
        for (x, text) in [
            (0.0, "0"),
            (1.0, "1"),
            (123.456_789, "123.457"),
            (0.012_345_678, "0.0123457"),
            (999_999.9, "1000000"),
            (1.5e8, "1.5e8"),
            (-1.234_567e-9, "-1.23457e-9"),
            (0.5, "0.5"),
            (f64::INFINITY, "inf"),
        ] {
            assert_eq!(significant(x), text);
        }
    }

    #[test]
    fn cells_in_every_form() {
        let columns = ["a", "b", "c"];
        let rows = [
            vec![Cell::from(0.1 + 0.2), Cell::from("x, y"), Cell::Nothing],
            vec![Cell::from(f64::INFINITY), Cell::from("z"), Cell::from(1.0)],
        ];
        let print = |form| {
            let mut out = Vec::new();
            print(form, &columns, &rows, &mut out).unwrap();
            String::from_utf8(out).unwrap()
        };
        assert_eq!(print(Form::Csv), "a,b,c\n0.30000000000000004,\"x, y\",\ninf,z,1.0\n");
        assert_eq!(
            print(Form::Json),
            "{\"a\":0.30000000000000004,\"b\":\"x, y\",\"c\":null}\n{\"a\":null,\"b\":\"z\",\"c\":1.0}\n"
        );
        assert_eq!(print(Form::Table), "  a     b  c\n0.3  x, y  -\ninf     z  1\n");
    }
}
