//! The shape polynomials: from the altitudes' own fits, then of all counts at once.

use super::basis::bernstein;
use super::degrees::{DegreeStep, search};
use super::joint::{Joint, Layer, Polynomials, refine, shape_at};
use super::least_squares::THOROUGH;
use super::linear::{dot, median, robust_scale};
use super::outcome::Standing;
use super::survey::{Place, Survey};
use super::trend::Trend;
use super::{FitSettings, SHAPE_KEYS};
use crate::error::OpticsError;

/// Largest share of an altitude's bins that may be bad before the altitude is.
const BAD_SHARE_MAX: f64 = 0.25;

/// The polynomials and how they came to be.
pub(super) struct Shapes {
    pub(super) trends: Vec<Trend>,
    /// Of the stages, in Bernstein's basis.
    pub(super) staged: Polynomials,
    /// Of all counts at once, if asked for and determined.
    pub(super) joint: Option<Joint>,
    /// Deviance per degree of freedom around the common polynomials, median over the altitudes, at least the dispersion.
    pub(super) dispersion: f64,
    /// The last comparison of degrees on the way to `joint`.
    pub(super) steps: Vec<DegreeStep>,
}

impl Shapes {
    pub(super) fn polynomials(&self) -> &Polynomials {
        self.joint.as_ref().map_or(&self.staged, |joint| &joint.polynomials)
    }

    /// Standard error of the polynomial of a parameter at ζ.
    pub(super) fn error(&self, parameter: usize, zeta: f64) -> f64 {
        let Some(joint) = &self.joint else {
            let trend = &self.trends[parameter];
            return trend.fit.standard_error(&bernstein(trend.degrees.zeta, zeta));
        };
        let first: usize = joint.polynomials[..parameter].iter().map(Vec::len).sum();
        let count = joint.polynomials[parameter].len();
        let row = bernstein(count - 1, zeta);
        let inner = |i: usize| dot(&joint.covariance[first + i][first..first + count], &row);
        let variance: f64 = (0..count).map(|i| row[i] * inner(i)).sum();
        (variance.max(0.0) * self.dispersion).sqrt()
    }
}

pub(super) fn shapes(
    survey: &mut Survey<'_>,
    settings: &FitSettings,
    progress: &dyn Fn(f64),
) -> Result<Shapes, OpticsError> {
    let mut trends = staged(survey, settings)?;
    let staged = std::array::from_fn(|p| trends[p].fit.values.clone());
    let (mut joint, mut steps) = (None, Vec::new());
    let mut dispersion = survey.dispersion;
    if settings.refine {
        // With the degrees of the stages, then with those that all counts ask for.
        joint = all_at_once(survey, settings, &staged);
        if let Some((first, _)) = &joint {
            let (start, found) = search(
                &layers(survey),
                &first.polynomials,
                &survey.bounds,
                settings.max_shape_degree,
                progress,
            );
            steps = found;
            joint = all_at_once(survey, settings, &start).or(joint);
        }
    }
    for trend in &mut trends {
        trend.outliers.clear();
    }
    let joint = joint.map(|(joint, misfit)| {
        dispersion = dispersion.max(misfit);
        joint
    });
    Ok(Shapes { trends, staged, joint, dispersion, steps })
}

/// Polynomials of the altitudes' own fits; altitudes that stand out in any parameter are rejected.
fn staged(survey: &mut Survey<'_>, settings: &FitSettings) -> Result<Vec<Trend>, OpticsError> {
    for _ in 0..3 {
        let used = survey.used();
        let Some(trends) = survey.trends(&used, settings) else {
            return Err(survey.refuse(format!("too few altitudes: {} are left for polynomials", used.len())));
        };
        let mut clean = true;
        for (trend, key) in trends.iter().zip(SHAPE_KEYS) {
            for (index, deviation) in &trend.outliers {
                let reason = format!("{key} deviates by {:.1} robust standard deviations", deviation.abs());
                survey.places[used[*index]].standing = Standing::Rejected(reason);
                clean = false;
            }
        }
        if clean {
            return Ok(trends);
        }
    }
    let used = survey.used();
    let trends = survey.trends(&used, settings);
    trends.ok_or_else(|| survey.refuse(format!("too few altitudes: {} are left for polynomials", used.len())))
}

/// All counts at once. Bins and altitudes that stand out from the common polynomials are set aside, those that do not are
/// taken back, until nothing changes. With the altitudes' median misfit.
fn all_at_once(survey: &mut Survey<'_>, settings: &FitSettings, from: &Polynomials) -> Option<(Joint, f64)> {
    let mut joint: Option<(Joint, f64)> = None;
    for _ in 0..4 {
        let start = joint.as_ref().map_or(from, |(joint, _)| &joint.polynomials);
        let new = refine(&layers(survey), start, &survey.bounds, THOROUGH)?;
        let (changed, misfit) = set_aside(survey, settings, &new.polynomials);
        joint = Some((new, misfit));
        if !changed {
            break;
        }
    }
    joint
}

/// Bins of the altitudes that take part.
fn layers(survey: &Survey<'_>) -> Vec<Layer> {
    let taking_part = |place: &&Place<'_>| !matches!(place.standing, Standing::Rejected(_));
    let layers = survey.places.iter().filter(taking_part).map(Place::layer);
    layers.filter(|layer| layer.bins.len() > 1 && layer.droplets() > 0.0).collect()
}

/// Applies the outlier rule to bins and altitudes, given the common polynomials. Tells if anything changed, and the median
/// deviance per degree of freedom.
fn set_aside(survey: &mut Survey<'_>, settings: &FitSettings, polynomials: &Polynomials) -> (bool, f64) {
    let with_droplets: Vec<usize> =
        (0..survey.places.len()).filter(|&i| survey.places[i].spectrum.droplets() > 0.0).collect();
    let all_residuals: Vec<Vec<f64>> =
        with_droplets.iter().map(|&i| bin_residuals(&survey.places[i], polynomials)).collect();
    let least = if survey.noise_known { 1.0 } else { 1e-6 };
    let scale = robust_scale(all_residuals.iter().flatten().copied()).max(least);
    let limit = settings.outlier_mads * scale;
    let mut changed = false;
    let mut misfits = Vec::new();
    for (&i, residuals) in with_droplets.iter().zip(&all_residuals) {
        let place = &mut survey.places[i];
        let bad: Vec<usize> = (0..residuals.len()).filter(|&b| residuals[b].abs() > limit).collect();
        changed |= bad != place.bad_bins;
        let kept = residuals.len() - bad.len();
        let deviance: f64 =
            residuals.iter().enumerate().filter(|(b, _)| !bad.contains(b)).map(|(_, r)| r * r).sum();
        misfits.push((deviance / (kept as f64 - 1.0).max(1.0), kept));
        place.bad_bins = bad;
    }
    let typical = median(&misfits.iter().map(|m| m.0).collect::<Vec<_>>());
    let spread = robust_scale(misfits.iter().map(|m| m.0 - typical));
    for (&i, (misfit, kept)) in with_droplets.iter().zip(&misfits) {
        let place = &mut survey.places[i];
        let chance = typical * (2.0 / (*kept as f64 - 1.0).max(1.0)).sqrt();
        let deviation = (misfit - typical) / spread.max(chance).max(1e-300);
        let total = place.spectrum.bins.len();
        let reason = if (total - kept) as f64 > BAD_SHARE_MAX * total as f64 && total - kept > 1 {
            Some(format!("{} of {total} bins stand out from the common shape", total - kept))
        } else if deviation > settings.outlier_mads {
            Some(format!("its misfit to the common shape is {deviation:.1} robust standard deviations high"))
        } else {
            None
        };
        let was = matches!(place.standing, Standing::Rejected(_));
        changed |= was != reason.is_some();
        place.standing = match (reason, &place.standing) {
            (Some(reason), _) => Standing::Rejected(reason),
            (None, Standing::Rejected(reason)) => {
                Standing::Weak(format!("rejected at first ({reason}), but its counts fit the common shape"))
            }
            (None, standing) => standing.clone(),
        };
    }
    (changed, typical)
}

/// Residuals of all bins of an altitude, its number density taken from the bins that were kept.
fn bin_residuals(place: &Place<'_>, polynomials: &Polynomials) -> Vec<f64> {
    let shape = shape_at(polynomials, place.spectrum.zeta());
    let all = Layer { zeta: place.spectrum.zeta(), bins: place.spectrum.bins.clone() };
    all.residuals(&shape, place.layer().number(&shape))
}
