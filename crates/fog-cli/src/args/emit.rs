//! Arguments of `emit`.

use super::ConfigArgs;
use clap::{Args as ClapArgs, Subcommand};
use std::path::PathBuf;

const EXAMPLES: &str = "\
Examples:
  fogbank emit slurm c.yaml --out /shared/out --parts 16 --cpus 8 > sweep.sbatch && sbatch sweep.sbatch
  fogbank emit kubernetes c.yaml --out /data/out --parts 16 --image registry/fogbank:0.1 --claim data | kubectl apply -f -

Every part runs `fogbank sweep --shard` on a shared folder. Parts need no talk: one that is killed is run again and goes on.
`fogbank verify` or `fogbank merge` proves the whole.";

/// Which system.
#[derive(Debug, ClapArgs)]
#[command(after_help = EXAMPLES)]
pub(crate) struct EmitArgs {
    #[command(subcommand)]
    pub(crate) system: EmitCommand,
}

/// Systems that run parts of a sweep.
#[derive(Debug, Subcommand)]
pub(crate) enum EmitCommand {
    /// A batch script with a job array for Slurm's sbatch.
    Slurm(SlurmArgs),
    /// An Indexed Job for Kubernetes.
    Kubernetes(KubernetesArgs),
}

/// What the parts have in common.
#[derive(Debug, ClapArgs)]
pub(crate) struct PartsArgs {
    #[command(flatten)]
    pub(crate) config: ConfigArgs,
    /// Folder of the data set, as every part sees it.
    #[arg(long, value_name = "DIR")]
    pub(crate) out: PathBuf,
    /// Number of parts [default: one for each frame, 100 at most].
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=100_000))]
    pub(crate) parts: Option<u32>,
    /// Cores of each part.
    #[arg(long, value_name = "N", default_value_t = 4, value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub(crate) cpus: u16,
    /// Memory of each part in GiB.
    #[arg(long, value_name = "GIB", default_value_t = 4, value_parser = clap::value_parser!(u16).range(1..=4096))]
    pub(crate) memory_gib: u16,
    /// Folder of the optics tables, as every part sees it [default: DIR.tables beside the data set].
    #[arg(long, value_name = "DIR")]
    pub(crate) cache_dir: Option<PathBuf>,
}

/// Arguments of `emit slurm`.
#[derive(Debug, ClapArgs)]
pub(crate) struct SlurmArgs {
    #[command(flatten)]
    pub(crate) parts: PartsArgs,
    /// Longest time of a part, as Slurm writes it.
    #[arg(long, value_name = "TIME", default_value = "1-00:00:00")]
    pub(crate) time: String,
    /// Partition.
    #[arg(long, value_name = "NAME")]
    pub(crate) partition: Option<String>,
    /// The program, as the nodes see it [default: this one].
    #[arg(long, value_name = "PATH")]
    pub(crate) program: Option<PathBuf>,
}

/// Arguments of `emit kubernetes`.
#[derive(Debug, ClapArgs)]
pub(crate) struct KubernetesArgs {
    #[command(flatten)]
    pub(crate) parts: PartsArgs,
    /// Container image that has `fogbank` on its path.
    #[arg(long, value_name = "IMAGE")]
    pub(crate) image: String,
    /// Persistent volume claim with the configuration, the scenes and the data set.
    #[arg(long, value_name = "NAME")]
    pub(crate) claim: String,
    /// Where the volume is mounted; the paths of the configuration count from there.
    #[arg(long, value_name = "DIR", default_value = "/data")]
    pub(crate) mount: PathBuf,
    /// Parts at work at the same time [default: all].
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=100_000))]
    pub(crate) parallelism: Option<u32>,
}
