//! `fog.visibility`: the fog that is seen as far as was asked for.

use crate::common::{folder, ids, read_json, sweep};
use fog_core::math;

#[test]
fn visibility_is_met_where_it_was_asked_for() {
    let visibility = "visibility: {mor_m: 300, altitude_m: 2}";
    let dir = folder(&format!(
        "camera: {{altitude_m: 2}}\noutputs: [tau]\nsweep: {{axes: {{fog: [\
         {{model: advection, height_m: 100}}, {{model: advection, height_m: 100, {visibility}}}, \
         {{model: homogeneous, height_m: 60, sigma_t_1_m: 0.1, phase: {{hg: 0.8}}, {visibility}}}]}}}}\n"
    ));
    sweep(dir.path(), "out").ok();
    let states: Vec<_> = ids(dir.path())
        .iter()
        .map(|id| read_json(&dir.path().join(format!("out/{id}.json")))["fog_state"]["at_camera"].clone())
        .collect();
    let number =
        |i: usize, key: &str| states[i][key].as_f64().unwrap_or_else(|| panic!("{key}: {}", states[i]));
    for i in [1, 2] {
        assert!((number(i, "mor_m") / 300.0 - 1.0).abs() < 1e-6, "{}", states[i]);
        assert!((number(i, "sigma_t_1_m") * 300.0 / math::f64::ln(20.0) - 1.0).abs() < 1e-6, "{}", states[i]);
    }
    // The number of droplets is scaled, not the droplets.
    let factor = number(1, "sigma_t_1_m") / number(0, "sigma_t_1_m");
    assert!((factor - 1.0).abs() > 0.01, "the layer is not by chance as asked for");
    for key in ["number_density_1_m3", "liquid_water_content_g_m3"] {
        assert!((number(1, key) / number(0, key) / factor - 1.0).abs() < 1e-6, "{key}");
    }
    assert_eq!(states[1]["effective_radius_um"], states[0]["effective_radius_um"]);
}
