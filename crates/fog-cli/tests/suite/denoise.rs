//! The output `denoised`: with the library that `FOGBANK_OIDN` names, and without one.

use crate::common::{assert_same, cache, command, contents, folder, ids, json, names, read_json, run};
use std::fs;
use std::path::Path;

const NOISY: &str = "fog: {model: homogeneous, height_m: 60, sigma_t_1_m: 0.05, phase: {hg: 0.8}}\n\
                     outputs: [image, hdr, standard_error, denoised]\n";

/// `sweep` with a library; the environment names none.
fn sweep(dir: &Path, out: &str, more: &[&str]) -> crate::common::Run {
    let cache = cache();
    let args = [&["sweep", "c.yaml", "--out", out, "--cache-dir", &cache], more].concat();
    let output = command(&args, dir).env_remove("FOGBANK_OIDN").output().expect("the program starts");
    let text = |bytes| String::from_utf8(bytes).expect("messages are UTF-8");
    crate::common::Run {
        code: output.status.code(),
        stdout: text(output.stdout),
        stderr: text(output.stderr),
    }
}

#[test]
fn a_missing_library_is_named_before_anything_is_rendered() {
    let dir = folder(NOISY);
    let at = dir.path();
    let refused = sweep(at, "out", &["--oidn", "no/such/folder/oidn.so"]);
    assert_eq!(refused.code, Some(2), "{}", refused.stderr);
    for part in ["`denoised`", "no/such/folder/oidn.so", "pip install pyoidn", "--oidn", "FOGBANK_OIDN"] {
        assert!(refused.stderr.contains(part), "`{part}` is not in: {}", refused.stderr);
    }
    assert_eq!(names(at), ["c.yaml"], "no data set was begun");
    let cache = cache();
    let args = ["sweep", "c.yaml", "--out", "out", "--cache-dir", &cache];
    let named = command(&args, at).env("FOGBANK_OIDN", "elsewhere.so").output().expect("the program starts");
    assert!(String::from_utf8_lossy(&named.stderr).contains("elsewhere.so"));
    // Who does not ask for it needs none.
    let dir = folder("fog: none\noutputs: [image]\n");
    assert_eq!(sweep(dir.path(), "out", &["--oidn", "no/such/folder/oidn.so"]).code, Some(0));
}

#[test]
fn the_picture_that_it_was_guessed_from_is_kept() {
    let dir = folder("outputs: [denoised, image]\nfog: none\n");
    let refused = run(&["plan", "c.yaml"], dir.path());
    assert_eq!(refused.code, Some(2));
    let message =
        "outputs.0: denoised is a guess from the output `hdr`, which is kept beside it: name hdr too";
    assert!(refused.stderr.contains(message), "{}", refused.stderr);
}

#[test]
fn denoised_beside_the_rendered() {
    let Some(library) = std::env::var_os("FOGBANK_OIDN") else {
        eprintln!("FOGBANK_OIDN names no library: not tested");
        return;
    };
    let library = library.into_string().expect("UTF-8");
    let dir = folder(NOISY);
    let at = dir.path();
    for (out, threads) in [("one", "1"), ("two", "2")] {
        let said = sweep(at, out, &["--oidn", &library, "--threads", threads]).ok().stdout;
        assert!(said.contains("Open Image Denoise 2."), "{said}");
    }
    // On this machine all bytes are the same, those of the denoised files too.
    assert_same(&at.join("one"), &at.join("two"));
    let id = &ids(at)[0];
    let file = |out: &str, kind: &str| at.join(out).join(format!("{id}.{kind}"));

    // Nearer to many samples than what it was made from.
    let more = ["--set", "outputs=[image, hdr, standard_error]", "--set", "render.samples=1500"];
    sweep(at, "reference", &more).ok();
    let reference = names(&at.join("reference")).into_iter().find(|n| n.ends_with(".hdr.exr")).expect("exr");
    let error = |kind: &str| {
        let (a, b) = (file("one", kind), at.join("reference").join(&reference));
        let args = ["compare", "--json", a.to_str().expect("UTF-8"), b.to_str().expect("UTF-8")];
        json(&run(&args, at).ok().stdout)["relative_mse"].as_f64().expect("a number")
    };
    let (rendered, denoised) = (error("hdr.exr"), error("denoised.exr"));
    assert!(denoised < 0.3 * rendered, "{denoised} {rendered}");

    // The record says what it is, and the library is named beside it.
    let record = read_json(&file("one", "json"));
    assert!(record["denoised"]["is"].as_str().expect("text").contains("estimate"), "{record}");
    let details = read_json(&file("one", "denoised.json"));
    assert!(details["library_version"].as_str().expect("text").starts_with("2."), "{details}");
    assert_eq!(details["files"].as_array().expect("files").len(), 2);
    let marker = fs::read_to_string(file("one", "done")).expect("read");
    assert!(!marker.contains("denoised"), "the marker is of reproducible files: {marker}");

    // Its files are part of the frame all the same: damage is found, and what is gone is made again.
    let before = contents(&at.join("one"));
    fs::write(file("one", "denoised.png"), "scratched").expect("write");
    let verified = run(&["verify", "one"], at);
    assert!(verified.code == Some(1) && verified.stdout.contains("denoised.png"), "{}", verified.stdout);
    sweep(at, "one", &["--oidn", &library]).ok();
    assert_eq!(contents(&at.join("one")), before);
}
