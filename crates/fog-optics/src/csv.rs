//! Tables of numbers in CSV text, with mistakes named by file, line, column and value.

use crate::error::{OpticsError, short};

/// A table of finite numbers under one of the headers that its reader knows.
pub(crate) struct CsvTable<'a> {
    file: &'a str,
    /// Names of the columns.
    pub(crate) header: &'static [&'static str],
    /// Rows in the order of the text.
    pub(crate) rows: Vec<CsvRow>,
    last_line: usize,
}

/// A row and the line that it was written in, from 1.
pub(crate) struct CsvRow {
    pub(crate) line: usize,
    pub(crate) cells: Vec<f64>,
}

impl<'a> CsvTable<'a> {
    /// Reads `text`, whose first line that is not empty must be one of `headers`, exactly. A byte-order mark, spaces around
    /// cells, CRLF and empty lines are accepted. `file` is used in messages alone.
    ///
    /// # Errors
    /// [`OpticsError::Csv`] if the header is another, or a row has not as many cells or a cell that is no finite number.
    pub(crate) fn read(
        text: &str,
        file: &'a str,
        headers: &[&'static [&'static str]],
    ) -> Result<Self, OpticsError> {
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        let mut lines = (text.lines().enumerate())
            .map(|(i, line)| (i + 1, line.trim()))
            .filter(|(_, line)| !line.is_empty());

        let (line, found) = lines.next().unwrap_or((1, ""));
        let fits = |header: &&&[&str]| found.split(',').map(str::trim).eq(header.iter().copied());
        let Some(header) = headers.iter().find(fits) else {
            let known: Vec<String> = headers.iter().map(|header| format!("`{}`", header.join(","))).collect();
            return Err(OpticsError::Csv {
                file: file.to_owned(),
                line,
                column: headers[0][0].to_owned(),
                problem: format!("found the header `{found}`; expected {}", known.join(" or ")),
            });
        };

        let mut table = Self { file, header, rows: Vec::new(), last_line: line };
        for (line, content) in lines {
            let cells: Vec<&str> = content.split(',').map(str::trim).collect();
            if cells.len() != header.len() {
                let problem =
                    format!("found {} cells in `{content}`; expected {}", cells.len(), header.len());
                return Err(table.fault(line, cells.len().min(header.len() - 1), problem));
            }
            let number = |(i, cell): (usize, &&str)| match cell.parse::<f64>() {
                Ok(x) if x.is_finite() => Ok(x),
                _ => Err(table.fault(line, i, format!("found `{cell}`; expected a finite number"))),
            };
            let cells = cells.iter().enumerate().map(number).collect::<Result<_, _>>()?;
            table.rows.push(CsvRow { line, cells });
            table.last_line = line;
        }
        Ok(table)
    }

    /// The error for the cell of column `column` (from 0) in a line.
    pub(crate) fn fault(&self, line: usize, column: usize, problem: impl Into<String>) -> OpticsError {
        OpticsError::Csv {
            file: self.file.to_owned(),
            line,
            column: self.header[column].to_owned(),
            problem: problem.into(),
        }
    }

    /// Refuses a table of fewer than `least` rows.
    pub(crate) fn need_rows(&self, least: usize) -> Result<(), OpticsError> {
        if self.rows.len() >= least {
            return Ok(());
        }
        let problem = format!("found {} rows of numbers; expected at least {least}", self.rows.len());
        Err(self.fault(self.last_line, 0, problem))
    }

    /// Refuses a column whose values do not ascend.
    pub(crate) fn need_ascending(&self, column: usize) -> Result<(), OpticsError> {
        for pair in self.rows.windows(2) {
            let (before, value) = (pair[0].cells[column], pair[1].cells[column]);
            if value <= before {
                let problem = format!("found {value}; expected more than in the row before");
                return Err(self.fault(pair[1].line, column, problem));
            }
        }
        Ok(())
    }

    /// Refuses a column with a value outside of `range`; `unit` follows the range in the message.
    pub(crate) fn need_range(&self, column: usize, range: [f64; 2], unit: &str) -> Result<(), OpticsError> {
        for row in &self.rows {
            let value = row.cells[column];
            if !(range[0]..=range[1]).contains(&value) {
                let [low, high] = range.map(short);
                return Err(self.fault(
                    row.line,
                    column,
                    format!("found {value}; expected {low} to {high}{unit}"),
                ));
            }
        }
        Ok(())
    }
}
