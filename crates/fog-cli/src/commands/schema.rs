//! `fogbank schema`: the JSON Schema of configurations.

use anyhow::Result;
use std::io::Write;
use std::process::ExitCode;

pub(crate) fn run() -> Result<ExitCode> {
    writeln!(std::io::stdout(), "{}", serde_json::to_string_pretty(&fogbank::plan::schema_json())?)?;
    Ok(ExitCode::SUCCESS)
}
