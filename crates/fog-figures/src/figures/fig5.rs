//! Fig. 5: number density by altitude.

use super::{CM3, figure, steps};
use crate::chart::style::PALETTE;
use crate::chart::{Axis, Panel, Row, Series};
use crate::sheet::Sheet;
use crate::{Figure, FiguresError, Sources};

pub(crate) fn draw(sources: &Sources<'_>) -> Result<Figure, FiguresError> {
    let model = sources.model();
    let mut sheet = Sheet::new(&["height_m", "altitude_m", "number_density_1_m3"]);
    let (mut series, mut all) = (Vec::new(), Vec::new());
    for (i, &height) in sources.heights_m().iter().enumerate() {
        let mut points = Vec::new();
        for zeta in steps(0.0, 1.0, 131) {
            let n = model.number_density_1_m3(zeta, height);
            sheet.row(&[height, zeta * height, n]);
            points.push([n * CM3, zeta * height]);
        }
        all.extend(points.iter().map(|p| p[0]));
        series
            .push(Series::line(&format!("fog of {height} m"), PALETTE[i % PALETTE.len()], points).width(2.4));
    }
    let panel = Panel::new(
        "",
        Axis::from_zero("Number density of droplets (cm⁻³)", all),
        Axis::from_zero("Altitude (m)", [sources.highest_m()]),
        series,
    );
    let caption = "Number of droplets per cm³ (10⁶ per m³) by altitude, N(ζ, H) of the model's scaling matrix. After Fig. 5 \
                   of Kolářová, Lachiver & Wilkie 2024, which shows the model's curve for 180 m with measurements at \
                   Vandenberg that are not public.";
    Ok(figure(
        "fig5",
        "Number density of droplets by altitude",
        caption,
        vec![Row::panels(460.0, [panel])],
        sheet,
    ))
}
