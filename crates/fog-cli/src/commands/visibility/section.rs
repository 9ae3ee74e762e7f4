//! Parts of a report: named numbers with units, as text, JSON and CSV.

use crate::rows::{self, Cell, Form};
use serde_json::{Map, Value};
use std::io::{self, Write};

/// A column: its name for programs, its name for people.
#[derive(Clone, Copy)]
pub(super) struct Column(pub(super) &'static str, pub(super) &'static str);

/// A title and rows under columns.
pub(super) struct Section {
    /// For people; without one the rows stand under the title before.
    pub(super) title: String,
    /// Name of the array in JSON; none if the one row's numbers stand for themselves.
    pub(super) name: Option<&'static str>,
    /// Number of columns, from the first, that say when the others hold.
    pub(super) conditions: usize,
    pub(super) columns: Vec<Column>,
    pub(super) rows: Vec<Vec<Cell>>,
}

impl Section {
    /// Numbers that stand for themselves: (name, name for people, value).
    pub(super) fn facts(title: String, facts: Vec<(&'static str, &'static str, Cell)>) -> Self {
        let (mut columns, mut row) = (Vec::new(), Vec::new());
        for (name, label, value) in facts {
            columns.push(Column(name, label));
            row.push(value);
        }
        Self { title, name: None, conditions: 0, columns, rows: vec![row] }
    }

    fn names(&self) -> Vec<&'static str> {
        self.columns.iter().map(|c| c.0).collect()
    }

    /// As text.
    pub(super) fn print(&self, out: &mut impl Write) -> io::Result<()> {
        writeln!(out, "\n{}", self.title)?;
        let labels: Vec<&str> = self.columns.iter().map(|c| c.1).collect();
        let mut text = Vec::new();
        if self.name.is_none() {
            rows::print_tall(Form::Table, &labels, &self.rows, &mut text)?;
        } else {
            rows::print(Form::Table, &labels, &self.rows, &mut text)?;
        }
        for line in String::from_utf8_lossy(&text).lines() {
            writeln!(out, "  {line}")?;
        }
        Ok(())
    }
}

/// A report on `fog` as one JSON object.
pub(super) fn json(fog: &str, sections: &[Section]) -> Value {
    let mut object = Map::new();
    object.insert("fog".to_owned(), Value::String(fog.to_owned()));
    for section in sections {
        let rows = section.rows.iter().map(|row| rows::object(&section.names(), row));
        match section.name {
            Some(name) => {
                object.insert(name.to_owned(), rows.collect());
            }
            None => object.extend(
                rows.filter_map(|row| match row {
                    Value::Object(members) => Some(members),
                    _ => None,
                })
                .flatten(),
            ),
        }
    }
    Value::Object(object)
}

/// Reports by altitude, a line per number.
pub(super) fn print_csv(reports: &[(f64, Vec<Section>)], out: &mut impl Write) -> io::Result<()> {
    let mut lines = Vec::new();
    for (altitude, section) in reports.iter().flat_map(|(a, sections)| sections.iter().map(move |s| (a, s))) {
        for row in &section.rows {
            let (when, values) = row.split_at(section.conditions);
            let when: Vec<String> = (when.iter().zip(&section.columns))
                .filter(|(cell, _)| **cell != Cell::Nothing)
                .map(|(cell, column)| format!("{}={}", column.0, cell.plain()))
                .collect();
            for (value, column) in values.iter().zip(&section.columns[section.conditions..]) {
                let part = Cell::from(section.name.unwrap_or(""));
                let when = Cell::Text(when.join(" "));
                lines.push(vec![Cell::Number(*altitude), part, when, Cell::from(column.0), value.clone()]);
            }
        }
    }
    rows::print(Form::Csv, &["altitude_m", "part", "condition", "quantity", "value"], &lines, out)
}
