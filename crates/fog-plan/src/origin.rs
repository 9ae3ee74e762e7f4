//! Where a value of the configuration was written.

use std::{fmt, sync::Arc};

/// The place that a key or value comes from, shown in front of every message.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Origin {
    /// A position in the configuration file.
    File {
        /// The file's name, as the user gave it.
        file: Arc<str>,
        /// Line, from 1.
        line: u64,
        /// Column in characters, from 1.
        column: u64,
    },
    /// A `--set KEY=VALUE` argument; holds `KEY=VALUE`.
    Set(Arc<str>),
    /// A `--where CONDITION` argument; holds `CONDITION`.
    Where(Arc<str>),
    /// Nobody wrote it: a default of the schema.
    Default,
}

impl Origin {
    /// The start of a file: for problems that have no better place.
    pub(crate) fn start_of(file: &Arc<str>) -> Self {
        Self::File { file: Arc::clone(file), line: 1, column: 1 }
    }
}

impl fmt::Display for Origin {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::File { file, line, column } => write!(f, "{file}:{line}:{column}"),
            Self::Set(argument) => write!(f, "--set {argument}"),
            Self::Where(condition) => write!(f, "--where {condition}"),
            Self::Default => f.write_str("default"),
        }
    }
}
