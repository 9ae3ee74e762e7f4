//! `model: droplets`: spectra of the literature, formulas and measured ones, with vertical profiles.

use crate::common::{Run, folder, ids, names, read_json, run, write};
use serde_json::Value;
use std::path::Path;

/// A sweep with a table cache of its own: other tests count the tables of the shared one.
fn sweep(dir: &Path, out: &str) -> Run {
    run(&["sweep", "c.yaml", "--out", out, "--cache-dir", "own"], dir)
}

fn refused(dir: &Path, words: &[&str]) {
    let run = sweep(dir, "out");
    assert_eq!(run.code, Some(2), "{}", run.stderr);
    for word in words {
        assert!(run.stderr.contains(word), "`{word}` is not in {}", run.stderr);
    }
}

fn states(dir: &Path) -> Vec<Value> {
    ids(dir).iter().map(|id| read_json(&dir.join(format!("out/{id}.json")))["fog_state"].clone()).collect()
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value}"))
}

#[test]
fn a_sweep_over_spectra_records_its_droplets() {
    let dir = folder(
        "outputs: [image, tau]\ncamera: {altitude_m: 0}\nsweep: {axes: {fog: [\
         {model: droplets, height_m: 60, droplets: shettle_fenn_radiation_heavy}, \
         {model: droplets, height_m: 60, droplets: shettle_fenn_radiation_heavy, vertical: {thinning: 1}}, \
         {model: droplets, height_m: 60, droplets: {gamma: {effective_radius_um: 3, effective_variance: 0.1}}, \
          visibility: {mor_m: 200, altitude_m: 0}, phase: {hg: 0.8}}, \
         {model: droplets, height_m: 60, droplets: {file: measured.csv}, vertical: {file: vertical.csv}}, \
         {model: droplets, height_m: 60, droplets: {gamma: {effective_radius_um: 3, effective_variance: 0.1}}, \
          number_density_1_m3: 5e7, vertical: advection, phase: mie_mean_diameter}]}}\n",
    );
    let spectrum = "lower_um,upper_um,number_1_cm3\n2,4,30\n4,8,50\n8,14,20\n";
    write(dir.path(), "measured.csv", spectrum);
    let vertical = "relative_altitude,relative_number_density\n0,1\n0.5,3\n1,0\n";
    write(dir.path(), "vertical.csv", vertical);
    let said = sweep(dir.path(), "out").ok().stdout;
    assert!(said.contains("advection fog of [60.0] m is an extrapolation"), "{said}");
    let states = states(dir.path());

    // Shettle & Fenn's model 3: 100 droplets per cm³, effective radius 6 µm, 16.6 1/km.
    let [even, thinning, gamma, measured, advection] = &states[..] else { panic!("{states:?}") };
    let base = &even["at_camera"];
    assert!((number(&base["sigma_t_1_m"]) / 0.01664 - 1.0).abs() < 2e-3, "{base}");
    assert!((number(&base["number_density_1_m3"]) / 1e8 - 1.0).abs() < 1e-4, "{base}");
    assert!((number(&base["liquid_water_content_g_m3"]) / 0.0626 - 1.0).abs() < 2e-3, "{base}");
    assert!((number(&base["effective_radius_um"]) - 6.0).abs() < 1e-3, "{base}");
    assert_eq!(base["sigma_t_1_m"], even["at_top"]["sigma_t_1_m"]);
    let droplets = &even["droplets"];
    assert!(droplets["source"].as_str().unwrap().contains("Shettle & Fenn 1979"), "{droplets}");
    assert!((number(&droplets["share_in_range"]) - 1.0).abs() < 1e-4, "{droplets}");
    assert_eq!(droplets["mean_number_density_1_m3"], 1e8);

    // The same mean, twice as dense at the ground and clear at the top.
    let ratio = number(&thinning["at_camera"]["sigma_t_1_m"]) / number(&base["sigma_t_1_m"]);
    assert!((ratio - 2.0).abs() < 1e-5, "{ratio}");
    assert_eq!(thinning["at_top"]["sigma_t_1_m"], 0.0);

    // The visibility fixes the number of droplets; the phase function's g is its own.
    assert!((number(&gamma["at_camera"]["mor_m"]) / 200.0 - 1.0).abs() < 1e-9, "{gamma}");
    assert!(number(&gamma["at_camera"]["number_density_1_m3"]) > 1e7);
    assert_eq!(gamma["at_camera"]["g"], 0.8);

    assert_eq!(measured["droplets"]["source"], "measured.csv");
    assert_eq!(measured["droplets"]["mean_number_density_1_m3"], 1e8);
    let n = number(&measured["at_base"]["number_density_1_m3"]);
    assert!((n / (1e8 / 1.75) - 1.0).abs() < 1e-4, "{n}");

    // The advection model's numbers by altitude, with the mean asked for; 60 m is below what was measured.
    assert_eq!(advection["droplets"]["mean_number_density_1_m3"], 5e7);
    let [base, top] = ["at_base", "at_top"].map(|place| number(&advection[place]["number_density_1_m3"]));
    assert!(base > 0.0 && base < 5e7 && top > 0.0 && top != base, "{base} {top}");
    let g = number(&advection["at_camera"]["g"]);
    assert!((0.7..0.9).contains(&g) && g != number(&gamma["at_base"]["g"]), "{g}");

    // One table per spectrum, found again by the next sweep, which makes the same bytes.
    let tables = || -> Vec<String> {
        names(&dir.path().join("own")).into_iter().filter(|n| n.ends_with(".fogtable")).collect()
    };
    let before = tables();
    assert!(before.len() == 3 && before.iter().all(|n| n.starts_with("droplets-")), "{before:?}");
    let said = sweep(dir.path(), "again").ok().stdout;
    assert!(!said.contains("built in"), "{said}");
    assert_eq!(tables(), before);
    crate::common::assert_same(&dir.path().join("out"), &dir.path().join("again"));
}

#[test]
fn mistakes_name_their_place() {
    let fog = |keys: &str| folder(&format!("fog: {{model: droplets, height_m: 60, {keys}}}\n"));
    let dir = fog("droplets: shettle_fenn_radiation_heavi");
    refused(dir.path(), &["fog.droplets: unknown value", "did you mean `shettle_fenn_radiation_heavy`?"]);
    let dir = fog("droplets: {gamma: {effective_radius_um: 5, effective_variance: 0.1}}");
    refused(dir.path(), &["fog.number_density_1_m3: missing", "fog.visibility"]);

    let dir = fog("droplets: {file: s.csv}");
    refused(dir.path(), &["cannot read s.csv"]);
    write(dir.path(), "s.csv", "diameter_um,density_1_um\n1,0\n5,many\n");
    refused(dir.path(), &["s.csv:3: column `density_1_um`: found `many`; expected a finite number"]);
    write(dir.path(), "s.csv", "diameter_um,density_1_um\n5,0\n1,1\n");
    refused(dir.path(), &["s.csv:3: column `diameter_um`: found 1; expected more than in the row before"]);
    write(dir.path(), "s.csv", "diameter_um,density_1_um\n1,0\n1.5,1\n2,0\n");
    refused(dir.path(), &["s.csv says nothing about the number of droplets", "fog.number_density_1_m3"]);
}
