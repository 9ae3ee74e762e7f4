//! The few SVG elements that charts are made of.

use super::style::{FRAME, INK};
use std::fmt::Write;

/// Fonts by preference: the embedded one first, then one of the same metrics, then whatever there is.
const FONTS: &str = "DejaVu Sans, Verdana, sans-serif";

/// A place on the page in px, y downwards.
pub(crate) type Point = [f64; 2];

/// A rectangle on the page in px.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Rect {
    pub(crate) x: f64,
    pub(crate) y: f64,
    pub(crate) w: f64,
    pub(crate) h: f64,
}

impl Rect {
    pub(crate) fn right(&self) -> f64 {
        self.x + self.w
    }

    pub(crate) fn bottom(&self) -> f64 {
        self.y + self.h
    }

    /// The rectangle without margins at its left, top, right and bottom.
    pub(crate) fn inset(&self, left: f64, top: f64, right: f64, bottom: f64) -> Self {
        Self { x: self.x + left, y: self.y + top, w: self.w - left - right, h: self.h - top - bottom }
    }
}

/// Where text stands relative to its point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Anchor {
    Start,
    Middle,
    End,
}

/// How a line is drawn.
#[derive(Clone, Debug)]
pub(crate) struct Stroke {
    pub(crate) colour: String,
    pub(crate) width: f64,
    /// SVG dash pattern; empty for a solid line.
    pub(crate) dash: &'static str,
}

impl Stroke {
    pub(crate) fn new(colour: &str, width: f64) -> Self {
        Self { colour: colour.to_owned(), width, dash: "" }
    }

    fn attributes(&self) -> String {
        let dash = if self.dash.is_empty() {
            String::new()
        } else {
            format!(r#" stroke-dasharray="{}""#, self.dash)
        };
        format!(r#"stroke="{}" stroke-width="{}"{dash}"#, self.colour, self.width)
    }
}

/// An SVG document in the making.
#[derive(Debug, Default)]
pub(crate) struct Svg {
    body: String,
    clips: usize,
}

impl Svg {
    /// A line through points; a point without place ends a piece.
    pub(crate) fn polyline(&mut self, points: &[Option<Point>], stroke: &Stroke) {
        let mut path = String::new();
        let mut pen_down = false;
        for point in points {
            match point {
                Some([x, y]) => {
                    let _ = write!(path, "{}{x:.2} {y:.2}", if pen_down { "L" } else { "M" });
                    pen_down = true;
                }
                None => pen_down = false,
            }
        }
        if !path.is_empty() {
            let attributes = stroke.attributes();
            let _ = writeln!(
                self.body,
                r#"<path d="{path}" fill="none" {attributes} stroke-linejoin="round" stroke-linecap="butt"/>"#
            );
        }
    }

    pub(crate) fn line(&mut self, from: Point, to: Point, stroke: &Stroke) {
        self.polyline(&[Some(from), Some(to)], stroke);
    }

    pub(crate) fn polygon(&mut self, points: &[Point], fill: &str, opacity: f64) {
        let mut list = String::new();
        for [x, y] in points {
            let _ = write!(list, "{x:.2},{y:.2} ");
        }
        let list = list.trim_end();
        let _ = writeln!(self.body, r#"<polygon points="{list}" fill="{fill}" fill-opacity="{opacity}"/>"#);
    }

    /// A filled rectangle with sharp edges, so that neighbours leave no seam.
    pub(crate) fn cell(&mut self, r: Rect, fill: &str) {
        let Rect { x, y, w, h } = r;
        let _ = writeln!(
            self.body,
            r#"<rect x="{x:.2}" y="{y:.2}" width="{w:.2}" height="{h:.2}" fill="{fill}" shape-rendering="crispEdges"/>"#
        );
    }

    pub(crate) fn frame(&mut self, r: Rect) {
        let Rect { x, y, w, h } = r;
        let _ = writeln!(
            self.body,
            r#"<rect x="{x:.2}" y="{y:.2}" width="{w:.2}" height="{h:.2}" fill="none" stroke="{FRAME}" stroke-width="1"/>"#
        );
    }

    pub(crate) fn dot(&mut self, [x, y]: Point, radius: f64, fill: &str) {
        let _ = writeln!(
            self.body,
            r##"<circle cx="{x:.2}" cy="{y:.2}" r="{radius}" fill="{fill}" fill-opacity="0.85" stroke="#ffffff" stroke-width="0.6"/>"##
        );
    }

    /// One line of text; `size` in px.
    pub(crate) fn text(&mut self, [x, y]: Point, text: &str, size: f64, colour: &str, anchor: Anchor) {
        let place = format!(r#"x="{x:.2}" y="{y:.2}""#);
        self.write_text(&place, text, size, colour, anchor);
    }

    /// One line of text that reads upwards, centred on its point.
    pub(crate) fn upward_text(&mut self, [x, y]: Point, text: &str, size: f64) {
        // A matrix, because `rotate` asks the platform for sines.
        let place = format!(r#"transform="matrix(0 -1 1 0 {x:.2} {y:.2})""#);
        self.write_text(&place, text, size, INK, Anchor::Middle);
    }

    fn write_text(&mut self, place: &str, text: &str, size: f64, colour: &str, anchor: Anchor) {
        let anchor = match anchor {
            Anchor::Start => "start",
            Anchor::Middle => "middle",
            Anchor::End => "end",
        };
        let text = subscripted(&escape(text), size);
        let _ = writeln!(
            self.body,
            r#"<text {place} font-size="{size}" fill="{colour}" text-anchor="{anchor}">{text}</text>"#
        );
    }

    /// Draws only what falls into a rectangle.
    pub(crate) fn clipped(&mut self, r: Rect, draw: impl FnOnce(&mut Self)) {
        let (Rect { x, y, w, h }, id) = (r, self.clips);
        self.clips += 1;
        let _ = writeln!(
            self.body,
            r#"<clipPath id="clip{id}"><rect x="{x:.2}" y="{y:.2}" width="{w:.2}" height="{h:.2}"/></clipPath>"#
        );
        let _ = writeln!(self.body, r#"<g clip-path="url(#clip{id})">"#);
        draw(self);
        self.body.push_str("</g>\n");
    }

    /// The document; `description` is for readers that cannot see it.
    pub(crate) fn finish(self, width: f64, height: f64, title: &str, description: &str) -> String {
        let (title, description) = (escape(title), escape(description));
        format!(
            concat!(
                r#"<svg xmlns="http://www.w3.org/2000/svg" width="{w}" height="{h}" viewBox="0 0 {w} {h}" "#,
                r#"font-family="{f}" role="img">"#,
                "\n<title>{t}</title>\n<desc>{d}</desc>\n",
                r##"<rect width="{w}" height="{h}" fill="#ffffff"/>"##,
                "\n{b}</svg>\n"
            ),
            w = width,
            h = height,
            f = FONTS,
            t = title,
            d = description,
            b = self.body
        )
    }
}

/// Letters and digits after `_` as a subscript: μ_L.
fn subscripted(text: &str, size: f64) -> String {
    let mut pieces = text.split('_');
    let mut out = pieces.next().unwrap_or_default().to_owned();
    let (small, down) = (0.75 * size, 0.22 * size);
    for piece in pieces {
        let end = piece.find(|c: char| !c.is_alphanumeric()).unwrap_or(piece.len());
        let (low, rest) = piece.split_at(end);
        let _ = write!(out, r#"<tspan dy="{down:.2}" font-size="{small:.2}">{low}</tspan>"#);
        if !rest.is_empty() {
            let _ = write!(out, r#"<tspan dy="-{down:.2}">{rest}</tspan>"#);
        }
    }
    out
}

fn escape(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}
