//! Charts as SVG: axes, panels, surfaces, strips of colour, pages.

mod axis;
mod legend;
mod page;
mod panel;
mod ridges;
mod strips;
pub(crate) mod style;
mod svg;
mod text;

pub(crate) use axis::Axis;
pub(crate) use page::{Block, Page, Row};
pub(crate) use panel::{Panel, Series};
pub(crate) use ridges::Ridges;
pub(crate) use strips::Strips;
pub(crate) use text::scientific;
