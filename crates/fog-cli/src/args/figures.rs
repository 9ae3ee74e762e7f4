//! Arguments of `fogbank figures`.

use clap::builder::PossibleValuesParser;
use clap::{Args, ValueEnum};
use std::path::PathBuf;

const EXAMPLES: &str = "\
Examples:
  fogbank figures --out figures                              every figure of the shipped model
  fogbank figures --out figures --only fig9 --only fig11     visibility by day, of lights at night
  fogbank figures --out figures --height 120 --only profiles --format svg,csv
  fogbank figures --out figures --coefficients my_fog.yaml   a model of `fogbank fit`, or your own

Figures:
  fig3         a droplet spectrum and its two parts
  fig4         droplet spectra by altitude
  fig5         number density by altitude
  fig6         droplet spectra at two altitudes
  fig7         the model beside another fog
  fig9         visibility of objects by day (Koschmieder)
  fig11        visibility of lights at night (Allard)
  profiles     extinction, water, effective radius and g by altitude
  wavelengths  extinction, absorption and g, 300 to 2500 nm
  phase        phase functions by angle
  phenomena    rainbow, fogbow, glory and corona by droplet size, with their colours

Numbers of figures are those of Kolářová, Lachiver & Wilkie 2024. Figures of one fog take, of the heights given, the lowest \
(fig3), the middle (fig4, fig6, fig7, wavelengths) or the highest (fig9, fig11): 100, 180 and 260 m are the paper's.";

/// Arguments of `figures`.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct FiguresArgs {
    /// Folder for the figures, one file per figure and format; made if it is not there.
    #[arg(long, value_name = "DIR")]
    pub(crate) out: PathBuf,
    /// Coefficients of the fog model: a file of `fogbank fit`, or your own of the form of tables/advection/arcata.yaml
    /// [default: that file].
    #[arg(long, value_name = "FILE")]
    pub(crate) coefficients: Option<PathBuf>,
    /// Fog height in m, 1 to 2000; may be repeated.
    #[arg(long = "height", value_name = "M", value_delimiter = ',', default_values_t = fogbank::figures::PAPER_HEIGHTS_M)]
    pub(crate) heights: Vec<f64>,
    /// Draw this figure alone; may be repeated.
    #[arg(long, value_name = "NAME", value_delimiter = ',', value_parser = PossibleValuesParser::new(fogbank::figures::NAMES), hide_possible_values = true)]
    pub(crate) only: Vec<String>,
    /// Formats to write: pictures, and the numbers in them as CSV.
    #[arg(long, value_name = "FORMATS", value_delimiter = ',', default_values_t = [FigureFormat::Svg, FigureFormat::Png, FigureFormat::Csv])]
    pub(crate) format: Vec<FigureFormat>,
    /// Print errors only.
    #[arg(long, short)]
    pub(crate) quiet: bool,
}

/// A file format of figures.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum FigureFormat {
    Svg,
    Png,
    Csv,
}

impl FigureFormat {
    /// Ending of a file's name.
    pub(crate) fn extension(self) -> &'static str {
        match self {
            Self::Svg => "svg",
            Self::Png => "png",
            Self::Csv => "csv",
        }
    }
}

impl std::fmt::Display for FigureFormat {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self.extension())
    }
}
