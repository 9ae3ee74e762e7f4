//! The fit of one altitude's spectrum: lognormal and Gaussian, from several starts, bad bins set aside.

use super::bins::{SHAPES, Shape, deviance_residual, shares, tamed};
use super::least_squares::{Minimum, Residuals, THOROUGH, minimise};
use super::linear::{inverse, robust_scale};
use super::measurements::{Bin, Spectrum};
use super::starts::starts;
use fog_core::math::f64::{exp, ln};

/// Parameters of an altitude: ln N, then the shape.
pub(super) const PARAMETERS: usize = SHAPES + 1;
/// Least number of bins of a spectrum that is fitted by itself: one more than the parameters.
pub const BINS_MIN: usize = PARAMETERS + 1;
/// Least number of bins with droplets of such a spectrum.
pub(super) const FILLED_MIN: usize = 4;
/// Share of the bins, the best ones, whose residuals judge between starts.
const TRUSTED: f64 = 0.85;
/// Largest share of a spectrum's bins that is set aside as bad.
const BAD_SHARE_MAX: f64 = 0.25;

/// What is allowed for each shape parameter, from the diameters that were measured.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Bounds(pub(super) [[f64; 2]; SHAPES]);

impl Bounds {
    /// Centres between the least and the greatest measured diameter (the lognormal's from a third of the least), σ_L from
    /// 0.05 to 2, σ_G from 0.15 of the narrowest bin to half of the range, and G : L from e⁻⁶ to e⁶.
    pub(super) fn of(spectra: &[Spectrum]) -> Self {
        let bins = || spectra.iter().flat_map(|s| &s.bins);
        let high = bins().map(|b| b.high_um).fold(0.0, f64::max);
        let low = bins().map(|b| b.low_um).fold(f64::INFINITY, f64::min).max(0.1).min(0.5 * high);
        let narrowest = bins().map(Bin::width_um).fold(f64::INFINITY, f64::min);
        let widest = 0.5 * (high - low).max(narrowest);
        Self([
            [ln(low / 3.0), ln(high)],
            [0.05, 2.0],
            [low, high],
            [0.15 * narrowest, widest.max(0.3 * narrowest)],
            [-6.0, 6.0],
        ])
    }

    /// Whether a parameter lies at one of its bounds.
    pub(super) fn touched(&self, shape: &Shape) -> bool {
        let at = |(x, [low, high]): (&f64, &[f64; 2])| (x - low).min(high - x) <= 1e-4 * (high - low);
        shape.iter().zip(&self.0).any(at)
    }

    fn with_number(&self) -> Vec<[f64; 2]> {
        std::iter::once([-700.0, 700.0]).chain(self.0).collect()
    }
}

/// The fit of an altitude by itself.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Lone {
    /// ln of the number density in m⁻³.
    pub(super) ln_number: f64,
    pub(super) shape: Shape,
    /// Standard errors of ln N and of the shape for counting noise of dispersion 1; `None` if the data do not determine all.
    pub(super) errors: Option<[f64; PARAMETERS]>,
    /// Deviance of the bins that were kept.
    pub(super) deviance: f64,
    /// Bins set aside, by index.
    pub(super) bad_bins: Vec<usize>,
    /// Sum of the squared residuals of the trusted bins: what judges between starts.
    pub(super) score: f64,
    pub(super) converged: bool,
    /// Starts that ended within one deviance of the best.
    pub(super) agreeing_starts: usize,
}

impl Lone {
    /// Whether the Gaussian is the narrower part: relative width σ_G/μ_G below the lognormal's σ_L.
    fn gaussian_is_narrow(&self) -> bool {
        self.shape[3] < self.shape[1] * self.shape[2]
    }
}

/// Residuals of a spectrum's bins.
struct SpectrumResiduals<'a> {
    bins: &'a [Bin],
    /// Scale of Cauchy's loss; `None` for plain residuals.
    taming: Option<f64>,
}

impl Residuals for SpectrumResiduals<'_> {
    fn count(&self) -> usize {
        self.bins.len()
    }

    fn evaluate(&self, parameters: &[f64], residuals: &mut [f64], mut columns: Option<&mut [Vec<f64>]>) {
        let mut share = Vec::with_capacity(self.bins.len());
        shares(&shape_of(parameters), self.bins, &mut share);
        let number = exp(parameters[0]);
        for (i, (bin, share)) in self.bins.iter().zip(&share).enumerate() {
            let sampled = number * bin.volume_m3;
            let (mut residual, mut slope) = deviance_residual(bin.droplets, sampled * share.value);
            if let Some(scale) = self.taming {
                let (tame, by_residual) = tamed(residual, scale);
                (residual, slope) = (tame, slope * by_residual);
            }
            residuals[i] = residual;
            if let Some(columns) = columns.as_deref_mut() {
                columns[0][i] = slope * sampled * share.value;
                for p in 0..SHAPES {
                    columns[1 + p][i] = slope * sampled * share.by_shape[p];
                }
            }
        }
    }
}

fn shape_of(parameters: &[f64]) -> Shape {
    std::array::from_fn(|p| parameters[1 + p])
}

/// Plain residuals of bins.
fn residuals_of(bins: &[Bin], parameters: &[f64]) -> Vec<f64> {
    let mut residuals = vec![0.0; bins.len()];
    SpectrumResiduals { bins, taming: None }.evaluate(parameters, &mut residuals, None);
    residuals
}

/// Sum of the squares of the smallest residuals.
fn trusted_sum(residuals: &[f64]) -> f64 {
    let mut squares: Vec<f64> = residuals.iter().map(|r| r * r).collect();
    squares.sort_by(f64::total_cmp);
    squares.truncate((TRUSTED * squares.len() as f64).ceil() as usize);
    squares.iter().sum()
}

/// Fits one altitude, from several starts; `None` if it has fewer than [`BINS_MIN`] bins, fewer than [`FILLED_MIN`] with droplets, or
/// no start led anywhere.
pub(super) fn fit(
    spectrum: &Spectrum,
    bounds: &Bounds,
    noise_known: bool,
    outlier_mads: f64,
) -> Option<Lone> {
    let bins = &spectrum.bins;
    if bins.len() < BINS_MIN || bins.iter().filter(|bin| bin.droplets > 0.0).count() < FILLED_MIN {
        return None;
    }
    let starts: Vec<Vec<f64>> = starts(bins).iter().map(|shape| with_number(bins, shape)).collect();
    let limits = bounds.with_number();
    let run = |start: &[f64], taming| minimise(&SpectrumResiduals { bins, taming }, start, &limits, THOROUGH);
    let plain: Vec<Minimum> = starts.iter().filter_map(|start| run(start, None)).collect();
    let (best, scale) = best_of(bins, &plain, noise_known)?;
    // Where a bin stands out even from the best fit, it may have pulled all of them: search again with tamed residuals.
    let worst = residuals_of(bins, &best.parameters).iter().fold(0.0f64, |m, r| m.max(r.abs()));
    let ends = if noise_known && worst <= outlier_mads {
        plain
    } else {
        let again = starts.iter().chain(plain.iter().map(|end| &end.parameters));
        again.filter_map(|start| run(start, Some(2.5 * scale))).collect()
    };
    choose(bins, &ends, bounds, noise_known, outlier_mads)
}

/// Fits one altitude from the shape that its neighbours suggest.
pub(super) fn fit_near(
    spectrum: &Spectrum,
    near: &Shape,
    bounds: &Bounds,
    noise_known: bool,
    outlier_mads: f64,
) -> Option<Lone> {
    let bins = &spectrum.bins;
    let start = with_number(bins, near);
    let limits = bounds.with_number();
    let run = |start: &[f64], taming| minimise(&SpectrumResiduals { bins, taming }, start, &limits, THOROUGH);
    let scale = scale_of(&residuals_of(bins, &start), noise_known);
    let first = run(&start, Some(2.5 * scale))?;
    let scale = scale_of(&residuals_of(bins, &first.parameters), noise_known);
    let second = run(&first.parameters, Some(2.5 * scale))?;
    choose(bins, &[second], bounds, noise_known, outlier_mads)
}

/// Of the ends that fit as well as the best (to four units of deviance), the first whose Gaussian is the narrow part and
/// that touches no bound; then bad bins are set aside, and the rest is fitted by plain likelihood.
fn choose(
    bins: &[Bin],
    ends: &[Minimum],
    bounds: &Bounds,
    noise_known: bool,
    outlier_mads: f64,
) -> Option<Lone> {
    let finish = |end: &Minimum| without_bad_bins(bins, &end.parameters, bounds, noise_known, outlier_mads);
    let (best, scale) = best_of(bins, ends, noise_known)?;
    let score = |end: &Minimum| trusted_sum(&residuals_of(bins, &end.parameters));
    let unit = scale * scale;
    let limit = score(best) + 4.0 * unit;
    let agreeing = ends.iter().filter(|end| score(end) <= score(best) + unit).count();
    let good = |lone: &Lone| lone.gaussian_is_narrow() && !bounds.touched(&lone.shape);
    let mut fallback = None;
    let mut tried: Vec<&Minimum> = Vec::new();
    for end in std::iter::once(best).chain(ends.iter().filter(|end| score(end) <= limit)) {
        let same = |other: &&Minimum| {
            other.parameters.iter().zip(&end.parameters).all(|(a, b)| (a - b).abs() <= 1e-3 * (1.0 + b.abs()))
        };
        if tried.iter().any(same) {
            continue;
        }
        tried.push(end);
        let lone = finish(end).map(|lone| Lone { agreeing_starts: agreeing, ..lone });
        if lone.as_ref().is_some_and(good) {
            return lone;
        }
        fallback = fallback.or(lone);
    }
    fallback
}

/// The end whose trusted bins fit best, and the scale of its residuals.
fn best_of<'a>(bins: &[Bin], ends: &'a [Minimum], noise_known: bool) -> Option<(&'a Minimum, f64)> {
    let mut best: Option<(&Minimum, f64, Vec<f64>)> = None;
    for end in ends {
        let residuals = residuals_of(bins, &end.parameters);
        let score = trusted_sum(&residuals);
        if best.as_ref().is_none_or(|(_, least, _)| score < *least) {
            best = Some((end, score, residuals));
        }
    }
    best.map(|(end, _, residuals)| (end, scale_of(&residuals, noise_known)))
}

/// Standard deviation of residuals by their median; at least that of counting noise where this is known.
fn scale_of(residuals: &[f64], noise_known: bool) -> f64 {
    let n = residuals.len() as f64;
    let freedom = (n / (n - PARAMETERS as f64).max(1.0)).sqrt();
    let scale = freedom * robust_scale(residuals.iter().copied());
    scale.max(if noise_known { 1.0 } else { 1e-6 })
}

/// Sets bins aside whose residuals exceed the limit, the worst first, and fits the others.
fn without_bad_bins(
    bins: &[Bin],
    start: &[f64],
    bounds: &Bounds,
    noise_known: bool,
    outlier_mads: f64,
) -> Option<Lone> {
    let most = ((BAD_SHARE_MAX * bins.len() as f64) as usize).min(bins.len() - BINS_MIN);
    let mut parameters = start.to_vec();
    let mut bad: Vec<usize> = Vec::new();
    for _ in 0..3 {
        let residuals = residuals_of(bins, &parameters);
        let kept: Vec<f64> = (0..bins.len()).filter(|i| !bad.contains(i)).map(|i| residuals[i]).collect();
        let limit = outlier_mads * scale_of(&kept, noise_known);
        let mut worst: Vec<usize> = (0..bins.len()).filter(|&i| residuals[i].abs() > limit).collect();
        worst.sort_by(|&a, &b| residuals[b].abs().total_cmp(&residuals[a].abs()));
        worst.truncate(most);
        worst.sort_unstable();
        let good: Vec<Bin> = (0..bins.len()).filter(|i| !worst.contains(i)).map(|i| bins[i]).collect();
        let limits = bounds.with_number();
        let end = minimise(&SpectrumResiduals { bins: &good, taming: None }, &parameters, &limits, THOROUGH)?;
        let settled = worst == bad;
        bad = worst;
        parameters = end.parameters;
        if settled || bad.is_empty() {
            return Some(lone(bins, &good, bad, &parameters, end.sum, end.converged));
        }
    }
    let good: Vec<Bin> = (0..bins.len()).filter(|i| !bad.contains(i)).map(|i| bins[i]).collect();
    let deviance = residuals_of(&good, &parameters).iter().map(|r| r * r).sum();
    Some(lone(bins, &good, bad, &parameters, deviance, true))
}

fn lone(
    bins: &[Bin],
    good: &[Bin],
    bad_bins: Vec<usize>,
    parameters: &[f64],
    deviance: f64,
    converged: bool,
) -> Lone {
    Lone {
        ln_number: parameters[0],
        shape: shape_of(parameters),
        errors: errors(good, parameters),
        deviance,
        bad_bins,
        score: trusted_sum(&residuals_of(bins, parameters)),
        converged,
        agreeing_starts: 1,
    }
}

/// Standard errors from Fisher's information of Poisson counts, Σ ∂m ∂m / m.
fn errors(bins: &[Bin], parameters: &[f64]) -> Option<[f64; PARAMETERS]> {
    let mut share = Vec::new();
    shares(&shape_of(parameters), bins, &mut share);
    let mut information = vec![vec![0.0; PARAMETERS]; PARAMETERS];
    for (bin, share) in bins.iter().zip(&share) {
        let sampled = exp(parameters[0]) * bin.volume_m3;
        let slope = |p: usize| sampled * if p == 0 { share.value } else { share.by_shape[p - 1] };
        for i in 0..PARAMETERS {
            for j in 0..PARAMETERS {
                information[i][j] += slope(i) * slope(j) / (sampled * share.value);
            }
        }
    }
    let covariance = inverse(&information)?;
    Some(std::array::from_fn(|p| covariance[p][p].sqrt()))
}

/// ln N that gives as many droplets as were measured, then the shape.
fn with_number(bins: &[Bin], shape: &Shape) -> Vec<f64> {
    let mut share = Vec::new();
    shares(shape, bins, &mut share);
    let expected: f64 = share.iter().zip(bins).map(|(share, bin)| share.value * bin.volume_m3).sum();
    let droplets: f64 = bins.iter().map(|bin| bin.droplets).sum();
    std::iter::once(ln(droplets / expected)).chain(*shape).collect()
}
