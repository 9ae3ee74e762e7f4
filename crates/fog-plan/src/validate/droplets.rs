//! Checks of `fog.droplets`, `fog.number_density_1_m3` and `fog.vertical`.

use super::Check;
use crate::{
    droplets::{DropletsSpec, LognormalSpec, VerticalSpec},
    frame::FogModel,
    ranges::{self, Range},
    schema::{DropletsFile, FogFile, GammaFile, LognormalFile, ModifiedGammaFile, VerticalFile},
};

/// γ of a modified gamma distribution that does not say.
const DEFAULT_GAMMA: f64 = 1.0;
/// Share of a lognormal that does not say.
const DEFAULT_SHARE: f64 = 1.0;
/// Most lognormals of a sum.
const MAX_LOGNORMALS: usize = 16;

impl Check<'_> {
    pub(super) fn parcel(&mut self, fog: &FogFile, height_m: Option<f64>) -> Option<FogModel> {
        let path = "fog.number_density_1_m3";
        let number = self.optional(path, fog.number_density_1_m3, ranges::NUMBER_DENSITY_1_M3);
        let why = "a name such as shettle_fenn_radiation_heavy, or one of {gamma: …}, {modified_gamma: …}, \
                   {lognormals: …}, {file: …}";
        let droplets = self.required("fog.droplets", fog.droplets.as_ref(), why);
        let droplets = droplets.and_then(|droplets| self.droplets(droplets));
        // Names and measured files can bring their number with them.
        let formula = matches!(
            droplets,
            Some(
                DropletsSpec::Gamma { .. } | DropletsSpec::ModifiedGamma { .. } | DropletsSpec::Lognormals(_)
            )
        );
        if formula && number == Some(None) && fog.visibility.is_none() {
            self.required(
                path,
                None::<f64>,
                "droplets per m³ in the mean over altitude, or give fog.visibility",
            );
            return None;
        }
        let vertical = match &fog.vertical {
            None => Some(VerticalSpec::Uniform),
            Some(vertical) => self.vertical(vertical),
        };
        Some(FogModel::Droplets {
            height_m: height_m?,
            droplets: droplets?,
            number_density_1_m3: number?,
            vertical: vertical?,
        })
    }

    fn droplets(&mut self, droplets: &DropletsFile) -> Option<DropletsSpec> {
        Some(match droplets {
            DropletsFile::Gamma(GammaFile { effective_radius_um, effective_variance }) => {
                let key = |key| format!("fog.droplets.gamma.{key}");
                let radius = self.needed(
                    &key("effective_radius_um"),
                    *effective_radius_um,
                    ranges::EFFECTIVE_RADIUS_UM,
                    "0.01 to 500 µm",
                );
                let variance = self.needed(
                    &key("effective_variance"),
                    *effective_variance,
                    ranges::EFFECTIVE_VARIANCE,
                    "0.001 to 0.33, usually about 0.1",
                );
                DropletsSpec::Gamma { effective_radius_um: radius?, effective_variance: variance? }
            }
            DropletsFile::ModifiedGamma(ModifiedGammaFile { alpha, b, gamma }) => {
                let key = |key| format!("fog.droplets.modified_gamma.{key}");
                let alpha =
                    self.needed(&key("alpha"), *alpha, ranges::ALPHA, "exponent of the rise, 0 to 1000");
                let b = self.needed(&key("b"), *b, ranges::B, "rate of the fall in µm^-gamma");
                let gamma = self.range(&key("gamma"), gamma.unwrap_or(DEFAULT_GAMMA), ranges::GAMMA);
                DropletsSpec::ModifiedGamma { alpha: alpha?, b: b?, gamma: gamma? }
            }
            DropletsFile::Lognormals(modes) => DropletsSpec::Lognormals(self.lognormals(modes)?),
            DropletsFile::File(file) => DropletsSpec::File(file.into()),
            named => DropletsSpec::Named(named.name()?),
        })
    }

    fn lognormals(&mut self, modes: &[LognormalFile]) -> Option<Vec<LognormalSpec>> {
        if modes.is_empty() || modes.len() > MAX_LOGNORMALS {
            let message = format!("{} lognormals; valid: 1 to {MAX_LOGNORMALS}", modes.len());
            self.problem("fog.droplets.lognormals", message);
            return None;
        }
        let mut specs = Vec::new();
        for (i, mode) in modes.iter().enumerate() {
            let key = |key| format!("fog.droplets.lognormals.{i}.{key}");
            let share = self.range(&key("share"), mode.share.unwrap_or(DEFAULT_SHARE), ranges::SHARE);
            let median = self.needed(
                &key("median_diameter_um"),
                mode.median_diameter_um,
                ranges::MEDIAN_DIAMETER_UM,
                "0.02 to 500 µm",
            );
            let sd = self.needed(&key("geometric_sd"), mode.geometric_sd, ranges::GEOMETRIC_SD, "1.02 to 4");
            if let (Some(share), Some(median_diameter_um), Some(geometric_sd)) = (share, median, sd) {
                specs.push(LognormalSpec { share, median_diameter_um, geometric_sd });
            }
        }
        (specs.len() == modes.len()).then_some(specs)
    }

    fn vertical(&mut self, vertical: &VerticalFile) -> Option<VerticalSpec> {
        Some(match vertical {
            VerticalFile::Uniform => VerticalSpec::Uniform,
            VerticalFile::Advection => VerticalSpec::Advection,
            VerticalFile::Thinning(exponent) => {
                VerticalSpec::Thinning(self.range("fog.vertical.thinning", *exponent, ranges::THINNING)?)
            }
            VerticalFile::Rows(rows) => VerticalSpec::Rows(self.rows(rows)?),
            VerticalFile::File(file) => VerticalSpec::File(file.into()),
        })
    }

    fn rows(&mut self, rows: &[[f64; 2]]) -> Option<Vec<[f64; 2]>> {
        let path = "fog.vertical.rows";
        if rows.len() < 2 {
            self.problem(path, format!("{} rows; valid: at least 2", rows.len()));
            return None;
        }
        if rows.iter().all(|row| row[1] == 0.0) {
            self.problem(path, "no droplets at any altitude");
            return None;
        }
        let mut good = true;
        for (i, [altitude, number]) in rows.iter().enumerate() {
            good &= self.range(&format!("{path}.{i}.0"), *altitude, ranges::RELATIVE_ALTITUDE).is_some();
            good &= self.range(&format!("{path}.{i}.1"), *number, ranges::RELATIVE_NUMBER).is_some();
            if i > 0 && *altitude <= rows[i - 1][0] {
                let message = format!("{altitude} follows {}; valid: ascending", rows[i - 1][0]);
                self.problem(&format!("{path}.{i}.0"), message);
                good = false;
            }
        }
        good.then(|| rows.to_vec())
    }

    /// A key that must be there and in its range.
    pub(super) fn needed(&mut self, path: &str, value: Option<f64>, range: Range, why: &str) -> Option<f64> {
        let value = self.required(path, value, why);
        value.and_then(|value| self.range(path, value, range))
    }
}
