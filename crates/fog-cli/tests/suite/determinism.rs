//! The same plan gives the same bytes: with any number of threads, whole or in pieces, killed and resumed.

use crate::common::{assert_same, cache, command, folder, ids, names, run, sweep, write};
use std::path::Path;
use std::process::Child;
use std::time::{Duration, Instant};

/// Eight frames: every kind of fog by day and by night.
fn eight_frames() -> tempfile::TempDir {
    let dir = folder(
        "camera: {altitude_m: 2, heading_deg: 10}\n\
         sweep:\n  axes:\n    lighting: [day, night]\n    fog:\n      - none\n      \
         - {model: advection, height_m: 100}\n      \
         - {model: homogeneous, height_m: 60, sigma_t_1_m: 0.02, single_scattering_albedo: 0.9, phase: {hg: 0.83}}\n      \
         - {model: layered, file: layers.csv, phase: mie_mean_diameter}\n",
    );
    write(dir.path(), "layers.csv", "altitude_m,sigma_t_1_m\n0,0.01\n20,0.03\n50,0\n");
    dir
}

#[test]
fn one_thread_or_two() {
    let dir = eight_frames();
    for threads in ["1", "2"] {
        run(
            &["sweep", "c.yaml", "--out", threads, "--threads", threads, "--cache-dir", &cache()],
            dir.path(),
        )
        .ok();
    }
    assert_same(&dir.path().join("1"), &dir.path().join("2"));
    // Two files of the plan, header and index; six of each frame.
    assert_eq!(names(&dir.path().join("1")).len(), 4 + 8 * 6);
}

#[test]
fn whole_or_in_pieces() {
    let dir = eight_frames();
    sweep(dir.path(), "whole").ok();
    let frames = ids(dir.path());
    for piece in [&frames[5], "2", &frames[0][..frames[0].len() - 1]] {
        let args = ["render", "c.yaml", "--frame", piece, "--out", "pieces", "--cache-dir", &cache()];
        run(&args, dir.path()).ok();
    }
    let done = |id: &&String| dir.path().join("pieces").join(format!("{id}.done")).exists();
    assert_eq!(frames.iter().filter(done).collect::<Vec<_>>(), [&frames[0], &frames[2], &frames[5]]);
    let rest = sweep(dir.path(), "pieces").ok().stdout;
    assert!(rest.contains("3 frames are done already, 5 to go"), "{rest}");
    assert_same(&dir.path().join("whole"), &dir.path().join("pieces"));
    // Once more: nothing to do, nothing changed.
    let again = sweep(dir.path(), "pieces").ok().stdout;
    assert!(again.contains("8 frames are done already, 0 to go"), "{again}");
    assert_same(&dir.path().join("whole"), &dir.path().join("pieces"));
}

#[cfg(unix)]
#[test]
fn killed_and_resumed() {
    let dir = eight_frames();
    let out = dir.path().join("killed");
    // Enough samples for frames that last, so that the kill strikes in the middle of one.
    let samples = ["--set", "render.samples=150", "--cache-dir", &cache()];
    run(&[&["sweep", "c.yaml", "--out", "whole"], &samples[..]].concat(), dir.path()).ok();

    let begin = || {
        command(&[&["sweep", "c.yaml", "--out", "killed"], &samples[..]].concat(), dir.path())
            .spawn()
            .expect("the program starts")
    };
    let count = |suffix: &str| {
        if out.exists() { names(&out).iter().filter(|n| n.ends_with(suffix)).count() } else { 0 }
    };
    // In the middle of the first frame, right after a marker, between the files of a frame.
    strike(begin(), || out.join("plan.jsonl").exists());
    strike(begin(), || count(".done") >= 2);
    strike(begin(), || count(".rgb.png") > count(".done").max(3) || count(".done") == 6);
    let done = count(".done");
    assert!((2..8).contains(&done), "{done} frames done before the last run");
    write(&out, ".fogbank-dead.tmp", "half a fi");

    let last = begin().wait_with_output().expect("the program ends");
    assert!(last.status.success());
    let said = String::from_utf8(last.stdout).expect("UTF-8");
    assert!(said.contains(&format!("{done} frames are done already, {} to go", 8 - done)), "{said}");
    assert_same(&dir.path().join("whole"), &out);
    assert_eq!(names(&out).iter().filter(|n| n.contains("tmp")).count(), 0);
    verified(dir.path());
}

fn verified(dir: &Path) {
    run(&["verify", "killed"], dir).ok();
}

/// Kills a run with SIGKILL at the moment `when`.
#[cfg(unix)]
fn strike(mut child: Child, when: impl Fn() -> bool) {
    use std::os::unix::process::ExitStatusExt;
    let started = Instant::now();
    while !when() {
        assert!(started.elapsed() < Duration::from_secs(60), "the moment never came");
        std::thread::sleep(Duration::from_micros(200));
    }
    child.kill().expect("kill");
    assert_eq!(child.wait().expect("wait").signal(), Some(9), "it was over before it was killed");
}
