//! `index.csv`: one line per frame of the plan.

use std::path::Path;

use serde_json::Value;

use crate::names::{INDEX, Kind};
use crate::{FrameState, PlanFrame, Result, atomic};

/// Files that have a column, with its name.
const COLUMNS: [(Kind, &str); 10] = [
    (Kind::Image, "image_file"),
    (Kind::Hdr, "hdr_file"),
    (Kind::Truth, "gt_file"),
    (Kind::Record, "record_file"),
    (Kind::Semantic, "semantic_file"),
    (Kind::Instance, "instance_file"),
    (Kind::Objects, "objects_file"),
    (Kind::Raw, "raw_file"),
    (Kind::Clear, "clear_file"),
    (Kind::ClearImage, "clear_image_file"),
];
/// Columns that are there even if no frame has such files.
const ALWAYS: usize = 7;

/// Writes the index: index, id, status, pair_id, one column per axis, and the names of the files of finished frames.
pub(crate) fn write(dir: &Path, plan: &[PlanFrame], states: &[FrameState]) -> Result<()> {
    atomic::write(dir, INDEX, text(plan, states).as_bytes())
}

fn text(plan: &[PlanFrame], states: &[FrameState]) -> String {
    let mut axes: Vec<&str> = Vec::new();
    for name in plan.iter().flat_map(|frame| frame.axes.keys()) {
        if !axes.contains(&name.as_str()) {
            axes.push(name);
        }
    }
    let mut out = String::new();
    let head = ["index", "id", "status", "pair_id"].into_iter().chain(axes.iter().copied());
    let columns: Vec<(Kind, &str)> = COLUMNS
        .into_iter()
        .enumerate()
        .filter(|(i, (kind, _))| *i < ALWAYS || plan.iter().any(|frame| kind.wanted(frame.outputs)))
        .map(|(_, column)| column)
        .collect();
    line(&mut out, head.chain(columns.iter().map(|(_, name)| *name)).map(str::to_owned));
    for (i, (frame, state)) in plan.iter().zip(states).enumerate() {
        let pair = frame.pair_id.clone().unwrap_or_default();
        let start = [i.to_string(), frame.id.clone(), state.name().to_owned(), pair];
        let values = axes.iter().map(|axis| frame.axes.get(*axis).map_or_else(String::new, plain));
        let files = columns.iter().map(|&(kind, _)| {
            let there = *state == FrameState::Done && kind.wanted(frame.outputs);
            if there { kind.file(&frame.id) } else { String::new() }
        });
        line(&mut out, start.into_iter().chain(values).chain(files));
    }
    out
}

/// Strings as they are, null as nothing, everything else as compact JSON.
fn plain(value: &Value) -> String {
    match value {
        Value::String(s) => s.clone(),
        Value::Null => String::new(),
        other => other.to_string(),
    }
}

/// Adds one line of CSV (RFC 4180, but with `\n`), quoting where needed.
fn line(out: &mut String, cells: impl Iterator<Item = String>) {
    for (i, cell) in cells.enumerate() {
        if i > 0 {
            out.push(',');
        }
        if cell.contains([',', '"', '\n', '\r']) {
            out.push_str(&format!("\"{}\"", cell.replace('"', "\"\"")));
        } else {
            out.push_str(&cell);
        }
    }
    out.push('\n');
}

#[cfg(test)]
mod tests {
    use serde_json::{Map, json};

    use super::*;
    use crate::OutputSet;

    #[test]
    fn columns_are_the_union_of_axes_and_cells_are_quoted() {
        let frame = |id: &str, axes: Value| PlanFrame {
            id: id.to_owned(),
            pair_id: Some("p".to_owned()),
            axes: axes.as_object().cloned().unwrap_or_else(Map::new),
            outputs: OutputSet::from_names(["image", "tau"]).expect("known"),
            spec: Value::Null,
        };
        let plan = [
            frame("a", json!({ "fog": "none", "camera.altitude_m": 2 })),
            frame("b", json!({ "fog": { "model": "advection", "height_m": 100 }, "lighting": "d\"ay" })),
        ];
        assert_eq!(
            text(&plan, &[FrameState::Done, FrameState::Missing]),
            "index,id,status,pair_id,fog,camera.altitude_m,lighting,image_file,hdr_file,gt_file,record_file,\
             semantic_file,instance_file,objects_file\n\
             0,a,done,p,none,2,,a.rgb.png,,a.gt.exr,a.json,,,\n\
             1,b,missing,p,\"{\"\"model\"\":\"\"advection\"\",\"\"height_m\"\":100}\",,\"d\"\"ay\",,,,,,,\n"
        );
    }
}
