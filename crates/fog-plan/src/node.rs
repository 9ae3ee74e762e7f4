//! The configuration as a tree that remembers where each key and value was written.

use crate::{origin::Origin, words::short_number};

/// A value and its origin.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Node {
    pub(crate) value: Value,
    pub(crate) origin: Origin,
}

/// The kinds of value that YAML and JSON share.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Value {
    Null,
    Bool(bool),
    /// Whole numbers from −2⁶³ to 2⁶⁴ − 1.
    Int(i128),
    Float(f64),
    Text(String),
    List(Vec<Node>),
    Map(Vec<Entry>),
}

/// A key of a map, where it was written, and its value.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Entry {
    pub(crate) key: String,
    pub(crate) key_origin: Origin,
    pub(crate) node: Node,
}

impl Node {
    pub(crate) fn new(value: Value, origin: &Origin) -> Self {
        Self { value, origin: origin.clone() }
    }

    /// The value at `key` of a map, or at an index of a list.
    pub(crate) fn child(&self, key: &str) -> Option<&Node> {
        match &self.value {
            Value::Map(entries) => entries.iter().find(|e| e.key == key).map(|e| &e.node),
            Value::List(items) => items.get(key.parse::<usize>().ok()?),
            _ => None,
        }
    }

    /// As [`Node::child`], to change it.
    pub(crate) fn child_mut(&mut self, key: &str) -> Option<&mut Node> {
        match &mut self.value {
            Value::Map(entries) => entries.iter_mut().find(|e| e.key == key).map(|e| &mut e.node),
            Value::List(items) => items.get_mut(key.parse::<usize>().ok()?),
            _ => None,
        }
    }

    /// Where the deepest existing part of a dotted path was written, passing over defaults.
    pub(crate) fn origin_of(&self, path: &str) -> &Origin {
        let mut origin = &self.origin;
        let mut node = self;
        for key in path.split('.') {
            let Some(child) = node.child(key) else { break };
            node = child;
            if node.origin != Origin::Default {
                origin = &node.origin;
            }
        }
        origin
    }

    /// Gives every part of the tree one origin.
    pub(crate) fn set_origin(&mut self, origin: &Origin) {
        self.origin = origin.clone();
        match &mut self.value {
            Value::List(items) => items.iter_mut().for_each(|item| item.set_origin(origin)),
            Value::Map(entries) => {
                for entry in entries {
                    entry.key_origin = origin.clone();
                    entry.node.set_origin(origin);
                }
            }
            _ => {}
        }
    }

    /// What a message calls this value.
    pub(crate) fn describe(&self) -> String {
        match &self.value {
            Value::Null => "nothing".into(),
            Value::Bool(b) => b.to_string(),
            Value::Int(n) => n.to_string(),
            Value::Float(x) => short_number(*x),
            Value::Text(text) if text.chars().count() > 60 => {
                format!("text \"{}…\"", text.chars().take(60).collect::<String>())
            }
            Value::Text(text) => format!("text \"{text}\""),
            Value::List(items) => {
                format!("a list of {} {}", items.len(), if items.len() == 1 { "item" } else { "items" })
            }
            Value::Map(_) => "a map".into(),
        }
    }

    /// A short form for plans and file names: the scalars inside, joined by `-`.
    pub(crate) fn short(&self) -> String {
        let join = |parts: Vec<String>| parts.join("-");
        match &self.value {
            Value::Null => "null".into(),
            Value::Bool(b) => b.to_string(),
            Value::Int(n) => n.to_string(),
            Value::Float(x) => short_number(*x),
            Value::Text(text) => text.clone(),
            Value::List(items) => join(items.iter().map(Node::short).collect()),
            Value::Map(entries) => join(entries.iter().map(|e| e.node.short()).collect()),
        }
    }

    /// The tree without its origins.
    pub(crate) fn to_json(&self) -> serde_json::Value {
        match &self.value {
            Value::Null => serde_json::Value::Null,
            Value::Bool(b) => (*b).into(),
            Value::Int(n) => match (i64::try_from(*n), u64::try_from(*n)) {
                (Ok(n), _) => n.into(),
                (_, Ok(n)) => n.into(),
                _ => (*n as f64).into(),
            },
            Value::Float(x) => (*x).into(),
            Value::Text(text) => text.as_str().into(),
            Value::List(items) => items.iter().map(Node::to_json).collect(),
            Value::Map(entries) => entries
                .iter()
                .map(|e| (e.key.clone(), e.node.to_json()))
                .collect::<serde_json::Map<_, _>>()
                .into(),
        }
    }

    /// A tree of values that all have one origin.
    pub(crate) fn from_json(json: &serde_json::Value, origin: &Origin) -> Self {
        let value = match json {
            serde_json::Value::Null => Value::Null,
            serde_json::Value::Bool(b) => Value::Bool(*b),
            serde_json::Value::Number(n) => match (n.as_i64(), n.as_u64()) {
                (Some(n), _) => Value::Int(n.into()),
                (_, Some(n)) => Value::Int(n.into()),
                _ => Value::Float(n.as_f64().unwrap_or(f64::NAN)),
            },
            serde_json::Value::String(text) => Value::Text(text.clone()),
            serde_json::Value::Array(items) => {
                Value::List(items.iter().map(|item| Self::from_json(item, origin)).collect())
            }
            serde_json::Value::Object(map) => Value::Map(
                map.iter()
                    .map(|(key, json)| Entry {
                        key: key.clone(),
                        key_origin: origin.clone(),
                        node: Self::from_json(json, origin),
                    })
                    .collect(),
            ),
        };
        Self::new(value, origin)
    }
}
