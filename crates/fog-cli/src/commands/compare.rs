//! `fogbank compare`: how different are two pictures, or the frames of two data sets?

mod report;

use crate::args::CompareArgs;
use crate::print;
use anyhow::{Context, Result, bail};
use fogbank::{Error, FramePair, Matching, compare_pictures, match_frames};
use report::Row;
use serde_json::json;
use std::io::{BufWriter, Write, stdout};
use std::path::Path;
use std::process::ExitCode;

pub(crate) fn run(args: &CompareArgs) -> Result<ExitCode> {
    match (args.a.is_dir(), args.b.is_dir()) {
        (true, true) => data_sets(args),
        (false, false) if args.pair || args.reference.is_some() => {
            let option = if args.pair { "--pair" } else { "--reference" };
            bail!("{option} is for data sets, but A and B are no folders")
        }
        (false, false) => pictures(args),
        (folder, _) => {
            // If one is not there at all, that is the mistake.
            let file = if folder { &args.b } else { &args.a };
            file.metadata().with_context(|| format!("cannot read {}", file.display()))?;
            bail!(
                "{} is a file and {} is a folder: compare two pictures or two data sets",
                file.display(),
                if folder { &args.a } else { &args.b }.display()
            )
        }
    }
}

fn pictures(args: &CompareArgs) -> Result<ExitCode> {
    let row = one(args, &args.a, &args.b, args.out.as_deref())?;
    let mut out = BufWriter::new(stdout().lock());
    if args.json {
        writeln!(out, "{:#}", row.json())?;
    } else {
        row.print(&mut out)?;
    }
    out.flush()?;
    Ok(verdict(args, &[row]))
}

fn data_sets(args: &CompareArgs) -> Result<ExitCode> {
    let matching = match &args.reference {
        Some(reference) => Matching::Reference(reference.clone()),
        None if args.pair => Matching::PairId,
        None => Matching::Id,
    };
    let matched = match_frames(&args.a, &args.b, &matching)?;
    if let Some(dir) = &args.out {
        std::fs::create_dir_all(dir).with_context(|| format!("cannot create {}", dir.display()))?;
    }
    let mut out = BufWriter::new(stdout().lock());
    let width = matched.pairs.iter().map(|pair| pair.ids[0].len()).max().unwrap_or(0);
    if !args.json {
        report::print_heads(width, &mut out)?;
    }
    let mut rows = Vec::new();
    for FramePair { ids, paths } in &matched.pairs {
        let map = args.out.as_ref().map(|dir| dir.join(format!("{}.de2000.png", ids[0])));
        let row = one(args, &paths[0], &paths[1], map.as_deref())?;
        if !args.json {
            row.print_line(&ids[0], width, &mut out)?;
            out.flush()?;
        }
        rows.push(row);
    }
    if args.json {
        let frames = matched.pairs.iter().zip(&rows).map(|(pair, row)| row.json_of_frames(&pair.ids));
        let left_out = matched.left_out.iter().map(
            |frame| json!({ "data_set": frame.side.to_string(), "id": frame.id, "reason": frame.reason }),
        );
        let all = json!({
            "a": args.a.display().to_string(),
            "b": args.b.display().to_string(),
            "matched_by": if matching == Matching::Id { "id" } else { "pair_id" },
            "reference": args.reference.as_ref().map(|reference| reference.to_string()),
            "frames": frames.collect::<Vec<_>>(),
            "means": report::means_json(&rows),
            "left_out": left_out.collect::<Vec<_>>(),
        });
        writeln!(out, "{all:#}")?;
    } else {
        report::print_means(&rows, width, &mut out)?;
        for frame in &matched.left_out {
            writeln!(out, "left out: {} of {}: {}", frame.id, frame.side, frame.reason)?;
        }
    }
    out.flush()?;
    Ok(verdict(args, &rows))
}

/// Compares two pictures and writes the map; of the comparison only the figures are kept.
fn one(args: &CompareArgs, a: &Path, b: &Path, map: Option<&Path>) -> Result<Row> {
    let mut compared = compare_pictures(a, b, args.exposure.map(|e| e as f32), args.blocks)?;
    let scale = args.scale.unwrap_or_else(|| compared.comparison.map_scale());
    if let Some(path) = map {
        let picture = compared.comparison.map_picture(scale);
        fogbank::dataset::write_png(path, &picture).map_err(Error::from)?;
    }
    compared.comparison.map = Vec::new();
    let map = map.map(|path| (path.to_path_buf(), scale));
    Ok(Row { files: [a.to_path_buf(), b.to_path_buf()], compared, map })
}

/// Exit code, and a complaint about the first picture that is too different.
fn verdict(args: &CompareArgs, rows: &[Row]) -> ExitCode {
    let Some(limit) = args.fail_above else { return ExitCode::SUCCESS };
    let too_different = |row: &&Row| row.compared.comparison.delta_e.mean > limit;
    let Some(row) = rows.iter().find(too_different) else { return ExitCode::SUCCESS };
    let more = rows.iter().filter(too_different).count() - 1;
    let others = if more > 0 { format!(" (and {more} more)") } else { String::new() };
    print::complaint(format_args!(
        "fogbank: {}: mean ΔE2000 of {:.4} is above {limit}{others}",
        row.files[0].display(),
        row.compared.comparison.delta_e.mean,
    ));
    ExitCode::from(1)
}
