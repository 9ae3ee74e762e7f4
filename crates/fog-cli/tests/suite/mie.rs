//! `fogbank mie`: the reference's spheres through the command line.

use crate::common::{json, run};
use std::path::Path;

const REFERENCE: &str = include_str!("../../../../tests/data/mie.csv");

fn mie(args: &[&str]) -> crate::common::Run {
    run(&[&["mie"], args].concat(), Path::new("."))
}

#[test]
fn spheres_of_the_reference_agree() {
    let mut lines = REFERENCE.lines();
    let header: Vec<&str> = lines.next().unwrap().split(',').collect();
    let spheres: Vec<Vec<&str>> = lines.map(|l| l.split(',').collect()).collect();
    // Every third one: a process each.
    for sphere in spheres.iter().step_by(3) {
        let index = format!("{},{}", sphere[0], sphere[1]);
        let out =
            mie(&["--index", &index, "--size-parameter", sphere[2], "--angles", "0,1,138,180", "--json"])
                .ok();
        let got = json(&out.stdout);
        for (name, want) in header.iter().zip(sphere).skip(3) {
            let want: f64 = want.parse().unwrap();
            let (value, scale) = match name.strip_prefix("abs_").and_then(|n| n.split_once("_sq_")) {
                None => (got[*name].as_f64().unwrap(), want),
                Some((s, angle)) => {
                    let angle: f64 = angle.trim_end_matches("deg").parse().unwrap();
                    let rows = got["angles"].as_array().unwrap();
                    let Some(row) = rows.iter().find(|r| r["angle_deg"] == angle) else { continue };
                    (row[format!("abs_{s}_sq")].as_f64().unwrap(), want)
                }
            };
            let bound = if name.starts_with('q') || *name == "g" { 1e-10 } else { 1e-8 };
            assert!(
                (value - want).abs() <= bound * scale.abs(),
                "{index} {} {name}: {value} {want}",
                sphere[2]
            );
        }
    }
}

#[test]
fn forms_hold_the_same_numbers() {
    let args = ["--index", "1.5", "--size-parameter", "10", "--angles", "0:180:90"];
    let csv = mie(&[&args[..], &["--csv"]].concat()).ok().stdout;
    let rows: Vec<Vec<&str>> = csv.lines().map(|l| l.split(',').collect()).collect();
    assert_eq!(
        rows[0].join(","),
        "n,k,size_parameter,q_ext,q_sca,q_abs,q_back,g,angle_deg,abs_s1_sq,abs_s2_sq,phase_function_1_sr"
    );
    assert_eq!(rows.len(), 4);
    let object = json(&mie(&[&args[..], &["--json"]].concat()).ok().stdout);
    assert_eq!(rows[1][3].parse::<f64>().unwrap(), object["q_ext"].as_f64().unwrap());
    assert_eq!(rows[3][9].parse::<f64>().unwrap(), object["angles"][2]["abs_s1_sq"].as_f64().unwrap());
    // Wiscombe 1979 prints 2.881999.
    let table = mie(&args).ok().stdout;
    assert!(table.contains("q_ext") && table.contains("2.882") && table.contains("abs_s1_sq"), "{table}");
}

#[test]
fn a_droplet_has_the_index_of_water() {
    let out = mie(&["--diameter-um", "10", "--wavelength", "550", "--json"]).ok().stdout;
    let object = json(&out);
    assert_eq!(object["n"], 1.333);
    assert!((object["size_parameter"].as_f64().unwrap() - 57.119_866_428_9).abs() < 1e-9);
    assert!(object.get("angles").is_none());
}

#[test]
fn mistakes_name_value_and_range() {
    for (args, expected) in [
        (&["--index", "1.5", "--size-parameter", "0"][..], "size parameter is 0; valid: 1e-6 to 100000"),
        (&["--index", "1.5", "--size-parameter", "1e6"], "size parameter is 1000000; valid: 1e-6 to 100000"),
        (&["--index", "-1.5", "--size-parameter", "1"], "refractive index n is -1.5; valid: 0.1 to 10"),
        (&["--index", "1.5,-0.1", "--size-parameter", "1"], "refractive index k is -0.1"),
        (&["--index", "water", "--size-parameter", "1"], "expected a finite number"),
        (&["--index", "1.5", "--size-parameter", "1", "--angles", "0,200"], "scattering angle 200"),
        (&["--index", "1.5", "--size-parameter", "1", "--angles", "0:180"], "FROM:TO:STEP"),
        (&["--diameter-um", "10", "--wavelength", "90"], "wavelength_nm is 90; valid: 200 to "),
        (&["--diameter-um", "-10", "--wavelength", "550"], "size parameter is -57"),
        (&["--index", "1.5"], "--size-parameter"),
        (&["--size-parameter", "1"], "--index"),
        (&["--diameter-um", "10"], "--wavelength"),
        (&["--index", "1.5", "--size-parameter", "1", "--json", "--csv"], "cannot be used with"),
    ] {
        let run = mie(args);
        assert_eq!(run.code, Some(2), "{args:?}\n{}", run.stdout);
        assert!(run.stderr.contains(expected), "{args:?}\n{}", run.stderr);
        assert_eq!(run.stdout, "");
    }
}
