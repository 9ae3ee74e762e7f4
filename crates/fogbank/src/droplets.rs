//! Droplets of a specification: spectra, vertical profiles and the files that they may come from.

use crate::error::Error;
use fog_core::optics_table::OpticsTable;
use fog_optics::advection::AdvectionModel;
use fog_optics::catalogue;
use fog_optics::droplets::{DropletLayer, Spectra};
use fog_optics::size::{LognormalMode, ModifiedGamma, SizeDistribution};
use fog_optics::spectrum_csv::parse_spectrum;
use fog_optics::vertical::VerticalProfile;
use fog_plan::{DropletsSpec, VerticalSpec};
use serde_json::{Value, json};
use std::path::Path;

/// Number density in 1/m³ of a fog whose number only a visibility fixes: 100 per cm³, before it is scaled.
const ANY_NUMBER_1_M3: f64 = 1e8;

/// A spectrum of a configuration, with its optics table.
#[derive(Clone, Debug)]
pub(crate) struct Spectrum {
    pub(crate) distribution: SizeDistribution,
    /// Number of droplets that comes with the spectrum, in 1/m³.
    pub(crate) number_density_1_m3: Option<f64>,
    /// Where it comes from.
    source: String,
    pub(crate) table: OpticsTable,
}

impl Spectrum {
    /// Reads the spectrum of a specification; `table` is asked for its table.
    pub(crate) fn new(
        spec: &DropletsSpec,
        table: impl FnOnce(&Spectra) -> Result<OpticsTable, Error>,
    ) -> Result<Self, Error> {
        let (distribution, number_density_1_m3, source) = read(spec)?;
        let table = table(&Spectra::Same(distribution.clone()))?;
        Ok(Self { distribution, number_density_1_m3, source, table })
    }

    /// What a record says about the spectrum.
    pub(crate) fn to_json(&self) -> Value {
        let moments = self.distribution.moments();
        json!({
            "source": self.source,
            "diameter_range_um": self.distribution.grid().range_um(),
            "share_in_range": moments.share_in_range,
            "mean_diameter_um": moments.mean_diameter_um,
            "effective_radius_um": moments.effective_radius_um,
            "effective_variance": moments.effective_variance,
        })
    }
}

fn read(spec: &DropletsSpec) -> Result<(SizeDistribution, Option<f64>, String), Error> {
    Ok(match spec {
        DropletsSpec::Gamma { effective_radius_um, effective_variance } => {
            let distribution = SizeDistribution::gamma(*effective_radius_um, *effective_variance)?;
            (distribution, None, "gamma distribution".to_owned())
        }
        DropletsSpec::ModifiedGamma { alpha, b, gamma } => {
            let parameters = ModifiedGamma { alpha: *alpha, b: *b, gamma: *gamma };
            let distribution = SizeDistribution::modified_gamma(parameters)?;
            (distribution, None, "modified gamma distribution".to_owned())
        }
        DropletsSpec::Lognormals(modes) => {
            let modes: Vec<LognormalMode> = (modes.iter())
                .map(|m| LognormalMode {
                    share: m.share,
                    median_diameter_um: m.median_diameter_um,
                    geometric_sd: m.geometric_sd,
                })
                .collect();
            (SizeDistribution::lognormals(&modes)?, None, "sum of lognormals".to_owned())
        }
        DropletsSpec::File(file) => {
            let spectrum = parse_spectrum(&text(file)?, &file.display().to_string())?;
            (spectrum.distribution, spectrum.number_density_1_m3, file.display().to_string())
        }
        DropletsSpec::Named(name) => {
            let named = catalogue::named(name)?;
            (named.distribution, Some(named.number_density_1_m3), named.source.to_owned())
        }
    })
}

/// The fog of a layer: a spectrum, its number, and where the droplets are. `number_density_1_m3` is the specification's;
/// `scaled_later` says that a visibility will fix the number.
pub(crate) fn fog(
    spectrum: &Spectrum,
    number_density_1_m3: Option<f64>,
    scaled_later: bool,
    vertical: &VerticalSpec,
    height_m: f64,
    model: &AdvectionModel,
) -> Result<DropletLayer, Error> {
    let any = scaled_later.then_some(ANY_NUMBER_1_M3);
    let number = number_density_1_m3.or(spectrum.number_density_1_m3).or(any).ok_or_else(|| {
        let source = &spectrum.source;
        Error::Fog(format!(
            "{source} says nothing about the number of droplets per volume: give fog.number_density_1_m3 or \
             fog.visibility"
        ))
    })?;
    let profile = match vertical {
        VerticalSpec::Uniform => VerticalProfile::uniform(),
        VerticalSpec::Advection => VerticalProfile::advection(model, height_m)?.0,
        VerticalSpec::Thinning(exponent) => VerticalProfile::thinning(*exponent)?,
        VerticalSpec::Rows(rows) => {
            VerticalProfile::rows(&rows.iter().map(|[zeta, n]| (*zeta, *n)).collect::<Vec<_>>())?
        }
        VerticalSpec::File(file) => VerticalProfile::from_csv(&text(file)?, &file.display().to_string())?,
    };
    Ok(DropletLayer::new(Spectra::Same(spectrum.distribution.clone()), profile, number, height_m)?)
}

fn text(file: &Path) -> Result<String, Error> {
    std::fs::read_to_string(file).map_err(|source| Error::Read { path: file.to_owned(), source })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_named_spectrum_can_be_configured() {
        for name in catalogue::NAMES {
            let text = format!(
                "version: 1\nname: t\nscene: none\nfog: {{model: droplets, height_m: 60, droplets: {name}}}\n"
            );
            let frame = fog_plan::parse(&text, "t.yaml", &[]).unwrap().frame(0).unwrap();
            let fog_plan::FogModel::Droplets { droplets, .. } = frame.fog.model else { panic!("{name}") };
            assert_eq!(droplets, DropletsSpec::Named(name.to_owned()));
        }
        let schema = fog_plan::schema_json().to_string();
        let in_schema = schema.matches("\"shettle_fenn_").count() + schema.matches("\"deirmendjian_").count();
        assert_eq!(in_schema, catalogue::NAMES.len(), "names that the catalogue does not have");
    }
}
