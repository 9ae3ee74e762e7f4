//! Arguments as they are typed.

mod compare;
mod emit;
mod export;
mod figures;
mod fit;
mod fog_source;
mod form;
mod merge;
mod mie;
mod number;
mod optics;
mod replay;
mod scene;
mod sweep;
mod visibility;

pub(crate) use compare::CompareArgs;
pub(crate) use emit::{EmitArgs, EmitCommand, KubernetesArgs, PartsArgs, SlurmArgs};
pub(crate) use export::ExportArgs;
pub(crate) use figures::{FigureFormat, FiguresArgs};
pub(crate) use fit::{FitArgs, FitCommand, SyntheticArgs};
pub(crate) use fog_source::FogSourceArgs;
pub(crate) use form::FormArgs;
pub(crate) use merge::MergeArgs;
pub(crate) use mie::MieArgs;
pub(crate) use optics::OpticsArgs;
pub(crate) use replay::ReplayArgs;
pub(crate) use scene::{ApproachArg, SceneArgs, SceneCommand, SceneFileArgs, StyleArg};
pub(crate) use sweep::SweepArgs;
pub(crate) use visibility::{EditionArg, VisibilityArgs};

use clap::{Args as ClapArgs, Parser, Subcommand, ValueEnum};
use std::path::PathBuf;

/// Synthetic camera data in fog whose every number can be traced to physics.
#[derive(Debug, Parser)]
#[command(name = "fogbank", version, about, after_help = EXAMPLES, max_term_width = 110)]
pub(crate) struct Args {
    #[command(subcommand)]
    pub(crate) command: Command,
}

const EXAMPLES: &str = "\
Examples:
  fogbank plan configs/quickstart.yaml                        list the frames without rendering
  fogbank sweep configs/quickstart.yaml --out out/quickstart  render all of them; run it again to finish what is missing
  fogbank render configs/quickstart.yaml --frame 3 --out out/one --set render.samples=256
  fogbank replay configs/quickstart.yaml --frame 3 --pixel 40,30 --sample 0   one path of that frame in words
  fogbank compare a.hdr.exr b.hdr.exr --out map.png           how different they look, where, and in radiance
  fogbank schema > fogbank.schema.json                        for completion and checks in an editor
  fogbank visibility --model advection --height 180           how far one sees in that fog, by every law
  fogbank optics --model advection --height 180 --altitude 2 --wavelength 550 905   extinction, albedo, g, water

Exit codes: 0 success, 1 a frame failed, 2 wrong arguments, configuration or files, 130 stopped on request.";

#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Render every frame of a configuration into a data set, or finish one that was begun.
    Sweep(SweepArgs),
    /// Render one frame of a configuration into a data set.
    Render(RenderArgs),
    /// Show the frames of a configuration without rendering.
    Plan(PlanArgs),
    /// Print the JSON Schema of configurations, for editors.
    Schema,
    /// Make a scene by formula: a street, a town, a motorway, a runway, targets.
    Scene(SceneArgs),
    /// Fit a fog model to measured droplet counts.
    Fit(FitArgs),
    /// Join folders that hold parts of one data set, and prove that nothing is missing.
    Merge(MergeArgs),
    /// Write a sweep as a job array of a cluster.
    Emit(EmitArgs),
    /// Write a data set in a format of others: COCO and more, without rendering anything again.
    Export(ExportArgs),
    /// Compare every file of a data set with its recorded hash.
    Verify(VerifyArgs),
    /// Draw figures of a fog model: droplets, optics, visibility, and what droplets do to sunlight.
    Figures(FiguresArgs),
    /// How far objects, lights and runways are seen in fog, by every law; conversions between visibility and water.
    Visibility(VisibilityArgs),
    /// Optical quantities of fog by altitude and wavelength.
    Optics(OpticsArgs),
    /// Scattering by one sphere: the Mie series.
    Mie(MieArgs),
    /// Trace one path of a frame again and tell what happened to it.
    Replay(ReplayArgs),
    /// Compare two pictures or data sets: ΔE2000 with its map, relative MSE, PSNR, z-scores.
    Compare(CompareArgs),
}

/// Which configuration.
#[derive(Debug, ClapArgs)]
pub(crate) struct ConfigArgs {
    /// Configuration file (YAML; see `fogbank schema`).
    pub(crate) config: PathBuf,
    /// Override one value by its dotted path, as `--set fog.height_m=180`; may be repeated.
    #[arg(long = "set", value_name = "KEY=VALUE")]
    pub(crate) sets: Vec<String>,
}

/// How to work.
#[derive(Debug, ClapArgs)]
pub(crate) struct WorkArgs {
    /// Folder of the data set; made if it is not there.
    #[arg(long, value_name = "DIR")]
    pub(crate) out: PathBuf,
    /// Threads to render with [default: all cores]. Does not change a single byte of the result.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub(crate) threads: Option<u16>,
    /// Folder of the optics tables [default: tables/cache beside ./tables, else the user's cache folder].
    #[arg(long, value_name = "DIR")]
    pub(crate) cache_dir: Option<PathBuf>,
    /// Library of Open Image Denoise 2, or its folder, for the output `denoised` [default: the environment variable
    /// FOGBANK_OIDN, else where the system looks for libraries].
    #[arg(long, value_name = "PATH")]
    pub(crate) oidn: Option<PathBuf>,
    /// Print errors only.
    #[arg(long, short)]
    pub(crate) quiet: bool,
    /// How to tell what happens: for people, or as lines of JSON on standard output.
    #[arg(long, value_enum, default_value = "text", value_name = "FORM")]
    pub(crate) log: LogArg,
}

/// How to tell what happens.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum LogArg {
    /// Words and a progress bar.
    Text,
    /// One JSON object for each event.
    Json,
}

/// Arguments of `render`.
#[derive(Debug, ClapArgs)]
pub(crate) struct RenderArgs {
    #[command(flatten)]
    pub(crate) config: ConfigArgs,
    #[command(flatten)]
    pub(crate) work: WorkArgs,
    /// Frame of a sweep: its id, the beginning of its id, or its index from 0 (see `fogbank plan`).
    #[arg(long, value_name = "ID")]
    pub(crate) frame: Option<String>,
}

/// Arguments of `plan`.
#[derive(Debug, ClapArgs)]
pub(crate) struct PlanArgs {
    #[command(flatten)]
    pub(crate) config: ConfigArgs,
    /// Print every frame with all its values, one JSON object per line.
    #[arg(long)]
    pub(crate) json: bool,
    /// List every frame, not only the first 1000.
    #[arg(long, conflicts_with = "json")]
    pub(crate) all: bool,
}

/// Arguments of `verify`.
#[derive(Debug, ClapArgs)]
pub(crate) struct VerifyArgs {
    /// Folder of the data set.
    pub(crate) dir: PathBuf,
}
