//! From polynomials to the model file, and the facts that a report shows beside it.

use super::FitSettings;
use super::altitude::Lone;
use super::basis::to_powers;
use super::bins::{Shape, shares, spectrum_shape};
use super::measurements::{Bin, Measurements};
use super::model_text::{ModelText, rounded};
use super::number::Number;
use super::outcome::{AltitudeFit, Fit, OwnFit, ParameterFit, SHAPE_KEYS, Standing};
use super::shapes::Shapes;
use super::survey::{Place, Survey, freedom};
use crate::advection::AdvectionModel;
use crate::error::OpticsError;
use fog_core::math::f64::exp;

/// Range of the paper's Mie tables in µm (Sec. 5.3).
const PAPER_RANGE_UM: [f64; 2] = [0.5, 60.0];

pub(super) fn assemble(
    measurements: &Measurements,
    settings: &FitSettings,
    survey: Survey<'_>,
    shapes: Shapes,
    number: Number,
) -> Result<Fit, OpticsError> {
    let heights_m = measurements.heights_m();
    let shape_fits: [ParameterFit; 5] = std::array::from_fn(|p| parameter_fit(p, &shapes));
    let coefficients: Vec<Vec<f64>> =
        number.fit.coefficients.iter().map(|row| row.iter().map(|c| rounded(*c)).collect()).collect();
    let remark = |p: usize| {
        let curve = &shape_fits[p].curve[10];
        format!("{:.3} +- {:.3} at zeta 0.5", curve[1], curve[2])
    };
    let model_yaml = ModelText {
        comment: &comment(measurements, &survey, &shapes, settings),
        diameter_range_um: settings.diameter_range_um.unwrap_or_else(|| default_range(measurements)),
        heights_m: &heights_m,
        shapes: std::array::from_fn(|p| (shape_fits[p].coefficients.clone(), remark(p))),
        number: &coefficients,
        number_remark: format!("R2 {:.4}, scatter {:.1} %", number.fit.r_squared, 100.0 * number.fit.scatter),
    }
    .yaml();
    let model = AdvectionModel::from_yaml(&model_yaml)?;

    let altitudes = (survey.places.iter().zip(&number.values))
        .map(|(place, value)| altitude_fit(place, *value, &model, survey.dispersion))
        .collect();
    let mut number_fit = number.fit;
    number_fit.coefficients = coefficients;
    let mut fit = Fit {
        model,
        model_yaml,
        source: measurements.source().to_owned(),
        heights_m,
        counting_noise_known: survey.noise_known,
        dispersion: survey.dispersion,
        common_dispersion: shapes.dispersion,
        altitudes,
        shapes: shape_fits,
        number: number_fit,
        refined: shapes.joint.is_some(),
        degree_steps: shapes.steps,
        outlier_mads: settings.outlier_mads,
        warnings: Vec::new(),
    };
    fit.warnings = warnings(&fit, settings);
    Ok(fit)
}

/// The paper's range, widened to tenths of a µm that hold the measured bins.
fn default_range(measurements: &Measurements) -> [f64; 2] {
    let bins = || measurements.spectra().iter().flat_map(|s| &s.bins);
    let low = bins().map(|b| b.low_um).fold(PAPER_RANGE_UM[0], f64::min);
    let high = bins().map(|b| b.high_um).fold(PAPER_RANGE_UM[1], f64::max);
    [((10.0 * low).floor() / 10.0).max(0.1), (10.0 * high).ceil() / 10.0]
}

fn comment(
    measurements: &Measurements,
    survey: &Survey<'_>,
    shapes: &Shapes,
    settings: &FitSettings,
) -> Vec<String> {
    let count = |of: fn(&Standing) -> bool| survey.places.iter().filter(|place| of(&place.standing)).count();
    let rejected = count(|s| matches!(s, Standing::Rejected(_)));
    let bad: usize = survey.places.iter().map(|place| place.bad_bins.len()).sum();
    let bins: usize = survey.places.iter().map(|place| place.spectrum.bins.len()).sum();
    let weights = if survey.noise_known {
        "counting noise"
    } else {
        "counting noise of unknown scale (no volumes given)"
    };
    let how = if shapes.joint.is_some() { ", refined over all counts at once" } else { "" };
    vec![
        format!("Fog model fitted by `fogbank fit` to {}.", measurements.source()),
        "Form: advection fog of Kolářová, Lachiver & Wilkie 2024 (Eurographics, 10.1111/cgf.15008).".into(),
        format!(
            "{} altitudes ({rejected} rejected), {bins} bins ({bad} set aside), rule: {} robust standard deviations.",
            survey.places.len(),
            settings.outlier_mads
        ),
        format!(
            "Weights: {weights}; dispersion {:.3}. Polynomials by cross-validation{how}.",
            survey.dispersion
        ),
    ]
}

fn parameter_fit(p: usize, shapes: &Shapes) -> ParameterFit {
    let in_powers =
        |bernstein: &[f64]| to_powers(bernstein).iter().map(|c| rounded(*c)).collect::<Vec<f64>>();
    let coefficients = in_powers(&shapes.polynomials()[p]);
    let curve = |i: u32| {
        let zeta = f64::from(i) / 20.0;
        [zeta, crate::advection::polynomial(&coefficients, zeta), shapes.error(p, zeta)]
    };
    ParameterFit {
        key: SHAPE_KEYS[p],
        curve: (0..=20).map(curve).collect(),
        staged: in_powers(&shapes.staged[p]),
        cross_validation: shapes.trends[p].table.clone(),
        scatter: shapes.trends[p].scatter,
        coefficients,
    }
}

fn altitude_fit(
    place: &Place<'_>,
    number: Option<([f64; 2], bool)>,
    model: &AdvectionModel,
    dispersion: f64,
) -> AltitudeFit {
    let spectrum = place.spectrum;
    let own = place.own.as_ref().and_then(|own| own_fit(place, own, dispersion));
    let zeta = spectrum.zeta();
    let shape: Shape = model.shape(zeta).parameters();
    let of_model = model.number_density_1_m3(zeta, spectrum.fog_height_m);
    AltitudeFit {
        spectrum: spectrum.clone(),
        bad_bins: place.bad_bins.clone(),
        own,
        standing: place.standing.clone(),
        number_density: number.map(|(value, _)| value),
        number_rejected: number.is_some_and(|(_, rejected)| rejected),
        model_rrse: rrse(&spectrum.bins, &place.bad_bins, &shape, of_model),
    }
}

fn own_fit(place: &Place<'_>, own: &Lone, dispersion: f64) -> Option<OwnFit> {
    let errors = own.errors?.map(|error| error * dispersion.sqrt());
    let number = exp(own.ln_number);
    Some(OwnFit {
        number_density_1_m3: number,
        number_density_error: errors[0],
        shape: spectrum_shape(&own.shape),
        shape_errors: [errors[1], errors[2], errors[3], errors[4], errors[5]],
        rrse: rrse(&place.spectrum.bins, &own.bad_bins, &own.shape, number),
        deviance_per_freedom: own.deviance / freedom(place.spectrum, own),
        agreeing_starts: own.agreeing_starts,
        converged: own.converged,
    })
}

/// √(Σ(y − f)² / Σ(y − ȳ)²) over the densities of the bins that were kept; 0 if these are all alike.
fn rrse(bins: &[Bin], bad: &[usize], shape: &Shape, number: f64) -> f64 {
    let mut share = Vec::new();
    shares(shape, bins, &mut share);
    let kept: Vec<usize> = (0..bins.len()).filter(|i| !bad.contains(i)).collect();
    let mean = kept.iter().map(|&i| bins[i].density_1_m3_um()).sum::<f64>() / kept.len().max(1) as f64;
    let (mut error, mut spread) = (0.0, 0.0);
    for &i in &kept {
        let measured = bins[i].density_1_m3_um();
        let fitted = number * share[i].value / bins[i].width_um();
        error += (measured - fitted) * (measured - fitted);
        spread += (measured - mean) * (measured - mean);
    }
    if spread > 0.0 { (error / spread).sqrt() } else { 0.0 }
}

/// What the user should know before using the model.
fn warnings(fit: &Fit, settings: &FitSettings) -> Vec<String> {
    let mut warnings = Vec::new();
    if let [height] = fit.heights_m[..] {
        warnings.push(format!(
            "only one fog height ({height} m) was measured: the number density does not depend on the height"
        ));
    }
    let used = || fit.altitudes.iter().filter(|a| !matches!(a.standing, Standing::Rejected(_)));
    let zeta = used().map(|a| a.spectrum.zeta());
    let (low, high) = zeta.fold((1.0f64, 0.0f64), |(low, high), z| (low.min(z), high.max(z)));
    if low > 0.15 || high < 0.85 {
        warnings.push(format!(
            "altitudes were measured for zeta {low:.2} to {high:.2}: the model extrapolates beyond"
        ));
    }
    if !fit.counting_noise_known {
        warnings.push(
            "no sampled volumes were given: bins are weighted as counts, the noise's size comes from the misfit".into(),
        );
    }
    if settings.refine && !fit.refined {
        warnings
            .push("the counts do not determine all polynomials at once: those of the stages are used".into());
    }
    let negative = fit.number.curves.iter().find(|c| c[2] < 0.0);
    if let Some([height, zeta, ..]) = negative {
        warnings.push(format!(
            "the number density is negative at zeta {zeta:.2} for a height of {height} m: the model is clear there"
        ));
    }
    let bins = || used().flat_map(|a| &a.spectrum.bins);
    let (least, most) =
        bins().fold((f64::INFINITY, 0.0f64), |(low, high), b| (low.min(b.low_um), high.max(b.high_um)));
    let everything = [Bin { low_um: least, high_um: most, droplets: 0.0, volume_m3: 1.0, line: 0, rows: 1 }];
    let outside = (0..=20).map(|i| {
        let shape: Shape = fit.model.shape(f64::from(i) / 20.0).parameters();
        let mut share = Vec::new();
        shares(&shape, &everything, &mut share);
        1.0 - share[0].value
    });
    let outside = outside.fold(0.0, f64::max);
    if outside > 0.1 {
        warnings.push(format!(
            "up to {:.0} % of the model's droplets are outside of the measured diameters, {least} to {most} um: they are extrapolated",
            100.0 * outside
        ));
    }
    let narrowest = bins().map(Bin::width_um).fold(f64::INFINITY, f64::min);
    let sigma_g = fit.shapes[3].curve.iter().map(|c| c[1]).fold(f64::INFINITY, f64::min);
    if narrowest > 3.0 * sigma_g {
        warnings.push(format!(
            "the bins are {narrowest} um wide and the Gaussian's sigma is down to {sigma_g:.2} um: its width is hardly resolved"
        ));
    }
    warnings
}
