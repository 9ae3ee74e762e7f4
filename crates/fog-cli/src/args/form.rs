//! In which form a command prints its numbers.

use crate::rows::Form;
use clap::Args;

/// Table, JSON or CSV.
#[derive(Debug, Args)]
pub(crate) struct FormArgs {
    /// Print JSON with full precision: one object per line.
    #[arg(long, conflicts_with = "csv")]
    json: bool,
    /// Print CSV with full precision.
    #[arg(long)]
    csv: bool,
}

impl FormArgs {
    pub(crate) fn form(&self) -> Form {
        match (self.json, self.csv) {
            (true, _) => Form::Json,
            (_, true) => Form::Csv,
            _ => Form::Table,
        }
    }
}
