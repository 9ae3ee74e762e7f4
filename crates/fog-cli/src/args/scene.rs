//! Arguments of `scene`.

use clap::{Args as ClapArgs, Subcommand, ValueEnum};
use std::path::PathBuf;

const EXAMPLES: &str = "\
Examples:
  fogbank scene urban --seed 7 --traffic 0.8 --out scenes/town.glb
  fogbank scene runway --designator 09L --approach malsr --papi-deg 3.2 --out scenes/runway.glb
  fogbank scene highway --style mutcd --length-m 2000 --out scenes/highway.glb
  fogbank scene targets --black-m 50,100,200 --out scenes/targets.glb
Each scene has its own --help. The same options and seed give the same bytes. Scenes are binary glTF 2.0 in metres, +Y up;
every object says in its node's extras of which class and instance it is; lamps are KHR_lights_punctual in candela.";

/// Arguments of `scene`.
#[derive(Debug, ClapArgs)]
#[command(after_help = EXAMPLES)]
pub(crate) struct SceneArgs {
    #[command(subcommand)]
    pub(crate) scene: SceneCommand,
}

/// Where to write, and what chance decides.
#[derive(Debug, ClapArgs)]
pub(crate) struct SceneFileArgs {
    /// Number that decides everything that the options leave open; street and targets leave nothing.
    #[arg(long, value_name = "S", default_value_t = 1)]
    pub(crate) seed: u64,
    /// File to write [default: NAME.glb].
    #[arg(long, value_name = "FILE")]
    pub(crate) out: Option<PathBuf>,
}

/// The scenes.
#[derive(Debug, Subcommand)]
pub(crate) enum SceneCommand {
    /// The street of Kolářová et al. 2024: checkered buildings that emit by night, a tower at the end.
    Street {
        #[command(flatten)]
        file: SceneFileArgs,
    },
    /// A street in a town: houses, vehicles, people, lamps, signs, traffic lights.
    ///
    /// It runs along −Z; drive on the right. A camera at position [1.6, 0, 0], altitude 1.5, heading 0 is a driver's. By
    /// `lighting: night` lamps, windows and the head lamps of driving cars shine (set luminance_of_one_cd_m2 to about 10).
    Urban {
        #[command(flatten)]
        file: SceneFileArgs,
        /// Length of the street in metres, 80 to 600.
        #[arg(long, default_value_t = 200.0)]
        length_m: f32,
        /// Whose signs, plates and markings.
        #[arg(long, value_enum, default_value_t = StyleArg::Vienna)]
        style: StyleArg,
        /// How full lanes and kerbs are, 0 (empty) to 1.
        #[arg(long, default_value_t = 0.5)]
        traffic: f32,
        /// How full the pavements are, 0 (empty) to 1.
        #[arg(long, default_value_t = 0.5)]
        people: f32,
        /// Speed limit on the signs: km/h (vienna) or mph (mutcd) [default: 30 or 25].
        #[arg(long)]
        limit: Option<u32>,
    },
    /// A motorway: three lanes each way, barriers, gantries, reflector posts every 50 m.
    ///
    /// It runs along −Z. A camera at position [11.6, 0, 0], altitude 1.5, heading 0 is a driver's in the right lane; the posts
    /// on its right are the driver's own scale of visibility.
    Highway {
        #[command(flatten)]
        file: SceneFileArgs,
        /// Length in metres ahead of the origin, 200 to 5000.
        #[arg(long, default_value_t = 1000.0)]
        length_m: f32,
        /// Whose signs, plates and markings.
        #[arg(long, value_enum, default_value_t = StyleArg::Vienna)]
        style: StyleArg,
        /// How full the lanes are, 0 (empty) to 1.
        #[arg(long, default_value_t = 0.4)]
        traffic: f32,
        /// Distance between gantries in metres, 100 to 5000; the first is at 120 m.
        #[arg(long, default_value_t = 400.0)]
        gantries_m: f32,
    },
    /// A runway with its markings, lights, PAPI, taxiway and land.
    ///
    /// The middle of the threshold is the origin; one lands along −Z. On a glide path of 3° to the aiming point (311 m beyond
    /// the threshold) a camera at distance d before the threshold has position [0, 0, d], altitude (d + 311) · 0.0524, pitch −3.
    Runway {
        #[command(flatten)]
        file: SceneFileArgs,
        /// Length in metres, 1200 to 5000.
        #[arg(long, default_value_t = 2500.0)]
        length_m: f32,
        /// Width in metres: 30, 45 or 60.
        #[arg(long, default_value_t = 45.0)]
        width_m: f32,
        /// Number and letter at the near end, as 09L; the scene's runway points north all the same.
        #[arg(long, default_value = "36")]
        designator: String,
        /// Approach lights.
        #[arg(long, value_enum, default_value_t = ApproachArg::Alsf2)]
        approach: ApproachArg,
        /// Glide path of the PAPI in degrees, 2 to 5.
        #[arg(long, default_value_t = 3.0)]
        papi_deg: f32,
        /// Intensity of all lights in percent of the full one; steps in use are 100, 20, 4, 0.8 and 0.16.
        #[arg(long, default_value_t = 100.0)]
        lights_percent: f32,
        /// Light the sequenced flashers, all at once.
        #[arg(long)]
        flashers: bool,
    },
    /// Checkerboards, ArUco markers and black targets at known distances, for validation.
    ///
    /// Distances are level ones from the eye at position [0, 0, 0]. Boards stand to the north (heading 0), black targets to the
    /// east (heading 90). Each node's extras give sizes and world positions: corners of markers (DICT_4X4_50), inner corners of
    /// checkerboards.
    Targets {
        #[command(flatten)]
        file: SceneFileArgs,
        /// Distances of the boards in metres, 1 to 5 of them.
        #[arg(long, value_delimiter = ',', default_value = "5,10,20,40")]
        boards_m: Vec<f32>,
        /// Distances of the black targets in metres, 1 to 8 of them.
        #[arg(long, value_delimiter = ',', default_value = "25,50,100,200,400,800")]
        black_m: Vec<f32>,
        /// Width that each black target subtends, in degrees, 0.1 to 4.
        #[arg(long, default_value_t = 2.0)]
        black_deg: f32,
        /// Altitude of the eye in metres, 0.5 to 100.
        #[arg(long, default_value_t = 2.0)]
        eye_m: f32,
    },
}

/// Whose signs.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub(crate) enum StyleArg {
    /// Vienna Convention.
    Vienna,
    /// Manual on Uniform Traffic Control Devices (USA).
    Mutcd,
}

/// Approach lights.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub(crate) enum ApproachArg {
    /// None.
    None,
    /// Medium intensity with alignment lights.
    Malsr,
    /// High intensity, categories II and III.
    #[value(name = "alsf2")]
    Alsf2,
}
