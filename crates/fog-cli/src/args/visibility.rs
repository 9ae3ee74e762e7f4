//! Arguments of `visibility`.

use super::number::{number, numbers};
use super::{FogSourceArgs, FormArgs};
use clap::builder::PossibleValuesParser;
use clap::{Args, ValueEnum};
use fogbank::optics::visibility::threshold;
use std::path::PathBuf;

const EXAMPLES: &str = "\
Examples:
  fogbank visibility --model advection --height 180 --altitude 2
  fogbank visibility --model advection --height 180 --altitude 60 --mor 300 --slant -3 --light night
  fogbank visibility --model advection --height 180 --altitude 60 --to 0,1145
  fogbank visibility --distribution shettle_fenn_radiation_heavy --light day --intensity 100 1000
  fogbank visibility --lwc 0.1 --number 1e8              size of the droplets, then everything else
  fogbank visibility --mor 350 --json

Objects: Koschmieder's law at 5 % contrast (the meteorological optical range of WMO-No. 8) and at 2 %. Lights: Allard's law \
with ICAO's thresholds of illuminance (Annex 3, Doc 9328: night, twilight, day, bright_day) or WMO's (WMO-No. 8: wmo_...). \
RVR: the greater of the markings' and the lights' range 2.5 m over the runway, which lies at altitude 0. All at 550 nm.";

/// Definition of the landing categories.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum EditionArg {
    /// CAT III in A, B and C (older text of ICAO Annex 6).
    Split,
    /// One CAT III (newer text).
    Undivided,
}

/// Arguments of `visibility`.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct VisibilityArgs {
    /// Fog layer from a CSV file with the columns altitude_m,sigma_t_1_m.
    #[arg(long, value_name = "FILE", conflicts_with_all = ["model", "distribution", "number", "lwc", "mor", "sigma", "height"])]
    pub(crate) layers: Option<PathBuf>,
    /// Look along these elevation angles in degrees: -3 is 3° down.
    #[arg(long, value_name = "DEG", value_parser = number, num_args = 1.., value_delimiter = ',',
          allow_negative_numbers = true)]
    pub(crate) slant: Vec<f64>,
    /// Look at a point: its altitude in m and its horizontal distance in m.
    #[arg(long, value_name = "ALT,DIST", value_parser = numbers::<2>, allow_hyphen_values = true)]
    pub(crate) to: Option<[f64; 2]>,
    /// Intensities of lights in cd [default: 100 1000 10000, as the paper's Fig. 11].
    #[arg(long, value_name = "CD", value_parser = number, num_args = 1.., value_delimiter = ',',
          allow_negative_numbers = true)]
    pub(crate) intensity: Vec<f64>,
    /// Thresholds of illuminance by name [default: ICAO's four].
    #[arg(long, value_name = "NAME", num_args = 1.., value_delimiter = ',',
          value_parser = PossibleValuesParser::new(threshold::NAMES))]
    pub(crate) light: Vec<String>,
    /// A threshold by background luminance in cd/m², after ICAO's continuous relation; instead of --light or beside it.
    #[arg(long, value_name = "CD/M2", value_parser = number, allow_negative_numbers = true)]
    pub(crate) background: Option<f64>,
    /// Runway lights for RVR: intensity of edge and centre-line lights in cd.
    #[arg(long, value_name = "EDGE,CENTRE", value_parser = numbers::<2>, default_value = "10000,5000",
          allow_hyphen_values = true)]
    pub(crate) runway_lights: [f64; 2],
    /// Setting of the runway lights in per cent of full intensity.
    #[arg(long, value_name = "PERCENT", value_parser = number, default_value = "100", allow_negative_numbers = true)]
    pub(crate) light_setting: f64,
    /// Definition of the landing categories.
    #[arg(long, value_enum, default_value = "split")]
    pub(crate) categories: EditionArg,
    #[command(flatten)]
    pub(crate) form: FormArgs,
    // Last, for its heading holds for all that follows.
    #[command(flatten)]
    pub(crate) fog: FogSourceArgs,
}
