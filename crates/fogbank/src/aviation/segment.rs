//! The longest row of lights that is seen.

use super::lights::Seen;
use serde::Serialize;

/// Lights nearer to one another than this along the runway's axis count as one place, in m: bars and rows across.
const SAME_PLACE_M: f64 = 3.0;
/// Groups that make up the row.
const ROW: [&str; 5] = ["approach", "threshold", "centre_line", "touchdown_zone", "edge"];

/// Consecutive lights along the runway's axis that are all seen.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Segment {
    /// Where it begins, in m before the threshold (negative beyond it).
    pub from_m: f64,
    /// Where it ends, farther along.
    pub to_m: f64,
    /// Its length in m.
    pub length_m: f64,
    /// Number of places with lights in it.
    pub lights: usize,
}

/// The longest segment, the nearer of two alike. A place is seen if any of its lights is.
pub(super) fn longest(seen: &[Seen]) -> Option<Segment> {
    let mut row: Vec<(f64, bool)> =
        seen.iter().filter(|s| ROW.contains(&s.kind.name)).map(|s| (s.before_m, s.visible)).collect();
    row.sort_by(|a, b| b.0.total_cmp(&a.0));
    let mut places: Vec<(f64, bool)> = Vec::new();
    for (before, visible) in row {
        match places.last_mut() {
            Some(last) if last.0 - before < SAME_PLACE_M => last.1 |= visible,
            _ => places.push((before, visible)),
        }
    }
    let segments = places.split(|place| !place.1).filter(|run| !run.is_empty()).map(|run| {
        let (from_m, to_m) = (run[0].0, run[run.len() - 1].0);
        Segment { from_m, to_m, length_m: from_m - to_m, lights: run.len() }
    });
    segments.reduce(|best, next| if next.length_m > best.length_m { next } else { best })
}
