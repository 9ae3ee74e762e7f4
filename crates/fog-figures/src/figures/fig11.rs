//! Fig. 11: how far lights are seen at night by Allard's law, in the model and in a linear gradient.

use super::fig9::extinctions;
use super::figure;
use crate::chart::style::PALETTE;
use crate::chart::{Axis, Panel, Row, Series, scientific};
use crate::sheet::Sheet;
use crate::{Figure, FiguresError, Sources};
use fog_optics::visibility::threshold::NIGHT;
use fog_optics::visibility::{PAPER_INTENSITIES_CD, allard_m};

pub(crate) fn draw(sources: &Sources<'_>) -> Result<Figure, FiguresError> {
    let (height, rows) = extinctions(sources)?;
    let mut sheet =
        Sheet::new(&["intensity_cd", "altitude_m", "visibility_model_m", "visibility_linear_gradient_m"]);
    let (mut ours, mut gradients, mut all) = (Vec::new(), Vec::new(), Vec::new());
    for (i, intensity) in PAPER_INTENSITIES_CD.into_iter().enumerate() {
        let (mut model, mut gradient) = (Vec::new(), Vec::new());
        for &[altitude, of_model, linear] in &rows {
            let seen = [of_model, linear].map(|sigma| allard_m(intensity, NIGHT.illuminance_lx, sigma));
            sheet.row(&[intensity, altitude, seen[0], seen[1]]);
            model.push([seen[0], altitude]);
            gradient.push([seen[1], altitude]);
            all.extend(seen);
        }
        let colour = PALETTE[[2, 0, 1][i % 3]];
        ours.push(Series::line(&format!("model, {intensity} cd"), colour, model).width(2.6));
        gradients
            .push(Series::line(&format!("linear gradient, {intensity} cd"), colour, gradient).dashed("8 4"));
    }
    let caption = format!(
        "Distance V at which a light of intensity I is just seen at night by Allard's law, E = I exp(−σV)/V², with a threshold E of \
         {} lx ({}; the paper does not print its own), in advection fog {height} m thick and in a layer whose σ rises linearly \
         from the model's least to its greatest value. After Fig. 11 of Kolářová, Lachiver & Wilkie 2024.",
        scientific(NIGHT.illuminance_lx),
        NIGHT.source
    );
    ours.extend(gradients);
    let panel = Panel::new(
        "",
        Axis::from_zero("Distance at which the light is seen (m)", all),
        Axis::linear("Altitude (m)", 0.0, height),
        ours,
    );
    Ok(figure(
        "fig11",
        "Visibility of lights at night (Allard)",
        &caption,
        vec![Row::panels(460.0, [panel])],
        sheet,
    ))
}
