//! Exports: what they refuse, what they leave behind, and that a killed one leaves nothing that looks whole. What is in them is
//! tested by the readers of their formats, in `tools/tests/test_export.py`.

use crate::common::{assert_same, command, contents, folder, ids, names, read_json, run, sweep, write};
use std::fs;
use std::path::Path;
use std::thread::sleep;
use std::time::Duration;

/// A data set of four frames, two poses of a stereo rig, with these outputs, in `out`.
fn data_set(outputs: &str) -> tempfile::TempDir {
    let dir = folder(&format!(
        "path: {{poses: [{{time_s: 0, position_m: [0, 1.5, 0]}}, {{time_s: 0.5, position_m: [0, 1.5, -1]}}]}}\n\
         cameras: {{left: {{position_m: [-0.2, 0, 0]}}, right: {{position_m: [0.3, 0, 0]}}}}\n\
         fog: {{model: homogeneous, height_m: 60, sigma_t_1_m: 0.02, phase: {{hg: 0.8}}}}\noutputs: [{outputs}]\n"
    ));
    sweep(dir.path(), "out").ok();
    dir
}

const ALL: &str = "image, depth, semantic, instance, objects";

fn export(dir: &Path, format: &str, out: &str, more: &[&str]) -> crate::common::Run {
    let args = [&["export", "out", "--format", format, "--out", out], more].concat();
    run(&args, dir)
}

#[test]
fn every_format_is_written_once_and_the_same_again() {
    let dir = data_set(ALL);
    let dir = dir.path();
    for format in ["coco", "kitti", "cityscapes", "nuscenes"] {
        let told = export(dir, format, format, &[]).ok().stdout;
        assert!(told.starts_with(&format!("{format}: 4 frames exported as {format}")), "{told}");
        let manifest = read_json(&dir.join(format).join("export.json"));
        assert_eq!((&manifest["export"], &manifest["frames"]), (&format.into(), &4.into()));
        assert!(!dir.join(format!("{format}.partial")).exists());
        // The same again is left as it is, and made anew it has the same bytes.
        let before = contents(&dir.join(format));
        assert!(export(dir, format, format, &[]).ok().stdout.contains("were exported already"));
        export(dir, format, format, &["--force", "--quiet"]).ok();
        assert_eq!(before, contents(&dir.join(format)));
        // Another export is not written over it.
        let refused = export(dir, format, format, &["--classes", "road"]);
        assert_eq!(refused.code, Some(2));
        assert!(refused.stderr.contains("holds an export already: 4 frames"), "{}", refused.stderr);
        assert_eq!(before, contents(&dir.join(format)));
    }
    // A stereo pair over two poses.
    let files = |sub: &str| names(&dir.join(sub));
    assert_eq!(files("kitti/training/image_2"), ["000000.png", "000001.png"]);
    assert_eq!(files("kitti/training/image_3"), files("kitti/training/depth_2"));
    assert_eq!(files("kitti/odometry/poses"), ["00.txt"]);
    let poses = fs::read_to_string(dir.join("kitti/odometry/poses/00.txt")).expect("read");
    assert!(poses.lines().nth(1).is_some_and(|line| line.ends_with(" 1.000000000e0")), "{poses}");
    assert_eq!(
        files("cityscapes/gtFine/train/t"),
        ["0", "1"]
            .map(|n| {
                ["color.png", "instanceIds.png", "labelIds.png", "polygons.json"]
                    .map(|end| format!("t_000000_00000{n}_gtFine_{end}"))
            })
            .concat()
    );
    assert_eq!(files("nuscenes/samples"), ["CAM_LEFT", "CAM_RIGHT"]);
    assert_eq!(files("nuscenes/v1.0-fogbank").len(), 13);
    // Pictures are the data set's, byte by byte.
    for id in ids(dir) {
        let original = fs::read(dir.join(format!("out/{id}.rgb.png"))).expect("read");
        assert!(original == fs::read(dir.join(format!("coco/images/{id}.png"))).expect("read"));
    }
    let none = export(dir, "lard-v2", "lard", &[]);
    assert_eq!(none.code, Some(2));
    assert!(none.stderr.contains("threshold_left") && !dir.join("lard").exists(), "{}", none.stderr);
}

#[test]
fn what_is_missing_is_named() {
    let dir = data_set("image");
    let dir = dir.path();
    let first = &ids(dir)[0];
    let told = export(dir, "coco", "x", &[]);
    assert_eq!(told.code, Some(2));
    let want = format!(
        "format coco needs outputs `instance`, `objects`, which frame {first} does not have; render the data set again with \
         outputs: [image, instance, objects]"
    );
    assert!(told.stderr.contains(&want), "{}", told.stderr);
    let told = export(dir, "coca", "x", &[]);
    assert_eq!(told.code, Some(2));
    assert!(told.stderr.contains("unknown format `coca`, expected one of coco, kitti"), "{}", told.stderr);
    let told = run(&["export", "nowhere", "--format", "coco", "--out", "x"], dir);
    assert_eq!((told.code, told.stderr.contains("dataset.json")), (Some(2), true), "{}", told.stderr);
    assert_eq!(names(dir), ["c.yaml", "out"]);
    let help = run(&["export", "--help"], dir).ok().stdout;
    assert!(help.contains("made of image, instance, objects\n") && help.contains("Exit codes"), "{help}");
}

#[test]
fn frames_that_are_not_done_are_left_out_and_told() {
    let dir = data_set(ALL);
    let dir = dir.path();
    let ids = ids(dir);
    fs::remove_file(dir.join(format!("out/{}.done", ids[0]))).expect("remove");
    let told = export(dir, "coco", "x", &[]);
    assert_eq!(told.code, Some(1));
    assert_eq!(told.stderr, "1 frames are not in the export: 0 failed, 1 missing\n");
    let all = read_json(&dir.join("x/annotations/instances.json"));
    assert_eq!(all["images"].as_array().map(Vec::len), Some(3));
    // Once it is there the export is another one.
    sweep(dir, "out").ok();
    let told = export(dir, "coco", "x", &[]);
    assert_eq!((told.code, told.stderr.contains("of other frames")), (Some(2), true), "{}", told.stderr);
    export(dir, "coco", "x", &["--force", "--classes", "road,building"]).ok();
    let some = read_json(&dir.join("x/annotations/instances.json"));
    assert_eq!(some["categories"].as_array().map(Vec::len), Some(2));
    let told = export(dir, "coco", "y", &["--classes", "roads"]);
    assert!(told.code == Some(2) && told.stderr.contains("no class `roads`"), "{}", told.stderr);
    // A damaged file of a frame is named, and nothing is left.
    write(dir, &format!("out/{}.objects.json", ids[1]), [b' '; 9]);
    let told = export(dir, "coco", "y", &[]);
    assert_eq!(told.code, Some(1), "{}", told.stderr);
    let size = fs::metadata(dir.join(format!("out/{}.instance.png", ids[2]))).expect("metadata").len();
    write(dir, &format!("out/{}.instance.png", ids[2]), vec![0; size as usize]);
    let told = export(dir, "coco", "z", &[]);
    assert_eq!(told.code, Some(2));
    assert!(told.stderr.contains(&format!("{}.instance.png", ids[2])), "{}", told.stderr);
    assert!(!dir.join("z").exists() && !dir.join("z.partial").exists());
}

#[test]
fn a_killed_export_leaves_nothing_that_looks_whole() {
    let dir = data_set(ALL);
    let dir = dir.path();
    export(dir, "kitti", "whole", &[]).ok();
    let mut kills = 0;
    for delay in 0..16 {
        let args = ["export", "out", "--format", "kitti", "--out", "x", "--quiet"];
        let mut child = command(&args, dir).spawn().expect("the program starts");
        sleep(Duration::from_micros(500 * delay));
        kills += u32::from(child.kill().is_ok());
        child.wait().expect("it ends");
        if dir.join("x").exists() {
            assert_same(&dir.join("x"), &dir.join("whole"));
            fs::remove_dir_all(dir.join("x")).expect("remove");
        }
    }
    assert!(kills > 0);
    // What they left is no hindrance, and is gone.
    fs::create_dir_all(dir.join("x.partial/junk")).expect("create");
    write(dir, "x.partial/.fogbank-export.lock", "");
    export(dir, "kitti", "x", &[]).ok();
    assert_same(&dir.join("x"), &dir.join("whole"));
    assert!(!dir.join("x.partial").exists());
    // Folders of others are not touched: not by name, not by force.
    for (out, file) in [("mine", "mine/letter.txt"), ("yours", "yours.partial/letter.txt")] {
        fs::create_dir_all(dir.join(file).parent().expect("a folder")).expect("create");
        write(dir, file, "dear");
        let told = export(dir, "kitti", out, &["--force"]);
        assert_eq!((told.code, told.stderr.contains("letter.txt")), (Some(2), true), "{}", told.stderr);
        assert_eq!(fs::read_to_string(dir.join(file)).expect("read"), "dear");
    }
    // One at a time.
    fs::create_dir_all(dir.join("busy.partial")).expect("create");
    let lock = fs::File::create(dir.join("busy.partial/.fogbank-export.lock")).expect("create");
    lock.lock().expect("lock");
    let told = export(dir, "kitti", "busy", &[]);
    assert_eq!((told.code, told.stderr.contains("is under way")), (Some(2), true), "{}", told.stderr);
}

#[test]
fn a_stopped_export_says_so_and_goes() {
    struct Stop;
    impl fog_export::Progress for Stop {
        fn begin(&self, frames: u64) -> bool {
            frames == 4
        }
        fn frame(&self, _: &str) -> bool {
            false
        }
    }
    let dir = data_set(ALL);
    let (from, to) = (dir.path().join("out"), dir.path().join("x"));
    let options = fog_export::Options::default();
    let result = fog_export::export(&from, fog_export::Format::Coco, &to, &options, &Stop);
    assert!(matches!(result, Err(fog_export::Error::Cancelled)), "{result:?}");
    assert_eq!(names(dir.path()), ["c.yaml", "out"]);
}
