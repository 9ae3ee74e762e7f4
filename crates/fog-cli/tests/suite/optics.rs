//! `fogbank optics`: droplets by altitude and wavelength.

use crate::common::{Run, folder, json, run, write};
use serde_json::Value;
use std::collections::BTreeMap;
use std::path::Path;

const REFERENCE: &str = include_str!("../../../../tests/data/fog_profile.csv");
const FIELDS: [&str; 13] = [
    "q_ext",
    "q_sca",
    "q_back",
    "g",
    "sigma_t_1_m",
    "sigma_s_1_m",
    "albedo",
    "number_density_m3",
    "liquid_water_content_g_m3",
    "mor_m",
    "effective_radius_um",
    "backscatter_1_m_sr",
    "lidar_ratio_sr",
];

fn optics(args: &[&str]) -> Run {
    run(&[&["optics"], args].concat(), Path::new("."))
}

fn number(row: &Value, name: &str) -> f64 {
    row[name].as_f64().unwrap_or_else(|| panic!("{name}: {row}"))
}

fn close(a: f64, b: f64, relative: f64) -> bool {
    (a / b - 1.0).abs() <= relative
}

#[test]
fn the_reference_profile_agrees_to_a_thousandth() {
    let mut heights: BTreeMap<&str, Vec<Vec<&str>>> = BTreeMap::new();
    for line in REFERENCE.lines().skip(1) {
        let row: Vec<&str> = line.split(',').collect();
        heights.entry(row[0]).or_default().push(row);
    }
    for (height, rows) in heights {
        let altitudes: Vec<&str> = rows.iter().map(|r| r[1]).collect();
        let args =
            ["--model", "advection", "--height", height, "--wavelength", "550", "--json", "--altitude"];
        let out = optics(&[&args[..], &altitudes].concat()).ok().stdout;
        assert_eq!(out.lines().count(), rows.len());
        for (line, row) in out.lines().zip(rows) {
            let got = json(line);
            for (name, column) in [
                ("altitude_m", 1),
                ("wavelength_nm", 2),
                ("number_density_m3", 5),
                ("liquid_water_content_g_m3", 6),
                ("sigma_t_1_m", 7),
                ("sigma_s_1_m", 8),
                ("g", 9),
            ] {
                let want: f64 = row[column].parse().unwrap();
                let value = number(&got, name);
                assert!((value - want).abs() <= 1e-3 * want.abs(), "{height} {name}: {value} {want}");
            }
            assert!(close(number(&got, "mor_m") * number(&got, "sigma_t_1_m"), 2.995_732_273_554, 1e-9));
        }
    }
}

#[test]
fn every_field_is_there_in_every_form() {
    let args =
        ["--model", "advection", "--height", "180", "--altitude", "2", "60", "--wavelength", "550,905"];
    let lines = optics(&[&args[..], &["--json"]].concat()).ok().stdout;
    let csv = optics(&[&args[..], &["--csv"]].concat()).ok().stdout;
    let table = optics(&args).ok().stdout;
    let mut csv_lines = csv.lines();
    let header: Vec<&str> = csv_lines.next().unwrap().split(',').collect();
    for (line, csv_line) in lines.lines().zip(csv_lines) {
        let row = json(line);
        for (name, cell) in header.iter().zip(csv_line.split(',')) {
            // serde_json reads numbers to the last bit but one.
            assert!(close(cell.parse().unwrap(), number(&row, name), 1e-15), "{name}");
        }
        assert!(close(
            number(&row, "sigma_s_1_m") / number(&row, "sigma_t_1_m"),
            number(&row, "albedo"),
            1e-12
        ));
        assert!(close(
            number(&row, "sigma_t_1_m") / number(&row, "backscatter_1_m_sr"),
            number(&row, "lidar_ratio_sr"),
            1e-12
        ));
    }
    for name in FIELDS {
        assert!(header.contains(&name) && table.contains(name), "{name}");
    }
    assert_eq!(lines.lines().count(), 4);
}

#[test]
fn amounts_lead_to_each_other() {
    let base = ["--distribution", "gamma:6,0.12", "--wavelength", "550", "--json"];
    let of = |amount: &[&str]| json(&optics(&[&base[..], amount].concat()).ok().stdout);
    let first = of(&["--number", "1e8"]);
    let text = |name: &str| number(&first, name).to_string();
    for (flag, name) in
        [("--lwc", "liquid_water_content_g_m3"), ("--mor", "mor_m"), ("--sigma", "sigma_t_1_m")]
    {
        let again = of(&[flag, &text(name)]);
        for field in FIELDS {
            assert!(close(number(&again, field), number(&first, field), 1e-9), "{flag} {field}");
        }
    }
    // Two amounts find the size too.
    let args =
        ["--number", "1e8", "--lwc", &text("liquid_water_content_g_m3"), "--effective-variance", "0.12"];
    let found = json(&optics(&[&args[..], &["--wavelength", "550", "--json"]].concat()).ok().stdout);
    assert!(close(number(&found, "effective_radius_um"), 6.0, 1e-4));
    assert!(close(number(&found, "mor_m"), number(&first, "mor_m"), 1e-4));
}

#[test]
fn the_catalogue_brings_its_own_number_and_lidars_their_wavelength() {
    let args = ["--distribution", "deirmendjian_cloud_c1", "--preset", "lidar_905", "--json"];
    let row = json(&optics(&args).ok().stdout);
    assert!(close(number(&row, "number_density_m3"), 1e8, 1e-5));
    assert_eq!(row["wavelength_nm"], 905.0);
    assert!(row["altitude_m"].is_null());
    // O'Connor et al. 2004: 18.8 ± 0.8 sr for water clouds at 905 nm.
    assert!((17.5..20.5).contains(&number(&row, "lidar_ratio_sr")), "{row}");
}

#[test]
fn a_measured_spectrum_is_read() {
    let dir = folder("");
    write(dir.path(), "s.csv", "lower_um,upper_um,number_1_cm3\n4,6,20\n6,10,30\n10,20,5\n");
    let args = ["optics", "--distribution", "s.csv", "--wavelength", "550", "--json"];
    let row = json(&run(&args, dir.path()).ok().stdout);
    assert!(close(number(&row, "number_density_m3"), 55e6, 1e-9));
    write(dir.path(), "bad.csv", "lower_um,upper_um,number_1_cm3\n4,6,many\n");
    let bad = run(&["optics", "--distribution", "bad.csv", "--wavelength", "550"], dir.path());
    assert!(
        bad.code == Some(2) && bad.stderr.contains("bad.csv:2") && bad.stderr.contains("many"),
        "{}",
        bad.stderr
    );
}

#[test]
fn visibility_scales_the_number_of_droplets() {
    let args =
        ["--model", "advection", "--height", "180", "--altitude", "60", "2", "--wavelength", "550", "--json"];
    let scaled = optics(&[&args[..], &["--mor", "300"]].concat()).ok().stdout;
    let plain = optics(&args).ok().stdout;
    let rows = |text: &str| text.lines().map(json).collect::<Vec<_>>();
    let (scaled, plain) = (rows(&scaled), rows(&plain));
    assert!(close(number(&scaled[0], "mor_m"), 300.0, 1e-9));
    let factor = |i: usize| number(&scaled[i], "number_density_m3") / number(&plain[i], "number_density_m3");
    assert!(close(factor(0), factor(1), 1e-9) && (factor(0) - 1.0).abs() > 0.1);
}

#[test]
fn extrapolation_is_warned_of() {
    for (height, warned) in [("99", true), ("100", false), ("260", false), ("300", true)] {
        let args =
            ["--model", "advection", "--height", height, "--altitude", "2", "--wavelength", "550", "--csv"];
        let run = optics(&args);
        assert_eq!(run.code, Some(0), "{}", run.stderr);
        assert_eq!(
            run.stderr.contains("extrapolation: the model was fitted to layers of 100 to 260 m"),
            warned
        );
        assert_eq!(run.stdout.lines().count(), 2);
    }
}

#[test]
fn mistakes_name_value_unit_and_range() {
    let layer = |height: &'static str, altitude: &'static str| {
        vec!["--model", "advection", "--height", height, "--altitude", altitude, "--wavelength", "550"]
    };
    let gamma = |more: &[&'static str]| {
        [&["--distribution", "gamma:6,0.12", "--wavelength", "550"][..], more].concat()
    };
    for (args, expected) in [
        (layer("0", "2"), "fog height_m is 0; valid: 1 to 2000"),
        (layer("-10", "2"), "fog height_m is -10; valid: 1 to 2000"),
        (layer("5000", "2"), "fog height_m is 5000; valid: 1 to 2000"),
        (layer("180", "181"), "altitude_m in the fog is 181; valid: 0 to 180"),
        (layer("180", "-1"), "altitude_m in the fog is -1; valid: 0 to 180"),
        (layer("nan", "2"), "expected a finite number"),
        (layer("180", "two"), "expected a finite number"),
        (vec!["--model", "advection", "--altitude", "2", "--wavelength", "550"], "--height"),
        (vec!["--model", "advection", "--height", "180", "--wavelength", "550"], "needs --altitude"),
        (vec!["--model", "advection", "--height", "180", "--altitude", "2"], "--wavelength"),
        (vec!["--model", "smoke", "--height", "180", "--wavelength", "550"], "possible values: advection"),
        (
            vec!["--distribution", "gamma:6,0.12", "--number", "1e8", "--wavelength", "100"],
            "wavelength_nm is 100; valid: 200 to ",
        ),
        (gamma(&[]), "needs an amount"),
        (gamma(&["--number", "-5"]), "number density (1/m³) is -5; valid: 1 to "),
        (gamma(&["--lwc", "0"]), "liquid water content (g/m³) is 0"),
        (gamma(&["--number", "1e8", "--lwc", "0.1"]), "one of --number"),
        (vec!["--distribution", "gamma:6", "--number", "1e8", "--wavelength", "550"], "expected two numbers"),
        (
            vec!["--distribution", "gamma:6,0.9", "--number", "1e8", "--wavelength", "550"],
            "effective_variance is 0.9",
        ),
        (vec!["--distribution", "london", "--wavelength", "550"], "shettle_fenn_radiation_heavy"),
        (vec!["--distribution", "none.csv", "--wavelength", "550"], "cannot read none.csv"),
        (vec!["--mor", "100", "--wavelength", "550"], "says nothing of the droplets"),
        (vec!["--lwc", "0.1", "--wavelength", "550"], "does not fix a fog"),
        (vec!["--lwc", "10", "--number", "1e6", "--wavelength", "550"], "within 0.8 to 60"),
        (vec!["--wavelength", "550"], "which fog?"),
    ] {
        let run = optics(&args);
        assert_eq!(run.code, Some(2), "{args:?}\n{}{}", run.stdout, run.stderr);
        assert!(run.stderr.contains(expected), "{args:?}\n{}", run.stderr);
        assert_eq!(run.stdout, "", "{args:?}");
    }
}
