//! `fogbank visibility`: every law, conversions, slants, runways.

use crate::common::{Run, folder, json, run, write};
use fog_core::math::f64::{exp, sin};
use serde_json::Value;
use std::path::Path;

fn visibility(args: &[&str]) -> Run {
    run(&[&["visibility"], args].concat(), Path::new("."))
}

fn report(args: &[&str]) -> Value {
    json(&visibility(&[args, &["--json"]].concat()).ok().stdout)
}

fn number(value: &Value, name: &str) -> f64 {
    value[name].as_f64().unwrap_or_else(|| panic!("{name}: {value}"))
}

fn close(a: f64, b: f64, relative: f64) -> bool {
    (a / b - 1.0).abs() <= relative
}

/// The row of an array in which all of these hold.
fn find<'a>(rows: &'a Value, wanted: &[(&str, Value)]) -> &'a Value {
    let found = rows.as_array().unwrap().iter().find(|row| wanted.iter().all(|(name, v)| row[*name] == *v));
    found.unwrap_or_else(|| panic!("{wanted:?} in {rows}"))
}

#[test]
fn everything_that_the_issue_asks_for_is_printed() {
    let run = visibility(&["--model", "advection", "--height", "180", "--altitude", "2"]).ok();
    for text in [
        "Advection fog, 180 m high",
        "MOR, 5 % contrast (WMO-No. 8)/m",
        "visual range, 2 % contrast/m",
        "liquid water content",
        "Kunkel 1984",
        "Gultepe",
        "ICAO Annex 3",
        "night",
        "twilight",
        "bright_day",
        "10000",
        "Runway visual range 2.5 m over a runway",
        "CAT II",
        "decision height",
        "to the ground",
    ] {
        assert!(run.stdout.contains(text), "{text} in\n{}", run.stdout);
    }
}

#[test]
fn laws_hold_between_the_numbers() {
    let r = report(&["--mor", "350", "--intensity", "100", "2000"]);
    let sigma = number(&r, "sigma_t_1_m");
    assert!(close(number(&r, "mor_m"), 350.0, 1e-12) && close(sigma, 2.995_732_273_554 / 350.0, 1e-12));
    assert!(close(number(&r, "koschmieder_m"), 350.0 * 3.912 / 2.995_732_273_554, 1e-12));
    let lights = r["allard"].as_array().unwrap();
    assert_eq!(lights.len(), 8);
    for row in lights {
        let (i, e, d) = (number(row, "intensity_cd"), number(row, "threshold_lx"), number(row, "range_m"));
        assert!(close(i * exp(-sigma * d) / (d * d), e, 1e-9), "{row}");
    }
    // In even fog the ground is seen as far as anything.
    let ground = find(&r["ground"], &[("law", "mor".into())]);
    assert!(close(number(ground, "range_m"), 350.0, 1e-9));
    // Thresholds of other sources by name, and by background luminance.
    let r = report(&["--mor", "350", "--light", "wmo_dark", "--background", "1000", "--intensity", "1000"]);
    let rows = r["allard"].as_array().unwrap();
    assert!(close(number(&rows[0], "threshold_lx"), 3.162_277_66e-8, 1e-9));
    assert!(close(number(&rows[1], "threshold_lx"), 1.659_587e-4, 1e-6), "10^(-5.7 + 1.92)");
    assert!(number(&rows[0], "range_m") > number(&rows[1], "range_m"));
}

#[test]
fn runways_follow_the_steps_and_categories() {
    let rvr = |args: &[&str]| report(&[args, &["--light", "day"]].concat())["rvr"][0].clone();
    let row = rvr(&["--mor", "100", "--light-setting", "0"]);
    assert_eq!((row["reported"].as_str(), row["category"].as_str()), (Some("0100"), Some("CAT IIIB")));
    assert_eq!(number(&row, "lights_m"), 0.0);
    let row = rvr(&["--mor", "100", "--light-setting", "0", "--categories", "undivided"]);
    assert_eq!(row["category"], "CAT III");
    let row = rvr(&["--mor", "340", "--light-setting", "0"]);
    assert_eq!((row["reported"].as_str(), row["category"].as_str()), (Some("0325"), Some("CAT II")));
    let row = rvr(&["--mor", "40", "--light-setting", "0"]);
    assert_eq!((row["reported"].as_str(), row["category"].as_str()), (Some("M0050"), Some("CAT IIIC")));
    let row = rvr(&["--mor", "5000"]);
    assert_eq!((row["reported"].as_str(), row["category"].as_str()), (Some("P2000"), Some("CAT I")));
    // Lights reach farther than markings in fog, and weaker lights less far.
    let (full, weak) = (rvr(&["--mor", "150"]), rvr(&["--mor", "150", "--light-setting", "3"]));
    assert!(number(&full, "rvr_m") > number(&weak, "rvr_m") && number(&weak, "rvr_m") > 150.0);
}

#[test]
fn visibility_water_and_number_go_round() {
    let spectrum = "shettle_fenn_radiation_heavy";
    let first = report(&["--distribution", spectrum, "--mor", "200"]);
    assert!(close(number(&first, "mor_m"), 200.0, 1e-9));
    let text = |name: &str| number(&first, name).to_string();
    let (water, n, sigma) =
        (text("liquid_water_content_g_m3"), text("number_density_m3"), text("sigma_t_1_m"));
    for (flag, value) in [("--lwc", &water), ("--number", &n), ("--sigma", &sigma)] {
        let again = report(&["--distribution", spectrum, flag, value]);
        assert!(close(number(&again, "mor_m"), 200.0, 1e-9), "{flag}");
    }
    // That spectrum is a gamma distribution of effective variance 1/9: the default family finds it from any two.
    for pair in [
        ["--lwc", &water, "--number", &n],
        ["--mor", "200", "--lwc", &water],
        ["--number", &n, "--mor", "200"],
    ] {
        let again = report(&pair);
        assert!(close(number(&again, "mor_m"), 200.0, 2e-4), "{pair:?}");
        assert!(
            close(number(&again, "effective_radius_um"), number(&first, "effective_radius_um"), 2e-4),
            "{pair:?}"
        );
    }
}

#[test]
fn slants_are_exact() {
    let dir = folder("");
    write(dir.path(), "l.csv", "altitude_m,sigma_t_1_m\n0,0\n100,0.1\n");
    let args = [
        "visibility",
        "--layers",
        "l.csv",
        "--altitude",
        "40",
        "--slant",
        "-90",
        "-30",
        "0",
        "--to",
        "0,30",
        "--json",
    ];
    let r = json(&run(&args, dir.path()).ok().stdout);
    // Vertical depth from 40 m to the ground: 0.001 · 40² / 2 = 0.8; to the point, 50 m away: 0.8 · 50 / 40.
    assert!(
        close(number(&r, "optical_depth"), 1.0, 1e-9) && close(number(&r, "transmittance"), exp(-1.0), 1e-9)
    );
    assert_eq!(number(&r, "path_length_m"), 50.0);
    assert_eq!(find(&r["to"], &[("law", "mor".into())])["seen"], true);
    let slant = |angle: f64| find(&r["slant"], &[("law", "mor".into()), ("elevation_deg", angle.into())]);
    assert!(slant(-90.0)["range_m"].is_null(), "the depth of 3 is nowhere reached");
    assert!(close(number(slant(-30.0), "ground_m"), 40.0 / sin(fog_core::math::PI / 6.0), 1e-12));
    assert_eq!(slant(-30.0)["ground_seen"], true);
    assert!(close(number(slant(0.0), "range_m"), number(&r, "mor_m"), 1e-9));
    assert!(slant(0.0)["ground_m"].is_null());
    // A flat slant is nearly level.
    let flat = visibility(&[
        "--sigma",
        "0.02",
        "--height",
        "400",
        "--altitude",
        "200",
        "--slant",
        "-0.1",
        "--light",
        "night",
        "--json",
    ]);
    let flat = json(&flat.ok().stdout);
    for row in flat["slant"].as_array().unwrap() {
        let level = match row["law"].as_str() {
            Some("mor") => number(&flat, "mor_m"),
            Some("koschmieder") => number(&flat, "koschmieder_m"),
            _ => number(find(&flat["allard"], &[("intensity_cd", row["intensity_cd"].clone())]), "range_m"),
        };
        assert!(close(number(row, "range_m"), level, 1e-9), "{row}");
    }
}

#[test]
fn the_model_is_scaled_to_a_visibility() {
    let args = [
        "--model",
        "advection",
        "--height",
        "180",
        "--altitude",
        "2,60",
        "--mor",
        "300",
        "--light",
        "night",
        "--json",
    ];
    let out = visibility(&args).ok().stdout;
    let reports: Vec<Value> = out.lines().map(json).collect();
    assert_eq!(reports.len(), 2);
    assert!(close(number(&reports[0], "mor_m"), 300.0, 1e-9));
    assert!(number(&reports[1], "mor_m") < 200.0, "thicker aloft");
    // Droplets and layer are two ways to the same extinction.
    let lwc = number(&reports[1], "liquid_water_content_g_m3");
    let radius = number(&reports[1], "effective_radius_um");
    let geometric = 1.5 * lwc / radius;
    assert!(close(number(&reports[1], "sigma_t_1_m"), geometric * 1.055, 0.01));
}

#[test]
fn csv_has_a_line_per_number() {
    let csv = visibility(&["--mor", "350", "--light", "night", "--intensity", "100", "--csv"]).ok().stdout;
    assert!(csv.starts_with("altitude_m,part,condition,quantity,value\n2.0,,,altitude_m,2.0\n"), "{csv}");
    assert!(
        csv.contains("\n2.0,allard,light=night threshold_lx=8e-7 intensity_cd=100,range_m,660.88"),
        "{csv}"
    );
    assert!(csv.lines().all(|line| line.split(',').count() >= 5));
}

#[test]
fn mistakes_are_explained() {
    let layer = |height: &'static str, altitude: &'static str| {
        vec!["--model", "advection", "--height", height, "--altitude", altitude]
    };
    for (args, expected) in [
        (layer("0", "2"), "fog height_m is 0; valid: 1 to 2000"),
        (layer("-5", "2"), "fog height_m is -5"),
        (layer("5000", "2"), "fog height_m is 5000"),
        (layer("180", "200"), "--altitude 200 m is outside of the fog; valid: 0 to 180 m"),
        (layer("180", "x"), "expected a finite number"),
        (vec!["--mor", "0"], "mor_m is 0; valid: 0.003 to"),
        (vec!["--mor", "-300"], "mor_m is -300"),
        (vec!["--sigma", "-0.1"], "sigma_t (1/m) is -0.1"),
        (vec!["--mor", "300", "--slant", "-95"], "elevation angle (degrees) is -95; valid: -90 to 90"),
        (vec!["--mor", "300", "--to", "5"], "expected 2 numbers"),
        (vec!["--mor", "300", "--to", "5,-1"], "horizontal distance_m is -1"),
        (vec!["--mor", "300", "--intensity", "0"], "--intensity 0 cd"),
        (vec!["--mor", "300", "--light", "noon"], "bright_day"),
        (vec!["--mor", "300", "--background", "-1"], "background luminance (cd/m²) is -1"),
        (vec!["--mor", "300", "--light-setting", "120"], "light setting (%) is 120; valid: 0 to 100"),
        (vec!["--mor", "300", "--sigma", "0.1", "--lwc", "1"], "two of"),
        (vec!["--mor", "300", "--sigma", "0.1"], "two different amounts"),
        (vec!["--lwc", "0.1"], "does not fix a fog"),
        (vec!["--layers", "none.csv"], "cannot read none.csv"),
        (vec![], "which fog?"),
    ] {
        let run = visibility(&args);
        assert_eq!(run.code, Some(2), "{args:?}\n{}{}", run.stdout, run.stderr);
        assert!(run.stderr.contains(expected), "{args:?}\n{}", run.stderr);
        assert_eq!(run.stdout, "", "{args:?}");
    }
    let far = visibility(&layer("300", "2"));
    assert!(far.code == Some(0) && far.stderr.contains("extrapolation"), "{}", far.stderr);
}
