//! A page: title, legend, blocks in a grid, caption.

use super::legend::{self, Key};
use super::panel::Panel;
use super::ridges::Ridges;
use super::strips::Strips;
use super::style::{CAPTION, INK, MUTED, TITLE};
use super::svg::{Anchor, Rect, Svg};
use super::text;

/// Width of every page in px; a PNG has more pixels ([`crate::raster`]).
pub(crate) const WIDTH: f64 = 1000.0;
const MARGIN: f64 = 22.0;
const GAP: f64 = 14.0;

/// What a cell of the page shows.
#[derive(Clone, Debug)]
pub(crate) enum Block {
    Panel(Panel),
    Ridges(Ridges),
    Strips(Strips),
}

impl Block {
    fn keys(&self) -> Vec<Key> {
        match self {
            Self::Panel(panel) => panel.keys(),
            Self::Ridges(_) | Self::Strips(_) => Vec::new(),
        }
    }

    fn draw(&self, svg: &mut Svg, outer: Rect) {
        match self {
            Self::Panel(panel) => panel.draw(svg, outer),
            Self::Ridges(ridges) => ridges.draw(svg, outer),
            Self::Strips(strips) => strips.draw(svg, outer),
        }
    }
}

/// Blocks side by side, of equal width and one height.
#[derive(Clone, Debug)]
pub(crate) struct Row {
    height: f64,
    blocks: Vec<Block>,
    /// One legend for the row; without, its labels belong to the page's legend.
    own_legend: bool,
    /// Number of blocks that the width is divided by.
    columns: usize,
}

impl Row {
    pub(crate) fn panels(height: f64, panels: impl IntoIterator<Item = Panel>) -> Self {
        Self::blocks(height, panels.into_iter().map(Block::Panel).collect())
    }

    pub(crate) fn blocks(height: f64, blocks: Vec<Block>) -> Self {
        Self { height, columns: blocks.len(), blocks, own_legend: false }
    }

    /// Gives each block the width of a row of so many, so that a row that is not full stays aligned with others.
    pub(crate) fn in_columns(mut self, columns: usize) -> Self {
        self.columns = columns;
        self
    }

    pub(crate) fn with_own_legend(mut self) -> Self {
        self.own_legend = true;
        self
    }

    fn keys(&self) -> Vec<Key> {
        legend::distinct(self.blocks.iter().flat_map(Block::keys))
    }
}

/// A whole figure.
#[derive(Clone, Debug)]
pub(crate) struct Page<'a> {
    pub(crate) title: &'a str,
    pub(crate) caption: &'a str,
    pub(crate) rows: Vec<Row>,
}

impl Page<'_> {
    /// The page as an SVG document, as high as its content.
    pub(crate) fn svg(&self) -> String {
        let (mut svg, inner) = (Svg::default(), WIDTH - 2.0 * MARGIN);
        let mut y = MARGIN + TITLE;
        svg.text([MARGIN, y], self.title, TITLE, INK, Anchor::Start);
        y += 16.0;
        let shared = self.rows.iter().filter(|row| !row.own_legend).flat_map(Row::keys);
        y = draw_legend(&mut svg, y, &legend::distinct(shared));
        for row in &self.rows {
            if row.own_legend {
                y = draw_legend(&mut svg, y + 6.0, &row.keys());
            }
            let count = row.columns as f64;
            let w = (inner - GAP * (count - 1.0)) / count;
            for (i, block) in row.blocks.iter().enumerate() {
                block.draw(&mut svg, Rect { x: MARGIN + i as f64 * (w + GAP), y, w, h: row.height });
            }
            y += row.height + 4.0;
        }
        y += 10.0;
        for line in text::wrap(self.caption, CAPTION, inner) {
            y += CAPTION * 1.4;
            svg.text([MARGIN, y], &line, CAPTION, MUTED, Anchor::Start);
        }
        svg.finish(WIDTH, (y + MARGIN).ceil(), self.title, self.caption)
    }
}

/// Draws a legend over the page's width and returns where it ends.
fn draw_legend(svg: &mut Svg, y: f64, keys: &[Key]) -> f64 {
    let (left, limit) = (MARGIN + 4.0, WIDTH - 2.0 * MARGIN - 8.0);
    legend::draw(svg, [left, y], keys, limit);
    y + legend::height(keys, limit)
}
