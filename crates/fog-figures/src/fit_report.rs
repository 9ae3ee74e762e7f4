//! From a fit to the slices that its figures are drawn from.

use crate::figures::steps;
use crate::fit::{FitNumber, FitParameter, FitProfile, fit_figures};
use crate::{Figure, FiguresError};
use fog_optics::fit::{AltitudeFit, Fit, SHAPE_KEYS, Standing};

/// Labels of [`SHAPE_KEYS`]' axes.
const LABELS: [&str; 5] = ["μ_L", "σ_L", "μ_G (µm)", "σ_G (µm)", "ln G:L"];
/// Points of a curve over diameter or altitude.
const POINTS: usize = 200;

/// One altitude's curves, owned.
struct Curves {
    measured: Vec<[f64; 2]>,
    fitted: Vec<[f64; 2]>,
    model: Vec<[f64; 2]>,
}

/// Figures of a fit: `spectra_H` for each fog height H (measured, fitted and model curve at each altitude), `parameters`
/// (those of the altitudes that were used, over ζ, with the model's polynomials) and `number_density`.
///
/// # Errors
/// If a number of the fit is not finite.
pub fn fit_report(fit: &Fit) -> Result<Vec<Figure>, FiguresError> {
    let curves: Vec<Curves> = fit.altitudes.iter().map(|altitude| curves(fit, altitude)).collect();
    let profiles: Vec<FitProfile<'_>> = (fit.altitudes.iter().zip(&curves))
        .map(|(altitude, c)| FitProfile {
            height_m: altitude.spectrum.fog_height_m,
            altitude_m: altitude.spectrum.altitude_m,
            measured: &c.measured,
            fitted: &c.fitted,
            model: &c.model,
        })
        .collect();
    let points: [Vec<[f64; 3]>; 5] = core::array::from_fn(|parameter| parameter_points(fit, parameter));
    let parameters: Vec<FitParameter<'_>> = (0..SHAPE_KEYS.len())
        .map(|p| FitParameter {
            name: SHAPE_KEYS[p],
            label: LABELS[p],
            fits: &points[p],
            polynomial: &fit.shapes[p].coefficients,
        })
        .collect();
    let numbers: Vec<_> = fit.heights_m.iter().map(|&height| number_curves(fit, height)).collect();
    let numbers: Vec<FitNumber<'_>> = (fit.heights_m.iter().zip(&numbers))
        .map(|(&height_m, (measured, model))| FitNumber { height_m, measured, model })
        .collect();
    fit_figures(&profiles, &parameters, &numbers)
}

/// What was measured at one altitude, the curve fitted there, and the model's.
fn curves(fit: &Fit, altitude: &AltitudeFit) -> Curves {
    let spectrum = &altitude.spectrum;
    let measured =
        spectrum.bins.iter().map(|b| [0.5 * (b.low_um + b.high_um), b.density_1_m3_um()]).collect();
    let last_um = spectrum.bins.iter().map(|b| b.high_um).fold(0.0, f64::max);
    let diameters = steps(last_um / POINTS as f64, last_um, POINTS);
    let sample = |density: &dyn Fn(f64) -> f64| diameters.iter().map(|&d| [d, density(d)]).collect();
    let fitted = altitude.own.as_ref().map(|own| sample(&|d| own.parts_1_m3_um(d).iter().sum()));
    let model = sample(&|d| fit.model.density_1_m3_um(d, spectrum.zeta(), spectrum.fog_height_m));
    Curves { measured, fitted: fitted.unwrap_or_default(), model }
}

/// (Fog height in m, ζ, value) of one parameter at every altitude that the general model was made from.
fn parameter_points(fit: &Fit, parameter: usize) -> Vec<[f64; 3]> {
    (fit.altitudes.iter())
        .filter(|a| matches!(a.standing, Standing::Used))
        .filter_map(|a| {
            let value = a.own.as_ref()?.shape.parameters()[parameter];
            Some([a.spectrum.fog_height_m, a.spectrum.zeta(), value])
        })
        .collect()
}

/// (Altitude in m, droplets in m⁻³) of one fog: measured, and the model's.
fn number_curves(fit: &Fit, height_m: f64) -> (Vec<[f64; 2]>, Vec<[f64; 2]>) {
    let measured = (fit.altitudes.iter())
        .filter(|a| a.spectrum.fog_height_m == height_m)
        .filter_map(|a| Some([a.spectrum.altitude_m, a.number_density?[0]]))
        .collect();
    let model = steps(0.0, 1.0, POINTS)
        .into_iter()
        .map(|zeta| [zeta * height_m, fit.model.number_density_1_m3(zeta, height_m)])
        .collect();
    (measured, model)
}
