//! Arguments of `compare`.

use clap::Args as ClapArgs;
use fogbank::Reference;
use std::path::PathBuf;

const HELP: &str = "\
A is measured against the reference B. Pictures are OpenEXR (R, G, B or Y: linear radiance), PNG \
or JPEG (sRGB). Data sets are folders that `fogbank sweep` made; their frames are matched by id, \
or with --pair or --reference by pair id.

Figures:
  ΔE2000        CIEDE2000 (Sharma, Wu & Dalal 2005) of each pixel as it is shown: exposure x
                radiance, clipped to [0, 1], not rounded; the white is that of sRGB (D65).
                About 1 is just seen, 100 is black against white.
  relative MSE  mean of |a - b|^2 / (|b|^2 + 0.01 mean |b|^2) over R, G, B, linear radiance
  PSNR          of the 8-bit sRGB values, peak 255; `inf` for equal ones (JSON: null)
  relative difference
                mean |difference of luminance| over the mean luminance of B (table: |a-b|)
  mean luminance
                of A and B, and how much A is above B (table: means)
  z-scores      differences of luminance over their standard errors, where a file holds
                `standard_error.Y` (the output `standard_error` of a configuration). With an
                rms of 1 or less noise explains them; it is less where samples are stratified.
If a picture is PNG or JPEG, figures of radiance are of the linear values that a display shows.
With --blocks all figures are of the blocks' mean linear values.
The means over a data set are means of the figures; its PSNR is that of the mean square error.

Examples:
  fogbank compare a.hdr.exr b.hdr.exr --out map.png
  fogbank compare shot.png golden.png --fail-above 0.5   exit code 1 if the mean is above 0.5
  fogbank compare out/new out/old --json                 the same frames of two data sets
  fogbank compare out/fog out/fog --pair --out maps      foggy frames against their clear ones
  fogbank compare out/fog out/fog --reference fog.phase=mie   every fog against the one with Mie scattering

Exit codes: 0 compared, 1 above --fail-above, 2 they cannot be compared.";

/// Arguments of `compare`.
#[derive(Debug, ClapArgs)]
#[command(after_help = HELP)]
pub(crate) struct CompareArgs {
    /// Picture or folder of a data set.
    pub(crate) a: PathBuf,
    /// The reference: another picture, or folder of a data set.
    pub(crate) b: PathBuf,
    /// Write the map of ΔE2000 as PNG; for data sets a folder, made if it is not there, for one map per frame.
    #[arg(long, value_name = "PNG|DIR")]
    pub(crate) out: Option<PathBuf>,
    /// ΔE2000 of the map's brightest colour [default: the smallest of 0.1, 0.2, 0.5, 1, … 100 above 99 % of the pixels].
    #[arg(long, value_name = "DE", value_parser = positive)]
    pub(crate) scale: Option<f64>,
    /// Factor from radiance to the display's white [default: what each EXR file records, else 1].
    #[arg(long, value_name = "E", value_parser = positive)]
    pub(crate) exposure: Option<f64>,
    /// Match the frames of data sets by pair id, fog against clear; if B has several of a pair, its frame without fog.
    #[arg(long)]
    pub(crate) pair: bool,
    /// Match the frames of data sets by pair id, against those frames of B whose resolved configuration has this value,
    /// as fog.model=advection; A and B may be the same folder.
    #[arg(long, value_name = "KEY=VALUE", conflicts_with = "pair")]
    pub(crate) reference: Option<Reference>,
    /// Compare means over blocks of N x N pixels, so that noise does not hide a difference.
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..=4096))]
    pub(crate) blocks: u32,
    /// Print one JSON object; infinite figures are null.
    #[arg(long)]
    pub(crate) json: bool,
    /// Exit with code 1 if the mean ΔE2000 of a picture is above this.
    #[arg(long, value_name = "DE", value_parser = not_negative)]
    pub(crate) fail_above: Option<f64>,
}

fn positive(text: &str) -> Result<f64, String> {
    number(text)
        .filter(|x| *x > 0.0 && *x <= f64::from(f32::MAX))
        .ok_or_else(|| "expected a number above 0".into())
}

fn not_negative(text: &str) -> Result<f64, String> {
    number(text).filter(|x| *x >= 0.0).ok_or_else(|| "expected a number, 0 or more".into())
}

fn number(text: &str) -> Option<f64> {
    text.parse().ok().filter(|x: &f64| x.is_finite())
}
