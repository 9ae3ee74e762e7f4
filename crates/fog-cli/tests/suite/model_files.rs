//! Fog models by file: from counts over a fit to frames and numbers, and what goes wrong on the way.

use crate::common::{Run, assert_same, cache, folder, ids, json, read_json, repository, run, sweep, write};
use serde_json::Value;
use std::fs;
use std::path::Path;

/// The shipped model with something replaced.
fn arcata(from: &str, to: &str) -> String {
    let text = fs::read_to_string(repository("tables/advection/arcata.yaml")).unwrap();
    assert!(text.contains(from), "{from}");
    text.replace(from, to)
}

/// The shipped model with other measured heights and three times the droplets: its tables are the shipped model's.
fn dense() -> String {
    arcata("[100, 180, 260]", "[40, 60]").replace("number_density_scale: 1.0", "number_density_scale: 3.0")
}

fn states(dir: &Path) -> Vec<Value> {
    ids(dir).iter().map(|id| read_json(&dir.join(format!("out/{id}.json")))["fog_state"].clone()).collect()
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value} is no number"))
}

/// |a / b − 1|.
fn off(a: &Value, b: &Value) -> f64 {
    (number(a) / number(b) - 1.0).abs()
}

fn refused(run: &Run, words: &[&str]) {
    assert_eq!(run.code, Some(2), "{}\n{}", run.stdout, run.stderr);
    for word in words {
        assert!(run.stderr.contains(word), "`{word}` is not in {}", run.stderr);
    }
}

#[test]
fn counts_become_a_model_that_renders_and_computes_like_the_one_they_came_from() {
    let dir = folder(
        "outputs: [image, tau]\nfog: {model: advection, height_m: 180}\n\
         sweep: {axes: {fog.coefficients: [null, model.yaml, copy.yaml]}}\n",
    );
    run(&["fit", "synthetic", "--out", "flights.csv"], dir.path()).ok();
    run(&["fit", "flights.csv", "--out", "model.yaml", "--quiet"], dir.path()).ok();
    let text = fs::read(dir.path().join("model.yaml")).unwrap();
    write(dir.path(), "copy.yaml", &text);

    // A cache of its own: other tests count the tables of the shared one.
    let sweep = ["sweep", "c.yaml", "--out", "out", "--cache-dir", "own"];
    let said = run(&sweep, dir.path()).ok().stdout;
    let tables: Vec<&str> = said.lines().filter(|line| line.starts_with("optics table (")).collect();
    assert_eq!(tables.len(), 2, "the same droplets have one table: {said}");
    assert!(tables[1].starts_with("optics table (polydisperse Mie, model.yaml)"), "{said}");
    let states = states(dir.path());
    let [shipped, fitted, copy] = &states[..] else { panic!("{states:?}") };
    assert_eq!(shipped["files"], serde_json::json!({}));
    let hash = &fitted["files"]["model.yaml"];
    assert!(hash.as_str().is_some_and(|hash| hash.len() == 64), "{fitted}");
    assert_eq!(copy["files"]["copy.yaml"], *hash);
    for place in ["at_camera", "at_base", "at_top"] {
        assert_eq!(fitted[place], copy[place]);
        for (key, most) in [("sigma_t_1_m", 0.2), ("g", 0.01), ("effective_radius_um", 0.1)] {
            let off = off(&fitted[place][key], &shipped[place][key]);
            assert!(off > 0.0 && off < most, "{place} {key}: {off}");
        }
    }

    let optics = |more: &[&str]| {
        let args = ["optics", "--model", "advection", "--height", "180", "--altitude", "60", "120", "--json"];
        let out = run(&[&args[..], &["--wavelength", "550", "905"], more].concat(), dir.path()).ok().stdout;
        out.lines().map(json).collect::<Vec<_>>()
    };
    let (shipped, fitted) = (optics(&[]), optics(&["--coefficients", "model.yaml"]));
    assert_eq!(fitted.len(), 4);
    for (fitted, shipped) in fitted.iter().zip(&shipped) {
        for (key, most) in [("sigma_t_1_m", 0.04), ("liquid_water_content_g_m3", 0.05), ("g", 0.003)] {
            let off = off(&fitted[key], &shipped[key]);
            assert!(off > 0.0 && off < most, "{key}: {off}");
        }
    }
}

#[test]
fn every_fog_that_takes_something_from_the_model_takes_it_from_the_file() {
    let fogs = [
        "{model: advection, height_m: 50, sampling: diameter",
        "{model: homogeneous, height_m: 50, phase: mie_mean_diameter",
        "{model: linear_gradient, height_m: 50, phase: jendersie_deon",
        "{model: layered, file: l.csv, phase: {hg: layer}",
        "{model: droplets, height_m: 80, droplets: deirmendjian_cloud_c1, vertical: advection",
    ];
    let axis: Vec<String> = fogs
        .iter()
        .flat_map(|fog| [format!("{fog}}}"), format!("{fog}, coefficients: dense.yaml}}")])
        .collect();
    let dir = folder(&format!("outputs: [tau]\nsweep: {{axes: {{fog: [{}]}}}}\n", axis.join(", ")));
    write(dir.path(), "dense.yaml", dense());
    write(dir.path(), "l.csv", "altitude_m,sigma_t_1_m\n0,0.01\n50,0.02\n");
    let said = sweep(dir.path(), "out").ok().stdout;
    // Each file is held to its own measured heights.
    let of = |model: &str, measured: &str, heights: &str| {
        let warning = format!(
            "advection fog of {heights} m is an extrapolation: the model{model} was fitted to layers of {measured} m"
        );
        assert!(said.contains(&warning), "{warning}\n{said}");
    };
    of("", "[100.0, 180.0, 260.0]", "[50.0, 80.0]");
    of(" of dense.yaml", "[40.0, 60.0]", "[80.0]");

    let states = states(dir.path());
    for (i, times) in [(0, 3.0), (1, 3.0), (2, 3.0), (3, 1.0), (4, 1.0)] {
        let (shipped, dense) = (&states[2 * i], &states[2 * i + 1]);
        assert!(dense["files"]["dense.yaml"].is_string() && shipped["files"]["dense.yaml"].is_null());
        let ratio = number(&dense["at_camera"]["sigma_t_1_m"]) / number(&shipped["at_camera"]["sigma_t_1_m"]);
        assert!((ratio / times - 1.0).abs() < 1e-9, "{}: {ratio}", fogs[i]);
        assert_eq!(dense["phase"], shipped["phase"]);
    }
    assert!(states[7]["files"]["l.csv"].is_string(), "{}", states[7]);
}

#[test]
fn bad_files_fail_their_frames_and_no_others() {
    let one = "fog: {model: advection, height_m: 150, coefficients: m.yaml}\n";
    let dir = folder(one);
    refused(&sweep(dir.path(), "out"), &["cannot read m.yaml", "No such file"]);
    write(dir.path(), "m.yaml", arcata("sigma_G: [1.41, 1.60]", "sigma_G: [1.41, wide]"));
    refused(
        &sweep(dir.path(), "out"),
        &["m.yaml: fog model: `sigma_G`: invalid floating point at line 14, column 17\n"],
    );
    write(dir.path(), "m.yaml", arcata("sigma_G: [1.41, 1.60]", "sigma_G: [1.0, -2.0]"));
    refused(&sweep(dir.path(), "out"), &["m.yaml: fog model: `sigma_G` is ", "valid: above 0"]);
    write(dir.path(), "m.yaml", arcata("mu_G:", "mu_Q:"));
    refused(&sweep(dir.path(), "out"), &["m.yaml: fog model: unknown field `mu_Q`", "line 13, column 1"]);
    assert!(!dir.path().join("out").exists());

    let dir =
        folder(&format!("outputs: [tau]\n{one}sweep: {{axes: {{fog.coefficients: [m.yaml, null]}}}}\n"));
    write(dir.path(), "m.yaml", "mu_L: [fog]\n");
    let first = sweep(dir.path(), "out");
    assert_eq!(first.code, Some(1), "{}", first.stderr);
    assert!(
        first.stderr.contains("FAILED: m.yaml: fog model: `mu_L`: invalid floating point at line 1"),
        "{}",
        first.stderr
    );
    assert!(first.stdout.contains("1 frames done, 1 failed"), "{}", first.stdout);
    // The mended file makes up for it.
    write(dir.path(), "m.yaml", dense());
    let again = ["sweep", "c.yaml", "--out", "out", "--retry-failed", "--cache-dir", &cache()];
    run(&again, dir.path()).ok();
    sweep(dir.path(), "at_once").ok();
    assert_same(&dir.path().join("out"), &dir.path().join("at_once"));
}

#[test]
fn a_data_set_is_of_one_content_of_each_file() {
    let dir = folder(
        "outputs: [tau]\nsweep:\n  axes:\n    fog: [none, {model: advection, height_m: 150, coefficients: m.yaml}, \
         {model: layered, file: l.csv, phase: {hg: 0}}]\n    camera.altitude_m: [2, 9]\n",
    );
    let layers = "altitude_m,sigma_t_1_m\n0,0.01\n50,0.02\n";
    write(dir.path(), "m.yaml", dense());
    write(dir.path(), "l.csv", layers);
    let render = |frame: &str| {
        let args = ["render", "c.yaml", "--frame", frame, "--out", "out", "--cache-dir"];
        run(&[&args[..], &[&crate::common::cache()]].concat(), dir.path())
    };
    for frame in ["0", "2", "4"] {
        render(frame).ok();
    }
    let ids = ids(dir.path());
    write(dir.path(), "l.csv", layers.replace("0.02", "0.03"));
    let changed = |file: &str, frame: &str| {
        format!("out holds frames made from another content of {file} (such as {frame})")
    };
    refused(&sweep(dir.path(), "out"), &[&changed("l.csv", &ids[4]), "use another folder or the old file"]);
    write(dir.path(), "l.csv", layers);
    write(dir.path(), "m.yaml", dense() + "# another remark\n");
    refused(&sweep(dir.path(), "out"), &[&changed("m.yaml", &ids[2])]);
    // A single frame is refused likewise, unless it has nothing to do with the file.
    refused(&render("3"), &[&changed("m.yaml", &ids[2])]);
    render("1").ok();
    write(dir.path(), "m.yaml", dense());
    let said = sweep(dir.path(), "out").ok().stdout;
    assert!(said.contains("6 frames done, 0 failed, 0 missing"), "{said}");
}

#[test]
fn coefficients_mean_the_same_on_every_command_line() {
    let dir = tempfile::tempdir().unwrap();
    write(dir.path(), "dense.yaml", dense());
    write(dir.path(), "bad.yaml", "mu_L: [fog]\n");
    let layer = ["--model", "advection", "--height", "50", "--altitude", "25"];
    let with = |command: &str, file: &str, more: &[&str]| {
        run(&[&[command][..], &layer, &["--coefficients", file], more].concat(), dir.path())
    };
    let said = with("visibility", "dense.yaml", &[]).ok().stdout;
    assert!(said.starts_with("Advection fog, 50 m high (model of dense.yaml)\n"), "{said}");
    let dense = json(&with("optics", "dense.yaml", &["--wavelength", "550", "--json"]).ok().stdout);
    let shipped = [&["optics"][..], &layer, &["--wavelength", "550", "--json"]].concat();
    let shipped = run(&shipped, dir.path());
    assert!(shipped.stderr.contains("fitted to layers of 100 to 260 m"), "{}", shipped.stderr);
    let ratio = number(&dense["sigma_t_1_m"]) / number(&json(&shipped.stdout)["sigma_t_1_m"]);
    assert!((ratio - 3.0).abs() < 1e-9, "{ratio}");
    for (command, more) in [("visibility", &[][..]), ("optics", &["--wavelength", "550"])] {
        refused(&with(command, "bad.yaml", more), &["bad.yaml: fog model: `mu_L`: ", "line 1"]);
        refused(&with(command, "none.yaml", more), &["cannot read none.yaml"]);
        let alone = [&[command, "--coefficients", "dense.yaml", "--mor", "300"][..], more].concat();
        refused(&run(&alone, dir.path()), &["--model"]);
    }
}
