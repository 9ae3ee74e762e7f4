//! One path again, in words and in numbers.

use crate::common::{cache, folder, ids, json, run, sweep};
use fogbank::dataset::read_exr_channels;
use serde_json::Value;

const FOG: &str =
    "fog: {model: advection, height_m: 40, number_density_scale: 4}\noutputs: [hdr, direct, airlight]\n";

fn numbers(value: &Value) -> Vec<f32> {
    value.as_array().expect("array").iter().map(|v| v.as_f64().expect("number") as f32).collect()
}

#[test]
fn a_replayed_path_is_the_films_sample() {
    let dir = folder(FOG);
    let one = ["--set", "render.samples=1", "--set", "lighting=sunny", "--cache-dir", &cache()];
    run(&[&["sweep", "c.yaml", "--out", "out"], &one[..]].concat(), dir.path()).ok();
    let plan = run(
        &["plan", "c.yaml", "--json", "--set", "render.samples=1", "--set", "lighting=sunny"],
        dir.path(),
    );
    let id = json(&plan.ok().stdout)["id"].as_str().expect("id").to_owned();
    let channels = read_exr_channels(&dir.path().join(format!("out/{id}.hdr.exr"))).expect("a readable file");
    let mut fog = 0;
    for pixel in ["0,0", "23,13", "12,7", "12,12", "3,9", "20,2"] {
        let path = ["replay", "c.yaml", "--pixel", pixel, "--sample", "0", "--json"];
        let told = json(&run(&[&path[..], &one].concat(), dir.path()).ok().stdout);
        let (x, y) = pixel.split_once(',').expect("pair");
        let i = y.parse::<usize>().expect("row") * 24 + x.parse::<usize>().expect("column");
        let picture: Vec<f32> = ["R", "G", "B"].iter().map(|c| channels[*c].values[i]).collect();
        assert_eq!(numbers(&told["value"]), picture, "{pixel}: {told:#}");
        for layer in ["direct", "airlight"] {
            assert_eq!(numbers(&told[layer])[1], channels[&format!("{layer}.G")].values[i], "{pixel}");
        }

        // The steps add up to the radiance, in their order.
        let steps = told["steps"].as_array().expect("steps");
        let mut sum = [0.0f32; 8];
        for added in steps.iter().filter_map(|s| s.get("added")) {
            sum.iter_mut().zip(numbers(added)).for_each(|(sum, added)| *sum += added);
        }
        assert_eq!(numbers(&told["radiance"]), sum, "{pixel}");
        assert_eq!(steps[0]["step"], "flight");
        fog += steps.iter().filter(|s| s["step"] == "collision").count();
    }
    assert!(fog > 0, "no path met the fog");
}

#[test]
fn in_words() {
    let dir = folder(FOG);
    let path = ["replay", "c.yaml", "--pixel", "12,12", "--sample", "2", "--cache-dir", &cache()];
    let said = run(&path, dir.path()).ok().stdout;
    let value = json(&run(&[&path[..], &["--json"]].concat(), dir.path()).ok().stdout);
    let [r, g, b] = numbers(&value["value"])[..] else { panic!("{value}") };
    for part in [
        &format!("frame {}, pixel 12,12, sample 2", ids(dir.path())[0]),
        "camera ray through image point (12.",
        "wavelengths: hero",
        "  1. flies",
        &format!("to the film: ({r:.6}, {g:.6}, {b:.6})"),
    ] {
        assert!(said.contains(part), "{part} is not in\n{said}");
    }
}

#[test]
fn paths_that_there_are_not() {
    let dir = folder(FOG);
    for (pixel, sample, message) in [
        ("24,0", "0", "the frame has no pixel 24,0: columns go from 0 to 23, rows from 0 to 13"),
        ("0,0", "3", "the frame has no sample 3: its pixels have 3 at most, counted from 0"),
        ("0", "0", "`0` is no pixel; write column and row as 40,30"),
    ] {
        let path = ["replay", "c.yaml", "--pixel", pixel, "--sample", sample, "--cache-dir", &cache()];
        let told = run(&path, dir.path());
        assert_eq!(told.code, Some(2), "{}", told.stderr);
        assert!(told.stderr.contains(message), "{}", told.stderr);
    }
    let dir = folder("fog: none\nsweep: {axes: {camera.altitude_m: [1, 2]}}\n");
    let told = run(&["replay", "c.yaml", "--pixel", "0,0", "--sample", "0"], dir.path());
    assert!(told.stderr.contains("name one with --frame ID"), "{}", told.stderr);
    sweep(dir.path(), "out").ok();
}
