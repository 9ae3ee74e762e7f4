//! The number density over relative altitude and fog height: the paper's scaling parameter matrix.

use super::FitSettings;
use super::joint::shape_at;
use super::linear::dot;
use super::outcome::{NumberFit, Standing};
use super::shapes::Shapes;
use super::survey::Survey;
use super::trend::{self, Degrees, Domain, Point, TrendSettings};
use crate::error::OpticsError;

/// Number densities of the altitudes and the polynomial through them.
pub(super) struct Number {
    pub(super) fit: NumberFit,
    /// By altitude of the survey: value and standard error in m⁻³, and whether it was set aside.
    pub(super) values: Vec<Option<([f64; 2], bool)>>,
}

pub(super) fn number(
    survey: &mut Survey<'_>,
    shapes: &Shapes,
    settings: &FitSettings,
) -> Result<Number, OpticsError> {
    let mut values: Vec<Option<([f64; 2], bool)>> = vec![None; survey.places.len()];
    let mut indices = Vec::new();
    let mut points = Vec::new();
    for (i, place) in survey.places.iter().enumerate() {
        if matches!(place.standing, Standing::Rejected(_)) {
            continue;
        }
        let layer = place.layer();
        let droplets = layer.droplets();
        if droplets == 0.0 {
            continue;
        }
        let value = layer.number(&shape_at(shapes.polynomials(), layer.zeta));
        let error = value * (shapes.dispersion / droplets).sqrt();
        values[i] = Some(([value, error], false));
        indices.push(i);
        points.push(Point { zeta: layer.zeta, height_m: place.spectrum.fog_height_m, value, error });
    }
    let mut heights: Vec<f64> = points.iter().map(|p| p.height_m).collect();
    heights.dedup();
    let [Some(&low), Some(&high)] = [heights.first(), heights.last()] else {
        return Err(survey.refuse("no altitude is left for the number density".into()));
    };
    let domain = Domain { heights_m: [low, high], positive: false };
    let trend_settings = TrendSettings {
        most: Degrees {
            zeta: settings.max_number_degree,
            height: settings.max_height_degree.min(heights.len() - 1),
        },
        folds: settings.folds,
        outlier_mads: settings.outlier_mads,
        relative: true,
    };
    let trend = trend::fit(&points, &domain, &trend_settings)
        .ok_or_else(|| survey.refuse("too few altitudes are left for the number density".into()))?;
    for (index, _) in &trend.outliers {
        if let Some((_, rejected)) = &mut values[indices[*index]] {
            *rejected = true;
        }
    }

    let at = |zeta: f64, height: f64| dot(&domain.row(trend.degrees, zeta, height), &trend.fit.values);
    let kept: Vec<&Point> = (points.iter().enumerate())
        .filter(|(i, _)| trend.outliers.iter().all(|(outlier, _)| outlier != i))
        .map(|(_, point)| point)
        .collect();
    let n = kept.len() as f64;
    let mean = kept.iter().map(|p| p.value).sum::<f64>() / n;
    let square = |x: f64| x * x;
    let unexplained: f64 = kept.iter().map(|p| square(p.value - at(p.zeta, p.height_m))).sum();
    let all: f64 = kept.iter().map(|p| square(p.value - mean)).sum();
    let relative: f64 = kept.iter().map(|p| square(p.value / at(p.zeta, p.height_m) - 1.0)).sum();
    let curve = |height: f64, zeta: f64| {
        let row = domain.row(trend.degrees, zeta, height);
        [height, zeta, dot(&row, &trend.fit.values), trend.fit.standard_error(&row)]
    };
    let curves = heights
        .iter()
        .flat_map(|&h| (0..=20).map(move |i| (h, f64::from(i) / 20.0)))
        .map(|(h, z)| curve(h, z))
        .collect();
    let fit = NumberFit {
        coefficients: domain.powers(trend.degrees, &trend.fit.values),
        degrees: trend.degrees,
        cross_validation: trend.table.clone(),
        scatter: trend.scatter,
        r_squared: if all > 0.0 { 1.0 - unexplained / all } else { 0.0 },
        rms_relative: (relative / n).sqrt(),
        curves,
    };
    Ok(Number { fit, values })
}
