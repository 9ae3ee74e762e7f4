//! Naming frames by a value of their specification.

use serde_json::Value;
use std::fmt::{Display, Formatter};
use std::str::FromStr;

/// A condition on a frame, written `KEY=VALUE`: the value at a dotted path of its resolved specification, as its record and
/// `plan.jsonl` have it.
///
/// ```
/// let reference: fogbank::Reference = "fog.height_m=260".parse()?;
/// assert!(reference.is_true_of(&serde_json::json!({"fog": {"model": "advection", "height_m": 260.0}})));
/// # Ok::<(), String>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Reference {
    key: String,
    value: Value,
}

impl Reference {
    /// Whether the specification has this value there; numbers are equal by value.
    #[must_use]
    pub fn is_true_of(&self, spec: &Value) -> bool {
        let step = |value: &Value, key: &str| match value {
            Value::Array(items) => key.parse::<usize>().ok().and_then(|i| items.get(i).cloned()),
            other => other.get(key).cloned(),
        };
        let found = self.key.split('.').try_fold(spec.clone(), |value, key| step(&value, key));
        found.is_some_and(|found| match (found.as_f64(), self.value.as_f64()) {
            (Some(a), Some(b)) => a == b,
            _ => found == self.value,
        })
    }
}

impl FromStr for Reference {
    type Err = String;

    /// JSON values are read as such, all else is text.
    fn from_str(text: &str) -> Result<Self, String> {
        let (key, value) =
            text.split_once('=')
                .filter(|(key, value)| !key.is_empty() && !value.is_empty())
                .ok_or_else(|| format!("expected KEY=VALUE, as fog.model=advection, not `{text}`"))?;
        let value = serde_json::from_str(value).unwrap_or_else(|_| Value::String(value.to_owned()));
        Ok(Self { key: key.to_owned(), value })
    }
}

impl Display for Reference {
    fn fmt(&self, f: &mut Formatter<'_>) -> std::fmt::Result {
        match &self.value {
            Value::String(text) => write!(f, "{}={text}", self.key),
            other => write!(f, "{}={other}", self.key),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn values_by_path() {
        let spec = json!({
            "fog": {"model": "advection", "phase": {"hg": 0.83}, "visibility": null},
            "camera": {"position_m": [0.0, 2.0, -5.0]},
        });
        for right in [
            "fog.model=advection",
            "fog.model=\"advection\"",
            "fog.phase.hg=0.83",
            "fog.phase={\"hg\": 0.83}",
            "fog.visibility=null",
            "camera.position_m.1=2",
        ] {
            assert!(right.parse::<Reference>().unwrap().is_true_of(&spec), "{right}");
        }
        for wrong in ["fog.model=none", "fog.phase.hg=0.8", "fog.height_m=null", "camera.position_m.3=0"] {
            assert!(!wrong.parse::<Reference>().unwrap().is_true_of(&spec), "{wrong}");
        }
        for no in ["fog.model", "=3", "fog.model="] {
            assert!(no.parse::<Reference>().unwrap_err().contains("KEY=VALUE"), "{no}");
        }
        assert_eq!("fog.phase.hg=0.83".parse::<Reference>().unwrap().to_string(), "fog.phase.hg=0.83");
    }
}
