//! One axis: its paths, and its values by index or by a number in [0, 1).

use crate::{
    de::NodeReader,
    error::{Problem, Problems},
    node::{Entry, Node, Value},
    origin::Origin,
    ranges,
    schema::AxisRange,
    words::{expected_one_of, short_number},
};

use serde::Deserialize;

/// Sections of a frame: what an axis can change.
const SECTIONS: [&str; 10] =
    ["scene", "fog", "camera", "path", "cameras", "sensor", "lighting", "render", "outputs", "runway"];

/// Floating-point steps may miss the last value by rounding: this share of a step still counts.
const STEP_SLACK: f64 = 1e-9;

/// An axis of the sweep.
#[derive(Clone, Debug)]
pub(crate) struct Axis {
    /// The key as written.
    pub(crate) name: String,
    /// Dotted paths that it sets: one, or several that change together.
    pub(crate) paths: Vec<String>,
    pub(crate) key_origin: Origin,
    pub(crate) values: Values,
}

/// The values of an axis.
#[derive(Clone, Debug)]
pub(crate) enum Values {
    /// As listed.
    List(Vec<Node>),
    /// Computed from the index.
    Steps { steps: Steps, len: usize, origin: Origin },
    /// Any number of an interval: for random and sobol.
    Continuous { from: f64, to: f64, origin: Origin },
}

/// Equidistant numbers.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Steps {
    /// Whole numbers stay whole.
    Whole { from: i64, step: i64 },
    /// `from + i · step`.
    Step { from: f64, step: f64 },
    /// `from + (to − from) · i / (len − 1)`.
    Ends { from: f64, to: f64 },
}

impl Axis {
    /// Reads an entry of `sweep.axes`.
    pub(crate) fn read(entry: &Entry, problems: &mut Problems) -> Option<Self> {
        let name = &entry.key;
        let paths: Vec<String> = name.split(',').map(|path| path.trim().to_owned()).collect();
        let at = format!("sweep.axes.{name}");
        for path in &paths {
            let section = path.split('.').next().unwrap_or_default();
            if !SECTIONS.contains(&section) {
                let message =
                    format!("an axis cannot change `{section}`{}", expected_one_of(section, &SECTIONS));
                problems.add(Problem::new(&entry.key_origin, at, message));
                return None;
            }
        }
        let values = match read_values(&entry.node) {
            Ok(values) => values,
            Err((problem, inner)) => {
                let path = if inner.is_empty() { at } else { format!("{at}.{inner}") };
                problems.add(Problem { path, ..problem });
                return None;
            }
        };
        let axis = Self { name: name.clone(), paths, key_origin: entry.key_origin.clone(), values };
        axis.check_linked(&entry.node, &at, problems).then_some(axis)
    }

    /// With several paths, every value is a list with one item for each.
    fn check_linked(&self, node: &Node, at: &str, problems: &mut Problems) -> bool {
        let wanted = self.paths.len();
        if wanted == 1 {
            return true;
        }
        let Values::List(items) = &self.values else {
            let message =
                "an axis with several paths needs a list of values, each a list with one item per path";
            problems.add(Problem::new(&node.origin, at, message));
            return false;
        };
        let mut fits = true;
        for (index, item) in items.iter().enumerate() {
            if !matches!(&item.value, Value::List(parts) if parts.len() == wanted) {
                let message =
                    format!("expected a list of {wanted} values, one per path, found {}", item.describe());
                problems.add(Problem::new(&item.origin, format!("{at}.{index}"), message));
                fits = false;
            }
        }
        fits
    }

    /// The part of `value` that belongs at each path.
    pub(crate) fn parts<'v>(&'v self, value: &'v Node) -> impl Iterator<Item = (&'v str, &'v Node)> {
        let parts = match &value.value {
            Value::List(parts) if self.paths.len() > 1 => parts.as_slice(),
            _ => std::slice::from_ref(value),
        };
        self.paths.iter().map(String::as_str).zip(parts)
    }
}

/// Reads a list or a range; the error carries the path below the axis.
fn read_values(node: &Node) -> Result<Values, (Problem, String)> {
    let wrong =
        |message: &str, inner: &str| (Problem::new(node.origin_of(inner), "", message), inner.to_owned());
    match &node.value {
        Value::List(items) if items.is_empty() => Err(wrong("empty; an axis needs at least one value", "")),
        Value::List(items) => Ok(Values::List(items.clone())),
        Value::Map(_) => {
            let range = AxisRange::deserialize(NodeReader::new(node)).map_err(|error| {
                let inner = error.path().join(".");
                (error.into_problem(node), inner)
            })?;
            read_range(node, range).map_err(|(message, inner)| wrong(&message, inner))
        }
        _ => {
            let expected = "expected a list of values, {from, to, count} or {from, to, step}";
            Err(wrong(&format!("{expected}, found {}", node.describe()), ""))
        }
    }
}

fn read_range(node: &Node, range: AxisRange) -> Result<Values, (String, &'static str)> {
    let AxisRange { from, to, count, step } = range;
    let origin = node.origin.clone();
    let whole = |key: &str| match node.child(key).map(|node| &node.value) {
        Some(Value::Int(n)) => i64::try_from(*n).ok(),
        _ => None,
    };
    match (count, step) {
        (Some(_), Some(_)) => Err(("count and step exclude each other; give one".into(), "step")),
        (None, None) => Ok(Values::Continuous { from, to, origin }),
        (Some(count), None) => {
            if !ranges::COUNT.contains(count as f64) {
                return Err((ranges::COUNT.message("count", count as f64), "count"));
            }
            // A whole step between whole ends keeps all values whole; a single value is the first.
            let span = whole("from").zip(whole("to")).and_then(|(from, to)| to.checked_sub(from));
            let steps = match (whole("from"), span) {
                (Some(from), _) if count == 1 => Steps::Whole { from, step: 0 },
                (Some(from), Some(span)) if count > 1 && span % (count - 1) == 0 => {
                    Steps::Whole { from, step: span / (count - 1) }
                }
                _ => Steps::Ends { from, to },
            };
            Ok(Values::Steps { steps, len: count as usize, origin })
        }
        (None, Some(step)) => {
            let intervals = f64::floor((to - from) / step + STEP_SLACK);
            if step == 0.0 || intervals.is_nan() || intervals < 0.0 {
                let message = format!(
                    "steps of {} never lead from {} to {}",
                    short_number(step),
                    short_number(from),
                    short_number(to)
                );
                return Err((message, "step"));
            }
            if !ranges::COUNT.contains(intervals + 1.0) {
                return Err((ranges::COUNT.message("count", intervals + 1.0), "step"));
            }
            let steps = match (whole("from"), whole("step")) {
                (Some(from), Some(step)) => Steps::Whole { from, step },
                _ => Steps::Step { from, step },
            };
            Ok(Values::Steps { steps, len: intervals as usize + 1, origin })
        }
    }
}

impl Values {
    /// How many values there are; none for an interval.
    pub(crate) fn len(&self) -> Option<usize> {
        match self {
            Self::List(items) => Some(items.len()),
            Self::Steps { len, .. } => Some(*len),
            Self::Continuous { .. } => None,
        }
    }

    /// The value at `index`, which the caller keeps below `len`. An interval gives its start.
    pub(crate) fn at(&self, index: usize) -> Node {
        match self {
            Self::List(items) => items[index].clone(),
            Self::Steps { steps, len, origin } => Node::new(steps.at(index, *len), origin),
            Self::Continuous { from, origin, .. } => Node::new(Value::Float(*from), origin),
        }
    }

    /// The value that a uniform number `u` in [0, 1) selects.
    pub(crate) fn draw(&self, u: f64) -> Node {
        match self {
            Self::Continuous { from, to, origin } => Node::new(Value::Float(from + (to - from) * u), origin),
            Self::List(_) | Self::Steps { .. } => {
                let len = self.len().unwrap_or(1);
                self.at(((u * len as f64) as usize).min(len - 1))
            }
        }
    }

    /// At most `limit` values in short form, for people.
    pub(crate) fn short(&self, limit: usize) -> Vec<String> {
        match self {
            Self::Continuous { from, to, .. } => {
                vec![format!("{} to {}", short_number(*from), short_number(*to))]
            }
            _ => (0..self.len().unwrap_or(0).min(limit)).map(|index| self.at(index).short()).collect(),
        }
    }
}

impl Steps {
    fn at(self, index: usize, len: usize) -> Value {
        match self {
            Self::Whole { from, step } => Value::Int(i128::from(from) + i128::from(step) * index as i128),
            Self::Step { from, step } => Value::Float(from + step * index as f64),
            Self::Ends { from, .. } if index == 0 => Value::Float(from),
            Self::Ends { to, .. } if index + 1 == len => Value::Float(to),
            Self::Ends { from, to } => Value::Float(from + (to - from) * (index as f64 / (len - 1) as f64)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::origin::Source;

    fn values(text: &str) -> Result<Vec<String>, String> {
        let node = crate::yaml::parse(text, &Source::named("c.yaml")).unwrap();
        let values =
            read_values(&node).map_err(|(problem, inner)| format!("{inner}: {}", problem.message))?;
        Ok(values.short(100))
    }

    #[test]
    fn ranges_include_both_ends() {
        assert_eq!(values("{from: 0, to: 1, count: 5}").unwrap(), ["0", "0.25", "0.5", "0.75", "1"]);
        assert_eq!(values("{from: 10, to: 4, step: -3}").unwrap(), ["10", "7", "4"]);
        assert_eq!(values("{from: 0, to: 0.3, step: 0.1}").unwrap(), ["0", "0.1", "0.2", "0.3"]);
        assert_eq!(values("{from: 0, to: 0.35, step: 0.1}").unwrap(), ["0", "0.1", "0.2", "0.3"]);
        assert_eq!(values("{from: 3, to: 9, count: 1}").unwrap(), ["3"]);
    }

    #[test]
    fn whole_numbers_stay_whole() {
        let node = crate::yaml::parse("{from: 16, to: 64, step: 16}", &Source::named("c.yaml")).unwrap();
        let values = read_values(&node).unwrap();
        assert_eq!(values.at(2).value, Value::Int(48));
    }

    #[test]
    fn impossible_ranges_are_refused() {
        assert_eq!(
            values("{from: 0, to: 1, step: -1}").unwrap_err(),
            "step: steps of -1 never lead from 0 to 1"
        );
        assert_eq!(
            values("{from: 0, to: 1, step: 0}").unwrap_err(),
            "step: steps of 0 never lead from 0 to 1"
        );
        assert_eq!(
            values("{from: 0, to: 1, count: 0}").unwrap_err(),
            "count: 0 is out of range; valid: 1 to 100000000"
        );
        assert_eq!(
            values("{from: 0, to: 1, steps: 2}").unwrap_err(),
            "steps: unknown key; expected one of from, to, count, step; did you mean `step`?"
        );
        assert_eq!(
            values("7").unwrap_err(),
            ": expected a list of values, {from, to, count} or {from, to, step}, found 7"
        );
        assert_eq!(values("[]").unwrap_err(), ": empty; an axis needs at least one value");
    }
}
