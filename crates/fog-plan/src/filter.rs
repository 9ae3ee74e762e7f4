//! Conditions on the values of frames, as `fog.height_m>=180, lighting=night`.

use std::fmt;

use serde_json::{Value, json};

use crate::{
    FrameSpec, Origin,
    error::{PlanError, Problem},
    words::did_you_mean,
};

/// Conditions that a frame must meet all together.
#[derive(Clone, Debug, PartialEq)]
pub struct Filter {
    text: String,
    conditions: Vec<Condition>,
}

#[derive(Clone, Debug, PartialEq)]
struct Condition {
    path: String,
    comparison: Comparison,
    value: Value,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Comparison {
    Equal,
    Unequal,
    Less,
    AtMost,
    Greater,
    AtLeast,
}

/// Longest first, so that `>=` is not read as `>`.
const COMPARISONS: [(&str, Comparison); 7] = [
    ("==", Comparison::Equal),
    ("!=", Comparison::Unequal),
    ("<=", Comparison::AtMost),
    (">=", Comparison::AtLeast),
    ("=", Comparison::Equal),
    ("<", Comparison::Less),
    (">", Comparison::Greater),
];

impl Filter {
    /// Reads conditions `PATH OP VALUE`, separated by commas or `&&`; OP is `=`, `!=`, `<`, `<=`, `>` or `>=`.
    ///
    /// PATH is an axis as it is written in the sweep, or a key of the frame as `fogbank plan --json` prints it
    /// (`fog.height_m`). A frame that lacks the key does not meet the condition, unless it is `!=`.
    ///
    /// ```
    /// assert!(fog_plan::Filter::parse("fog.height_m>=180, lighting=night").is_ok());
    /// assert!(fog_plan::Filter::parse("fog.height_m").is_err());
    /// ```
    ///
    /// # Errors
    /// A condition without comparison, path or value, or one that orders what is no number.
    pub fn parse(text: &str) -> Result<Self, PlanError> {
        let parts = text.split("&&").flat_map(|part| part.split(',')).map(str::trim);
        let conditions = parts.map(|part| Condition::parse(part, text)).collect::<Result<_, _>>()?;
        Ok(Self { text: text.to_owned(), conditions })
    }

    /// By frame, whether it meets every condition.
    ///
    /// # Errors
    /// A path that no frame has.
    pub fn matches(&self, frames: &[FrameSpec]) -> Result<Vec<bool>, PlanError> {
        let documents: Vec<Value> = frames.iter().map(|frame| json!(frame)).collect();
        self.matches_json(&documents.iter().collect::<Vec<_>>())
    }

    /// As [`Filter::matches`], of frames as `fogbank plan --json` prints them.
    ///
    /// # Errors
    /// A path that no frame has.
    pub fn matches_json(&self, documents: &[&Value]) -> Result<Vec<bool>, PlanError> {
        let mut matching = vec![true; documents.len()];
        for condition in &self.conditions {
            let found: Vec<Option<&Value>> =
                documents.iter().map(|document| lookup(document, &condition.path)).collect();
            if found.iter().all(Option::is_none) {
                return Err(self.unknown(&condition.path, documents));
            }
            matching.iter_mut().zip(found).for_each(|(m, value)| *m &= condition.is_met(value));
        }
        Ok(matching)
    }

    fn unknown(&self, path: &str, documents: &[&Value]) -> PlanError {
        let mut paths = Vec::new();
        for document in documents.iter().take(64) {
            if let Some(axes) = document["axes"].as_object() {
                paths.extend(axes.keys().cloned());
            }
            collect(document, "", &mut paths);
        }
        let known: Vec<&str> = paths.iter().map(String::as_str).collect();
        let suggestion =
            did_you_mean(path, &known).map_or_else(String::new, |path| format!("; did you mean `{path}`?"));
        problem(&self.text, format!("no frame has a value `{path}`{suggestion}"))
    }
}

impl fmt::Display for Filter {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.text)
    }
}

impl Condition {
    fn parse(part: &str, whole: &str) -> Result<Self, PlanError> {
        let malformed = || {
            let form = "PATH OP VALUE with OP one of =, !=, <, <=, >, >=, as fog.height_m>=180";
            problem(whole, format!("`{part}` is no condition; expected {form}"))
        };
        let at = part.find(['=', '!', '<', '>']).ok_or_else(malformed)?;
        let (path, rest) = part.split_at(at);
        let (sign, comparison) =
            COMPARISONS.into_iter().find(|(sign, _)| rest.starts_with(sign)).ok_or_else(malformed)?;
        let (path, value) = (path.trim(), rest[sign.len()..].trim());
        if path.is_empty() || value.is_empty() {
            return Err(malformed());
        }
        let value = serde_json::from_str(value).unwrap_or_else(|_| Value::from(value));
        let orders = !matches!(comparison, Comparison::Equal | Comparison::Unequal);
        if orders && !value.is_number() {
            return Err(problem(whole, format!("`{part}`: {value} is no number, which {sign} needs")));
        }
        Ok(Self { path: path.to_owned(), comparison, value })
    }

    fn is_met(&self, found: Option<&Value>) -> bool {
        let Some(found) = found else { return self.comparison == Comparison::Unequal };
        let numbers = found.as_f64().zip(self.value.as_f64());
        let equal = numbers.map_or_else(|| *found == self.value, |(a, b)| a == b);
        let ordered = |holds: fn(&f64, &f64) -> bool| numbers.is_some_and(|(a, b)| holds(&a, &b));
        match self.comparison {
            Comparison::Equal => equal,
            Comparison::Unequal => !equal,
            Comparison::Less => ordered(f64::lt),
            Comparison::AtMost => ordered(f64::le),
            Comparison::Greater => ordered(f64::gt),
            Comparison::AtLeast => ordered(f64::ge),
        }
    }
}

/// A value of a frame: its axis of that name, else the key at that path.
fn lookup<'v>(document: &'v Value, path: &str) -> Option<&'v Value> {
    let axis = document["axes"].get(path);
    axis.or_else(|| {
        path.split('.').try_fold(document, |value, key| match value {
            Value::Array(items) => items.get(key.parse::<usize>().ok()?),
            value => value.get(key),
        })
    })
    .filter(|value| !value.is_null())
}

fn collect(value: &Value, path: &str, paths: &mut Vec<String>) {
    let Some(map) = value.as_object() else { return paths.push(path.to_owned()) };
    for (key, value) in map.iter().filter(|(key, _)| *key != "axes") {
        collect(value, &if path.is_empty() { key.clone() } else { format!("{path}.{key}") }, paths);
    }
}

fn problem(text: &str, message: String) -> PlanError {
    PlanError::Invalid(vec![Problem::new(&Origin::Where(text.into()), "", message)])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn picked(filter: &str) -> Result<Vec<usize>, String> {
        let yaml = "version: 1\nname: t\nscene: none\nfog: none\nlighting: day\n\
                    sweep: {axes: {fog: [none, {model: advection, height_m: 100}, {model: advection, height_m: 180}], \
                    lighting: [day, night]}}\n";
        let plan = crate::parse(yaml, "t.yaml", &[]).expect("valid plan");
        let frames: Vec<FrameSpec> = plan.frames().map(|f| f.expect("frame")).collect();
        let matches = Filter::parse(filter).and_then(|f| f.matches(&frames)).map_err(|e| e.to_string())?;
        Ok((0..frames.len()).filter(|&i| matches[i]).collect())
    }

    #[test]
    fn values_of_axes_and_of_frames() {
        assert_eq!(picked("fog.height_m>=180").expect("picked"), [4, 5]);
        assert_eq!(picked("fog.height_m < 180 && lighting = night").expect("picked"), [3]);
        assert_eq!(picked("fog=none").expect("picked"), [0, 1]);
        assert_eq!(picked("fog.height_m!=100, camera.altitude_m==2").expect("picked"), [0, 1, 4, 5]);
        assert_eq!(picked("lighting=dawn").expect("picked"), [0_usize; 0]);
    }

    #[test]
    fn mistakes_are_explained() {
        let said = |filter| picked(filter).expect_err("refused");
        assert!(
            said("fog.heigth_m>1")
                .contains("no frame has a value `fog.heigth_m`; did you mean `fog.height_m`?")
        );
        assert!(said("fog.height_m").contains("`fog.height_m` is no condition"));
        assert!(said("fog.height_m>tall").contains("\"tall\" is no number, which > needs"));
        assert!(said("=3").contains("is no condition"));
    }
}
