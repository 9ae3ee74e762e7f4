//! YAML text to a tree with positions. The parser's budgets stop hostile input (deep nesting, alias bombs).

use std::fmt;

use serde::de::{Deserialize, Deserializer, MapAccess, SeqAccess, Visitor};
use serde_yaml::{Location, Spanned};

use crate::{
    error::Problem,
    node::{Entry, Node, Value},
    origin::{Origin, Source},
};

/// Deeper nesting than this is refused: no configuration needs it, and recursion must stay bounded.
const MAX_DEPTH: usize = 32;

/// Reads one YAML document. Duplicate keys are errors, merge keys (`<<`) are applied.
///
/// # Errors
/// The first syntax error, with its position in `file`.
pub(crate) fn parse(text: &str, file: &Source) -> Result<Node, Problem> {
    let options = serde_yaml::options! {
        budget: serde_yaml::budget! { max_depth: MAX_DEPTH },
        strict_booleans: true,
        reject_unsupported_tags: true,
        with_snippet: false,
        emit_comments: false,
    };
    match serde_yaml::from_str_with_options::<Spanned<Raw>>(text, options) {
        Ok(raw) => Ok(locate(raw, file)),
        Err(error) => Err(problem(&error, file)),
    }
}

fn problem(error: &serde_yaml::Error, file: &Source) -> Problem {
    let origin = match error.location() {
        Some(location) => origin(location, file),
        None => Origin::start_of(file),
    };
    let message = match error.without_snippet() {
        serde_yaml::Error::DuplicateMappingKey { key: Some(key), .. } => format!("duplicate key `{key}`"),
        serde_yaml::Error::DuplicateMappingKey { .. } => "duplicate key".into(),
        serde_yaml::Error::MultipleDocuments { .. } => "more than one YAML document in the file".into(),
        other => {
            // The position is in front already: cut the parser's own.
            let text = other.to_string();
            format!("not valid YAML: {}", text.split(" at line ").next().unwrap_or(&text))
        }
    };
    Problem::new(&origin, "", message)
}

fn origin(location: Location, file: &Source) -> Origin {
    Origin::at(file, location.line(), location.column())
}

/// What the parser delivers; `locate` then adds the file's name.
enum Raw {
    Scalar(Value),
    List(Vec<Spanned<Raw>>),
    Map(Vec<(Spanned<String>, Spanned<Raw>)>),
}

fn locate(raw: Spanned<Raw>, file: &Source) -> Node {
    let value = match raw.value {
        Raw::Scalar(value) => value,
        Raw::List(items) => Value::List(items.into_iter().map(|item| locate(item, file)).collect()),
        Raw::Map(entries) => Value::Map(
            entries
                .into_iter()
                .map(|(key, value)| Entry {
                    key_origin: origin(key.defined, file),
                    key: key.value,
                    node: locate(value, file),
                })
                .collect(),
        ),
    };
    Node { value, origin: origin(raw.defined, file) }
}

impl<'de> Deserialize<'de> for Raw {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(RawVisitor)
    }
}

struct RawVisitor;

impl<'de> Visitor<'de> for RawVisitor {
    type Value = Raw;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a YAML value")
    }

    fn visit_unit<E>(self) -> Result<Raw, E> {
        Ok(Raw::Scalar(Value::Null))
    }

    fn visit_bool<E>(self, value: bool) -> Result<Raw, E> {
        Ok(Raw::Scalar(Value::Bool(value)))
    }

    fn visit_i64<E>(self, value: i64) -> Result<Raw, E> {
        Ok(Raw::Scalar(Value::Int(value.into())))
    }

    fn visit_u64<E>(self, value: u64) -> Result<Raw, E> {
        Ok(Raw::Scalar(Value::Int(value.into())))
    }

    fn visit_f64<E>(self, value: f64) -> Result<Raw, E> {
        Ok(Raw::Scalar(Value::Float(value)))
    }

    fn visit_str<E>(self, value: &str) -> Result<Raw, E> {
        Ok(Raw::Scalar(Value::Text(value.to_owned())))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut access: A) -> Result<Raw, A::Error> {
        let mut items = Vec::new();
        while let Some(item) = access.next_element()? {
            items.push(item);
        }
        Ok(Raw::List(items))
    }

    fn visit_map<A: MapAccess<'de>>(self, mut access: A) -> Result<Raw, A::Error> {
        let mut entries = Vec::new();
        while let Some(entry) = access.next_entry()? {
            entries.push(entry);
        }
        Ok(Raw::Map(entries))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Result<Node, String> {
        parse(text, &Source::named("c.yaml")).map_err(|p| p.to_string())
    }

    #[test]
    fn positions_are_of_keys_and_values() {
        let node = read("a: 1\nb:\n  c: [x, 2.5]\n").unwrap();
        let Value::Map(entries) = &node.value else { panic!("not a map") };
        assert_eq!(entries[1].key_origin.to_string(), "c.yaml:2:1");
        assert_eq!(node.origin_of("b.c.1").to_string(), "c.yaml:3:10");
        assert_eq!(node.origin_of("b.c.9").to_string(), "c.yaml:3:6");
    }

    #[test]
    fn merge_keys_keep_the_place_of_definition() {
        let node = read("m: &m {x: 1, y: 2}\nn:\n  <<: *m\n  y: 3\n").unwrap();
        let n = node.child("n").unwrap();
        assert_eq!(n.child("x").unwrap().value, Value::Int(1));
        assert_eq!(n.child("y").unwrap().value, Value::Int(3));
        assert_eq!(node.origin_of("n.x").to_string(), "c.yaml:1:11");
    }

    #[test]
    fn syntax_errors_have_a_place() {
        assert_eq!(read("a: 1\nb: 2\na: 3\n").unwrap_err(), "c.yaml:3:1: duplicate key `a`");
        assert_eq!(read("- 1\n---\n- 2").unwrap_err(), "c.yaml:3:1: more than one YAML document in the file");
        assert!(read("a: b: c").unwrap_err().starts_with("c.yaml:1:5: not valid YAML: mapping values"));
        assert!(read("a: .nan").unwrap_err().starts_with("c.yaml:1:4: not valid YAML: non-finite"));
        assert!(read("a: *x").unwrap_err().starts_with("c.yaml:1:4: not valid YAML: alias"));
    }

    #[test]
    fn hostile_input_is_refused() {
        assert!(read(&"[".repeat(100_000)).is_err());
        assert!(read(&format!("{}{}", "[".repeat(40), "]".repeat(40))).is_err());
        let mut bomb = String::from("a: &a [x,x,x,x,x,x,x,x,x,x]\n");
        for (old, new) in ('a'..='i').zip('b'..='j') {
            let aliases = vec![format!("*{old}"); 10].join(",");
            bomb.push_str(&format!("{new}: &{new} [{aliases}]\n"));
        }
        assert!(read(&bomb).unwrap_err().contains("not valid YAML"));
    }
}
