//! Arguments of `export`.

use clap::Args as ClapArgs;
use fog_export::Format;
use std::path::PathBuf;

const EXAMPLES: &str = "\
Examples:
  fogbank export out/town --format coco --out town-coco
  fogbank export out/town --format coco --out town-cars --classes car,truck,bus
  fogbank export out/town --format kitti --out town-kitti
  fogbank export out/town --format webdataset --out town-shards --shard-size 512

Nothing is rendered again: a format is made of the outputs that the data set has, and says which it
lacks. Frames that are not done are left out and counted. What a format cannot hold is counted and
told, here and in X/export.json. The folder X appears when the export is whole; until then it is
X.partial, which goes when the export is stopped. Two cameras of a rig beside each other become
KITTI's image_2 and image_3, and Cityscapes' left and right. Axes, units, and what becomes of what:
docs/export.md.

Exit codes: 0 every frame of the plan is exported, 1 some are missing or failed, 2 wrong arguments
or files, 130 stopped.";

/// What to export, how and where.
#[derive(Debug, ClapArgs)]
#[command(after_help = help())]
pub(crate) struct ExportArgs {
    /// Folder of the data set.
    pub(crate) dir: PathBuf,
    /// Format to write; see below.
    #[arg(long, value_name = "F", value_parser = format)]
    pub(crate) format: Format,
    /// Folder of the export: a new or empty one. The same export there is kept as it is.
    #[arg(long, value_name = "X")]
    pub(crate) out: PathBuf,
    /// Export again and replace the export that is in the folder. Folders that are no exports are never replaced.
    #[arg(long)]
    pub(crate) force: bool,
    /// Only things of these classes, as `car,person`; formats of label masks keep every class.
    #[arg(long, value_name = "NAMES", value_delimiter = ',')]
    pub(crate) classes: Vec<String>,
    /// MiB up to which a tar (webdataset) or Parquet file (huggingface) is filled, 1 and up; one frame always fits.
    #[arg(long, value_name = "MIB", default_value_t = fog_export::SHARD_SIZE_MIB, value_parser = clap::value_parser!(u32).range(1..))]
    pub(crate) shard_size: u32,
    /// Print errors only.
    #[arg(long, short)]
    pub(crate) quiet: bool,
}

/// The formats, and how to use the command.
fn help() -> String {
    let mut text = "Formats, and the outputs that the data set must have been rendered with:\n".to_owned();
    for format in Format::ALL {
        let (about, needs) = (format.about(), format.needs().join(", "));
        text.push_str(&format!("  {:<12} {about}\n{:15}made of {needs}\n", format.name(), ""));
    }
    text + "\n" + EXAMPLES
}

fn format(name: &str) -> Result<Format, String> {
    Format::from_name(name).map_err(|e| e.to_string())
}
