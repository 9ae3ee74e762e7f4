//! Fig. 6: size distributions at two altitudes of one fog.

use super::{CM3, figure, steps};
use crate::chart::style::PALETTE;
use crate::chart::{Axis, Panel, Row, Series};
use crate::sheet::Sheet;
use crate::{Figure, FiguresError, Sources};
use fog_optics::distribution::{gaussian, lognormal};

/// The paper's 50 m and 100 m of 180 m.
const ZETAS: [f64; 2] = [50.0 / 180.0, 100.0 / 180.0];

pub(crate) fn draw(sources: &Sources<'_>) -> Result<Figure, FiguresError> {
    let (model, height) = (sources.model(), sources.middle_m());
    let mut sheet = Sheet::new(&["height_m", "altitude_m", "diameter_um", "density_1_m3_um"]);
    let mut curves = Vec::new();
    for zeta in ZETAS {
        let (shape, n) = (model.shape(zeta), model.number_density_1_m3(zeta, height));
        let part = n / (1.0 + shape.gl_ratio) * CM3;
        let (mut sum, mut logn, mut gauss) = (Vec::new(), Vec::new(), Vec::new());
        for d in steps(0.5, 40.0, 396) {
            let density = model.density_1_m3_um(d, zeta, height);
            sheet.row(&[height, zeta * height, d, density]);
            sum.push([d, density * CM3]);
            logn.push([d, part * lognormal(d, shape.mu_l, shape.sigma_l)]);
            gauss.push([d, part * shape.gl_ratio * gaussian(d, shape.mu_g, shape.sigma_g)]);
        }
        curves.push((zeta, [sum, logn, gauss]));
    }
    let top = curves.iter().flat_map(|c| c.1[0].iter().map(|p| p[1])).fold(0.0, f64::max);
    let panels = curves.into_iter().map(|(zeta, [sum, logn, gauss])| {
        Panel::new(
            &format!("{:.0} m above the base (ζ = {zeta:.2})", zeta * height),
            Axis::linear("Droplet diameter (µm)", 0.0, 40.0),
            Axis::from_zero("Droplets (cm⁻³ µm⁻¹)", [top]),
            vec![
                Series::line("model", PALETTE[1], sum).width(2.8),
                Series::line("its lognormal part", PALETTE[2], logn).dashed("7 4").width(1.4),
                Series::line("its Gaussian part", PALETTE[0], gauss).dashed("7 4").width(1.4),
            ],
        )
    });
    let rows = vec![Row::panels(360.0, panels)];
    let caption = format!(
        "Droplet spectra of advection fog {height} m thick. After Fig. 6 of Kolářová, Lachiver & Wilkie 2024, which shows \
         the model's curves with fits to measurements at Arcata and Vandenberg that are not public."
    );
    Ok(figure(
        "fig6",
        &format!("Droplet spectra at two altitudes in {height} m of fog"),
        &caption,
        rows,
        sheet,
    ))
}
