//! Fig. 7: the model's surface beside that of another fog.

use super::figure;
use super::surface::{COLUMNS, Surface};
use crate::chart::{Block, Row};
use crate::sheet::Sheet;
use crate::{Figure, FiguresError, Sources};
use fog_optics::catalogue;

/// The fog of the literature that the model stands beside.
const OTHER: &str = "shettle_fenn_advection_heavy";
/// It reaches further than the model.
const LAST_UM: f64 = 60.0;

pub(crate) fn draw(sources: &Sources<'_>) -> Result<Figure, FiguresError> {
    let (model, height) = (sources.model(), sources.middle_m());
    let other = catalogue::named(OTHER)?;
    let mut sheet = Sheet::new(&COLUMNS);
    let model_density = |d: f64, altitude: f64| model.density_1_m3_um(d, altitude / height, height);
    let other_density = |d: f64, _: f64| other.number_density_1_m3 * other.distribution.density_1_um(d);
    let mut block = |heading: &str, fog: &str, density: &dyn Fn(f64, f64) -> f64| {
        let surface = Surface { heading, fog, height_m: height, last_um: LAST_UM, density };
        Block::Ridges(surface.ridges(&mut sheet))
    };
    let blocks = vec![
        block(&format!("The model, {height} m"), &format!("advection {height} m"), &model_density),
        block("Shettle & Fenn's heavy advection fog", OTHER, &other_density),
    ];
    let caption = format!(
        "Left: the model. Right: {} ({}), {:.0} droplets per cm³, the same at every altitude, as fogs of the literature are. Mind \
         the scales: fewer but larger droplets there. After Fig. 7 of Kolářová, Lachiver & Wilkie 2024, which compares fits to \
         measurements at Arcata and Vandenberg that are not public.",
        other.description,
        other.source,
        1e-6 * other.number_density_1_m3
    );
    let title = format!("Droplet spectra by altitude: {height} m of the model and a uniform fog");
    Ok(figure("fig7", &title, &caption, vec![Row::blocks(430.0, blocks)], sheet))
}
