//! Strips of colour over a common axis, one per thing.

use super::axis::Axis;
use super::panel::heading;
use super::style::{FRAME, INK, LABEL, MUTED, TICK};
use super::svg::{Anchor, Rect, Stroke, Svg};
use super::text;

/// Colours along an axis.
#[derive(Clone, Debug)]
pub(crate) struct Strips {
    pub(crate) heading: String,
    pub(crate) x: Axis,
    /// Label of each strip, and its colours at equal steps from one end of the axis to the other.
    pub(crate) strips: Vec<(String, Vec<String>)>,
}

impl Strips {
    pub(crate) fn draw(&self, svg: &mut Svg, outer: Rect) {
        let widest = self.strips.iter().map(|s| text::width(&s.0, TICK)).fold(0.0, f64::max);
        let plot = outer.inset(widest + 14.0, 30.0, 10.0, 46.0);
        heading(svg, outer, plot, &self.heading);
        let pitch = plot.h / self.strips.len().max(1) as f64;
        for (i, (label, colours)) in self.strips.iter().enumerate() {
            let y = plot.y + i as f64 * pitch;
            svg.text([plot.x - 8.0, y + 0.5 * pitch + 3.0], label, TICK, INK, Anchor::End);
            let step = plot.w / colours.len() as f64;
            for (k, colour) in colours.iter().enumerate() {
                if k > 0 && colours[k - 1] == *colour {
                    continue;
                }
                // Each colour reaches to the end and the next ones cover it, which leaves no seams.
                let from = k as f64 * step;
                svg.cell(Rect { x: plot.x + from, y, w: plot.w - from, h: pitch - 4.0 }, colour);
            }
        }
        let tick = Stroke::new(FRAME, 1.0);
        for (value, label) in &self.x.ticks {
            if let Some(t) = self.x.place(*value) {
                let px = plot.x + plot.w * t;
                svg.line([px, plot.bottom()], [px, plot.bottom() + 5.0], &tick);
                svg.text([px, plot.bottom() + 19.0], label, TICK, MUTED, Anchor::Middle);
            }
        }
        svg.text([plot.x + 0.5 * plot.w, plot.bottom() + 40.0], &self.x.label, LABEL, INK, Anchor::Middle);
    }
}
