//! Pictograms.

use crate::picture::Area;

/// A walking person of a height about a point: head, and limbs as lines.
pub(super) fn walker([x, y]: [f32; 2], height: f32) -> [Area; 3] {
    let p = |a: f32, b: f32| [x + a * height, y + b * height];
    let trunk = vec![p(0.02, 0.22), p(0.0, -0.03)];
    let limbs = vec![
        vec![p(0.0, -0.05), p(0.11, -0.25), p(0.10, -0.46)],
        vec![p(0.0, -0.05), p(-0.08, -0.26), p(-0.20, -0.45)],
        vec![p(0.03, 0.22), p(0.17, 0.06), p(0.25, 0.08)],
        vec![p(0.0, 0.22), p(-0.12, 0.10), p(-0.13, -0.02)],
    ];
    [
        Area::Disc(p(0.04, 0.40), 0.085 * height),
        Area::Lines(vec![trunk], 0.085 * height),
        Area::Lines(limbs, 0.045 * height),
    ]
}
