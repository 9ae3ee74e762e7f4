//! A frame with two axes and what is drawn in it.

use super::axis::Axis;
use super::legend::{Key, Mark};
use super::style::{FRAME, GRID, INK, LABEL, MUTED, TICK};
use super::svg::{Anchor, Point, Rect, Stroke, Svg};
use super::text;

/// One set of points (x, y), drawn as a line or as dots.
#[derive(Clone, Debug)]
pub(crate) struct Series {
    label: Option<String>,
    points: Vec<Point>,
    mark: Mark,
}

impl Series {
    /// A solid line.
    pub(crate) fn line(label: &str, colour: &str, points: Vec<Point>) -> Self {
        Self::of(label, points, Mark::Line(Stroke::new(colour, 2.0)))
    }

    /// Separate dots.
    pub(crate) fn dots(label: &str, colour: &str, points: Vec<Point>) -> Self {
        Self::of(label, points, Mark::Dot(colour.to_owned()))
    }

    fn of(label: &str, points: Vec<Point>, mark: Mark) -> Self {
        Self { label: (!label.is_empty()).then(|| label.to_owned()), points, mark }
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.points.is_empty()
    }

    /// The line in dashes.
    pub(crate) fn dashed(self, dash: &'static str) -> Self {
        self.restroked(|stroke| stroke.dash = dash)
    }

    /// The line with this width in px.
    pub(crate) fn width(self, width: f64) -> Self {
        self.restroked(|stroke| stroke.width = width)
    }

    fn restroked(mut self, change: impl FnOnce(&mut Stroke)) -> Self {
        if let Mark::Line(stroke) = &mut self.mark {
            change(stroke);
        }
        self
    }
}

/// A chart of lines and dots.
#[derive(Clone, Debug)]
pub(crate) struct Panel {
    pub(crate) heading: String,
    pub(crate) x: Axis,
    pub(crate) y: Axis,
    pub(crate) series: Vec<Series>,
    /// Thin dotted lines at values of x, with a word at their top.
    pub(crate) marks: Vec<(f64, String)>,
}

impl Panel {
    pub(crate) fn new(heading: &str, x: Axis, y: Axis, series: Vec<Series>) -> Self {
        Self { heading: heading.to_owned(), x, y, series, marks: Vec::new() }
    }

    /// What a legend says about the series, each label once.
    pub(crate) fn keys(&self) -> Vec<Key> {
        let labelled = self.series.iter().filter_map(|s| Some((s.label.clone()?, s.mark.clone())));
        labelled.map(|(label, mark)| Key { label, mark }).collect()
    }

    pub(crate) fn draw(&self, svg: &mut Svg, outer: Rect) {
        let plot = plot_rect(outer, &self.heading, &self.y);
        heading(svg, outer, plot, &self.heading);
        draw_axes(svg, plot, &self.x, &self.y);
        let place = |[x, y]: Point| {
            let (tx, ty) = (self.x.place(x)?, self.y.place(y)?);
            // Far outside is as good as infinitely far, and keeps the numbers of the file small.
            Some([plot.x + plot.w * tx.clamp(-9.0, 9.0), plot.bottom() - plot.h * ty.clamp(-9.0, 9.0)])
        };
        svg.clipped(plot, |svg| {
            for (value, _) in &self.marks {
                if let Some(t) = self.x.place(*value) {
                    let x = plot.x + plot.w * t;
                    let stroke = Stroke { dash: "2 3", ..Stroke::new(FRAME, 1.0) };
                    svg.line([x, plot.y], [x, plot.bottom()], &stroke);
                }
            }
            for series in &self.series {
                let points: Vec<Option<Point>> = series.points.iter().map(|&p| place(p)).collect();
                match &series.mark {
                    Mark::Line(stroke) => svg.polyline(&points, stroke),
                    Mark::Dot(colour) => points.iter().flatten().for_each(|&p| svg.dot(p, 3.4, colour)),
                }
            }
        });
        for (value, word) in &self.marks {
            if let Some(t) = self.x.place(*value) {
                svg.text([plot.x + plot.w * t + 4.0, plot.y + 14.0], word, TICK - 1.0, MUTED, Anchor::Start);
            }
        }
        svg.frame(plot);
    }
}

/// The frame inside of its labels.
pub(crate) fn plot_rect(outer: Rect, heading: &str, y: &Axis) -> Rect {
    let ticks = y.ticks.iter().map(|t| text::width(&t.1, TICK)).fold(0.0, f64::max);
    outer.inset(ticks + 32.0, if heading.is_empty() { 8.0 } else { 30.0 }, 10.0, 46.0)
}

/// Words over the frame.
pub(crate) fn heading(svg: &mut Svg, outer: Rect, plot: Rect, words: &str) {
    if !words.is_empty() {
        svg.text([plot.x, outer.y + 20.0], words, LABEL, INK, Anchor::Start);
    }
}

/// Grid, ticks and labels; the frame is drawn last, over the data.
pub(crate) fn draw_axes(svg: &mut Svg, plot: Rect, x: &Axis, y: &Axis) {
    let (grid, tick) = (Stroke::new(GRID, 1.0), Stroke::new(FRAME, 1.0));
    let at_x = |v: f64| x.place(v).map(|t| plot.x + plot.w * t);
    let at_y = |v: f64| y.place(v).map(|t| plot.bottom() - plot.h * t);
    for (value, label) in &x.ticks {
        if let Some(px) = at_x(*value) {
            svg.line([px, plot.y], [px, plot.bottom()], &grid);
            svg.line([px, plot.bottom()], [px, plot.bottom() + 5.0], &tick);
            svg.text([px, plot.bottom() + 19.0], label, TICK, MUTED, Anchor::Middle);
        }
    }
    for (value, label) in &y.ticks {
        if let Some(py) = at_y(*value) {
            svg.line([plot.x, py], [plot.right(), py], &grid);
            svg.line([plot.x - 5.0, py], [plot.x, py], &tick);
            svg.text([plot.x - 8.0, py + 4.3], label, TICK, MUTED, Anchor::End);
        }
    }
    for px in x.minor.iter().filter_map(|&v| at_x(v)) {
        svg.line([px, plot.bottom()], [px, plot.bottom() + 3.0], &tick);
    }
    for py in y.minor.iter().filter_map(|&v| at_y(v)) {
        svg.line([plot.x - 3.0, py], [plot.x, py], &tick);
    }
    svg.text([plot.x + 0.5 * plot.w, plot.bottom() + 40.0], &x.label, LABEL, INK, Anchor::Middle);
    let widest = y.ticks.iter().map(|t| text::width(&t.1, TICK)).fold(0.0, f64::max);
    svg.upward_text([plot.x - widest - 17.0, plot.y + 0.5 * plot.h], &y.label, LABEL);
}
