//! Arguments of `mie`.

use super::FormArgs;
use super::number::{Angles, angles, index, number};
use clap::Args;

const EXAMPLES: &str = "\
Examples:
  fogbank mie --index 1.333 --size-parameter 40
  fogbank mie --index 1.5,0.1 --size-parameter 10 --angles 0,90,180
  fogbank mie --diameter-um 10 --wavelength 905 --angles 0:180:1 --csv > phase.csv

q_back is 4 |S1(180°)|² / x² (Bohren & Huffman 1983); |S1|², |S2|² are their intensities, perpendicular and parallel to the \
scattering plane; the phase function, in 1/sr, is that of unpolarised light and integrates to 1 over the sphere.";

/// Arguments of `mie`.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct MieArgs {
    /// Refractive index n or n,k relative to the medium, k ≥ 0 absorbs [default: water at --wavelength].
    #[arg(long, value_name = "N[,K]", value_parser = index, required_unless_present = "wavelength", allow_negative_numbers = true)]
    pub(crate) index: Option<[f64; 2]>,
    /// Size parameter x = πd/λ, 1e-6 to 1e5.
    #[arg(long, value_name = "X", value_parser = number, allow_negative_numbers = true,
          required_unless_present_all = ["diameter_um", "wavelength"], conflicts_with = "diameter_um")]
    pub(crate) size_parameter: Option<f64>,
    /// Diameter of the sphere in µm, instead of --size-parameter.
    #[arg(long, value_name = "UM", value_parser = number, requires = "wavelength", allow_negative_numbers = true)]
    pub(crate) diameter_um: Option<f64>,
    /// Wavelength in nm, for --diameter-um and for the index of water.
    #[arg(long, value_name = "NM", value_parser = number, allow_negative_numbers = true)]
    pub(crate) wavelength: Option<f64>,
    /// Scattering angles in degrees: a list as 0,1,180 or FROM:TO:STEP.
    #[arg(long, value_name = "DEG", value_parser = angles, allow_hyphen_values = true)]
    pub(crate) angles: Option<Angles>,
    #[command(flatten)]
    pub(crate) form: FormArgs,
}
