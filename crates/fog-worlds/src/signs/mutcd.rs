//! Signs after MUTCD (2009): R1-1 30 in, R1-2 36 in, R2-1 24 × 30 in, R5-1 30 in, W11-2 30 in, D3-1.

use super::Sign;
use super::colours::{BLACK, GREEN, RED, WHITE, YELLOW};
use super::panel::{Panel, regular, round_polygon, rounded};
use super::symbols::walker;
use crate::picture::Area;

const INCH: f32 = 0.0254;

pub(super) fn draw(sign: &Sign) -> Panel {
    match sign {
        Sign::Stop => {
            // 30 in between parallel edges: the circle around has 1/cos 22.5° of that.
            let d = 30.0 * INCH / 0.9239;
            Panel::regular("STOP".into(), d, 8, 22.5, WHITE)
                .fill(&Area::Polygon(regular(0.5 * d, 0.475 * d, 8, 22.5)), RED)
                .write("STOP", [0.5 * d, 0.5 * d], 8.0 * INCH, WHITE)
        }
        Sign::Yield => {
            let (w, h) = (36.0 * INCH, 31.2 * INCH);
            let triangle = |inset: f32| {
                let x = inset * 1.732;
                [[0.5 * w, 2.0 * inset], [w - x, h - inset], [x, h - inset]]
            };
            Panel::new("YIELD".into(), [w, h], round_polygon(&triangle(0.0), 0.05), RED, 1.0)
                .fill(&Area::Polygon(round_polygon(&triangle(0.11), 0.02)), WHITE)
                .write("YIELD", [0.5 * w, 0.79 * h], 0.075, RED)
        }
        Sign::Limit(limit) => {
            let (w, h) = (24.0 * INCH, 30.0 * INCH);
            framed(&format!("SPEED LIMIT {limit}"), [w, h], WHITE, BLACK)
                .write("SPEED", [0.5 * w, 0.83 * h], 4.0 * INCH, BLACK)
                .write("LIMIT", [0.5 * w, 0.65 * h], 4.0 * INCH, BLACK)
                .write(&limit.to_string(), [0.5 * w, 0.3 * h], 10.0 * INCH, BLACK)
        }
        Sign::NoEntry => {
            let w = 30.0 * INCH;
            Panel::rectangle("DO NOT ENTER".into(), [w; 2], 0.03, WHITE)
                .fill(&Area::Disc([0.5 * w; 2], 0.48 * w), RED)
                .fill(&Area::rectangle([0.13 * w, 0.43 * w], [0.87 * w, 0.57 * w]), WHITE)
                .write("DO NOT", [0.5 * w, 0.68 * w], 0.11 * w, WHITE)
                .write("ENTER", [0.5 * w, 0.32 * w], 0.11 * w, WHITE)
        }
        Sign::Crossing => {
            let d = 30.0 * INCH * core::f32::consts::SQRT_2;
            let mut panel = Panel::regular("pedestrian".into(), d, 4, 0.0, YELLOW);
            let line: Vec<[f32; 2]> = regular(0.5 * d, 0.46 * d, 4, 0.0);
            let closed = line.iter().chain(&line[..1]).copied().collect();
            panel = panel.fill(&Area::Lines(vec![closed], 0.012 * d), BLACK);
            for part in walker([0.5 * d; 2], 0.5 * d) {
                panel = panel.fill(&part, BLACK);
            }
            panel
        }
        Sign::Parking => {
            let (w, h) = (12.0 * INCH, 18.0 * INCH);
            framed("NO PARKING", [w, h], WHITE, RED).write("NO", [0.5 * w, 0.68 * h], 0.1, RED).write(
                "PARKING",
                [0.5 * w, 0.38 * h],
                0.042,
                RED,
            )
        }
        Sign::Priority => framed("ONE WAY", [36.0 * INCH, 12.0 * INCH], BLACK, WHITE).write(
            "ONE WAY",
            [18.0 * INCH, 6.0 * INCH],
            4.5 * INCH,
            WHITE,
        ),
        Sign::Name(name) => {
            let (w, h) = (crate::font::width(name, 6.0 * INCH) + 0.2, 9.0 * INCH);
            framed(name, [w, h], GREEN, WHITE).write(name, [0.5 * w, 0.5 * h], 5.0 * INCH, WHITE)
        }
        Sign::Destination(rows) => super::panel_of_rows(rows, GREEN),
    }
}

/// A rectangle with a thin line along its edge.
fn framed(name: &str, size: [f32; 2], colour: [f32; 3], line: [f32; 3]) -> Panel {
    let edge = 0.5 * INCH;
    Panel::rectangle(name.to_owned(), size, 1.5 * INCH, colour)
        .fill(&Area::Polygon(rounded(size, edge, 1.2 * INCH)), line)
        .fill(&Area::Polygon(rounded(size, 2.0 * edge, 1.0 * INCH)), colour)
}
