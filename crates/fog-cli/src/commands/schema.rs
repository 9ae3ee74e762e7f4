//! `fogbank schema`: the JSON Schema of configurations.

use anyhow::Result;
use std::process::ExitCode;

pub(crate) fn run() -> Result<ExitCode> {
    println!("{}", serde_json::to_string_pretty(&fogbank::plan::schema_json())?);
    Ok(ExitCode::SUCCESS)
}
