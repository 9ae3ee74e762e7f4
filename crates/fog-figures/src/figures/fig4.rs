//! Fig. 4: size distributions by altitude, as a surface and from its side.

use super::surface::{COLUMNS, CURVES, Surface};
use super::{CM3, figure, steps};
use crate::chart::style::ramp;
use crate::chart::{Axis, Block, Panel, Row, Series};
use crate::sheet::Sheet;
use crate::{Figure, FiguresError, Sources};

pub(crate) fn draw(sources: &Sources<'_>) -> Result<Figure, FiguresError> {
    let (model, height) = (sources.model(), sources.middle_m());
    let density = |d: f64, altitude: f64| model.density_1_m3_um(d, altitude / height, height);
    let mut sheet = Sheet::new(&COLUMNS);
    let surface = Surface {
        heading: "Size distributions by altitude",
        fog: &format!("advection {height} m"),
        height_m: height,
        last_um: 40.0,
        density: &density,
    };
    let ridges = surface.ridges(&mut sheet);

    let sizes = [2.0, 4.0, 6.0, 8.0, 10.0, 12.0, 15.0];
    let side = (sizes.iter().enumerate())
        .map(|(i, &d)| {
            let points = steps(0.0, height, 181).into_iter().map(|a| [a, density(d, a) * CM3]).collect();
            Series::line(&format!("{d} µm"), &ramp(i as f64 / 6.0), points)
        })
        .collect();
    let z = ridges.z.clone();
    let side = Panel::new(
        "Side view: density by altitude at one diameter",
        Axis::linear("Altitude (m)", 0.0, height),
        z,
        side,
    );
    let caption = format!(
        "Droplet spectra of advection fog {height} m thick, one curve every {:.1} m. After Fig. 4 of Kolářová, \
         Lachiver & Wilkie 2024: the right column, which is the model; the measured spectra of its left column are not \
         public.",
        height / (CURVES - 1) as f64
    );
    let title = format!("Droplet spectra by altitude in {height} m of fog");
    let rows =
        vec![Row::blocks(470.0, vec![Block::Ridges(ridges)]), Row::panels(300.0, [side]).with_own_legend()];
    Ok(figure("fig4", &title, &caption, rows, sheet))
}
