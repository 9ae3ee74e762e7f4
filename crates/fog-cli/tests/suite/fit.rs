//! `fogbank fit`: from synthetic counts to a model and its report.

use crate::common::{names, repository, run, write};
use std::fs;

const HEAD: &str = "fog_height_m,altitude_m,diameter_low_um,diameter_high_um,count,sample_volume_m3\n";

#[test]
fn flights_become_a_model_and_a_report() {
    let dir = tempfile::tempdir().unwrap();
    let said = run(&["fit", "synthetic", "--out", "flights.csv"], dir.path()).ok().stdout;
    assert_eq!(said, "flights.csv: 1620 rows of counts\n");
    let said =
        run(&["fit", "flights.csv", "--out", "model.yaml", "--report", "a/report"], dir.path()).ok().stdout;
    assert!(said.contains("flights.csv: fog of 100, 180, 260 m, 54 altitudes"), "{said}");
    assert!(said.contains("model: model.yaml") && said.contains("report: a/report/report.md"), "{said}");
    assert!(said.contains("mu_G         degree 1"), "{said}");
    let report = dir.path().join("a/report");
    let figures = ["number_density", "parameters", "spectra_100", "spectra_180", "spectra_260"];
    let mut files: Vec<String> =
        figures.iter().flat_map(|f| [format!("{f}.png"), format!("{f}.svg")]).collect();
    files.extend(["fits.csv", "parameters.csv", "report.md", "spectra.csv"].map(str::to_owned));
    files.sort();
    assert_eq!(names(&report), files);
    let text = fs::read_to_string(report.join("report.md")).unwrap();
    assert!(text.starts_with("# Fog model fitted to flights.csv\n") && text.contains("## Rules"), "{text}");
    assert!(figures.iter().all(|f| text.contains(&format!("({f}.png)"))), "{text}");

    // The same bytes again, by one thread.
    let mut again =
        crate::common::command(&["fit", "flights.csv", "--out", "again.yaml", "--quiet"], dir.path());
    let output = again.env("RAYON_NUM_THREADS", "1").output().unwrap();
    assert!(output.status.success() && output.stdout.is_empty() && output.stderr.is_empty());
    let model = fs::read(dir.path().join("model.yaml")).unwrap();
    assert!(fs::read(dir.path().join("again.yaml")).unwrap() == model);

    // The model can be flown through itself.
    let args = [
        "fit",
        "synthetic",
        "--model",
        "model.yaml",
        "--heights-m",
        "150",
        "--bins",
        "2,20,2",
        "--out",
        "b.csv",
    ];
    let said = run(&[&args[..], &["--approaches", "1", "--seed", "3"]].concat(), dir.path()).ok().stdout;
    assert_eq!(said, "b.csv: 135 rows of counts\n");
    let said = run(&["fit", "b.csv", "--out", "b.yaml", "--staged"], dir.path()).ok().stdout;
    assert!(said.contains("warning: only one fog height (150 m) was measured"), "{said}");
}

#[test]
fn shipped_model_gives_the_shipped_form() {
    let dir = tempfile::tempdir().unwrap();
    run(&["fit", "synthetic", "--out", "f.csv", "--altitude-step-m", "20"], dir.path()).ok();
    run(&["fit", "f.csv", "--out", "m.yaml", "-q"], dir.path()).ok();
    let keys = |text: &str| -> Vec<String> {
        let key = |line: &str| line.split(':').next().map(str::to_owned);
        text.lines().filter(|line| !line.starts_with(['#', ' '])).filter_map(key).collect()
    };
    let ours = fs::read_to_string(dir.path().join("m.yaml")).unwrap();
    let shipped = fs::read_to_string(repository("tables/advection/arcata.yaml")).unwrap();
    assert_eq!(keys(&ours), keys(&shipped));
}

#[test]
fn mistakes_are_explained() {
    let dir = tempfile::tempdir().unwrap();
    write(dir.path(), "text.csv", format!("{HEAD}100,50,2,5,many,1e-4\n"));
    write(dir.path(), "top.csv", format!("{HEAD}100,150,2,5,3,1e-4\n"));
    write(dir.path(), "value.csv", "fog_height_m,altitude_m,diameter_low_um,diameter_high_um\n100,5,2,5\n");
    write(dir.path(), "few.csv", format!("{HEAD}100,50,2,5,3,1e-4\n"));
    write(dir.path(), "bad.yaml", "mu_L: [1]\n");
    let refuse = |args: &[&str], what: &str| {
        let run = run(args, dir.path());
        assert_eq!(run.code, Some(2), "{args:?}: {}", run.stdout);
        assert!(run.stderr.contains(what), "{args:?}: {}", run.stderr);
        assert!(!dir.path().join("m.yaml").exists(), "{args:?}");
    };
    let fit = |file| vec!["fit", file, "--out", "m.yaml"];
    refuse(&fit("text.csv"), "fogbank: text.csv:2: column `count`: found `many`; expected a finite number");
    refuse(&fit("top.csv"), "fogbank: top.csv:2: column `altitude_m`: found 150; expected 0 to 100 m");
    refuse(&fit("value.csv"), "value.csv:1: column `count`: found 0 columns of values");
    refuse(&fit("few.csv"), "few.csv: too few bins: at most 1 at an altitude");
    refuse(&fit("none.csv"), "cannot read none.csv");
    refuse(&["fit", "few.csv"], "--out <MODEL.yaml>");
    refuse(&["fit", "few.csv", "--out", "few.csv"], "would overwrite the measurements");
    refuse(&[&fit("few.csv")[..], &["--diameter-range-um", "1"]].concat(), "needs LOW,HIGH");
    let synthetic = |more: &[&'static str]| [&["fit", "synthetic", "--out", "m.yaml"], more].concat();
    refuse(&synthetic(&["--bins", "3,2,1"]), "--bins 3,2,1: expected a width");
    refuse(&synthetic(&["--bins", "3,2"]), "--bins needs LOW,HIGH,WIDTH");
    refuse(&synthetic(&["--heights-m", "0"]), "fog height_m is 0");
    refuse(&synthetic(&["--sample-volume-cm3", "0"]), "sample volume in m³ is 0");
    refuse(&synthetic(&["--altitude-step-m", "500"]), "altitude step in m is 500");
    refuse(&synthetic(&["--model", "bad.yaml"]), "bad.yaml");
    refuse(&synthetic(&["--model", "none.yaml"]), "cannot read none.yaml");
}

#[test]
fn help_teaches_the_format() {
    let dir = tempfile::tempdir().unwrap();
    let help = run(&["fit", "--help"], dir.path()).ok().stdout;
    for part in [
        "fog_height_m,altitude_m,diameter_low_um,diameter_high_um,count",
        "density_1_m3_um",
        "fogbank fit synthetic",
    ] {
        assert!(help.contains(part), "{help}");
    }
}
