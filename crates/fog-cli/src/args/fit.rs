//! Arguments of `fit`.

use clap::{Args as ClapArgs, Subcommand};
use std::path::PathBuf;

const EXAMPLES: &str = "\
DATA.csv has one row for each fog height, altitude and diameter bin:
  fog_height_m,altitude_m,diameter_low_um,diameter_high_um,count,sample_volume_m3
  100,5,2,5,1043,5.7e-5
The name of the column of values says what they are, exactly one of:
  count                droplets counted in the bin; needs sample_volume_m3
  number_per_bin_1_m3  droplets of the bin per m3 of air
  density_1_m3_um      droplets per m3 of air and um of diameter
sample_volume_m3 gives the counting noise. Rows of the same place and bin (several approaches)
are merged. A bin without a row is a gap, not a zero. Lines that begin with # are comments.

MODEL.yaml has the form of tables/advection/arcata.yaml.
DIR gets report.md, its figures as SVG and PNG, and the numbers in fits.csv, parameters.csv and spectra.csv.

Examples:
  fogbank fit flights.csv --out model.yaml --report report
  fogbank fit synthetic --out flights.csv           counts that a probe would bring home
  fogbank fit synthetic --out fine.csv --bins 1.5,46.5,1 --sample-volume-cm3 200 --seed 7";

/// Arguments of `fit`.
#[derive(Debug, ClapArgs)]
#[command(after_help = EXAMPLES, args_conflicts_with_subcommands = true, subcommand_negates_reqs = true)]
pub(crate) struct FitArgs {
    /// Measured droplet counts (CSV, see below).
    #[arg(required = true)]
    pub(crate) data: Option<PathBuf>,
    /// File of the fitted model.
    #[arg(long, value_name = "MODEL.yaml", required = true)]
    pub(crate) out: Option<PathBuf>,
    /// Folder for the report; made if it is not there.
    #[arg(long, value_name = "DIR")]
    pub(crate) report: Option<PathBuf>,
    /// Diameters in um that the model is summed over [default: 0.5,60, widened to the measured bins].
    #[arg(long, value_name = "LOW,HIGH", value_delimiter = ',')]
    pub(crate) diameter_range_um: Option<Vec<f64>>,
    /// Deviation, in robust standard deviations, beyond which bins and altitudes are set aside.
    #[arg(long, value_name = "N", default_value_t = 5.0)]
    pub(crate) outlier_mads: f64,
    /// Stop after the stages of the paper: do not fit all counts at once.
    #[arg(long)]
    pub(crate) staged: bool,
    /// Print errors and warnings only.
    #[arg(long, short)]
    pub(crate) quiet: bool,
    #[command(subcommand)]
    pub(crate) command: Option<FitCommand>,
}

#[derive(Debug, Subcommand)]
pub(crate) enum FitCommand {
    /// Write the counts of synthetic flights through fog of a known model, with counting noise.
    Synthetic(SyntheticArgs),
}

/// Arguments of `fit synthetic`.
#[derive(Debug, ClapArgs)]
pub(crate) struct SyntheticArgs {
    /// File to write (CSV).
    #[arg(long, value_name = "DATA.csv")]
    pub(crate) out: PathBuf,
    /// Fog model to fly through: `arcata`, the shipped one, or a model file.
    #[arg(long, value_name = "MODEL", default_value = "arcata")]
    pub(crate) model: String,
    /// Fog heights in m.
    #[arg(long, value_name = "H,H,...", value_delimiter = ',', default_value = "100,180,260")]
    pub(crate) heights_m: Vec<f64>,
    /// Vertical distance of the altitudes in m.
    #[arg(long, value_name = "M", default_value_t = 10.0)]
    pub(crate) altitude_step_m: f64,
    /// Diameter bins in um: from the first edge to the last, and their width.
    #[arg(long = "bins", value_name = "LOW,HIGH,WIDTH", value_delimiter = ',', default_value = "1.5,46.5,3")]
    pub(crate) bins_um: Vec<f64>,
    /// Air in cm3 that each approach samples at each altitude [default: what a probe of 0.3 mm2 sweeps on 10 m of a 3 degree
    /// glide slope, 57.3].
    #[arg(long, value_name = "CM3")]
    pub(crate) sample_volume_cm3: Option<f64>,
    /// Approaches through the fog of each height.
    #[arg(long, value_name = "N", default_value_t = 2)]
    pub(crate) approaches: usize,
    /// Seed of the counting noise.
    #[arg(long, value_name = "N", default_value_t = 1)]
    pub(crate) seed: u64,
}
