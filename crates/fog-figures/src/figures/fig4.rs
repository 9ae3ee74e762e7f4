//! Fig. 4: size distributions by altitude, as a surface and from its side.

use super::{CM3, figure, steps};
use crate::chart::style::ramp;
use crate::chart::{Axis, Block, Panel, Ridges, Row, Series};
use crate::sheet::Sheet;
use crate::{Figure, FiguresError, Sources};

/// Greatest diameter that is drawn, in µm.
const LAST_UM: f64 = 40.0;

/// Surface of n(diameter in µm, altitude in m) in m⁻³ µm⁻¹ over a layer, with the rows that it adds to a CSV
/// `label, altitude_m, diameter_um, density_1_m3_um`.
pub(crate) fn surface(
    heading: &str,
    label: &str,
    height_m: f64,
    z: Axis,
    density: impl Fn(f64, f64) -> f64,
    sheet: &mut Sheet,
) -> Ridges {
    let mut profiles = Vec::new();
    for altitude in steps(0.0, height_m, 27) {
        let mut points = Vec::new();
        for d in steps(0.5, LAST_UM, 159) {
            let n = density(d, altitude);
            sheet.named_row(&[label], &[altitude, d, n]);
            points.push([d, n * CM3]);
        }
        profiles.push((altitude, points));
    }
    let x = Axis::linear("Droplet diameter (µm)", 0.0, LAST_UM);
    Ridges { heading: heading.to_owned(), x, y: Axis::linear("Altitude (m)", 0.0, height_m), z, profiles }
}

/// Columns of the rows that [`surface`] adds.
pub(crate) const COLUMNS: [&str; 4] = ["fog", "altitude_m", "diameter_um", "density_1_m3_um"];

/// The axis of densities that holds these surfaces, each sampled over diameter and relative altitude.
pub(crate) fn density_axis(density: &dyn Fn(f64, f64) -> f64) -> Axis {
    let values = steps(0.0, 1.0, 41)
        .into_iter()
        .flat_map(|zeta| steps(0.5, LAST_UM, 159).into_iter().map(move |d| density(d, zeta) * CM3));
    Axis::from_zero("Droplets (cm⁻³ µm⁻¹)", values)
}

pub(crate) fn draw(sources: &Sources<'_>) -> Result<Figure, FiguresError> {
    let (model, height) = (sources.model(), sources.middle_m());
    let density = |d: f64, altitude: f64| model.density_1_m3_um(d, altitude / height, height);
    let z = density_axis(&|d, zeta| density(d, zeta * height));
    let mut sheet = Sheet::new(&COLUMNS);
    let label = format!("advection {height} m");
    let ridges = surface("Size distributions by altitude", &label, height, z.clone(), density, &mut sheet);

    let sizes = [2.0, 4.0, 6.0, 8.0, 10.0, 12.0, 15.0, 20.0];
    let side = (sizes.iter().enumerate())
        .map(|(i, &d)| {
            let points = steps(0.0, height, 181).into_iter().map(|a| [a, density(d, a) * CM3]).collect();
            Series::line(&format!("{d} µm"), &ramp(i as f64 / 7.0), points)
        })
        .collect();
    let side = Panel::new(
        "Side view: density by altitude at one diameter",
        Axis::linear("Altitude (m)", 0.0, height),
        z,
        side,
    );
    let caption = format!(
        "Droplet spectra of advection fog {height} m thick, one curve each {:.3} m of altitude. After Fig. 4 of Kolářová, \
         Lachiver & Wilkie 2024: the right column, which is the model; the measured spectra of its left column are not \
         public.",
        height / 26.0
    );
    let title = format!("Droplet spectra by altitude in {height} m of fog");
    let rows =
        vec![Row::blocks(470.0, vec![Block::Ridges(ridges)]), Row::panels(300.0, [side]).with_own_legend()];
    Ok(figure("fig4", &title, &caption, rows, sheet))
}
