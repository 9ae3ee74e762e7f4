//! The error of reading the schema from the tree: it learns its place while it travels outwards.

use std::fmt;

use serde::de;

use crate::{
    error::Problem,
    node::Node,
    origin::Origin,
    words::{expected_one_of, unit_of},
};

/// What serde found wrong, and where.
#[derive(Debug)]
pub(crate) struct DeError {
    kind: Kind,
    /// Keys from the innermost outwards.
    path: Vec<String>,
    origin: Option<Origin>,
}

#[derive(Debug)]
enum Kind {
    UnknownKey { key: String, expected: &'static [&'static str] },
    MissingKey { key: &'static str },
    UnknownValue { value: String, expected: &'static [&'static str] },
    Type { expected: String, found: Option<String> },
    Custom(String),
}

impl DeError {
    /// Expected something else than `node`.
    pub(crate) fn wrong_type(node: &Node, expected: impl Into<String>) -> Self {
        let kind = Kind::Type { expected: expected.into(), found: Some(node.describe()) };
        Self { kind, path: Vec::new(), origin: Some(node.origin.clone()) }
    }

    /// Expected a number at `key`, whose suffix names the unit.
    pub(crate) fn wrong_number(node: &Node, key: &str, expected: &str) -> Self {
        match unit_of(key) {
            Some((_, unit)) => Self::wrong_type(node, format!("{expected} ({unit})")),
            None => Self::wrong_type(node, expected),
        }
    }

    /// Gives an error that has no place yet the place of `node`.
    pub(crate) fn at(mut self, node: &Node) -> Self {
        if self.origin.is_none() {
            self.origin = Some(node.origin.clone());
            if let Kind::Type { found, .. } = &mut self.kind {
                *found = Some(node.describe());
            }
        }
        self
    }

    /// Gives an unknown key the place where the key itself was written.
    pub(crate) fn at_key(mut self, origin: &Origin) -> Self {
        self.origin.get_or_insert_with(|| origin.clone());
        self
    }

    /// The error as seen from the map or list around.
    pub(crate) fn within(mut self, key: &str) -> Self {
        self.path.push(key.to_owned());
        self
    }

    /// Dotted path of the key concerned, outermost first.
    pub(crate) fn path(&self) -> Vec<String> {
        let mut path: Vec<String> = self.path.iter().rev().cloned().collect();
        match &self.kind {
            Kind::UnknownKey { key, .. } => path.push(key.clone()),
            Kind::MissingKey { key } => path.push((*key).to_owned()),
            _ => {}
        }
        path
    }

    /// Whether a key is absent (rather than wrong).
    pub(crate) fn is_missing(&self) -> bool {
        matches!(self.kind, Kind::MissingKey { .. })
    }

    /// The message for the user; `root` gives a place to what has none.
    pub(crate) fn into_problem(self, root: &Node) -> Problem {
        let path = self.path().join(".");
        let origin = match self.origin {
            Some(Origin::Default) | None => root.origin_of(&path).clone(),
            Some(origin) => origin,
        };
        Problem { origin, path, message: self.kind.to_string() }
    }
}

impl fmt::Display for Kind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::UnknownKey { key, expected } => write!(f, "unknown key{}", expected_one_of(key, expected)),
            Self::MissingKey { .. } => f.write_str("missing; this key is required"),
            Self::UnknownValue { value, expected } => {
                write!(f, "unknown value \"{value}\"{}", expected_one_of(value, expected))
            }
            Self::Type { expected, found: Some(found) } => write!(f, "expected {expected}, found {found}"),
            Self::Type { expected, found: None } => write!(f, "expected {expected}"),
            Self::Custom(message) => f.write_str(message),
        }
    }
}

impl fmt::Display for DeError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.path().join("."), self.kind)
    }
}

impl std::error::Error for DeError {}

impl From<Kind> for DeError {
    fn from(kind: Kind) -> Self {
        Self { kind, path: Vec::new(), origin: None }
    }
}

impl de::Error for DeError {
    fn custom<T: fmt::Display>(message: T) -> Self {
        Kind::Custom(message.to_string()).into()
    }

    fn invalid_type(_: de::Unexpected<'_>, expected: &dyn de::Expected) -> Self {
        Kind::Type { expected: expected.to_string(), found: None }.into()
    }

    fn invalid_value(unexpected: de::Unexpected<'_>, expected: &dyn de::Expected) -> Self {
        Self::invalid_type(unexpected, expected)
    }

    fn unknown_variant(value: &str, expected: &'static [&'static str]) -> Self {
        Kind::UnknownValue { value: value.to_owned(), expected }.into()
    }

    fn unknown_field(key: &str, expected: &'static [&'static str]) -> Self {
        Kind::UnknownKey { key: key.to_owned(), expected }.into()
    }

    fn missing_field(key: &'static str) -> Self {
        Kind::MissingKey { key }.into()
    }
}
