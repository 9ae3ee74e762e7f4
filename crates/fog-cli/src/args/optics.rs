//! Arguments of `optics`.

use super::number::number;
use super::{FogSourceArgs, FormArgs};
use clap::Args;
use clap::builder::PossibleValuesParser;

const EXAMPLES: &str = "\
Examples:
  fogbank optics --model advection --height 180 --altitude 2 60 150 --wavelength 550 905 1550
  fogbank optics --model advection --coefficients my.yaml --height 180 --altitude 2 --wavelength 550
  fogbank optics --distribution shettle_fenn_radiation_heavy --preset lidar_905 --json
  fogbank optics --distribution gamma:6,0.12 --mor 100 --wavelength 550
  fogbank optics --lwc 0.1 --number 1e8 --preset visible --csv

A row per altitude and wavelength: efficiencies as means over the droplets' shadows (q_back in Bohren & Huffman's \
convention), coefficients of extinction and scattering in 1/m, the droplets in the spectrum's range of diameters, mor_m at \
550 nm and 5 % contrast at that altitude, backscatter in 1/(m sr) and the lidar ratio in sr, by the Mie series of water.";

/// Arguments of `optics`.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct OpticsArgs {
    /// Wavelengths in nm.
    #[arg(long, value_name = "NM", value_parser = number, num_args = 1.., value_delimiter = ',',
          required_unless_present = "preset", allow_negative_numbers = true)]
    pub(crate) wavelength: Vec<f64>,
    /// Wavelengths by name.
    #[arg(long, value_name = "NAME", value_parser = PossibleValuesParser::new(fogbank::optics::lidar::PRESETS.map(|p| p.name)))]
    pub(crate) preset: Option<String>,
    #[command(flatten)]
    pub(crate) form: FormArgs,
    // Last, for its heading holds for all that follows.
    #[command(flatten)]
    pub(crate) fog: FogSourceArgs,
}
