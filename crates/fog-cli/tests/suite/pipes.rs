//! Readers that go away, as in `fogbank plan … | head`.

use crate::common::{cache, command, folder, ids, run};
use std::path::Path;
use std::process::Output;

const SWEEP: &str = "fog: none\nsweep: {axes: {camera.altitude_m: [2, 30, 50]}}\n";

/// Runs with a standard output that nobody reads.
fn unread(args: &[&str], dir: &Path) -> Output {
    let (reader, writer) = std::io::pipe().unwrap();
    drop(reader);
    command(args, dir).stdout(writer).output().unwrap()
}

#[test]
fn lists_end_when_nobody_reads_on() {
    let dir = folder(SWEEP);
    for args in [&["schema"][..], &["plan", "c.yaml"], &["plan", "c.yaml", "--json"], &["scene", "street"]] {
        let output = unread(args, dir.path());
        assert_eq!(String::from_utf8_lossy(&output.stderr), "", "{args:?}");
        assert_eq!(output.status.code(), Some(0), "{args:?}");
    }
}

#[test]
fn sweeps_go_on_when_nobody_listens() {
    let dir = folder(SWEEP);
    let output = unread(&["sweep", "c.yaml", "--out", "out", "--cache-dir", &cache()], dir.path());
    assert_eq!(String::from_utf8_lossy(&output.stderr), "");
    assert_eq!(output.status.code(), Some(0));
    assert_eq!(ids(dir.path()).len(), 3);
    run(&["verify", "out"], dir.path()).ok();
}

#[cfg(target_os = "linux")]
#[test]
fn a_list_that_cannot_be_stored_is_an_error() {
    let dir = folder(SWEEP);
    for args in [&["schema"][..], &["plan", "c.yaml", "--json"]] {
        let full = std::fs::File::options().write(true).open("/dev/full").unwrap();
        let output = command(args, dir.path()).stdout(full).output().unwrap();
        assert_eq!(output.status.code(), Some(2), "{args:?}");
        assert!(String::from_utf8_lossy(&output.stderr).contains("No space left"), "{args:?}");
    }
}
