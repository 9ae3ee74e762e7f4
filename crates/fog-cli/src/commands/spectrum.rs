//! A droplet spectrum by what a user types for it.

use anyhow::{Context, Result, bail};
use fogbank::optics::catalogue;
use fogbank::optics::size::{LognormalMode, SizeDistribution};
use fogbank::optics::spectrum_csv::parse_spectrum;
use std::path::Path;

/// A spectrum, and how many droplets its source has per m³ where it says so.
pub(super) struct Spectrum {
    pub(super) distribution: SizeDistribution,
    pub(super) number_density_1_m3: Option<f64>,
    pub(super) description: String,
}

/// A name of the catalogue, `gamma:R,V`, `lognormal:D,S` or a CSV file.
pub(super) fn read(text: &str) -> Result<Spectrum> {
    if let Some(parameters) = text.strip_prefix("gamma:") {
        let [radius, variance] = pair(text, parameters)?;
        let description =
            format!("gamma spectrum, effective radius {radius} µm, effective variance {variance}");
        let distribution = SizeDistribution::gamma(radius, variance)?;
        return Ok(Spectrum { distribution, number_density_1_m3: None, description });
    }
    if let Some(parameters) = text.strip_prefix("lognormal:") {
        let [median_diameter_um, geometric_sd] = pair(text, parameters)?;
        let mode = LognormalMode { share: 1.0, median_diameter_um, geometric_sd };
        return Ok(Spectrum {
            distribution: SizeDistribution::lognormals(&[mode])?,
            number_density_1_m3: None,
            description: format!(
                "lognormal spectrum, median diameter {median_diameter_um} µm, geometric standard deviation {geometric_sd}"
            ),
        });
    }
    if Path::new(text).extension().is_some_and(|e| e.eq_ignore_ascii_case("csv")) {
        let content = std::fs::read_to_string(text).with_context(|| format!("cannot read {text}"))?;
        let measured = parse_spectrum(&content, text)?;
        return Ok(Spectrum {
            distribution: measured.distribution,
            number_density_1_m3: measured.number_density_1_m3,
            description: format!("spectrum of {text}"),
        });
    }
    let named = catalogue::named(text)?;
    Ok(Spectrum {
        distribution: named.distribution,
        number_density_1_m3: Some(named.number_density_1_m3),
        description: format!("{} ({})", named.description, named.source),
    })
}

fn pair(whole: &str, parameters: &str) -> Result<[f64; 2]> {
    let numbers: Vec<Option<f64>> = parameters.split(',').map(|p| p.trim().parse().ok()).collect();
    match numbers[..] {
        [Some(a), Some(b)] => Ok([a, b]),
        _ => bail!("--distribution {whole}: expected two numbers, as gamma:6,0.12 or lognormal:10,1.5"),
    }
}
