//! Optics by altitude.

use super::{figure, steps};
use crate::chart::style::PALETTE;
use crate::chart::{Axis, Panel, Row, Series};
use crate::sheet::Sheet;
use crate::{Figure, FiguresError, Sources};
use fog_optics::state::FogState;

type Quantity = (&'static str, &'static str, fn(&FogState) -> f64);

const QUANTITIES: [Quantity; 4] = [
    ("Extinction coefficient at 550 nm", "σ (1/m)", |s| s.sigma_t_550_1_m),
    ("Liquid water content", "LWC (g/m³)", |s| s.liquid_water_content_g_m3.unwrap_or(f64::NAN)),
    ("Effective radius", "r_eff (µm)", |s| s.effective_radius_um.unwrap_or(f64::NAN)),
    ("Mean cosine of the scattering angle at 550 nm", "g", |s| s.g.unwrap_or(f64::NAN)),
];

pub(crate) fn draw(sources: &Sources<'_>) -> Result<Figure, FiguresError> {
    let mut sheet = Sheet::new(&[
        "height_m",
        "altitude_m",
        "sigma_t_550_1_m",
        "liquid_water_content_g_m3",
        "effective_radius_um",
        "g_550",
    ]);
    let mut curves = [const { Vec::new() }; 4];
    for &height in sources.heights_m() {
        let mut points = [const { Vec::new() }; 4];
        for zeta in steps(0.0, 1.0, 131) {
            let altitude = zeta * height;
            let state = sources.state(height, altitude)?;
            if state.g.is_none() {
                continue; // no droplets there
            }
            let values = QUANTITIES.map(|q| (q.2)(&state));
            sheet.row(&[height, altitude, values[0], values[1], values[2], values[3]]);
            for (points, value) in points.iter_mut().zip(values) {
                points.push([value, altitude]);
            }
        }
        for (curves, points) in curves.iter_mut().zip(points) {
            curves.push((height, points));
        }
    }
    let mut panels = (QUANTITIES.iter().zip(curves).enumerate()).map(|(q, (quantity, curves))| {
        let values = curves.iter().flat_map(|c| c.1.iter().map(|p| p[0]));
        let x = if q < 2 { Axis::from_zero(quantity.1, values) } else { Axis::over(quantity.1, values) };
        let series = curves.into_iter().enumerate().map(|(i, (height, points))| {
            Series::line(&format!("fog of {height} m"), PALETTE[i % PALETTE.len()], points)
        });
        let y = Axis::from_zero("Altitude (m)", [sources.highest_m()]);
        Panel::new(quantity.0, x, y, series.collect())
    });
    let rows = vec![Row::panels(310.0, panels.by_ref().take(2)), Row::panels(310.0, panels)];
    let [first_um, last_um] = sources.model().diameters().range_um();
    let caption = format!(
        "From the model's droplet spectra by Mie series of water, summed over {first_um} to {last_um} µm. Effective radius \
         and g depend on relative altitude alone; extinction and water grow with the number of droplets."
    );
    Ok(figure("profiles", "Optics of advection fog by altitude", &caption, rows, sheet))
}
