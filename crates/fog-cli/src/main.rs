//! `fogbank`: the command line. One file per subcommand under `commands`.
//!
//! Exit codes: 0 all is well, 1 a frame failed, 2 the user's mistake (arguments, configuration, files), 130 stopped on
//! request.

mod args;
mod commands;
mod json_log;
mod listener;
mod pace;
mod print;
mod report;
mod rows;

use clap::Parser;
use std::process::ExitCode;

fn main() -> ExitCode {
    let args = args::Args::parse();
    let result = match args.command {
        args::Command::Sweep(args) => commands::sweep::run(&args),
        args::Command::Render(args) => commands::render::run(&args),
        args::Command::Plan(args) => commands::plan::run(&args),
        args::Command::Schema => commands::schema::run(),
        args::Command::Scene(args) => commands::scene::run(&args),
        args::Command::Fit(args) => commands::fit::run(&args),
        args::Command::Merge(args) => commands::merge::run(&args),
        args::Command::Emit(args) => commands::emit::run(&args),
        args::Command::Export(args) => commands::export::run(&args),
        args::Command::Verify(args) => commands::verify::run(&args),
        args::Command::Figures(args) => commands::figures::run(&args),
        args::Command::Visibility(args) => commands::visibility::run(&args),
        args::Command::Optics(args) => commands::optics::run(&args),
        args::Command::Mie(args) => commands::mie::run(&args),
        args::Command::Replay(args) => commands::replay::run(&args),
        args::Command::Compare(args) => commands::compare::run(&args),
    };
    match result {
        Ok(code) => code,
        Err(error) if print::reader_has_gone(&error) => ExitCode::SUCCESS,
        Err(error) => {
            let ours = error.downcast_ref::<fogbank::Error>();
            let export = error.downcast_ref::<fog_export::Error>();
            // Our own messages hold their causes already.
            let is_ours = ours.is_some() || export.is_some();
            let message = if is_ours { error.to_string() } else { format!("{error:#}") };
            print::complaint(format_args!("fogbank: {message}"));
            ExitCode::from(match (ours, export) {
                (Some(fogbank::Error::Cancelled), _) | (_, Some(fog_export::Error::Cancelled)) => 130,
                (Some(e), _) if !e.is_user_mistake() => 1,
                _ => 2,
            })
        }
    }
}
