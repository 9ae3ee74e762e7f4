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
        /// Where another file included this one.
        via: Option<Arc<Origin>>,
    },
    /// A `--set KEY=VALUE` argument; holds `KEY=VALUE`.
    Set(Arc<str>),
    /// A `--where CONDITION` argument; holds `CONDITION`.
    Where(Arc<str>),
    /// Nobody wrote it: a default of the schema.
    Default,
}

/// A file that places are in.
#[derive(Clone, Debug)]
pub(crate) struct Source {
    /// The file's name, for messages.
    pub(crate) name: Arc<str>,
    /// Where another file included it.
    pub(crate) via: Option<Arc<Origin>>,
}

impl Source {
    pub(crate) fn named(name: &str) -> Self {
        Self { name: name.into(), via: None }
    }
}

impl Origin {
    /// The start of a file: for problems that have no better place.
    pub(crate) fn start_of(file: &Source) -> Self {
        Self::at(file, 1, 1)
    }

    pub(crate) fn at(file: &Source, line: u64, column: u64) -> Self {
        Self::File { file: Arc::clone(&file.name), line, column, via: file.via.clone() }
    }

    /// ` (included at b.yaml:2:3, included at a.yaml:1:10)` for a place in an included file; else nothing.
    pub(crate) fn chain(&self) -> String {
        let mut links = Vec::new();
        let mut here = self;
        while let Self::File { via: Some(above), .. } = here {
            links.push(format!("included at {above}"));
            here = above;
        }
        if links.is_empty() { String::new() } else { format!(" ({})", links.join(", ")) }
    }
}

impl fmt::Display for Origin {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::File { file, line, column, .. } => write!(f, "{file}:{line}:{column}"),
            Self::Set(argument) => write!(f, "--set {argument}"),
            Self::Where(condition) => write!(f, "--where {condition}"),
            Self::Default => f.write_str("default"),
        }
    }
}
