//! One text for one meaning: what is hashed.

use std::fmt::Write;

use serde_json::Value;

/// JSON with sorted keys, no spaces, and whole numbers without fraction (`2.0`, `2` and `-0.0`, `0` are the same).
pub(crate) fn canonical(value: &Value) -> String {
    let mut text = String::new();
    write(value, &mut text);
    text
}

fn write(value: &Value, out: &mut String) {
    match value {
        Value::Array(items) => {
            out.push('[');
            for (index, item) in items.iter().enumerate() {
                if index > 0 {
                    out.push(',');
                }
                write(item, out);
            }
            out.push(']');
        }
        Value::Object(map) => {
            let mut entries: Vec<_> = map.iter().collect();
            entries.sort_unstable_by_key(|(key, _)| *key);
            out.push('{');
            for (index, (key, item)) in entries.into_iter().enumerate() {
                if index > 0 {
                    out.push(',');
                }
                write(&Value::from(key.as_str()), out);
                out.push(':');
                write(item, out);
            }
            out.push('}');
        }
        Value::Number(number) => match number.as_f64() {
            Some(x) if number.is_f64() && x == f64::trunc(x) && f64::abs(x) < 9_007_199_254_740_992.0 => {
                let _ = write!(out, "{}", x as i64);
            }
            _ => {
                let _ = write!(out, "{number}");
            }
        },
        // Null, booleans and text are as JSON writes them.
        scalar => {
            let _ = write!(out, "{scalar}");
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn order_and_number_form_do_not_matter() {
        let a: Value = serde_json::from_str(r#"{"b": 2.0, "a": [-0.0, 0.5, null, "x\n"], "c": {}}"#).unwrap();
        let b: Value = serde_json::from_str(r#"{"c": {}, "a": [0, 5e-1, null, "x\n"], "b": 2}"#).unwrap();
        assert_eq!(canonical(&a), canonical(&b));
        assert_eq!(canonical(&a), r#"{"a":[0,0.5,null,"x\n"],"b":2,"c":{}}"#);
    }
}
