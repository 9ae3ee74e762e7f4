//! Fig. 3: a size distribution and the two curves that it is the sum of.

use super::{CM3, figure, steps};
use crate::chart::style::PALETTE;
use crate::chart::{Axis, Panel, Row, Series};
use crate::sheet::Sheet;
use crate::{Figure, FiguresError, Sources};
use fog_optics::distribution::{gaussian, lognormal};

const ZETA: f64 = 0.5;

pub(crate) fn draw(sources: &Sources<'_>) -> Result<Figure, FiguresError> {
    let (model, height) = (sources.model(), sources.lowest_m());
    let shape = model.shape(ZETA);
    let n = model.number_density_1_m3(ZETA, height);
    let (l, g) = (n / (1.0 + shape.gl_ratio), n * shape.gl_ratio / (1.0 + shape.gl_ratio));
    let mut sheet = Sheet::new(&["diameter_um", "lognormal_1_m3_um", "gaussian_1_m3_um", "sum_1_m3_um"]);
    let mut curves = [const { Vec::new() }; 3];
    for d in steps(0.5, 40.0, 396) {
        let parts = [l * lognormal(d, shape.mu_l, shape.sigma_l), g * gaussian(d, shape.mu_g, shape.sigma_g)];
        let values = [parts[0], parts[1], parts[0] + parts[1]];
        sheet.row(&[d, values[0], values[1], values[2]]);
        for (curve, value) in curves.iter_mut().zip(values) {
            curve.push([d, value * CM3]);
        }
    }
    let [logn, gauss, sum] = curves;
    let y = Axis::from_zero("Droplets (cm⁻³ µm⁻¹)", sum.iter().map(|p| p[1]));
    let panel = Panel::new(
        "",
        Axis::linear("Droplet diameter (µm)", 0.0, 40.0),
        y,
        vec![
            Series::line("lognormal part", PALETTE[2], logn).dashed("7 4"),
            Series::line("Gaussian part", PALETTE[0], gauss).dashed("7 4"),
            Series::line("sum: the size distribution", PALETTE[1], sum).width(2.8),
        ],
    );
    let caption = format!(
        "Advection fog of {height} m at {} m (ζ = {ZETA}): L = {:.3}·10⁸ m⁻³, μ_L = {:.2}, σ_L = {:.2}; G = {:.3}·10⁸ m⁻³, \
         μ_G = {:.2} µm, σ_G = {:.2} µm. After Fig. 3 of Kolářová, Lachiver & Wilkie 2024 (Eq. 1–3); the measurements \
         in it are not public. The paper prints L = 1.99·10⁸ and G = 3.89·10⁸ m⁻³; tables/advection/arcata.yaml says why the \
         shipped model has a third of them.",
        ZETA * height,
        l / 1e8,
        shape.mu_l,
        shape.sigma_l,
        g / 1e8,
        shape.mu_g,
        shape.sigma_g
    );
    let title = "A droplet spectrum is a lognormal and a Gaussian curve";
    Ok(figure("fig3", title, &caption, vec![Row::panels(420.0, [panel])], sheet))
}
