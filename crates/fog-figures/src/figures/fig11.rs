//! Fig. 11: how far lights are seen at night by Allard's law, in the model and in a linear gradient.

use super::fig9::extinctions;
use super::figure;
use crate::chart::style::PALETTE;
use crate::chart::{Axis, Panel, Row, Series};
use crate::sheet::Sheet;
use crate::{Figure, FiguresError, Sources};
use fog_optics::visibility::threshold::NIGHT;
use fog_optics::visibility::{PAPER_INTENSITIES_CD, allard_m};

pub(crate) fn draw(sources: &Sources<'_>) -> Result<Figure, FiguresError> {
    let (height, rows) = extinctions(sources)?;
    let mut sheet =
        Sheet::new(&["intensity_cd", "altitude_m", "visibility_model_m", "visibility_linear_gradient_m"]);
    let (mut series, mut all) = (Vec::new(), Vec::new());
    for (i, intensity) in PAPER_INTENSITIES_CD.into_iter().enumerate().rev() {
        let (mut model, mut gradient) = (Vec::new(), Vec::new());
        for &[altitude, ours, linear] in &rows {
            let [ours, linear] = [ours, linear].map(|sigma| allard_m(intensity, NIGHT.illuminance_lx, sigma));
            sheet.row(&[intensity, altitude, ours, linear]);
            model.push([ours, altitude]);
            gradient.push([linear, altitude]);
            all.extend([ours, linear]);
        }
        let colour = PALETTE[[2, 0, 1][i]];
        series.push(Series::line(&format!("{intensity} cd, model"), colour, model).width(2.6));
        series.push(
            Series::line(&format!("{intensity} cd, linear gradient of σ"), colour, gradient).dashed("8 4"),
        );
    }
    let caption = format!(
        "Distance at which a light is just seen at night by Allard's law, E = I exp(−σV)/V², with a threshold of {:e} lx \
         ({}; the paper does not print its own), in advection fog {height} m thick and in a layer whose σ rises linearly from \
         the model's least to its greatest value. After Fig. 11 of Kolářová, Lachiver & Wilkie 2024.",
        NIGHT.illuminance_lx, NIGHT.source
    );
    let panel = Panel::new(
        "",
        Axis::from_zero("Distance at which the light is seen (m)", all),
        Axis::linear("Altitude (m)", 0.0, height),
        series,
    );
    Ok(figure(
        "fig11",
        "Visibility of lights at night (Allard)",
        &caption,
        vec![Row::panels(460.0, [panel])],
        sheet,
    ))
}
