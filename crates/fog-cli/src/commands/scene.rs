//! `fogbank scene`: a scene made by formula, as a file.

use crate::args::{ApproachArg, SceneArgs, SceneCommand, SceneFileArgs, StyleArg};
use crate::print;
use anyhow::{Context, Result};
use fogbank::worlds::{ApproachLights, Highway, Runway, Style, Targets, Urban, World};
use std::path::PathBuf;
use std::process::ExitCode;

pub(crate) fn run(args: &SceneArgs) -> Result<ExitCode> {
    let (name, world, file) = world(&args.scene);
    let bytes = world.glb(file.seed).with_context(|| format!("scene {name}"))?;
    let path = file.out.clone().unwrap_or_else(|| PathBuf::from(format!("{name}.glb")));
    std::fs::write(&path, &bytes).with_context(|| format!("cannot write {}", path.display()))?;
    print::news(format_args!("{}: {} bytes", path.display(), bytes.len()));
    Ok(ExitCode::SUCCESS)
}

fn style(arg: StyleArg) -> Style {
    match arg {
        StyleArg::Vienna => Style::Vienna,
        StyleArg::Mutcd => Style::Mutcd,
    }
}

/// Name, scene and file that the arguments ask for.
fn world(command: &SceneCommand) -> (&'static str, World, &SceneFileArgs) {
    match command {
        SceneCommand::Street { file } => ("street", World::Street, file),
        SceneCommand::Urban { file, length_m, style: whose, traffic, people, limit } => {
            let options = Urban {
                length_m: *length_m,
                style: style(*whose),
                traffic: *traffic,
                people: *people,
                limit: limit.unwrap_or(style(*whose).town_limit()),
            };
            ("urban", World::Urban(options), file)
        }
        SceneCommand::Highway { file, length_m, style: whose, traffic, gantries_m } => {
            let options = Highway {
                length_m: *length_m,
                style: style(*whose),
                traffic: *traffic,
                gantries_m: *gantries_m,
            };
            ("highway", World::Highway(options), file)
        }
        SceneCommand::Runway {
            file,
            length_m,
            width_m,
            designator,
            approach,
            papi_deg,
            lights_percent,
            flashers,
        } => {
            let options = Runway {
                length_m: *length_m,
                width_m: *width_m,
                designator: designator.clone(),
                approach: match approach {
                    ApproachArg::None => ApproachLights::None,
                    ApproachArg::Malsr => ApproachLights::Malsr,
                    ApproachArg::Alsf2 => ApproachLights::Alsf2,
                },
                papi_deg: *papi_deg,
                lights_percent: *lights_percent,
                flashers: *flashers,
            };
            ("runway", World::Runway(options), file)
        }
        SceneCommand::Targets { file, boards_m, black_m, black_deg, eye_m } => {
            let options = Targets {
                boards_m: boards_m.clone(),
                black_m: black_m.clone(),
                black_deg: *black_deg,
                eye_m: *eye_m,
            };
            ("targets", World::Targets(options), file)
        }
    }
}
