//! CSV text: a header of names with units, then rows of numbers and names.

use std::fmt::Write;

/// A table in the making.
#[derive(Debug)]
pub(crate) struct Sheet {
    text: String,
    columns: usize,
}

impl Sheet {
    pub(crate) fn new(columns: &[&str]) -> Self {
        Self { text: columns.join(",") + "\n", columns: columns.len() }
    }

    /// Adds a row of numbers, each in the shortest form that gives the same number back.
    pub(crate) fn row(&mut self, numbers: &[f64]) {
        self.named_row(&[], numbers);
    }

    /// Adds a row that begins with words.
    pub(crate) fn named_row(&mut self, words: &[&str], numbers: &[f64]) {
        debug_assert_eq!(words.len() + numbers.len(), self.columns);
        for (i, word) in words.iter().enumerate() {
            let _ = write!(self.text, "{}{word}", if i > 0 { "," } else { "" });
        }
        for (i, number) in numbers.iter().enumerate() {
            let comma = if i + words.len() > 0 { "," } else { "" };
            // Numbers far from 1 in powers of ten, or a row grows by hundreds of zeros.
            let wide = *number != 0.0 && !(1e-5..1e15).contains(&number.abs());
            let _ = if wide {
                write!(self.text, "{comma}{number:e}")
            } else {
                write!(self.text, "{comma}{number}")
            };
        }
        self.text.push('\n');
    }

    pub(crate) fn finish(self) -> String {
        self.text
    }
}
