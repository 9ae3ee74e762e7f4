//! Extinction, absorption and mean cosine by wavelength.

use super::{figure, steps};
use crate::chart::style::ramp;
use crate::chart::{Axis, Panel, Row, Series};
use crate::sheet::Sheet;
use crate::{Figure, FiguresError, Sources};
use fog_optics::distribution::DiameterGrid;
use fog_optics::size::SizeDistribution;

const ZETAS: [f64; 4] = [0.0, 0.5, 0.75, 1.0];
/// Diameters of a sum: more than the tables have, and at equal ratios, so that the sharp resonances of single droplets do not
/// recur from wavelength to wavelength.
const DIAMETERS: usize = 1200;
/// Lines of lidars, in nm.
const LIDARS_NM: [f64; 2] = [905.0, 1550.0];

pub(crate) fn draw(sources: &Sources<'_>) -> Result<Figure, FiguresError> {
    let (model, height) = (sources.model(), sources.middle_m());
    let mut sheet =
        Sheet::new(&["height_m", "altitude_m", "wavelength_nm", "sigma_t_1_m", "sigma_s_1_m", "albedo", "g"]);
    let mut curves = [const { Vec::new() }; 3];
    let [first_um, last_um] = model.diameters().range_um();
    for zeta in ZETAS {
        let n = model.number_density_1_m3(zeta, height);
        let grid = DiameterGrid::geometric(first_um, last_um, DIAMETERS)?;
        let spectrum = SizeDistribution::lognormal_gaussian(model.shape(zeta), grid)?;
        let mut points = [const { Vec::new() }; 3];
        for nm in steps(300.0, 2500.0, 89) {
            let optics = spectrum.optics(nm)?;
            let albedo = optics.c_sca_m2 / optics.c_ext_m2;
            let (sigma_t, sigma_s) = (n * optics.c_ext_m2, n * optics.c_sca_m2);
            sheet.row(&[height, zeta * height, nm, sigma_t, sigma_s, albedo, optics.g]);
            for (points, value) in points.iter_mut().zip([sigma_t, 1.0 - albedo, optics.g]) {
                points.push([nm, value]);
            }
        }
        for (curves, points) in curves.iter_mut().zip(points) {
            curves.push((zeta, points));
        }
    }
    let panel = |heading: &str, y: Axis, curves: Vec<(f64, Vec<[f64; 2]>)>| {
        let series = curves.into_iter().map(|(zeta, points)| {
            Series::line(&format!("ζ = {zeta} ({:.0} m)", zeta * height), &ramp(zeta), points)
        });
        let mut panel =
            Panel::new(heading, Axis::linear("Wavelength (nm)", 300.0, 2500.0), y, series.collect());
        panel.marks = LIDARS_NM.iter().map(|&nm| (nm, format!("{nm}"))).collect();
        panel
    };
    let values = |curves: &[(f64, Vec<[f64; 2]>)]| -> Vec<f64> {
        curves.iter().flat_map(|c| c.1.iter().map(|p| p[1])).collect()
    };
    let [sigma, absorbed, g] = curves;
    let panels = [
        panel("Extinction coefficient", Axis::from_zero("σ (1/m)", values(&sigma)), sigma),
        panel("Mean cosine of the scattering angle", Axis::over("g", values(&g)), g),
        panel("Share that is absorbed at a collision", Axis::log("1 − albedo", 1e-8, 1.0), absorbed),
    ];
    let [first, second, third] = panels;
    let rows = vec![Row::panels(320.0, [first, second]), Row::panels(320.0, [third])];
    let caption = format!(
        "Advection fog {height} m thick at four relative altitudes ζ, from the model's droplet spectra by Mie series of water. \
         Dotted: the wavelengths of common lidars."
    );
    Ok(figure("wavelengths", &format!("Optics of {height} m of fog by wavelength"), &caption, rows, sheet))
}
