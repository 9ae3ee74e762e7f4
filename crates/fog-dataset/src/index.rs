//! `index.csv`: one line per frame of the plan.

use std::io::Write;

use serde::Deserialize;
use serde_json::{Map, Value};

use crate::names::{INDEX, Kind};
use crate::store::Store;
use crate::{Error, FrameState, OutputSet, Result, plan};

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

/// What the index takes from a line of the plan.
#[derive(Deserialize)]
struct Row {
    id: String,
    #[serde(default)]
    pair_id: Option<String>,
    #[serde(default)]
    axes: Map<String, Value>,
    outputs: OutputSet,
}

/// Writes the index from `plan.jsonl`: index, id, status, pair_id, one column per axis, and the names of the files of finished
/// frames. `outputs` has every set of outputs that some frame has.
pub(crate) fn write(store: &Store, outputs: &[OutputSet], states: &[FrameState]) -> Result<()> {
    let refuse = |e| Error::io("write", &store.path(INDEX))(e);
    let mut axes: Vec<String> = Vec::new();
    plan::read(store, &mut |row: Row| {
        axes.extend(
            row.axes
                .into_iter()
                .map(|(name, _)| name)
                .filter(|name| !axes.contains(name))
                .collect::<Vec<_>>(),
        );
        Ok(())
    })?;
    let columns: Vec<(Kind, &str)> = COLUMNS
        .into_iter()
        .enumerate()
        .filter(|(i, (kind, _))| *i < ALWAYS || outputs.iter().any(|&outputs| kind.wanted(outputs)))
        .map(|(_, column)| column)
        .collect();
    let mut file = store.create(INDEX)?;
    let mut text = String::new();
    let head = ["index", "id", "status", "pair_id"].into_iter().chain(axes.iter().map(String::as_str));
    line(&mut text, head.chain(columns.iter().map(|(_, name)| *name)).map(str::to_owned));
    let mut i = 0;
    plan::read(store, &mut |row: Row| {
        let state = states.get(i).copied().unwrap_or(FrameState::Missing);
        let start = [i.to_string(), row.id.clone(), state.name().to_owned(), row.pair_id.unwrap_or_default()];
        let values = axes.iter().map(|axis| row.axes.get(axis).map_or_else(String::new, plain));
        let files = columns.iter().map(|&(kind, _)| {
            let there = state == FrameState::Done && kind.wanted(row.outputs);
            if there { kind.file(&row.id) } else { String::new() }
        });
        line(&mut text, start.into_iter().chain(values).chain(files));
        file.write_all(text.as_bytes()).map_err(refuse)?;
        text.clear();
        i += 1;
        Ok(())
    })?;
    file.finish()
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
    use serde_json::json;

    use super::*;
    use crate::PlanFrame;

    #[test]
    fn columns_are_the_union_of_axes_and_cells_are_quoted() {
        let frame = |id: &str, axes: Value| PlanFrame {
            id: id.to_owned(),
            pair_id: Some("p".to_owned()),
            axes: axes.as_object().cloned().unwrap_or_else(Map::new),
            outputs: OutputSet::from_names(["image", "tau"]).expect("known"),
            spec: Value::Null,
        };
        let frames = [
            frame("a", json!({ "fog": "none", "camera.altitude_m": 2 })),
            frame("b", json!({ "fog": { "model": "advection", "height_m": 100 }, "lighting": "d\"ay" })),
        ];
        let dir = tempfile::tempdir().expect("temporary folder");
        let store = Store::at(dir.path()).expect("a folder");
        plan::write(&store, &|each| frames.iter().try_for_each(&mut *each)).expect("written");
        write(&store, &[frames[0].outputs], &[FrameState::Done, FrameState::Missing]).expect("written");
        assert_eq!(
            String::from_utf8(store.read(INDEX).expect("read").expect("there")).expect("text"),
            "index,id,status,pair_id,fog,camera.altitude_m,lighting,image_file,hdr_file,gt_file,record_file,\
             semantic_file,instance_file,objects_file\n\
             0,a,done,p,none,2,,a.rgb.png,,a.gt.exr,a.json,,,\n\
             1,b,missing,p,\"{\"\"model\"\":\"\"advection\"\",\"\"height_m\"\":100}\",,\"d\"\"ay\",,,,,,,\n"
        );
    }
}
