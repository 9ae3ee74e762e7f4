//! From SVG to PNG.

use crate::FiguresError;
use resvg::tiny_skia::{Color, Pixmap, Transform};
use resvg::usvg::{Options, Tree};

/// DejaVu Sans reduced to the characters that figures use; its licence is beside it.
pub(crate) const FONT: &[u8] = include_bytes!("../fonts/DejaVuSans-subset.ttf");

/// Width of PNG pictures in pixels.
pub const WIDTH_PX: u32 = 1600;

/// PNG bytes of an SVG text, [`WIDTH_PX`] wide; text in the embedded font whatever the system has.
pub(crate) fn png(svg: &str) -> Result<Vec<u8>, FiguresError> {
    let fault = |e: &dyn std::fmt::Display| FiguresError::Raster(e.to_string());
    let mut options = Options::default();
    options.fontdb_mut().load_font_data(FONT.to_vec());
    options.fontdb_mut().set_sans_serif_family("DejaVu Sans");
    let tree = Tree::from_str(svg, &options).map_err(|e| fault(&e))?;
    let scale = WIDTH_PX as f32 / tree.size().width();
    let height = (tree.size().height() * scale).round() as u32;
    let mut pixmap = Pixmap::new(WIDTH_PX, height).ok_or_else(|| fault(&"it is empty"))?;
    pixmap.fill(Color::WHITE);
    resvg::render(&tree, Transform::from_scale(scale, scale), &mut pixmap.as_mut());
    pixmap.encode_png().map_err(|e| fault(&e))
}
