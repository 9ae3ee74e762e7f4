//! Exposure, the sensor's raw picture and its development.

use crate::common::{folder, ids, read_json, sweep};
use fogbank::dataset::{Channel, read_exr_channels, read_picture};
use fogbank::film::srgb8;
use std::collections::BTreeMap;
use std::path::Path;

/// Channels of `<id>.hdr.exr` in `out`.
fn hdr(dir: &Path, id: &str) -> BTreeMap<String, Channel> {
    read_exr_channels(&dir.join(format!("out/{id}.hdr.exr"))).expect("hdr")
}

fn luminance(channels: &BTreeMap<String, Channel>) -> Vec<f64> {
    let at = |c: &str, i: usize| f64::from(channels[c].values[i]);
    (0..channels["R"].values.len())
        .map(|i| 0.2126 * at("R", i) + 0.7152 * at("G", i) + 0.0722 * at("B", i))
        .collect()
}

#[test]
fn automatic_exposure_is_recorded_and_shown() {
    let dir = folder(
        "fog: {model: homogeneous, height_m: 60, sigma_t_1_m: 0.05, phase: {hg: 0.8}}\noutputs: [image, hdr]\n\
         sweep: {axes: {sensor.exposure: [auto, {percentile: 0.5, target: 0.18}, 0.25]}}\n",
    );
    sweep(dir.path(), "out").ok();
    let ids = ids(dir.path());
    let out = dir.path().join("out");
    for (k, (percentile, target)) in [(0.99, 0.8), (0.5, 0.18)].into_iter().enumerate() {
        let record = read_json(&out.join(format!("{}.json", ids[k])));
        let exposure = record["sensor"]["exposure"].as_f64().expect("a number");
        assert_eq!(record["sensor"]["exposure_from"]["target"], target);
        let channels = hdr(dir.path(), &ids[k]);
        let mut y = luminance(&channels);
        y.sort_by(f64::total_cmp);
        let rank = percentile * (y.len() - 1) as f64;
        let below = y[rank as usize];
        let above = y[(rank as usize + 1).min(y.len() - 1)];
        let want = target / (below + (above - below) * (rank - (rank as usize) as f64));
        assert!((exposure / want - 1.0).abs() < 1e-6, "{exposure} {want}");
        // What the picture shows, and what comparisons read.
        let exr = read_picture(&out.join(format!("{}.hdr.exr", ids[k]))).expect("hdr");
        assert_eq!(exr.scale, fogbank::film::Scale::Radiance { exposure: exposure as f32 });
        let png = read_picture(&out.join(format!("{}.rgb.png", ids[k]))).expect("png");
        for (i, rgb) in png.rgb.iter().enumerate() {
            for (c, name) in ["R", "G", "B"].iter().enumerate() {
                assert_eq!(srgb8(rgb[c]), srgb8(channels[*name].values[i] * exposure as f32));
            }
        }
    }
    let record = read_json(&out.join(format!("{}.json", ids[2])));
    assert_eq!(record["sensor"]["exposure"], 0.25);
    assert_eq!(record["sensor"].get("exposure_from"), None);
}

#[test]
fn a_photographers_exposure_knows_the_unit_of_radiance() {
    let dir = folder(
        "fog: none\noutputs: [image]\nsensor: {exposure: {iso: 100, shutter_s: 0.01, f_number: 4}}\n\
         sweep: {axes: {lighting: [night, {scene_emitters: true, luminance_of_one_cd_m2: 50}]}}\n",
    );
    let config = std::fs::read_to_string(dir.path().join("c.yaml")).expect("config");
    // One section `sensor` only.
    let config = config.replace("sensor: {width_px: 24, height_px: 14, horizontal_fov_deg: 60}\n", "");
    let config = config.replace("sensor: {exposure", "sensor: {width_px: 24, height_px: 14, exposure");
    std::fs::write(dir.path().join("c.yaml"), config).expect("write");
    sweep(dir.path(), "out").ok();
    let ids = ids(dir.path());
    // Saturation: 78 / 100 lx·s = L · π/4 · 0.9 · 0.01 s / 16.
    let saturation = 0.78 * 16.0 / (std::f64::consts::FRAC_PI_4 * 0.9 * 0.01);
    for (id, one) in ids.iter().zip([1.0, 50.0]) {
        let record = read_json(&dir.path().join(format!("out/{id}.json")));
        let exposure = record["sensor"]["exposure"].as_f64().expect("a number");
        assert!((exposure / (one / saturation) - 1.0).abs() < 1e-12, "{exposure}");
        let from = &record["sensor"]["exposure_from"];
        assert_eq!(from["iso"], 100.0);
        assert!(
            (from["saturation_luminance_cd_m2"].as_f64().expect("a number") / saturation - 1.0).abs() < 1e-12
        );
    }
}
