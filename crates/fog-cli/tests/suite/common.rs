//! Running the program, and small configurations for it.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// What a finished run left behind.
pub(crate) struct Run {
    pub(crate) code: Option<i32>,
    pub(crate) stdout: String,
    pub(crate) stderr: String,
}

impl Run {
    /// Insists on success without a word on stderr.
    pub(crate) fn ok(self) -> Self {
        assert_eq!(self.code, Some(0), "{}\n{}", self.stdout, self.stderr);
        assert_eq!(self.stderr, "");
        self
    }
}

/// The program with a command line, in a folder of its own.
pub(crate) fn command(args: &[&str], dir: &Path) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_fogbank"));
    command.args(args).current_dir(dir).stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::piped());
    command
}

/// Runs a command line in `dir` to its end.
pub(crate) fn run(args: &[&str], dir: &Path) -> Run {
    let output = command(args, dir).output().expect("the program starts");
    let text = |bytes| String::from_utf8(bytes).expect("messages are UTF-8");
    Run { code: output.status.code(), stdout: text(output.stdout), stderr: text(output.stderr) }
}

/// `sweep` of `dir/c.yaml` into `dir/OUT`.
pub(crate) fn sweep(dir: &Path, out: &str) -> Run {
    run(&["sweep", "c.yaml", "--out", out, "--cache-dir", &cache()], dir)
}

/// The cache that all tests share, so that the optics table is built once.
pub(crate) fn cache() -> String {
    concat!(env!("CARGO_TARGET_TMPDIR"), "/tables").to_owned()
}

/// A file of the repository.
pub(crate) fn repository(file: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").join(file)
}

/// A folder with a configuration `c.yaml`: the street by day in 24 × 14 pixels, and the lines given.
pub(crate) fn folder(lines: &str) -> tempfile::TempDir {
    let dir = tempfile::tempdir().expect("temporary folder");
    let scene = repository("scenes/street.glb");
    write(dir.path(), "c.yaml", config(&format!("scene: {{file: {scene:?}}}\nlighting: day\n{lines}")));
    dir
}

/// A configuration without scene and lighting: five lines, and those given.
pub(crate) fn config(lines: &str) -> String {
    format!(
        "version: 1\nname: t\nseed: 7\nsensor: {{width_px: 24, height_px: 14, horizontal_fov_deg: 60}}\n\
         render: {{samples: 3}}\n{lines}"
    )
}

pub(crate) fn write(dir: &Path, name: &str, content: impl AsRef<[u8]>) {
    fs::write(dir.join(name), content).expect("write");
}

/// Ids of the frames, from `plan --json`.
pub(crate) fn ids(dir: &Path) -> Vec<String> {
    let plan = run(&["plan", "c.yaml", "--json"], dir).ok().stdout;
    let id = |line| json(line)["id"].as_str().expect("id").to_owned();
    plan.lines().map(id).collect()
}

pub(crate) fn json(text: &str) -> serde_json::Value {
    serde_json::from_str(text).expect("JSON")
}

pub(crate) fn read_json(path: &Path) -> serde_json::Value {
    json(&fs::read_to_string(path).expect("read"))
}

/// Names of the entries of a folder, sorted.
pub(crate) fn names(dir: &Path) -> Vec<String> {
    let entries = fs::read_dir(dir).expect("list").map(|e| e.expect("entry").file_name());
    let mut names: Vec<_> = entries.map(|n| n.into_string().expect("UTF-8")).collect();
    names.sort();
    names
}

/// Every file below a folder with its bytes; of timings only that they are there.
pub(crate) fn contents(dir: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    let mut all = BTreeMap::new();
    for name in names(dir) {
        let path = dir.join(&name);
        if path.is_dir() {
            all.extend(contents(&path).into_iter().map(|(file, bytes)| (Path::new(&name).join(file), bytes)));
        } else {
            let timing = name.ends_with(".timing.json");
            let bytes = if timing { Vec::new() } else { fs::read(path).expect("read") };
            all.insert(PathBuf::from(name), bytes);
        }
    }
    all
}

/// Insists on the same files with the same bytes.
pub(crate) fn assert_same(a: &Path, b: &Path) {
    let (a, b) = (contents(a), contents(b));
    assert_eq!(a.keys().collect::<Vec<_>>(), b.keys().collect::<Vec<_>>());
    let differing: Vec<_> = a.keys().filter(|name| a[*name] != b[*name]).collect();
    assert!(differing.is_empty(), "other bytes in {differing:?}");
}
