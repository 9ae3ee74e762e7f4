//! Folders that are not what is needed.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use fog_dataset::{Error, OutputSet, PlanFrame, verify};
use fog_film::{Channels, FrameError};

use crate::common::{frame, open, open_with, planned, store};

fn plan() -> Vec<PlanFrame> {
    vec![planned("f0", OutputSet::all())]
}

#[test]
fn another_configuration_is_refused_by_its_keys() {
    let dir = tempfile::tempdir().expect("temporary folder");
    open_with(dir.path(), "seed: 1\n", "code-1", plan()).expect("a data set");
    let e = open_with(dir.path(), "seed: 2\n", "code-1", plan()).expect_err("refused");
    assert!(matches!(&e, Error::ConfigDiffers { keys, .. } if keys == &["seed: 1 -> seed: 2"]), "{e}");
    assert_eq!(
        e.to_string(),
        format!(
            "{} holds a data set of another configuration (changed: seed: 1 -> seed: 2); \
             use another folder or the old configuration",
            dir.path().display()
        )
    );
    let e = open_with(dir.path(), "seed: 1\n", "code-2", plan()).expect_err("refused");
    assert!(matches!(e, Error::CodeDiffers { .. }), "{e}");
    let e = open_with(dir.path(), "seed: 1\n", "code-1", Vec::new()).expect_err("refused");
    assert!(matches!(e, Error::PlanDiffers { .. }), "{e}");
    assert_eq!(fs::read(dir.path().join("config.resolved.yaml")).expect("a file"), b"seed: 1\n");
    // Nothing to compare with: refused all the same.
    fs::remove_file(dir.path().join("config.resolved.yaml")).expect("removed");
    let e = open_with(dir.path(), "seed: 2\n", "code-1", plan()).expect_err("refused");
    assert!(matches!(&e, Error::ConfigDiffers { keys, .. } if keys.is_empty()), "{e}");
}

#[test]
fn foreign_folders_are_left_alone() {
    let dir = tempfile::tempdir().expect("temporary folder");
    fs::write(dir.path().join("holiday.jpg"), b"").expect("written");
    let e = open_with(dir.path(), "seed: 1\n", "c", plan()).expect_err("refused");
    assert!(matches!(e, Error::NotADataSet { .. }) && e.to_string().contains("holiday.jpg"), "{e}");
    assert_eq!(fs::read_dir(dir.path()).expect("a folder").count(), 1);
    assert!(verify(dir.path()).expect_err("no data set").to_string().contains("dataset.json"));

    let other = tempfile::tempdir().expect("temporary folder");
    for content in [
        "{\"name\": \"coco\"}",
        "",
        "{\"format\":\"fogbank-dataset\",\"format_version\":99,\"name\":\"\",\
        \"frames\":0,\"config_digest\":\"\",\"code_digest\":\"\",\"files\":[],\"details\":null}",
    ] {
        fs::write(other.path().join("dataset.json"), content).expect("written");
        let e = open_with(other.path(), "seed: 1\n", "c", plan()).expect_err("refused");
        assert!(matches!(e, Error::Damaged { .. }) && e.to_string().contains("dataset.json"), "{e}");
    }
}

#[test]
fn ids_that_cannot_name_files_are_refused() {
    let dir = tempfile::tempdir().expect("temporary folder");
    for ids in [["../x", "a"], ["a", "a"]] {
        let plan = ids.map(|id| planned(id, OutputSet::all())).to_vec();
        let e = open_with(&dir.path().join("new"), "a: 1\n", "c", plan).expect_err("refused");
        assert!(matches!(e, Error::BadId { .. }), "{e}");
    }
    assert_eq!(fs::read_dir(dir.path()).expect("a folder").count(), 0, "nothing was created");
    let set = open(&dir.path().join("set"), 1);
    let e = store(&set, "f7", &frame(4, 4, Channels::Rgb, 1)).expect_err("refused");
    assert!(matches!(e, Error::UnknownFrame { .. }), "{e}");
}

#[test]
fn bad_frames_leave_no_marker() {
    let dir = tempfile::tempdir().expect("temporary folder");
    let set = open(dir.path(), 1);
    let mut f = frame(4, 4, Channels::Rgb, 1);
    f.direct[5][1] = f32::NAN;
    let e = store(&set, "f0", &f).expect_err("refused");
    assert!(matches!(e, Error::Frame { source: FrameError::NotFinite { x: 1, y: 1 }, .. }), "{e}");
    f.direct.pop();
    assert!(store(&set, "f0", &f).is_err());
    assert!(!set.is_done("f0") && !dir.path().join("f0.hdr.exr").exists());
}

#[test]
fn a_folder_that_cannot_be_is_named() {
    let dir = tempfile::tempdir().expect("temporary folder");
    let file = dir.path().join("file");
    fs::write(&file, b"").expect("written");
    for path in [file.join("out"), file.clone()] {
        let e = open_with(&path, "seed: 1\n", "c", plan()).expect_err("refused");
        let text = e.to_string();
        assert!(text.starts_with(&format!("cannot create {}: ", path.display())), "{text}");
        assert!(text.contains("os error"), "{text}");
    }
}

#[test]
fn a_lost_folder_is_named() {
    let dir = tempfile::tempdir().expect("temporary folder");
    let set = open(&dir.path().join("set"), 1);
    fs::remove_dir_all(set.dir()).expect("removed");
    let e = store(&set, "f0", &frame(4, 4, Channels::Rgb, 1)).expect_err("refused").to_string();
    assert!(e.contains("f0.rgb.png") && e.contains("os error 2"), "{e}");
    assert!(set.finish().is_err() && !set.is_done("f0"));
}

/// A file system of 64 KiB in memory, as long as it lives.
struct TinyDisk(PathBuf);

impl TinyDisk {
    fn mount(at: &Path) -> Option<Self> {
        let mut command = Command::new("mount");
        command.args(["-t", "tmpfs", "-o", "size=160k", "tmpfs"]).arg(at);
        command.output().is_ok_and(|o| o.status.success()).then(|| Self(at.to_path_buf()))
    }
}

impl Drop for TinyDisk {
    fn drop(&mut self) {
        let unmounted = Command::new("umount").arg(&self.0).status();
        assert!(unmounted.is_ok_and(|s| s.success()), "{} stays mounted", self.0.display());
    }
}

#[test]
fn a_full_disk_is_named_and_leaves_nothing_half() {
    let dir = tempfile::tempdir().expect("temporary folder");
    let Some(disk) = TinyDisk::mount(dir.path()) else {
        println!("skipped: mounting a tmpfs needs root");
        return;
    };
    let set = open(&disk.0.join("set"), 2);
    let e = store(&set, "f0", &frame(64, 64, Channels::Rgb, 4)).expect_err("full").to_string();
    assert!(e.contains("f0.hdr.exr") && e.contains("No space left on device"), "{e}");
    assert!(!set.is_done("f0"));
    let names: Vec<_> =
        fs::read_dir(set.dir()).expect("a folder").map(|e| e.expect("entry").file_name()).collect();
    assert!(names.iter().all(|n| n != "f0.hdr.exr" && !n.to_string_lossy().ends_with(".tmp")), "{names:?}");
    // The other frames still fit.
    store(&set, "f1", &frame(8, 4, Channels::Rgb, 4)).expect("fits");
    assert!(set.is_intact("f1"));
}
