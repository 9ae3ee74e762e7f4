//! What a user of this crate can do wrong.

use fog_core::optics_table::OpticsTableError;
use fog_core::phase::PhaseError;
use fog_core::profile::ProfileError;

/// Why an optical quantity was refused: the kind of mistake and the offending input.
#[derive(Debug, thiserror::Error, PartialEq)]
pub enum OpticsError {
    /// A number outside the range in which the method holds.
    #[error("{what} is {value}; valid: {valid}")]
    Range {
        /// Name of the quantity, with its unit.
        what: &'static str,
        /// What was given.
        value: f64,
        /// What is valid.
        valid: String,
    },
    /// The text of a fog model is not YAML of the expected form; the message has line and column.
    #[error("fog model: {0}")]
    ModelText(String),
    /// A fog model that reads well but makes no sense.
    #[error("fog model: `{key}` {problem}")]
    Model {
        /// Key of the model file.
        key: &'static str,
        /// What is wrong with it.
        problem: String,
    },
    /// A cell of a CSV text that cannot be used.
    #[error("{file}:{line}: column `{column}`: {problem}")]
    Csv {
        /// Name of the file as given by the caller.
        file: String,
        /// Line, from 1.
        line: usize,
        /// Column name, or what was expected as the header.
        column: String,
        /// The value found and what is expected instead.
        problem: String,
    },
    /// Measurements that read well but from which no fog model can be fitted.
    #[error("{file}: {problem}")]
    Fit {
        /// Name of the measurements' file as given by the caller.
        file: String,
        /// What is missing, and what would do.
        problem: String,
    },
    /// Parameters or rows that make no droplet spectrum.
    #[error("droplet spectrum: {0}")]
    Distribution(String),
    /// A name that is in no list.
    #[error("unknown {what} `{name}`; expected one of {known}")]
    UnknownName {
        /// What the name is for.
        what: &'static str,
        /// What was given.
        name: String,
        /// The names there are.
        known: String,
    },
    /// Axes of a table that do not fit each other or do not ascend.
    #[error("optics table settings: {0}")]
    Settings(String),
    /// The table refused its values.
    #[error(transparent)]
    Table(#[from] OpticsTableError),
    /// An analytic phase function refused its parameters.
    #[error(transparent)]
    Phase(#[from] PhaseError),
    /// The profile refused its values.
    #[error(transparent)]
    Profile(#[from] ProfileError),
}

/// Fails with [`OpticsError::Range`] unless `low ≤ value ≤ high`.
pub(crate) fn check_range(what: &'static str, value: f64, low: f64, high: f64) -> Result<(), OpticsError> {
    if (low..=high).contains(&value) {
        return Ok(());
    }
    Err(OpticsError::Range { what, value, valid: format!("{} to {}", short(low), short(high)) })
}

/// `1e6` rather than `1000000`, `1e-9` rather than `0.000000001`.
pub(crate) fn short(x: f64) -> String {
    if x == 0.0 || (1e-4..1e6).contains(&x.abs()) { format!("{x}") } else { format!("{x:e}") }
}
