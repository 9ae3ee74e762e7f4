//! Curves one behind the other in oblique projection: a surface over two axes.

use super::axis::Axis;
use super::panel::heading;
use super::style::{FRAME, GRID, INK, LABEL, MUTED, TICK, ramp};
use super::svg::{Anchor, Point, Rect, Stroke, Svg};
use super::text;

/// A surface z(x, y) as profiles over x, the nearest first.
#[derive(Clone, Debug)]
pub(crate) struct Ridges {
    pub(crate) heading: String,
    pub(crate) x: Axis,
    /// Runs into the depth of the picture.
    pub(crate) y: Axis,
    /// Upwards.
    pub(crate) z: Axis,
    /// y of each profile, ascending, and its points (x, z).
    pub(crate) profiles: Vec<(f64, Vec<Point>)>,
}

/// Share of the block that the depth axis takes to the right and upwards.
const DEPTH: [f64; 2] = [0.26, 0.44];

impl Ridges {
    pub(crate) fn draw(&self, svg: &mut Svg, outer: Rect) {
        let widest = self.z.ticks.iter().map(|t| text::width(&t.1, TICK)).fold(0.0, f64::max);
        let depth_labels = self.y.ticks.iter().map(|t| text::width(&t.1, TICK)).fold(0.0, f64::max);
        let plot = outer.inset(widest + 32.0, 34.0, depth_labels + 22.0, 46.0);
        heading(svg, outer, plot, &self.heading);
        let (front_w, front_h) = (plot.w * (1.0 - DEPTH[0]), plot.h * (1.0 - DEPTH[1]));
        let project = |tx: f64, ty: f64, tz: f64| -> Point {
            [
                plot.x + front_w * tx + plot.w * DEPTH[0] * ty,
                plot.bottom() - front_h * tz - plot.h * DEPTH[1] * ty,
            ]
        };
        self.draw_box(svg, &project);

        // From the far end to the near one, so that near profiles hide far ones.
        for (y, points) in self.profiles.iter().rev() {
            let Some(ty) = self.y.place(*y) else { continue };
            let top: Vec<Point> = (points.iter())
                .filter_map(|&[x, z]| Some(project(self.x.place(x)?, ty, self.z.place(z)?)))
                .collect();
            let (Some(first), Some(last)) = (points.first(), points.last()) else { continue };
            let mut outline = top.clone();
            for x in [last[0], first[0]] {
                if let Some(tx) = self.x.place(x) {
                    outline.push(project(tx, ty, 0.0));
                }
            }
            let colour = ramp(ty);
            svg.polygon(&outline, "#ffffff", 0.8);
            svg.polygon(&outline, &colour, 0.22);
            let top: Vec<Option<Point>> = top.into_iter().map(Some).collect();
            svg.polyline(&top, &Stroke::new(&colour, 1.5));
        }
    }

    /// Floor with its grid, back walls, ticks and labels.
    fn draw_box(&self, svg: &mut Svg, project: &dyn Fn(f64, f64, f64) -> Point) {
        let (grid, tick) = (Stroke::new(GRID, 1.0), Stroke::new(FRAME, 1.0));
        for (value, label) in &self.x.ticks {
            let Some(t) = self.x.place(*value) else { continue };
            svg.line(project(t, 0.0, 0.0), project(t, 1.0, 0.0), &grid);
            svg.line(project(t, 1.0, 0.0), project(t, 1.0, 1.0), &grid);
            let [px, py] = project(t, 0.0, 0.0);
            svg.line([px, py], [px, py + 5.0], &tick);
            svg.text([px, py + 19.0], label, TICK, MUTED, Anchor::Middle);
        }
        for (value, label) in &self.y.ticks {
            let Some(t) = self.y.place(*value) else { continue };
            svg.line(project(0.0, t, 0.0), project(1.0, t, 0.0), &grid);
            let [px, py] = project(1.0, t, 0.0);
            svg.line([px, py], [px + 5.0, py], &tick);
            svg.text([px + 9.0, py + 4.3], label, TICK, MUTED, Anchor::Start);
        }
        for (value, label) in &self.z.ticks {
            let Some(t) = self.z.place(*value) else { continue };
            svg.line(project(0.0, 1.0, t), project(1.0, 1.0, t), &grid);
            svg.line(project(0.0, 0.0, t), project(0.0, 1.0, t), &grid);
            let [px, py] = project(0.0, 0.0, t);
            svg.line([px - 5.0, py], [px, py], &tick);
            svg.text([px - 8.0, py + 4.3], label, TICK, MUTED, Anchor::End);
        }
        let edges = [
            ([0.0, 0.0, 0.0], [1.0, 0.0, 0.0]),
            ([1.0, 0.0, 0.0], [1.0, 1.0, 0.0]),
            ([0.0, 0.0, 0.0], [0.0, 0.0, 1.0]),
            ([0.0, 0.0, 1.0], [0.0, 1.0, 1.0]),
            ([0.0, 1.0, 1.0], [1.0, 1.0, 1.0]),
            ([1.0, 1.0, 0.0], [1.0, 1.0, 1.0]),
        ];
        for ([ax, ay, az], [bx, by, bz]) in edges {
            svg.line(project(ax, ay, az), project(bx, by, bz), &tick);
        }
        let [px, py] = project(0.5, 0.0, 0.0);
        svg.text([px, py + 40.0], &self.x.label, LABEL, INK, Anchor::Middle);
        let widest = self.z.ticks.iter().map(|t| text::width(&t.1, TICK)).fold(0.0, f64::max);
        let [px, py] = project(0.0, 0.0, 0.5);
        svg.upward_text([px - widest - 17.0, py], &self.z.label, LABEL);
        // The depth axis's words stand under its middle, right of the floor.
        let [px, py] = project(1.0, 0.0, 0.0);
        svg.text([px + 34.0, py - 2.0], &self.y.label, LABEL, INK, Anchor::Start);
    }
}
