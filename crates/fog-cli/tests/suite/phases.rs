//! Phase functions, coefficients and sampling of a configuration: they render, and are recorded.

use crate::common::{folder, ids, read_json, sweep};
use serde_json::{Value, json};

/// Records of one small frame per fog.
fn records(fogs: &[&str]) -> Vec<Value> {
    let dir = folder(&format!("outputs: [image, tau]\nsweep: {{axes: {{fog: [{}]}}}}\n", fogs.join(", ")));
    sweep(dir.path(), "out").ok();
    ids(dir.path()).iter().map(|id| read_json(&dir.path().join(format!("out/{id}.json")))).collect()
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value} is no number"))
}

#[test]
fn every_phase_function_is_recorded() {
    let records = records(&[
        "{model: advection, height_m: 100}",
        "{model: advection, height_m: 100, sampling: diameter}",
        "{model: advection, height_m: 100, phase: {hg: 0.83}}",
        "{model: advection, height_m: 100, phase: {hg: layer}}",
        "{model: advection, height_m: 100, phase: mie_mean_diameter}",
        "{model: advection, height_m: 100, phase: jendersie_deon}",
        "{model: advection, height_m: 100, phase: {jendersie_deon: {diameter_um: 12}}}",
    ]);
    let phases: Vec<&Value> = records.iter().map(|r| &r["fog_state"]["phase"]).collect();
    assert_eq!(phases[0], &json!({"kind": "mie", "sampling": "table"}));
    assert_eq!(phases[1], &json!({"kind": "mie", "sampling": "diameter"}));
    assert_eq!(phases[2], &json!({"kind": "henyey_greenstein", "g": 0.83}));
    assert!((0.85..0.87).contains(&number(&phases[3]["g"])), "{}", phases[3]);
    assert_eq!(phases[3]["wavelength_nm"], 550.0);
    // Both know the mean diameter of the layer's droplets.
    assert_eq!(phases[4]["diameter_um"], phases[5]["diameter_um"]);
    assert!((9.0..11.0).contains(&number(&phases[5]["diameter_um"])), "{}", phases[5]);
    assert_eq!(phases[6]["diameter_um"], 12.0);
    assert!((number(&phases[6]["g_hg"]) - 0.990455).abs() < 1e-6, "{}", phases[6]);
    for record in &records[2..] {
        // A phase function of its own gives the fog its g.
        assert_eq!(record["fog_state"]["at_camera"]["g"], record["fog_state"]["phase"]["g"], "{record}");
    }
    assert!(records.iter().all(|r| r["fog_state"]["coefficient"] == "integral"));
}

#[test]
fn the_papers_coefficient_is_smaller_and_named() {
    let records = records(&[
        "{model: advection, height_m: 180}",
        "{model: advection, height_m: 180, coefficient: paper}",
        "{model: advection, height_m: 180, coefficient: paper, visibility: {mor_m: 300, altitude_m: 2}}",
        "{model: homogeneous, height_m: 180, coefficient: paper, phase: {hg: layer}}",
        "{model: linear_gradient, height_m: 180, coefficient: paper, phase: {hg: layer}}",
        "{model: homogeneous, height_m: 180, sigma_t_1_m: 0.01, sampling: diameter}",
        "{model: droplets, height_m: 50, droplets: shettle_fenn_radiation_heavy, coefficient: paper}",
        "{model: droplets, height_m: 50, droplets: shettle_fenn_radiation_heavy, sampling: diameter}",
    ]);
    let state = |i: usize| &records[i]["fog_state"];
    let sigma = |i: usize, place: &str| number(&state(i)[place]["sigma_t_1_m"]);
    let names: Vec<&Value> = (0..records.len()).map(|i| &state(i)["coefficient"]).collect();
    assert_eq!(
        names,
        ["integral", "paper", "paper", "paper", "paper"]
            .map(Value::from)
            .iter()
            .chain([&Value::Null, &json!("paper"), &json!("integral")])
            .collect::<Vec<_>>()
    );
    for place in ["at_base", "at_camera", "at_top"] {
        let ratio = sigma(0, place) / sigma(1, place);
        assert!((15.0..30.0).contains(&ratio), "{place}: {ratio}");
    }
    // A visibility is met by either coefficient; the baselines are made from the paper's layer.
    assert!((number(&state(2)["at_camera"]["mor_m"]) / 300.0 - 1.0).abs() < 1e-6);
    let (even, base, top) = (sigma(3, "at_camera"), sigma(4, "at_base"), sigma(4, "at_top"));
    assert!(base < even && even < top && top < sigma(0, "at_top"), "{base} {even} {top}");
    assert!((base / sigma(1, "at_base") - 1.0).abs() < 0.3, "{base}");
    assert!(sigma(6, "at_camera") < 0.3 * sigma(7, "at_camera"));
    assert_eq!(state(7)["phase"]["sampling"], "diameter");
    // The droplets are the same, whatever they are said to add up to.
    let water = |i: usize| &state(i)["at_camera"]["liquid_water_content_g_m3"];
    assert_eq!(water(0), water(1));
}
