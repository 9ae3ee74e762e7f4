//! A hundred kills, damaged files, a full disk, a folder that cannot be written: the data set ends as if nothing had happened,
//! or the program says what is wrong.
#![cfg(unix)]

use crate::common::{assert_same, cache, command, folder, names, run};
use fog_core::random::mix64;
use std::fs;
use std::path::Path;
use std::process::{Child, Command};
use std::time::Duration;

const KILLS: u64 = 100;

/// 24 frames that take some tens of milliseconds each.
fn restless() -> tempfile::TempDir {
    folder(
        "fog: {model: advection, height_m: 100}\n\
         sweep: {axes: {lighting: [day, night], fog.height_m: [100, 120, 140, 160], camera.altitude_m: [2, 30, 60]}}\n",
    )
}

const SAMPLES: [&str; 2] = ["--set", "render.samples=40"];
const QUICK: [&str; 2] = ["--set", "render.samples=4"];

fn begin(dir: &Path, tables: &str, more: &[&str]) -> Child {
    let args = ["sweep", "c.yaml", "--out", "out", "--threads", "1", "--cache-dir", tables];
    command(&[&args, &SAMPLES[..], more].concat(), dir).spawn().expect("the program starts")
}

fn children(parent: u32) -> Vec<String> {
    let list = Command::new("ps").args(["-o", "pid=", "--ppid", &parent.to_string()]).output().unwrap();
    String::from_utf8(list.stdout).unwrap().split_whitespace().map(str::to_owned).collect()
}

/// Inverts one bit of a file.
fn flip(path: &Path, at: u64) {
    let mut bytes = fs::read(path).unwrap();
    let at = at as usize % bytes.len();
    bytes[at] ^= 4;
    fs::write(path, bytes).unwrap();
}

/// Files of the folder whose names end so.
fn files(dir: &Path, end: &str) -> Vec<String> {
    if !dir.exists() {
        return Vec::new();
    }
    names(dir).into_iter().filter(|name| name.ends_with(end)).collect()
}

#[test]
fn a_hundred_kills_and_damage() {
    let dir = restless();
    let (out, tables) = (dir.path().join("out"), dir.path().join("tables"));
    let whole = ["sweep", "c.yaml", "--out", "whole", "--cache-dir", &cache()];
    run(&[&whole, &SAMPLES[..]].concat(), dir.path()).ok();
    fs::create_dir(&tables).unwrap();
    for table in files(Path::new(&cache()), ".fogtable") {
        fs::copy(Path::new(&cache()).join(&table), tables.join(&table)).unwrap();
    }

    let mut killed = 0;
    for round in 0.. {
        let number = |salt: u64| mix64(mix64(round) ^ salt);
        if killed >= KILLS {
            break;
        }
        // Overlapping parts, of numbers that change, by one process or two.
        let count = 1 + number(1) % 3;
        let shard = format!("{}/{count}", number(2) % count);
        let mut parents = vec![begin(dir.path(), "tables", &["--workers", "2", "--shard", &shard])];
        if number(3) % 2 == 0 {
            parents.push(begin(dir.path(), "tables", &[]));
        }
        std::thread::sleep(Duration::from_millis(20 + number(4) % 150));
        if number(5) % 2 == 0 {
            for child in children(parents[0].id()).iter().take(1) {
                killed += u64::from(Command::new("kill").args(["-KILL", child]).status().unwrap().success());
            }
            std::thread::sleep(Duration::from_millis(number(6) % 60));
        }
        for mut parent in parents {
            killed += u64::from(parent.try_wait().unwrap().is_none());
            parent.kill().unwrap();
            parent.wait().unwrap();
        }
        if number(7) % 8 == 0 {
            let tables: Vec<String> = files(&dir.path().join("tables"), ".fogtable");
            flip(&dir.path().join("tables").join(&tables[number(8) as usize % tables.len()]), number(9));
        }
        if round % 10 == 9 {
            let pictures = files(&out, "r");
            if !pictures.is_empty() {
                flip(&out.join(&pictures[number(10) as usize % pictures.len()]), number(11));
            }
        }
    }
    // What was damaged is named.
    let ended = begin(dir.path(), "tables", &["--workers", "2"]).wait_with_output().unwrap();
    assert_eq!(ended.status.code(), Some(0), "{}", String::from_utf8_lossy(&ended.stderr));
    let pictures = files(&out, ".hdr.exr");
    flip(&out.join(&pictures[3]), 1234);
    let verified = run(&["verify", "out"], dir.path());
    assert_eq!(verified.code, Some(1));
    let said = format!("{}: has another content than its recorded hash", pictures[3]);
    assert!(verified.stdout.contains(&said), "{}", verified.stdout);
    // And mended.
    let ended = begin(dir.path(), "tables", &["--recheck"]).wait_with_output().unwrap();
    assert_eq!(ended.status.code(), Some(0), "{}", String::from_utf8_lossy(&ended.stderr));
    assert_same(&dir.path().join("whole"), &out);
    run(&["verify", "out"], dir.path()).ok();
}

#[test]
fn a_full_disk_and_a_folder_that_cannot_be_written() {
    let dir = restless();
    let out = dir.path().join("out");
    fs::create_dir(&out).unwrap();
    let mount =
        |args: &[&str]| Command::new("mount").args(args).arg(&out).status().is_ok_and(|s| s.success());
    if !mount(&["-t", "tmpfs", "-o", "size=200k", "none"]) {
        eprintln!("skipped: a file system cannot be mounted here (no root)");
        return;
    }
    let full =
        begin(dir.path(), &cache(), &[&QUICK[..], &["--workers", "2"]].concat()).wait_with_output().unwrap();
    let said = String::from_utf8_lossy(&full.stderr).into_owned();
    let remounted = mount(&["-o", "remount,size=20m,ro"]);
    let locked = begin(dir.path(), &cache(), &QUICK).wait_with_output().unwrap();
    let writable = mount(&["-o", "remount,rw"]);
    let rest =
        begin(dir.path(), &cache(), &[&QUICK[..], &["--retry-failed"]].concat()).wait_with_output().unwrap();
    let copied = Command::new("cp").arg("-r").arg(&out).arg(dir.path().join("copy")).status();
    let unmounted = Command::new("umount").arg(&out).status().is_ok_and(|s| s.success());
    assert!(remounted && writable && unmounted && copied.is_ok_and(|s| s.success()));

    assert!(matches!(full.status.code(), Some(1 | 2)) && said.contains("No space left on device"), "{said}");
    let said = String::from_utf8_lossy(&locked.stderr);
    assert!(locked.status.code() == Some(2) && said.contains("Read-only file system"), "{said}");
    assert_eq!(rest.status.code(), Some(0), "{}", String::from_utf8_lossy(&rest.stderr));
    let whole = ["sweep", "c.yaml", "--out", "whole", "--cache-dir", &cache()];
    run(&[&whole, &QUICK[..]].concat(), dir.path()).ok();
    assert_same(&dir.path().join("whole"), &dir.path().join("copy"));
}
