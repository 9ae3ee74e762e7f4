//! Figures of a fit: spectra by altitude, parameters over relative altitude, number density.

use crate::chart::style::PALETTE;
use crate::chart::{Axis, Panel, Row, Series};
use crate::figures::{CM3, figure, steps};
use crate::sheet::Sheet;
use crate::{Figure, FiguresError};
use fog_optics::advection::polynomial;

/// A measured spectrum at one altitude and the curve that was fitted to it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FitProfile<'a> {
    /// Height of the fog in m.
    pub(crate) height_m: f64,
    /// Altitude over the fog's base in m.
    pub(crate) altitude_m: f64,
    /// Measured: (diameter in µm, droplets in m⁻³ µm⁻¹).
    pub(crate) measured: &'a [[f64; 2]],
    /// The fitted curve: (diameter in µm, droplets in m⁻³ µm⁻¹), diameters ascending.
    pub(crate) fitted: &'a [[f64; 2]],
    /// The curve of the general model, likewise; may be empty.
    pub(crate) model: &'a [[f64; 2]],
}

/// One parameter of the spectra over relative altitude: the fits of single altitudes and the polynomial through all of them.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FitParameter<'a> {
    /// Its name as it stands in the CSV, for example `mu_l`.
    pub(crate) name: &'a str,
    /// Label of the axis with the unit, for example `μ_G (µm)`.
    pub(crate) label: &'a str,
    /// Fits: (height of the fog in m, relative altitude ζ, value).
    pub(crate) fits: &'a [[f64; 3]],
    /// Coefficients c0, c1, … of the polynomial Σ c_i ζ^i.
    pub(crate) polynomial: &'a [f64],
}

/// Number density of one fog: measured and of the model.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FitNumber<'a> {
    /// Height of the fog in m.
    pub(crate) height_m: f64,
    /// Measured: (altitude in m, droplets in m⁻³).
    pub(crate) measured: &'a [[f64; 2]],
    /// The model's curve: (altitude in m, droplets in m⁻³), altitudes ascending.
    pub(crate) model: &'a [[f64; 2]],
}

/// Spectra side by side.
const COLUMNS: usize = 3;

/// Draws a fit to measurements: one figure `spectra_H` for each height H of `profiles` (measured points, fitted and model
/// curve, a small panel per altitude), `parameters` (every parameter over ζ with its polynomial) and `number_density`.
/// Parts without data are left out. The order of heights, altitudes and parameters is that of the arguments.
///
/// # Errors
/// If there is nothing to draw, or a value is not finite.
pub(crate) fn fit_figures(
    profiles: &[FitProfile<'_>],
    parameters: &[FitParameter<'_>],
    numbers: &[FitNumber<'_>],
) -> Result<Vec<Figure>, FiguresError> {
    check(profiles, parameters, numbers)?;
    let mut heights: Vec<f64> = Vec::new();
    for profile in profiles {
        if !heights.contains(&profile.height_m) {
            heights.push(profile.height_m);
        }
    }
    let mut all: Vec<Figure> = heights.iter().map(|&h| spectra(h, profiles)).collect();
    if !parameters.is_empty() {
        all.push(draw_parameters(parameters));
    }
    if !numbers.is_empty() {
        all.push(draw_numbers(numbers));
    }
    Ok(all)
}

fn check(
    profiles: &[FitProfile<'_>],
    parameters: &[FitParameter<'_>],
    numbers: &[FitNumber<'_>],
) -> Result<(), FiguresError> {
    let finite2 = |points: &[[f64; 2]]| points.as_flattened().iter().all(|x| x.is_finite());
    let fault = |what: String| Err(FiguresError::FitData(what));
    for p in profiles {
        let points = finite2(p.measured) && finite2(p.fitted) && finite2(p.model);
        if !(points && p.height_m.is_finite() && p.altitude_m.is_finite()) {
            return fault(format!(
                "the spectrum at {} m of {} m has values that are not finite",
                p.altitude_m, p.height_m
            ));
        }
    }
    for p in parameters {
        if !p.fits.as_flattened().iter().chain(p.polynomial).all(|x| x.is_finite()) {
            return fault(format!("parameter {} has values that are not finite", p.name));
        }
    }
    for n in numbers {
        if !(finite2(n.measured) && finite2(n.model) && n.height_m.is_finite()) {
            return fault(format!("the number density of {} m has values that are not finite", n.height_m));
        }
    }
    if profiles.is_empty() && parameters.is_empty() && numbers.is_empty() {
        return fault("there is nothing to draw".to_owned());
    }
    Ok(())
}

fn scaled(points: &[[f64; 2]]) -> Vec<[f64; 2]> {
    points.iter().map(|&[x, n]| [x, n * CM3]).collect()
}

/// Measured points, fitted curve and model at every altitude of one fog.
fn spectra(height_m: f64, profiles: &[FitProfile<'_>]) -> Figure {
    let mut sheet = Sheet::new(&["kind", "height_m", "altitude_m", "diameter_um", "density_1_m3_um"]);
    let mut panels = Vec::new();
    let here: Vec<_> = profiles.iter().filter(|p| p.height_m == height_m).collect();
    let last_um =
        (here.iter().flat_map(|p| p.measured.iter().chain(p.fitted)).map(|p| p[0])).fold(0.0, f64::max);
    for (i, profile) in here.iter().enumerate() {
        let sets = [("measured", profile.measured), ("fitted", profile.fitted), ("model", profile.model)];
        for (kind, [d, n]) in sets.iter().flat_map(|set| set.1.iter().map(|p| (set.0, *p))) {
            sheet.named_row(&[kind], &[height_m, profile.altitude_m, d, n]);
        }
        let values = sets.iter().flat_map(|set| set.1.iter().map(|p| p[1] * CM3));
        // Words at the outer panels alone leave room for the small ones.
        let y_label = if i % COLUMNS == 0 { "cm⁻³ µm⁻¹" } else { "" };
        let x_label = if i + COLUMNS >= here.len() { "Diameter (µm)" } else { "" };
        panels.push(Panel::new(
            &format!("{} m", profile.altitude_m),
            Axis::from_zero(x_label, [0.95 * last_um]),
            Axis::from_zero(y_label, values),
            drawn([
                Series::line("fit at this altitude", PALETTE[0], scaled(profile.fitted)),
                Series::line("general model", PALETTE[1], scaled(profile.model)).dashed("6 4"),
                Series::dots("measured", PALETTE[2], scaled(profile.measured)),
            ]),
        ));
    }
    let rows = panels.chunks(COLUMNS).map(|row| Row::panels(205.0, row.iter().cloned()).in_columns(COLUMNS));
    let caption = format!(
        "Droplets by diameter at altitudes over the base of {height_m} m of fog: measured, the sum of a lognormal and a Gaussian \
         curve fitted at each altitude (Eq. 1–3 of Kolářová, Lachiver & Wilkie 2024), and the general model fitted to all."
    );
    let title = format!("Measured and fitted spectra, fog of {height_m} m");
    figure(&format!("spectra_{height_m}"), &title, &caption, rows.collect(), sheet)
}

/// The series that have points.
fn drawn(series: impl IntoIterator<Item = Series>) -> Vec<Series> {
    series.into_iter().filter(|s| !s.is_empty()).collect()
}

fn draw_parameters(parameters: &[FitParameter<'_>]) -> Figure {
    let mut sheet = Sheet::new(&["parameter", "kind", "height_m", "zeta", "value"]);
    let mut heights: Vec<f64> = Vec::new();
    for [height, ..] in parameters.iter().flat_map(|p| p.fits) {
        if !heights.contains(height) {
            heights.push(*height);
        }
    }
    let mut panels = Vec::new();
    for parameter in parameters {
        let mut series = Vec::new();
        for (i, height) in heights.iter().enumerate() {
            let fits = parameter.fits.iter().filter(|f| f[0] == *height);
            let points: Vec<[f64; 2]> = fits.map(|f| [f[1], f[2]]).collect();
            for [zeta, value] in &points {
                sheet.named_row(&[parameter.name, "fit"], &[*height, *zeta, *value]);
            }
            series.push(Series::dots(
                &format!("fits, fog of {height} m"),
                PALETTE[[0, 2, 4, 5, 3][i % 5]],
                points,
            ));
        }
        let curve: Vec<[f64; 2]> =
            steps(0.0, 1.0, 101).into_iter().map(|z| [z, polynomial(parameter.polynomial, z)]).collect();
        for height in &heights {
            for [zeta, value] in &curve {
                sheet.named_row(&[parameter.name, "polynomial"], &[*height, *zeta, *value]);
            }
        }
        let values = parameter.fits.iter().map(|f| f[2]).chain(curve.iter().map(|p| p[1]));
        let y = Axis::over(parameter.label, values);
        series.push(Series::line("polynomial", PALETTE[1], curve).width(2.4));
        panels.push(Panel::new("", Axis::linear("Relative altitude ζ", -0.03, 1.03), y, series));
    }
    let rows = panels.chunks(2).map(|row| Row::panels(270.0, row.iter().cloned()).in_columns(2)).collect();
    let caption = "Parameters of the spectra over relative altitude ζ = z/H: values fitted at single altitudes of each fog, and the \
                   polynomial of the general model (Sec. 4.3 of Kolářová, Lachiver & Wilkie 2024).";
    figure("parameters", "Parameters of the spectra over relative altitude", caption, rows, sheet)
}

fn draw_numbers(numbers: &[FitNumber<'_>]) -> Figure {
    let mut sheet = Sheet::new(&["kind", "height_m", "altitude_m", "number_density_1_m3"]);
    let (mut series, mut densities, mut altitudes) = (Vec::new(), Vec::new(), Vec::new());
    for (i, number) in numbers.iter().enumerate() {
        let colour = PALETTE[i % PALETTE.len()];
        for (kind, points) in [("measured", number.measured), ("model", number.model)] {
            for &[altitude, n] in points {
                sheet.named_row(&[kind], &[number.height_m, altitude, n]);
                densities.push(n * CM3);
                altitudes.push(altitude);
            }
        }
        let turned = |points: &[[f64; 2]]| points.iter().map(|&[z, n]| [n * CM3, z]).collect();
        series.push(Series::line(&format!("model, {} m", number.height_m), colour, turned(number.model)));
        series.push(Series::dots(
            &format!("measured, {} m", number.height_m),
            colour,
            turned(number.measured),
        ));
    }
    let panel = Panel::new(
        "",
        Axis::from_zero("Number density of droplets (cm⁻³)", densities),
        Axis::from_zero("Altitude (m)", altitudes),
        series,
    );
    let caption =
        "Number of droplets per cm³ by altitude: measured, and N(ζ, H) of the model fitted to all fogs.";
    figure(
        "number_density",
        "Number density of droplets by altitude",
        caption,
        vec![Row::panels(440.0, [panel])],
        sheet,
    )
}
