//! Which fog: the model, a droplet spectrum with an amount, or amounts alone.

use super::number::number;
use clap::{Args, ValueEnum};

/// Fog models.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Model {
    /// The advection fog of Kolářová, Lachiver & Wilkie 2024.
    Advection,
}

/// Which fog.
#[derive(Debug, Args)]
#[command(next_help_heading = "Fog")]
pub(crate) struct FogSourceArgs {
    /// Fog model; needs --height.
    #[arg(long, value_enum, requires = "height", conflicts_with_all = ["distribution", "number", "lwc", "sigma"])]
    pub(crate) model: Option<Model>,
    /// Height of the fog layer in m; the model is measured from 100 to 260 m.
    #[arg(long, value_name = "M", value_parser = number, allow_negative_numbers = true)]
    pub(crate) height: Option<f64>,
    /// Altitudes in m over the fog's base.
    #[arg(long, value_name = "M", value_parser = number, num_args = 1.., value_delimiter = ',',
          allow_negative_numbers = true)]
    pub(crate) altitude: Vec<f64>,
    /// Droplet spectrum: a name of the catalogue (as shettle_fenn_radiation_heavy), gamma:R,V (effective radius in µm,
    /// effective variance), lognormal:D,S (median diameter in µm, geometric standard deviation), or a CSV file.
    #[arg(long, value_name = "NAME")]
    pub(crate) distribution: Option<String>,
    /// Number of droplets per m³.
    #[arg(long, value_name = "1/M3", value_parser = number, allow_negative_numbers = true)]
    pub(crate) number: Option<f64>,
    /// Liquid water content in g/m³.
    #[arg(long, value_name = "G/M3", value_parser = number, allow_negative_numbers = true)]
    pub(crate) lwc: Option<f64>,
    /// Meteorological optical range in m (5 % contrast, 550 nm); with --model it scales the number of droplets so that it
    /// is met at the first --altitude.
    #[arg(long, value_name = "M", value_parser = number, allow_negative_numbers = true)]
    pub(crate) mor: Option<f64>,
    /// Extinction coefficient in 1/m at 550 nm.
    #[arg(long, value_name = "1/M", value_parser = number, allow_negative_numbers = true)]
    pub(crate) sigma: Option<f64>,
    /// Without --distribution, two amounts fix the size of the droplets of a gamma spectrum of this effective variance
    /// [default: 0.1111, n(r) ∝ r⁶ e^(−br)].
    #[arg(long, value_name = "V", value_parser = number, conflicts_with = "geometric_sd")]
    pub(crate) effective_variance: Option<f64>,
    /// Likewise of a lognormal spectrum of this geometric standard deviation.
    #[arg(long, value_name = "S", value_parser = number)]
    pub(crate) geometric_sd: Option<f64>,
}
