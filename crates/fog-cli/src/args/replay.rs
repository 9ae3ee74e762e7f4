//! Arguments of `replay`.

use super::ConfigArgs;
use clap::Args as ClapArgs;
use std::path::PathBuf;

const EXAMPLES: &str = "\
Examples:
  fogbank replay configs/quickstart.yaml --frame 3 --pixel 40,30 --sample 0     one path in words
  fogbank replay c.yaml --pixel 12,7 --sample 5 --json                          with all numbers at all wavelengths

Pixels count from 0 at the upper left. The path is the one that `fogbank render` traces there with the same
configuration: same random numbers, same integrator. A pixel of the picture is the mean of its samples.";

/// Which path.
#[derive(Debug, ClapArgs)]
#[command(after_help = EXAMPLES)]
pub(crate) struct ReplayArgs {
    #[command(flatten)]
    pub(crate) config: ConfigArgs,
    /// Frame of a sweep: its id, the beginning of its id, or its index from 0 (see `fogbank plan`).
    #[arg(long, value_name = "ID")]
    pub(crate) frame: Option<String>,
    /// Column and row of the pixel, from 0.
    #[arg(long, value_name = "X,Y", value_parser = pixel)]
    pub(crate) pixel: [u32; 2],
    /// Which of the pixel's samples, from 0.
    #[arg(long, value_name = "N")]
    pub(crate) sample: u64,
    /// Print one JSON object with every number at every wavelength.
    #[arg(long)]
    pub(crate) json: bool,
    /// Folder of the optics tables [default: tables/cache beside ./tables, else the user's cache folder].
    #[arg(long, value_name = "DIR")]
    pub(crate) cache_dir: Option<PathBuf>,
}

fn pixel(text: &str) -> Result<[u32; 2], String> {
    let wrong = || format!("`{text}` is no pixel; write column and row as 40,30");
    let (x, y) = text.split_once(',').ok_or_else(wrong)?;
    let number = |s: &str| s.trim().parse().map_err(|_| wrong());
    Ok([number(x)?, number(y)?])
}
