//! `fogbank compare`: figures, maps, matching and exit codes.

use crate::common::{cache, folder, json, names, run, write};
use fogbank::dataset::{read_picture, read_plan, write_png};
use fogbank::film::Srgb8Picture;
use serde_json::Value;
use std::fs;
use std::path::Path;

const SWEEP: &str = "outputs: [image, hdr, standard_error]\nsweep: {axes: {fog: [none, {model: homogeneous, \
                     height_m: 60, sigma_t_1_m: 0.1, phase: {hg: 0.5}}], camera.altitude_m: [2, 30]}}\n";

/// Renders `dir/c.yaml` into `dir/OUT` with a seed and a number of samples.
fn render(dir: &Path, out: &str, seed: u32, samples: u32) {
    let sets = [format!("seed={seed}"), format!("render.samples={samples}")];
    run(
        &["sweep", "c.yaml", "--out", out, "--cache-dir", &cache(), "--set", &sets[0], "--set", &sets[1]],
        dir,
    )
    .ok();
}

/// Ids of a data set's frames, in plan order.
fn ids(set: &Path) -> Vec<String> {
    read_plan(set).expect("a plan").into_iter().map(|frame| frame.id).collect()
}

fn compared(dir: &Path, args: &[&str]) -> Value {
    json(&run(&[&["compare", "--json"], args].concat(), dir).ok().stdout)
}

fn close(value: &Value, want: f64, relative: f64) {
    let got = value.as_f64().unwrap_or_else(|| panic!("{value} is no number"));
    assert!((got / want - 1.0).abs() < relative, "{got} is not {want}");
}

/// A PNG of one colour.
fn even(dir: &Path, name: &str, [width, height]: [u32; 2], colour: [u8; 3]) {
    let bytes = colour.repeat((width * height) as usize);
    write_png(&dir.join(name), &Srgb8Picture { width, height, bytes }).expect("written");
}

#[test]
fn known_differences_of_pictures() {
    let dir = tempfile::tempdir().unwrap();
    let at = dir.path();
    even(at, "red.png", [7, 5], [255, 0, 0]);
    even(at, "green.png", [7, 5], [0, 255, 0]);
    even(at, "grey.png", [7, 5], [124; 3]);
    even(at, "lighter.png", [7, 5], [129; 3]);
    let c = compared(at, &["red.png", "green.png"]);
    close(&c["delta_e_2000"]["mean"], 86.61, 3e-4);
    assert_eq!(c["delta_e_2000"]["max"], c["delta_e_2000"]["median"]);
    assert_eq!(
        (&c["width"], &c["a"]["values"], &c["z_scores"]),
        (&json("7"), &json("\"srgb\""), &Value::Null)
    );
    close(&c["relative_difference_of_means"], 0.2126 / 0.7152 - 1.0, 1e-6);
    close(&c["relative_mse"], 2.0 / 1.01, 1e-6);
    let c = compared(at, &["lighter.png", "grey.png"]);
    close(&c["psnr_srgb8_db"], 34.151_403, 1e-7);
    // Linear values of the bytes, by the formula of sRGB.
    let linear = |byte: f64| fog_core::math::f64::pow((byte / 255.0 + 0.055) / 1.055, 2.4);
    close(&c["mean_relative_difference"], linear(129.0) / linear(124.0) - 1.0, 1e-5);
}

#[test]
fn equal_pictures() {
    let dir = folder("fog: none\n");
    let at = dir.path();
    render(at, "out", 1, 3);
    let id = &ids(&at.join("out"))[0];
    let (exr, png) = (format!("out/{id}.hdr.exr"), format!("out/{id}.rgb.png"));
    let text = run(&["compare", &exr, &exr, "--out", "map.png"], at).ok().stdout;
    for part in
        ["24 x 14 pixels", "mean 0.0000", "maximum 0.0000", "inf dB of 8-bit sRGB", "exposure 1)", "map.png"]
    {
        assert!(text.contains(part), "`{part}` is not in: {text}");
    }
    let map = read_picture(&at.join("map.png")).expect("a picture");
    assert_eq!((map.width, map.height), (24, 14), "too narrow for a scale");
    assert!(map.rgb.iter().all(|rgb| *rgb == map.rgb[0] && rgb[0] == 0.0), "all black");
    assert_eq!(names(at), ["c.yaml", "map.png", "out"]);
    // The PNG of a frame is what its radiance looks like.
    let c = compared(at, &[&exr, &png]);
    assert_eq!((&c["psnr_srgb8_db"], &c["linear_values"]), (&Value::Null, &json("\"display\"")));
    assert!(c["delta_e_2000"]["max"].as_f64().unwrap() < 1.0, "{c}");
    // But not at another exposure, which radiance does not know.
    let c = compared(at, &[&exr, &png, "--exposure", "0.5"]);
    assert!(c["delta_e_2000"]["mean"].as_f64().unwrap() > 5.0, "{c}");
    assert_eq!(c["a"]["exposure"], 0.5);
    assert_eq!(compared(at, &[&exr, &exr, "--exposure", "0.5"])["relative_mse"], 0.0);
}

#[test]
fn frames_of_two_seeds() {
    let dir = folder(SWEEP);
    let at = dir.path();
    render(at, "a", 1, 48);
    render(at, "b", 2, 48);
    let ids = ids(&at.join("a"));
    let c = compared(at, &["a", "b", "--out", "maps"]);
    let frames = c["frames"].as_array().unwrap();
    assert_eq!((frames.len(), &c["matched_by"]), (4, &json("\"id\"")));
    let mut maps: Vec<_> = ids.iter().map(|id| format!("{id}.de2000.png")).collect();
    maps.sort();
    assert_eq!(names(&at.join("maps")), maps);
    for frame in frames {
        let z = &frame["z_scores"];
        // Below 1 in clear air: stratified samples err less than their variance says.
        assert!((0.5..1.4).contains(&z["rms"].as_f64().unwrap()), "{frame}");
        assert!(z["mean"].as_f64().unwrap().abs() < 0.4, "{frame}");
        assert!(frame["delta_e_2000"]["mean"].as_f64().unwrap() > 0.1, "other noise: {frame}");
    }
    for figure in ["mean", "median", "p95", "max"] {
        let sum: f64 = frames.iter().map(|f| f["delta_e_2000"][figure].as_f64().unwrap()).sum();
        close(&c["means"]["delta_e_2000"][figure], sum / 4.0, 1e-12);
    }
    let table = run(&["compare", "a", "b"], at).ok().stdout;
    assert_eq!(table.lines().count(), 6, "{table}");
    assert!(table.starts_with("frame ") && table.lines().last().unwrap().starts_with("mean "), "{table}");
    // A frame that one of them lacks is left out.
    fs::remove_file(at.join("b").join(format!("{}.hdr.exr", ids[1]))).unwrap();
    let c = compared(at, &["a", "b"]);
    assert_eq!(c["frames"].as_array().unwrap().len(), 3);
    assert_eq!(
        (&c["left_out"][0]["id"], &c["left_out"][0]["reason"]),
        (&json(&format!("{:?}", ids[1])), &json("\"B has no picture of it\""))
    );
}

#[test]
fn fog_against_clear() {
    let dir = folder(SWEEP);
    let at = dir.path();
    render(at, "out", 1, 4);
    let ids = ids(&at.join("out"));
    // Frames 0 and 1 are clear, 2 and 3 foggy, at the same two altitudes.
    let c = compared(at, &["out", "out", "--pair"]);
    let pairs: Vec<_> = c["frames"].as_array().unwrap().iter().map(|f| (&f["id"], &f["id_b"])).collect();
    let id = |i: usize| Value::from(ids[i].clone());
    assert_eq!(pairs, [(&id(2), &id(0)), (&id(3), &id(1))]);
    assert_eq!(c["left_out"], json("[]"));
    let mean = c["frames"][0]["delta_e_2000"]["mean"].as_f64().unwrap();
    // The same two pictures by themselves.
    let (foggy, clear) = (format!("out/{}.hdr.exr", ids[2]), format!("out/{}.hdr.exr", ids[0]));
    close(&compared(at, &[&foggy, &clear])["delta_e_2000"]["mean"], mean, 1e-15);
    // Exit codes around that difference.
    for (limit, code) in [(mean * 1.001, 0), (mean * 0.999, 1)] {
        let judged = run(&["compare", &foggy, &clear, "--fail-above", &limit.to_string()], at);
        assert_eq!(judged.code, Some(code), "{}", judged.stderr);
        assert_eq!(judged.stderr.is_empty(), code == 0, "{}", judged.stderr);
    }
    let judged = run(&["compare", "out", "out", "--pair", "--fail-above", "0"], at);
    assert_eq!(judged.code, Some(1));
    assert!(judged.stderr.contains("is above 0 (and 1 more)"), "{}", judged.stderr);
}

#[test]
fn fogs_against_one_of_them() {
    let dir = folder(
        "fog: {model: homogeneous, height_m: 60, sigma_t_1_m: 0.1, phase: {hg: 0.5}}\noutputs: [hdr, \
         standard_error]\nsweep: {axes: {fog.phase.hg: [0, 0.5, 0.9], camera.altitude_m: [2, 30]}}\n",
    );
    let at = dir.path();
    render(at, "out", 1, 16);
    render(at, "again", 2, 16);
    let ids = ids(&at.join("out"));
    let c = compared(at, &["out", "out", "--reference", "fog.phase.hg=0.5"]);
    let pairs = |c: &Value| -> Vec<[String; 2]> {
        let frames = c["frames"].as_array().unwrap().iter();
        frames.map(|f| ["id", "id_b"].map(|key| f[key].as_str().unwrap().to_owned())).collect()
    };
    let want = |places: &[[usize; 2]]| -> Vec<[String; 2]> {
        places.iter().map(|place| place.map(|i| ids[i].clone())).collect()
    };
    assert_eq!(pairs(&c), want(&[[0, 2], [1, 3], [4, 2], [5, 3]]));
    assert_eq!((&c["matched_by"], &c["left_out"]), (&json("\"pair_id\""), &json("[]")));
    assert_eq!(c["reference"], "fog.phase.hg=0.5");
    // Between folders the reference has a partner too; there only noise differs, which blocks lessen.
    let fine = compared(at, &["out", "again", "--reference", "fog.phase.hg=0.5"]);
    assert_eq!(pairs(&fine), want(&[[0, 2], [1, 3], [2, 2], [3, 3], [4, 2], [5, 3]]));
    let coarse = compared(at, &["out", "again", "--reference", "fog.phase.hg=0.5", "--blocks", "4"]);
    let noise = |c: &Value| c["frames"][2]["relative_mse"].as_f64().unwrap();
    assert_eq!((&coarse["frames"][2]["width"], &coarse["frames"][2]["height"]), (&json("6"), &json("4")));
    assert!(noise(&coarse) < noise(&fine) / 8.0, "{} {}", noise(&coarse), noise(&fine));
    let z = coarse["frames"][2]["z_scores"]["rms"].as_f64().unwrap();
    assert!((0.4..1.6).contains(&z), "standard errors are those of the blocks: {z}");

    for (value, part) in [
        ("camera.altitude_m=2", "3 frames of its pair"),
        ("fog.model=advection", "with fog.model=advection"),
        ("fog.model", "expected KEY=VALUE"),
    ] {
        let refused = run(&["compare", "out", "out", "--reference", value], at);
        assert!(refused.code == Some(2) && refused.stderr.contains(part), "{}", refused.stderr);
    }
}

#[test]
fn mistakes() {
    let dir = folder("fog: none\n");
    let at = dir.path();
    render(at, "out", 1, 3);
    fs::create_dir(at.join("empty")).unwrap();
    let fog = ["--set", "fog={model: homogeneous, height_m: 9, sigma_t_1_m: 0.1, phase: {hg: 0}}"];
    let sweep = ["sweep", "c.yaml", "--out", "foggy", "--cache-dir", &cache()];
    run(&[&sweep[..], &fog].concat(), at).ok();
    write(at, "cat.png", "miaow");
    even(at, "small.png", [2, 3], [9; 3]);
    even(at, "large.png", [4, 3], [9; 3]);
    let truth = format!("out/{}.gt.exr", ids(&at.join("out"))[0]);
    for (args, parts) in [
        (vec!["small.png", "large.png"], vec!["small.png with large.png", "A has 2 x 3 pixels, B has 4 x 3"]),
        (
            vec!["cat.png", "small.png"],
            vec!["cat.png is no picture", "neither PNG nor JPEG nor Radiance HDR nor OpenEXR"],
        ),
        (
            vec!["small.png", &truth],
            vec!["gt.exr is no picture", "neither channels R, G, B nor Y, but depth.Z"],
        ),
        (vec!["small.png", "none.png"], vec!["cannot read none.png: No such file"]),
        (vec!["out", "none"], vec!["cannot read none: No such file"]),
        (vec!["small.png", "out"], vec!["small.png is a file and out is a folder"]),
        (vec!["out", "empty"], vec!["cannot read empty/dataset.json"]),
        (
            vec!["out", "foggy"],
            vec!["not one frame of A has a partner in B", "no frame of this id", "pair id"],
        ),
        (vec!["out", "out", "--pair"], vec!["not one frame of A has a partner in B"]),
        (vec!["small.png", "small.png", "--pair"], vec!["--pair is for data sets"]),
        (
            vec!["small.png", "small.png", "--reference", "fog.model=none"],
            vec!["--reference is for data sets"],
        ),
        (vec!["small.png", "large.png", "--blocks", "2"], vec!["A has 2 x 3 pixels, B has 4 x 3"]),
        (vec!["small.png", "small.png", "--exposure", "2"], vec!["both are sRGB pictures"]),
        (vec!["small.png", "small.png", "--out", "no/map.png"], vec!["cannot write no/map.png"]),
        (vec!["small.png", "small.png", "--scale", "0"], vec!["--scale", "above 0"]),
        (vec!["small.png", "small.png", "--fail-above", "nan"], vec!["--fail-above", "0 or more"]),
    ] {
        let refused = run(&[&["compare"], &args[..]].concat(), at);
        assert_eq!(refused.code, Some(2), "{args:?}: {}{}", refused.stdout, refused.stderr);
        for part in parts {
            assert!(refused.stderr.contains(part), "`{part}` is not in: {}", refused.stderr);
        }
    }
    // Frames that differ in fog match by pair, also between folders.
    assert_eq!(compared(at, &["foggy", "out", "--pair"])["frames"].as_array().unwrap().len(), 1);
}
