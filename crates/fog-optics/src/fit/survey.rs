//! Every altitude fitted by itself, and what is known of each on the way to the model.

use super::altitude::{self, BINS_MIN, Bounds, FILLED_MIN, Lone, PARAMETERS};
use super::bins::{SHAPES, Shape};
use super::joint::Layer;
use super::linear::{dot, median};
use super::measurements::{Measurements, Spectrum};
use super::outcome::Standing;
use super::trend::{self, Degrees, Domain, Point, Trend, TrendSettings};
use super::{FitSettings, SHAPE_KEYS};
use crate::error::OpticsError;
use rayon::prelude::*;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Least number of altitudes with fits of their own that polynomials are made of.
const ALTITUDES_MIN: usize = 4;

/// The altitudes on their way.
pub(super) struct Survey<'a> {
    pub(super) source: &'a str,
    pub(super) noise_known: bool,
    pub(super) bounds: Bounds,
    pub(super) dispersion: f64,
    pub(super) places: Vec<Place<'a>>,
}

/// One altitude.
pub(super) struct Place<'a> {
    pub(super) spectrum: &'a Spectrum,
    pub(super) own: Option<Lone>,
    pub(super) bad_bins: Vec<usize>,
    pub(super) standing: Standing,
}

impl Place<'_> {
    /// Bins that were not set aside.
    pub(super) fn layer(&self) -> Layer {
        let bins = self.spectrum.bins.iter().enumerate();
        let kept = bins.filter(|(i, _)| !self.bad_bins.contains(i)).map(|(_, bin)| *bin);
        Layer { zeta: self.spectrum.zeta(), bins: kept.collect() }
    }
}

impl Survey<'_> {
    pub(super) fn refuse(&self, problem: String) -> OpticsError {
        OpticsError::Fit { file: self.source.to_owned(), problem }
    }

    /// Altitudes whose own fits enter the polynomials.
    pub(super) fn used(&self) -> Vec<usize> {
        (0..self.places.len()).filter(|&i| self.places[i].standing == Standing::Used).collect()
    }

    /// Values of one shape parameter of the altitudes given, with standard errors scaled by the dispersion.
    pub(super) fn points(&self, used: &[usize], parameter: usize) -> Vec<Point> {
        let point = |&i: &usize| {
            let place = &self.places[i];
            let own = place.own.as_ref()?;
            Some(Point {
                zeta: place.spectrum.zeta(),
                height_m: place.spectrum.fog_height_m,
                value: own.shape[parameter],
                error: own.errors?[1 + parameter] * self.dispersion.sqrt(),
            })
        };
        used.iter().filter_map(point).collect()
    }

    /// Polynomials of the shape parameters over ζ from the altitudes' own fits.
    pub(super) fn trends(&self, used: &[usize], settings: &FitSettings) -> Option<Vec<Trend>> {
        (0..SHAPES)
            .map(|parameter| {
                let trend_settings = TrendSettings {
                    most: Degrees { zeta: settings.max_shape_degree, height: 0 },
                    folds: settings.folds,
                    outlier_mads: settings.outlier_mads,
                    relative: false,
                };
                trend::fit(&self.points(used, parameter), &shape_domain(parameter), &trend_settings)
            })
            .collect()
    }

    /// Judges each altitude's own fit, and takes the dispersion from those that are good.
    fn judge(&mut self) {
        for place in &mut self.places {
            place.standing = standing(place.spectrum, place.own.as_ref(), &self.bounds);
            place.bad_bins = place.own.as_ref().map_or_else(Vec::new, |own| own.bad_bins.clone());
        }
        let good: Vec<f64> = (self.places.iter())
            .filter(|place| place.standing == Standing::Used)
            .filter_map(|place| place.own.as_ref().map(|own| own.deviance / freedom(place.spectrum, own)))
            .collect();
        let least = if self.noise_known { 1.0 } else { 1e-12 };
        self.dispersion = median(&good).max(least);
    }
}

/// The domain of a shape parameter: widths must be positive.
pub(super) fn shape_domain(parameter: usize) -> Domain {
    Domain { heights_m: [0.0, 0.0], positive: SHAPE_KEYS[parameter].starts_with("sigma") }
}

/// Bins kept less parameters.
pub(super) fn freedom(spectrum: &Spectrum, own: &Lone) -> f64 {
    (spectrum.bins.len() - own.bad_bins.len()).saturating_sub(PARAMETERS).max(1) as f64
}

fn standing(spectrum: &Spectrum, own: Option<&Lone>, bounds: &Bounds) -> Standing {
    if spectrum.droplets() == 0.0 {
        return Standing::Rejected("no droplets".into());
    }
    let weak = |why: String| Standing::Weak(why);
    let bins = spectrum.bins.len();
    let filled = spectrum.bins.iter().filter(|bin| bin.droplets > 0.0).count();
    match own {
        None if bins < BINS_MIN => weak(format!("{bins} bins; a fit by itself needs {BINS_MIN}")),
        None if filled < FILLED_MIN => {
            weak(format!("{filled} bins with droplets; a fit by itself needs {FILLED_MIN}"))
        }
        None => weak("no start led to a fit".into()),
        Some(own) if own.errors.is_none() => weak("its counts do not determine all parameters".into()),
        Some(own) if bounds.touched(&own.shape) => weak("a parameter is at its bound".into()),
        Some(_) => Standing::Used,
    }
}

/// Fits every altitude, then again from what the polynomials over ζ suggest.
pub(super) fn survey<'a>(
    measurements: &'a Measurements,
    settings: &FitSettings,
    progress: &(dyn Fn(f64) + Sync),
) -> Result<Survey<'a>, OpticsError> {
    let spectra = measurements.spectra();
    let noise_known = measurements.counting_noise_known();
    let bounds = Bounds::of(spectra);
    let refuse = |problem: String| OpticsError::Fit { file: measurements.source().to_owned(), problem };
    if spectra.iter().all(|s| s.droplets() == 0.0) {
        return Err(refuse("there are no droplets: every value is 0".into()));
    }
    let most = spectra.iter().map(|s| s.bins.len()).max().unwrap_or(0);
    if most < BINS_MIN {
        let problem = format!(
            "too few bins: at most {most} at an altitude; six parameters need at least {BINS_MIN} at {ALTITUDES_MIN} altitudes"
        );
        return Err(refuse(problem));
    }

    let done = AtomicUsize::new(0);
    let step = || progress((done.fetch_add(1, Ordering::Relaxed) + 1) as f64 / (2 * spectra.len()) as f64);
    let place = |spectrum: &'a Spectrum| {
        let own = altitude::fit(spectrum, &bounds, noise_known, settings.outlier_mads);
        step();
        Place { spectrum, own, bad_bins: Vec::new(), standing: Standing::Used }
    };
    let places = spectra.par_iter().map(place).collect();
    let mut survey = Survey { source: measurements.source(), noise_known, bounds, dispersion: 1.0, places };
    survey.judge();

    // Where the neighbours' shape fits as well as the altitude's own, it is the better name for the parts.
    let used = survey.used();
    if used.len() < ALTITUDES_MIN {
        let problem = format!(
            "too few altitudes: {} of {} have fits of their own; polynomials over altitude need {ALTITUDES_MIN}",
            used.len(),
            spectra.len()
        );
        return Err(refuse(problem));
    }
    if let Some(trends) = survey.trends(&used, settings) {
        let near = |spectrum: &Spectrum| -> Shape {
            std::array::from_fn(|p| {
                let row = shape_domain(p).row(trends[p].degrees, spectrum.zeta(), 0.0);
                dot(&row, &trends[p].fit.values).clamp(bounds.0[p][0], bounds.0[p][1])
            })
        };
        let limit = 4.0 * survey.dispersion;
        let again = |place: &Place<'_>| {
            let own = place.own.as_ref()?;
            let new = altitude::fit_near(
                place.spectrum,
                &near(place.spectrum),
                &bounds,
                noise_known,
                settings.outlier_mads,
            );
            step();
            new.filter(|new| new.score <= own.score + limit)
                .map(|new| Lone { agreeing_starts: own.agreeing_starts, ..new })
        };
        let found: Vec<Option<Lone>> = survey.places.par_iter().map(again).collect();
        for (place, new) in survey.places.iter_mut().zip(found) {
            place.own = new.or(place.own.take());
        }
        survey.judge();
    }
    Ok(survey)
}
