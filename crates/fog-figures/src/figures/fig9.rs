//! Fig. 9: horizontal visibility by Koschmieder's law in the model and in a linear gradient.

use super::{figure, steps};
use crate::chart::style::PALETTE;
use crate::chart::{Axis, Panel, Row, Series};
use crate::sheet::Sheet;
use crate::{Figure, FiguresError, Sources};
use fog_optics::layer::linear_gradient;
use fog_optics::visibility::koschmieder_m;

/// (altitude in m, σ_t in 1/m of the model, σ_t of the linear gradient) over the highest fog, and its height. The gradient
/// runs from the least to the greatest σ_t of the model, base to top (Sec. 6.1).
pub(crate) fn extinctions(sources: &Sources<'_>) -> Result<(f64, Vec<[f64; 3]>), FiguresError> {
    let height = sources.highest_m();
    let layer = sources.layer(height)?;
    let [least, greatest] = layer.min_max_sigma_t();
    let gradient = linear_gradient(height, least, greatest, 1.0)?;
    let rows = steps(0.0, 1.0, 261).into_iter().map(|zeta| {
        let altitude = zeta * height;
        [altitude, layer.sigma_t_at(altitude), gradient.sigma_t_at(altitude)]
    });
    Ok((height, rows.collect()))
}

/// The altitude of the paper's comparison, 25 m in 260 m (Sec. 6.2).
pub(crate) const COMPARED_ZETA: f64 = 25.0 / 260.0;

pub(crate) fn draw(sources: &Sources<'_>) -> Result<Figure, FiguresError> {
    let (height, rows) = extinctions(sources)?;
    let mut sheet = Sheet::new(&["altitude_m", "visibility_model_m", "visibility_linear_gradient_m"]);
    let (mut model, mut gradient) = (Vec::new(), Vec::new());
    for [altitude, ours, linear] in rows {
        let [ours, linear] = [koschmieder_m(ours), koschmieder_m(linear)];
        sheet.row(&[altitude, ours, linear]);
        model.push([ours, altitude]);
        gradient.push([linear, altitude]);
    }
    let (altitude, there) =
        (COMPARED_ZETA * height, |c: &[[f64; 2]]| c[(COMPARED_ZETA * 260.0).round() as usize][0]);
    let caption = format!(
        "Horizontal visibility by Koschmieder's law with a contrast threshold of 2 %, V = 3.912/σ at 550 nm, in advection fog \
         {height} m thick and in a layer whose σ rises linearly from the model's least to its greatest value. At {altitude:.0} m: \
         {:.0} m in the model, {:.0} m in the gradient. After Fig. 9 of Kolářová, Lachiver & Wilkie 2024.",
        there(&model),
        there(&gradient)
    );
    let x = Axis::from_zero("Horizontal visibility (m)", model.iter().chain(&gradient).map(|p| p[0]));
    let panel = Panel::new(
        "",
        x,
        Axis::linear("Altitude (m)", 0.0, height),
        vec![
            Series::line("model", PALETTE[1], model).width(2.8),
            Series::line("linear gradient", PALETTE[0], gradient).dashed("8 4").width(2.4),
        ],
    );
    Ok(figure(
        "fig9",
        "Visibility of objects by day (Koschmieder)",
        &caption,
        vec![Row::panels(460.0, [panel])],
        sheet,
    ))
}
