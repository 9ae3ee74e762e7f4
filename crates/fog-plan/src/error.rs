//! What is wrong with a configuration, in the user's words.

use std::{fmt, path::PathBuf};

use thiserror::Error;

use crate::origin::Origin;

/// One mistake: where it was written, which key it concerns, and what is wrong.
///
/// Its `Display` is the whole message: `configs/x.yaml:3:11: camera.altitude_m: expected a number (metres), …`; after it come
/// the places, if any, where one file included the other.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Problem {
    /// Where the offending key or value was written.
    pub origin: Origin,
    /// Dotted path of the key, empty when the problem concerns the whole document.
    pub path: String,
    /// What was expected, what was found, and a suggestion where there is one.
    pub message: String,
}

impl Problem {
    pub(crate) fn new(origin: &Origin, path: impl Into<String>, message: impl Into<String>) -> Self {
        Self { origin: origin.clone(), path: path.into(), message: message.into() }
    }
}

impl fmt::Display for Problem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: ", self.origin)?;
        if !self.path.is_empty() {
            write!(f, "{:.300}: ", self.path)?;
        }
        // What is quoted may be as long as a hostile file.
        write!(f, "{:.2000}{}", self.message, self.origin.chain())
    }
}

/// Why there is no plan. Its `Display` is the full message for the user, one line per problem.
#[derive(Debug, Error)]
pub enum PlanError {
    /// The configuration file cannot be read.
    #[error("{}: cannot read the configuration: {source}", path.display())]
    Read {
        /// The file, as the user named it.
        path: PathBuf,
        /// The system's reason.
        source: std::io::Error,
    },
    /// The configuration is wrong.
    #[error("{}", join(.0))]
    Invalid(Vec<Problem>),
}

impl PlanError {
    /// The single mistakes; empty when the file could not be read at all.
    #[must_use]
    pub fn problems(&self) -> &[Problem] {
        match self {
            Self::Read { .. } => &[],
            Self::Invalid(problems) => problems,
        }
    }
}

fn join(problems: &[Problem]) -> String {
    problems.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n")
}

/// Collects problems; one place and key is reported once, and not more than a screenful in all.
#[derive(Debug, Default)]
pub(crate) struct Problems(Vec<Problem>);

impl Problems {
    /// More than this would only bury the first ones.
    const LIMIT: usize = 20;

    pub(crate) fn add(&mut self, problem: Problem) {
        let known = |p: &Problem| p.origin == problem.origin && p.path == problem.path;
        if !self.is_full() && !self.0.iter().any(known) {
            self.0.push(problem);
        }
    }

    pub(crate) fn extend(&mut self, problems: impl IntoIterator<Item = Problem>) {
        for problem in problems {
            self.add(problem);
        }
    }

    pub(crate) fn is_full(&self) -> bool {
        self.0.len() >= Self::LIMIT
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    pub(crate) fn into_vec(self) -> Vec<Problem> {
        self.0
    }

    /// `Ok` without problems.
    pub(crate) fn into_result(self) -> Result<(), PlanError> {
        if self.0.is_empty() { Ok(()) } else { Err(PlanError::Invalid(self.0)) }
    }
}
