//! Several processes on one sweep, parts of a sweep, and what becomes of a data set that is there already.

use crate::common::{assert_same, cache, command, folder, ids, json, names, run, sweep, write};
use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

const AXES: &str = "sweep: {axes: {lighting: [day, night], fog.height_m: [60, 100, 120], camera.altitude_m: [2, 30]}}\n\
                    fog: {model: advection, height_m: 100}\n";

/// Arguments of a sweep with further ones.
fn arguments<'a>(out: &'a str, cache: &'a str, more: &[&'a str]) -> Vec<&'a str> {
    [&["sweep", "c.yaml", "--out", out, "--cache-dir", cache], more].concat()
}

fn done(dir: &Path) -> usize {
    if dir.exists() { names(dir).iter().filter(|name| name.ends_with(".done")).count() } else { 0 }
}

#[test]
fn parts_and_selections_add_up() {
    let dir = folder(AXES);
    let cache = cache();
    let go = |out: &str, more: &[&str]| run(&arguments(out, &cache, more), dir.path());
    sweep(dir.path(), "whole").ok();
    // Parts into one folder, with another number of them on the way.
    for part in ["0/3", "3/4", "1/3", "2/3"] {
        go("parts", &["--shard", part]).ok();
    }
    assert_same(&dir.path().join("whole"), &dir.path().join("parts"));
    // By value, by name, by process.
    go("picked", &["--where", "lighting=night, fog.height_m>60"]).ok();
    assert_eq!(done(&dir.path().join("picked")), 4);
    let frames = ids(dir.path());
    go("picked", &["--only", &frames[0], "--only", "1"]).ok();
    assert_eq!(done(&dir.path().join("picked")), 6);
    go("picked", &["--workers", "3", "--threads", "1"]).ok();
    assert_same(&dir.path().join("whole"), &dir.path().join("picked"));

    let refused = go("picked", &["--where", "fog.height_m>999"]);
    assert_eq!(refused.code, Some(2));
    assert!(refused.stderr.contains("none of the 12 frames has fog.height_m>999"), "{}", refused.stderr);
    let refused = go("picked", &["--shard", "4/4"]);
    assert!(refused.stderr.contains("parts count from 0"), "{}", refused.stderr);
}

#[test]
fn folders_are_merged_and_proved_whole() {
    let dir = folder(AXES);
    let cache = cache();
    sweep(dir.path(), "whole").ok();
    for part in ["0/3", "1/3", "2/3"] {
        run(&arguments(&part[..1], &cache, &["--shard", part]), dir.path()).ok();
    }
    let merge = |parts: &[&str]| run(&[&["merge", "--out", "all"], parts].concat(), dir.path());
    let some = merge(&["0", "1"]);
    assert_eq!(some.code, Some(1));
    assert!(some.stdout.contains("all: 8 done, 0 failed, 4 missing"), "{}", some.stdout);
    // A damaged file is noticed, and taken from where it is whole.
    let frame = |name: &&String| name.ends_with(".hdr.exr");
    let name = names(&dir.path().join("2")).iter().find(frame).unwrap().clone();
    let path = dir.path().join("2").join(&name);
    let mut bytes = fs::read(&path).unwrap();
    let last = bytes.len() - 1;
    bytes[last] ^= 1;
    fs::write(&path, bytes).unwrap();
    let some = merge(&["2"]);
    assert_eq!(some.code, Some(1));
    assert!(some.stdout.contains("11 done, 0 failed, 1 missing"), "{}", some.stdout);
    assert!(some.stderr.contains(&format!("2/{name}: has another content")), "{}", some.stderr);
    let all = merge(&["2", "whole"]);
    assert_eq!(all.code, Some(0));
    assert!(all.stdout.contains("whole: 1 frames taken"), "{}", all.stdout);
    assert_same(&dir.path().join("whole"), &dir.path().join("all"));
    run(&["verify", "all"], dir.path()).ok();

    write(
        dir.path(),
        "c.yaml",
        fs::read_to_string(dir.path().join("c.yaml")).unwrap().replace("[2, 30]", "[2]"),
    );
    sweep(dir.path(), "other").ok();
    let refused = merge(&["whole", "other"]);
    assert_eq!(refused.code, Some(2));
    assert!(refused.stderr.contains("not parts of one data set"), "{}", refused.stderr);
}

#[test]
fn job_arrays_are_written_and_run() {
    let dir = folder(AXES);
    let cache = cache();
    let emit = |more: &[&str]| {
        let args = ["c.yaml", "--out", "out", "--parts", "3", "--cpus", "1", "--cache-dir", &cache];
        run(&[&["emit"], &more[..1], &args, &more[1..]].concat(), dir.path()).ok().stdout
    };
    let script = emit(&["slurm", "--set", "render.samples=2", "--partition", "fog"]);
    assert!(
        script.contains("#SBATCH --array=0-2\n") && script.contains("#SBATCH --partition=fog\n"),
        "{script}"
    );
    // As Slurm runs it.
    for task in ["0", "2", "1"] {
        let mut shell = std::process::Command::new("sh");
        shell.args(["-c", &script]).current_dir(dir.path()).env("SLURM_SUBMIT_DIR", dir.path());
        let variables =
            [("SLURM_ARRAY_TASK_ID", task), ("SLURM_ARRAY_TASK_COUNT", "3"), ("SLURM_ARRAY_TASK_MIN", "0")];
        let ended = shell.envs(variables).output().unwrap();
        assert!(ended.status.success(), "{}", String::from_utf8_lossy(&ended.stderr));
    }
    assert_eq!(done(&dir.path().join("out")), 12);

    let job = json(&emit(&["kubernetes", "--image", "fogbank:0.1", "--claim", "data", "--parallelism", "2"]));
    let spec = &job["spec"];
    let numbers = [&spec["completions"], &spec["parallelism"]].map(|n| n.as_u64());
    assert_eq!((numbers, &spec["completionMode"]), ([Some(3), Some(2)], &"Indexed".into()));
    let command = spec["template"]["spec"]["containers"][0]["command"].to_string();
    assert!(command.contains(r#""--shard","auto/3""#), "{command}");
}

#[test]
fn data_sets_are_extended_and_replaced() {
    let dir = folder(AXES);
    let cache = cache();
    let go = |more: &[&str]| run(&arguments("out", &cache, more), dir.path());
    go(&["--where", "camera.altitude_m=2"]).ok();
    let old = ids(dir.path());
    let marker = |id: &str| fs::read(dir.path().join(format!("out/{id}.done"))).unwrap();
    let before = marker(&old[0]);

    let text = fs::read_to_string(dir.path().join("c.yaml")).unwrap();
    let longer = text.replace("[60, 100, 120]", "[60, 80, 100, 120]");
    write(dir.path(), "c.yaml", &longer);
    let refused = go(&[]);
    assert_eq!(refused.code, Some(2));
    assert!(refused.stderr.contains("another configuration"), "{}", refused.stderr);
    let said = go(&["--mode", "extend"]).ok().stdout;
    assert!(said.contains("6 frames are done already, 10 to go"), "{said}");
    assert_eq!((done(&dir.path().join("out")), marker(&old[0])), (16, before));
    run(&["verify", "out"], dir.path()).ok();
    go(&[]).ok();

    // A frame less is no extension.
    write(dir.path(), "c.yaml", text.replace("[60, 100, 120]", "[60]"));
    let refused = go(&["--mode", "extend"]);
    assert!(refused.stderr.contains("is not in this plan"), "{}", refused.stderr);
    write(dir.path(), "out/mine.txt", "not Fogbank's");
    go(&["--mode", "overwrite"]).ok();
    assert_eq!(done(&dir.path().join("out")), 4);
    assert!(dir.path().join("out/mine.txt").exists());
    fs::remove_file(dir.path().join("out/mine.txt")).unwrap();
    sweep(dir.path(), "fresh").ok();
    assert_same(&dir.path().join("out"), &dir.path().join("fresh"));
    // The same once more: rendered again.
    let said = go(&["--mode", "overwrite", "--only", "0"]).ok().stdout;
    assert!(said.contains("1/1"), "{said}");
    assert_same(&dir.path().join("out"), &dir.path().join("fresh"));
}

#[test]
fn events_are_lines_of_json() {
    let dir = folder(AXES);
    let args = arguments("out", "cache", &["--workers", "2", "--log", "json", "--only", "0", "--only", "7"]);
    let said = run(&args, dir.path()).ok().stdout;
    let lines: Vec<_> = said.lines().map(json).collect();
    let events: BTreeSet<&str> = lines.iter().filter_map(|line| line["event"].as_str()).collect();
    let expected =
        ["finished", "frame_done", "frame_started", "progress", "ready", "scene", "table", "warning"];
    assert_eq!(events.into_iter().collect::<Vec<_>>(), expected);
    let last = &lines[lines.len() - 1];
    assert_eq!((&last["done"], &last["missing"]), (&2.into(), &10.into()));
    assert!(lines.iter().all(|line| line["unix_time_s"].as_f64() > Some(1.7e9)));
}

#[cfg(unix)]
mod processes {
    use super::*;
    use std::process::{Child, Command};
    use std::time::{Duration, Instant};

    fn wait_for(what: &str, condition: impl Fn() -> bool) {
        let begun = Instant::now();
        while !condition() {
            assert!(begun.elapsed() < Duration::from_secs(100), "{what}");
            std::thread::sleep(Duration::from_millis(3));
        }
    }

    /// The processes whose parent is this one.
    fn children(parent: u32) -> Vec<u32> {
        let list = Command::new("ps").args(["-o", "pid=", "--ppid", &parent.to_string()]).output().unwrap();
        String::from_utf8(list.stdout).unwrap().split_whitespace().map(|pid| pid.parse().unwrap()).collect()
    }

    fn signal(signal: &str, pid: u32) {
        Command::new("kill").args([signal, &pid.to_string()]).status().unwrap();
    }

    fn begin(dir: &Path, out: &str, more: &[&str]) -> Child {
        let cache = cache();
        let long = ["--set", "render.samples=120", "--workers", "2", "--threads", "1"];
        command(&[&arguments(out, &cache, &long), more].concat(), dir).spawn().expect("the program starts")
    }

    #[test]
    fn workers_are_replaced_and_stopped() {
        let dir = folder(AXES);
        let out = dir.path().join("out");
        run(&arguments("whole", &cache(), &["--set", "render.samples=120"]), dir.path()).ok();

        // Stopped on request: what is done is kept, and no worker goes on.
        let parent = begin(dir.path(), "out", &[]);
        wait_for("a frame", || done(&out) >= 1);
        let workers = children(parent.id());
        signal("-INT", parent.id());
        let said = parent.wait_with_output().unwrap();
        assert_eq!(said.status.code(), Some(130));
        assert!(String::from_utf8_lossy(&said.stderr).contains("stopped on request"));
        assert!(workers.iter().all(|pid| !Path::new(&format!("/proc/{pid}")).exists()));
        assert!(names(&out).iter().all(|name| !name.contains(".tmp")) && out.join("index.csv").exists());

        // The parent killed: the workers go with it.
        let mut parent = begin(dir.path(), "out", &[]);
        wait_for("workers", || children(parent.id()).len() == 2);
        let workers = children(parent.id());
        parent.kill().unwrap();
        parent.wait().unwrap();
        wait_for("the workers' end", || {
            workers.iter().all(|pid| !Path::new(&format!("/proc/{pid}")).exists())
        });

        // Workers killed: others take their places.
        let parent = begin(dir.path(), "out", &[]);
        for _ in 0..3 {
            wait_for("workers", || !children(parent.id()).is_empty());
            let so_far = done(&out);
            children(parent.id()).first().into_iter().for_each(|&pid| signal("-KILL", pid));
            wait_for("a frame", || done(&out) > so_far || done(&out) == 12);
        }
        let said = parent.wait_with_output().unwrap();
        assert_eq!(said.status.code(), Some(0), "{}", String::from_utf8_lossy(&said.stderr));
        assert_same(&dir.path().join("whole"), &out);
    }

    #[test]
    fn frames_that_take_too_long_fail_alone() {
        // Two frames: one of a hundred pixels, and one that takes hours.
        let dir = folder(
            "fog: none\nsweep: {mode: zip, axes: {sensor.width_px: [8, 4000], render.samples: [1, 1000000]}}\n",
        );
        let cache = cache();
        let go = || run(&arguments("out", &cache, &["--frame-timeout", "2"]), dir.path());
        let failed = go();
        assert_eq!(failed.code, Some(1), "{}", failed.stderr);
        assert!(failed.stderr.contains("FAILED: not done within 2 s, 2 times"), "{}", failed.stderr);
        assert_eq!(done(&dir.path().join("out")), 1);
        // Not again unless asked to.
        let failed = go();
        assert_eq!(failed.code, Some(1));
        assert!(failed.stderr.contains("1 frames failed before"), "{}", failed.stderr);
    }
}
