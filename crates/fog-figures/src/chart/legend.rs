//! Legends: samples of lines and dots with their words, in rows.

use super::style::{INK, TICK};
use super::svg::{Anchor, Point, Stroke, Svg};
use super::text;

const ROW: f64 = 20.0;
const SAMPLE: f64 = 26.0;

/// How a series is drawn.
#[derive(Clone, Debug)]
pub(crate) enum Mark {
    Line(Stroke),
    /// Fill colour.
    Dot(String),
}

/// One entry.
#[derive(Clone, Debug)]
pub(crate) struct Key {
    pub(crate) label: String,
    pub(crate) mark: Mark,
}

/// Drops the entries whose labels came before.
pub(crate) fn distinct(keys: impl IntoIterator<Item = Key>) -> Vec<Key> {
    let mut kept: Vec<Key> = Vec::new();
    for key in keys {
        if kept.iter().all(|k| k.label != key.label) {
            kept.push(key);
        }
    }
    kept
}

/// Places of the entries in rows of `limit` px, relative to the legend's corner, and the height of all rows.
fn layout(keys: &[Key], limit: f64) -> (Vec<Point>, f64) {
    let (mut x, mut y) = (0.0, 0.0);
    let mut places = Vec::new();
    for key in keys {
        let w = SAMPLE + 7.0 + text::width(&key.label, TICK) + 22.0;
        if x > 0.0 && x + w - 22.0 > limit {
            (x, y) = (0.0, y + ROW);
        }
        places.push([x, y]);
        x += w;
    }
    (places, if keys.is_empty() { 0.0 } else { y + ROW })
}

/// Height in px that [`draw`] takes.
pub(crate) fn height(keys: &[Key], limit: f64) -> f64 {
    layout(keys, limit).1
}

/// Draws the entries in rows below and right of `corner`.
pub(crate) fn draw(svg: &mut Svg, corner: Point, keys: &[Key], limit: f64) {
    for (key, [x, y]) in keys.iter().zip(layout(keys, limit).0) {
        let (x, y) = (corner[0] + x, corner[1] + y + 0.5 * ROW);
        match &key.mark {
            Mark::Line(stroke) => svg.line([x, y], [x + SAMPLE, y], stroke),
            Mark::Dot(colour) => svg.dot([x + 0.5 * SAMPLE, y], 3.8, colour),
        }
        svg.text([x + SAMPLE + 7.0, y + 4.4], &key.label, TICK, INK, Anchor::Start);
    }
}
