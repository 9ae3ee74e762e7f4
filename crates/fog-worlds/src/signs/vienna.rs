//! Signs after the Vienna Convention; sizes of the usual kind in Germany: circles 600 mm, triangles 900 mm, octagon 900 mm.

use super::Sign;
use super::colours::{BLACK, BLUE, RED, WHITE, YELLOW};
use super::panel::{Panel, regular, round_polygon, rounded};
use super::symbols::walker;
use crate::picture::Area;

const CIRCLE: f32 = 0.6;
const TRIANGLE: f32 = 0.9;
const SQUARE: f32 = 0.6;

pub(super) fn draw(sign: &Sign) -> Panel {
    let mid = 0.5 * CIRCLE;
    match sign {
        Sign::Stop => {
            let d = 0.9;
            Panel::regular("stop".into(), d, 8, 22.5, WHITE)
                .fill(&Area::Polygon(regular(0.5 * d, 0.47 * d, 8, 22.5)), RED)
                .write("STOP", [0.5 * d, 0.5 * d], 0.24 * d, WHITE)
        }
        Sign::Yield => {
            let (w, h) = (TRIANGLE, 0.866 * TRIANGLE);
            let triangle = |inset: f32| {
                let x = inset * 1.732;
                [[0.5 * w, 2.0 * inset], [w - x, h - inset], [x, h - inset]]
            };
            let name = "yield".to_owned();
            Panel::new(name, [w, h], round_polygon(&triangle(0.0), 0.04), RED, 1.0)
                .fill(&Area::Polygon(round_polygon(&triangle(0.075), 0.02)), WHITE)
        }
        Sign::Priority => {
            let diamond =
                |r: f32| Area::Polygon(regular(0.5, r, 4, 0.0).iter().map(|p| p.map(|c| c * 0.8)).collect());
            Panel::regular("priority".into(), 0.8, 4, 0.0, BLACK)
                .fill(&diamond(0.485), WHITE)
                .fill(&diamond(0.34), YELLOW)
        }
        Sign::Limit(limit) => Panel::regular(format!("limit {limit}"), CIRCLE, 40, 0.0, RED)
            .fill(&Area::Disc([mid; 2], 0.385 * CIRCLE), WHITE)
            .write(&limit.to_string(), [mid; 2], 0.42 * CIRCLE * if *limit > 99 { 0.8 } else { 1.0 }, BLACK),
        Sign::NoEntry => Panel::regular("no entry".into(), CIRCLE, 40, 0.0, RED)
            .fill(&Area::rectangle([0.14 * CIRCLE, 0.42 * CIRCLE], [0.86 * CIRCLE, 0.58 * CIRCLE]), WHITE),
        Sign::Crossing => {
            let s = SQUARE;
            let triangle =
                round_polygon(&[[0.1 * s, 0.14 * s], [0.9 * s, 0.14 * s], [0.5 * s, 0.86 * s]], 0.02);
            let mut panel =
                Panel::rectangle("crossing".into(), [s; 2], 0.03, BLUE).fill(&Area::Polygon(triangle), WHITE);
            for part in walker([0.5 * s, 0.43 * s], 0.48 * s) {
                panel = panel.fill(&part, BLACK);
            }
            let stripes = (0..5).map(|k| {
                let x = (0.26 + 0.12 * k as f32) * s;
                vec![[x - 0.02 * s, 0.17 * s], [x + 0.02 * s, 0.21 * s]]
            });
            panel.fill(&Area::Lines(stripes.collect(), 0.018 * s), BLACK)
        }
        Sign::Parking => Panel::rectangle("parking".into(), [SQUARE; 2], 0.03, WHITE)
            .fill(&Area::Polygon(rounded([SQUARE; 2], 0.02, 0.02)), BLUE)
            .write("P", [0.5 * SQUARE; 2], 0.62 * SQUARE, WHITE),
        Sign::Name(name) => {
            let (w, h) = (crate::font::width(name, 0.12) + 0.16, 0.2);
            Panel::rectangle(format!("name {name}"), [w, h], 0.01, BLUE).write(
                name,
                [0.5 * w, 0.5 * h],
                0.12,
                WHITE,
            )
        }
        Sign::Destination(rows) => super::panel_of_rows(rows, BLUE),
    }
}
