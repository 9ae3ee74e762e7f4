//! When a frame counts as done, and what is found damaged.

use std::fs;

use fog_dataset::{Counts, FrameState, verify};
use fog_film::Channels;

use crate::common::{contents, frame, open, open_with, store};

#[test]
fn a_frame_is_done_only_when_whole() {
    let dir = tempfile::tempdir().expect("temporary folder");
    let set = open(dir.path(), 2);
    let f = frame(16, 9, Channels::Rgb, 2);
    assert!(!set.is_done("f0") && !set.is_done("no such frame"));
    store(&set, "f0", &f).expect("written");
    assert!(set.is_done("f0") && set.is_intact("f0"));
    assert_eq!(set.state("f1"), FrameState::Missing);
    let whole = contents(dir.path());

    for name in ["f0.rgb.png", "f0.hdr.exr", "f0.gt.exr", "f0.json", "f0.done"] {
        let path = dir.path().join(name);
        fs::remove_file(&path).expect("removed");
        assert!(!set.is_done("f0"), "{name} is gone");
        fs::write(&path, &whole[name][..whole[name].len() / 2]).expect("truncated");
        assert!(!set.is_done("f0"), "{name} is truncated");
        store(&set, "f0", &f).expect("written again");
        assert!(set.is_done("f0"));
        assert!(contents(dir.path()) == whole, "the same after {name}");
    }

    // A marker that names fewer files than the outputs ask for, as of a frame with other outputs.
    let marker = dir.path().join("f0.done");
    let mut fewer: serde_json::Value = serde_json::from_slice(&whole["f0.done"]).expect("JSON");
    fewer["files"].as_array_mut().expect("files").remove(1);
    fs::write(&marker, fewer.to_string()).expect("written");
    assert!(!set.is_done("f0"));
    // A marker of another configuration.
    let text = String::from_utf8(whole["f0.done"].clone()).expect("text");
    fs::write(&marker, text.replace("digest of seed: 1", "digest of seed: 2")).expect("written");
    assert!(!set.is_done("f0"));
}

#[test]
fn failures_are_recorded_until_the_frame_succeeds() {
    let dir = tempfile::tempdir().expect("temporary folder");
    let set = open(dir.path(), 3);
    let f = frame(16, 9, Channels::Rgb, 2);
    set.record_failure("f0", "the lens fogged up").expect("recorded");
    set.record_failure("f1", "no light").expect("recorded");
    assert!(
        fs::read_to_string(dir.path().join("f0.failed.json")).expect("text").contains("the lens fogged up")
    );
    assert_eq!(set.finish().expect("an index"), Counts { done: 0, failed: 2, missing: 1 });
    store(&set, "f0", &f).expect("written");
    assert!(!dir.path().join("f0.failed.json").exists());
    set.record_failure("f0", "a slower worker").expect("ignored");
    assert!(!dir.path().join("f0.failed.json").exists());
    assert!(set.record_failure("f9", "unknown").is_err());

    assert_eq!(set.finish().expect("an index"), Counts { done: 1, failed: 1, missing: 1 });
    assert_eq!(
        fs::read_to_string(dir.path().join("index.csv")).expect("an index"),
        "index,id,status,pair_id,camera.altitude_m,image_file,hdr_file,gt_file,record_file,semantic_file,\
         instance_file,objects_file,raw_file,clear_file,clear_image_file\n\
         0,f0,done,p0,2,f0.rgb.png,f0.hdr.exr,f0.gt.exr,f0.json,f0.semantic.png,f0.instance.png,f0.objects.json,\
         f0.raw.png,f0.clear.exr,f0.clear.rgb.png\n\
         1,f1,failed,p0,2,,,,,,,,,,\n\
         2,f2,missing,p0,2,,,,,,,,,,\n"
    );
}

#[test]
fn pieces_and_resumption_give_the_bytes_of_one_run() {
    let (whole, pieces) = (tempfile::tempdir().expect("folder"), tempfile::tempdir().expect("folder"));
    let f = frame(16, 9, Channels::Rgb, 2);
    let set = open(whole.path(), 3);
    for id in ["f0", "f1", "f2"] {
        store(&set, id, &f).expect("written");
    }
    set.finish().expect("an index");

    let first = open(pieces.path(), 3);
    store(&first, "f2", &f).expect("written");
    first.finish().expect("an index");
    drop(first);
    // Killed while writing: half a temporary, files without a marker, a folder without its plan.
    fs::write(pieces.path().join(".fogbank-x1y2z3.tmp"), b"half").expect("written");
    fs::write(pieces.path().join("f0.hdr.exr"), b"of another try").expect("written");
    fs::remove_file(pieces.path().join("plan.jsonl")).expect("removed");
    let second = open(pieces.path(), 3);
    assert!(second.is_done("f2") && !second.is_done("f0"));
    for id in ["f0", "f1"] {
        store(&second, id, &f).expect("written");
    }
    assert_eq!(second.finish().expect("an index").done, 3);
    assert!(contents(whole.path()) == contents(pieces.path()));
}

#[test]
fn verify_finds_a_flipped_bit_and_a_lost_file() {
    let dir = tempfile::tempdir().expect("temporary folder");
    let set = open(dir.path(), 4);
    for id in ["f0", "f1", "f2"] {
        store(&set, id, &frame(16, 9, Channels::Rgb, 2)).expect("written");
    }
    let report = verify(dir.path()).expect("a report");
    assert!(report.problems.is_empty() && !report.is_complete());
    assert_eq!(report.counts, Counts { done: 3, failed: 0, missing: 1 });

    let path = dir.path().join("f1.hdr.exr");
    let mut bytes = fs::read(&path).expect("a file");
    let middle = bytes.len() / 2;
    bytes[middle] ^= 1;
    fs::write(&path, bytes).expect("written");
    assert!(set.is_done("f1") && !set.is_intact("f1"));
    fs::remove_file(dir.path().join("f2.json")).expect("removed");
    fs::write(dir.path().join("f0.done"), b"{").expect("written");
    fs::write(dir.path().join("config.resolved.yaml"), b"seed: 2\n").expect("written");
    let report = verify(dir.path()).expect("a report");
    let found: Vec<(Option<&str>, &str)> =
        report.problems.iter().map(|p| (p.frame.as_deref(), p.file.as_str())).collect();
    assert_eq!(
        found,
        [
            (None, "config.resolved.yaml"),
            (Some("f0"), "f0.done"),
            (Some("f1"), "f1.hdr.exr"),
            (Some("f2"), "f2.json")
        ]
    );
    assert_eq!(report.counts, Counts { done: 0, failed: 0, missing: 4 });
    assert!(
        open_with(dir.path(), "seed: 1\n", "code-1", set.plan().to_vec()).is_ok(),
        "opening repairs the text"
    );
    assert_eq!(verify(dir.path()).expect("a report").problems.len(), 3);
}
