//! Fig. 7: two fogs as surfaces side by side.

use super::fig4::{COLUMNS, density_axis, surface};
use super::figure;
use crate::chart::{Block, Row};
use crate::sheet::Sheet;
use crate::{Figure, FiguresError, Sources};

pub(crate) fn draw(sources: &Sources<'_>) -> Result<Figure, FiguresError> {
    let model = sources.model();
    let mut sheet = Sheet::new(&COLUMNS);
    let (low, high) = (sources.lowest_m(), sources.highest_m());
    let axis = density_axis(&|d, zeta| model.density_1_m3_um(d, zeta, high));
    let blocks = [low, high].map(|height| {
        let label = format!("advection {height} m");
        let density = |d: f64, altitude: f64| model.density_1_m3_um(d, altitude / height, height);
        let heading = format!("Fog of {height} m");
        Block::Ridges(surface(&heading, &label, height, axis.clone(), density, &mut sheet))
    });
    let rows = vec![Row::blocks(420.0, blocks.into())];
    let caption = "x";
    Ok(figure("fig7", "Two fogs compared", caption, rows, sheet))
}
