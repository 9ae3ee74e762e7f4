//! Keypoints: COCO wants those of a class always in the same number and order.

use std::collections::BTreeMap;

use serde_json::{Value, json};

/// The names of the keypoints of each class, in the order in which they came up.
#[derive(Debug, Default)]
pub(crate) struct Keypoints(BTreeMap<u64, Vec<String>>);

impl Keypoints {
    /// Triples x, y, v of the names known so far, and how many have v above 0: 2 is visible, 1 in the image but hidden, 0 neither
    /// (then x and y are 0).
    pub(crate) fn of(&mut self, object: &Value, size: [u32; 2]) -> (Vec<f64>, usize) {
        let points = object["keypoints"].as_array().map_or(&[][..], Vec::as_slice);
        let Some(class) = object["class_id"].as_u64().filter(|_| !points.is_empty()) else {
            return (Vec::new(), 0);
        };
        let names = self.0.entry(class).or_default();
        let mut triples = vec![0.0; 3 * names.len()];
        let mut count = 0;
        for point in points {
            let Some(name) = point["name"].as_str() else { continue };
            let place = names.iter().position(|n| n == name).unwrap_or_else(|| {
                names.push(name.to_owned());
                triples.extend([0.0; 3]);
                names.len() - 1
            });
            let [x, y] = [0, 1].map(|c: usize| point["image_px"][c].as_f64());
            let (Some(x), Some(y)) = (x, y) else { continue };
            if (0.0..f64::from(size[0])).contains(&x) && (0.0..f64::from(size[1])).contains(&y) {
                let seen = if point["visible"] == true { 2.0 } else { 1.0 };
                triples[3 * place..3 * place + 3].copy_from_slice(&[x - 0.5, y - 0.5, seen]);
                count += 1;
            }
        }
        (triples, count)
    }

    /// The names by class.
    pub(crate) fn by_class(&self) -> BTreeMap<u64, Vec<String>> {
        self.0.clone()
    }
}

/// An annotation's line with as many keypoints as its class has; `None` if it has as many.
pub(crate) fn padded(line: &str, skeletons: &BTreeMap<u64, Vec<String>>) -> Option<String> {
    let mut value: Value = serde_json::from_str(line).ok()?;
    let wanted = 3 * skeletons.get(&value["category_id"].as_u64()?)?.len();
    let given = value["keypoints"].as_array().map_or(0, Vec::len);
    if given == wanted {
        return None;
    }
    let mut points = value["keypoints"].as_array().cloned().unwrap_or_default();
    points.resize(wanted, json!(0.0));
    value["keypoints"] = json!(points);
    if given == 0 {
        value["num_keypoints"] = json!(0);
    }
    Some(value.to_string())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keypoints_keep_their_places() {
        let point = |name: &str, x: f64, visible: bool| json!({"name": name, "image_px": [x, 2.5], "visible": visible});
        let thing = |points: Vec<Value>| json!({"class_id": 36, "keypoints": points});
        let mut keypoints = Keypoints::default();
        let first = keypoints.of(&thing(vec![point("a", 0.5, true), point("b", 11.0, true)]), [10, 10]);
        assert_eq!(first, (vec![0.0, 2.0, 2.0, 0.0, 0.0, 0.0], 1));
        let second = keypoints.of(&thing(vec![point("c", 3.0, false)]), [10, 10]);
        assert_eq!(second, (vec![0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 2.5, 2.0, 1.0], 1));
        let names = keypoints.by_class();
        assert_eq!(names[&36], ["a", "b", "c"]);
        let line = json!({"category_id": 36, "keypoints": first.0, "num_keypoints": 1}).to_string();
        let value: Value = serde_json::from_str(&padded(&line, &names).expect("longer")).expect("JSON");
        assert_eq!(
            (value["keypoints"].as_array().map(Vec::len), &value["num_keypoints"]),
            (Some(9), &json!(1))
        );
        assert!(padded(&value.to_string(), &names).is_none());
        assert!(padded(r#"{"category_id": 1}"#, &names).is_none());
    }
}
