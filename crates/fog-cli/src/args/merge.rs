//! Arguments of `merge`.

use clap::Args as ClapArgs;
use std::path::PathBuf;

const EXAMPLES: &str = "\
Examples:
  fogbank merge part0 part1 part2 --out whole      three folders that `fogbank sweep --shard I/3` has filled
  fogbank merge /mnt/*/out --out whole             again when more has arrived: only what is missing is copied

The folders must be of one configuration and one version of the program. Every file is hashed on the way: a frame with a
damaged file is taken from another folder, or counts as missing.

Exit codes: 0 every frame of the plan is there, 1 some are missing, failed or damaged, 2 the folders do not fit together.";

/// Which folders.
#[derive(Debug, ClapArgs)]
#[command(after_help = EXAMPLES)]
pub(crate) struct MergeArgs {
    /// Folders with parts of one data set.
    #[arg(required = true)]
    pub(crate) parts: Vec<PathBuf>,
    /// Folder of the whole; made if it is not there, gone on with if it is.
    #[arg(long, value_name = "DIR")]
    pub(crate) out: PathBuf,
}
