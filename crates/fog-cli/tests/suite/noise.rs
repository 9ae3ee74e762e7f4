//! Sampling until the noise is low.

use crate::common::{assert_same, cache, folder, ids, read_json, run, sweep};
use fogbank::dataset::read_exr_channels;

const NOISE: &str = "outputs: [image, hdr, standard_error, samples]\n\
    fog: {model: homogeneous, height_m: 50, sigma_t_1_m: 0.02, phase: {hg: 0.8}}\n";
const SETS: [&str; 6] =
    ["--set", "render.samples=16", "--set", "render.noise=0.1", "--set", "render.max_samples=200"];

#[test]
fn samples_go_where_the_noise_is() {
    let dir = folder(NOISE);
    for threads in ["1", "3"] {
        let args = ["sweep", "c.yaml", "--out", threads, "--threads", threads, "--cache-dir", &cache()];
        let said = run(&[&args[..], &SETS].concat(), dir.path()).ok().stdout;
        assert!(said.contains("at least") && said.contains("at most 0.1 million"), "{said}");
    }
    assert_same(&dir.path().join("1"), &dir.path().join("3"));

    let plan = run(&[&["plan", "c.yaml", "--json"], &SETS[..]].concat(), dir.path()).ok().stdout;
    let spec = crate::common::json(&plan);
    assert_eq!((&spec["render"]["noise"], &spec["render"]["max_samples"]), (&0.1.into(), &200.into()));
    let id = spec["id"].as_str().expect("id");
    let channels = read_exr_channels(&dir.path().join(format!("1/{id}.hdr.exr"))).expect("a readable file");
    let (counts, errors) = (&channels["samples.Y"].values, &channels["standard_error.Y"].values);
    let record = read_json(&dir.path().join(format!("1/{id}.json")));
    let noise = &record["noise"];
    let number = |value: &serde_json::Value| value.as_f64().unwrap_or_else(|| panic!("{noise}"));
    let floor = number(&noise["pixels"]["floor_luminance"]);
    let mut within = 0;
    for i in 0..counts.len() {
        let [r, g, b] = ["R", "G", "B"].map(|c| f64::from(channels[c].values[i]));
        let luminance = fog_core::colour::luminance([r, g, b]);
        let relative = f64::from(errors[i]) / luminance.max(floor);
        assert!(relative <= 0.1001 || counts[i] == 200.0, "pixel {i}: {relative} after {}", counts[i]);
        within += u32::from(relative <= 0.1 * (1.0 + 1e-6));
    }
    let (least, most) = counts.iter().fold((f32::MAX, 0.0f32), |(l, m), &n| (l.min(n), m.max(n)));
    let mean = counts.iter().map(|&n| f64::from(n)).sum::<f64>() / counts.len() as f64;
    assert!(least < 0.7 * most, "all pixels took about {mean} samples");
    assert_eq!(
        (&noise["samples_least"], &noise["samples_most"]),
        (&(least as u64).into(), &(most as u64).into())
    );
    assert!((number(&noise["samples_per_pixel"]) - mean).abs() < 1e-9, "{noise}");
    assert_eq!(number(&noise["pixels"]["target"]), 0.1);
    assert!(
        (number(&noise["pixels"]["share_within_target"]) - f64::from(within) / counts.len() as f64).abs()
            < 1e-9
    );
}

#[test]
fn a_fixed_number_is_recorded_as_before() {
    let dir = folder(NOISE);
    sweep(dir.path(), "out").ok();
    let id = &ids(dir.path())[0];
    let record = read_json(&dir.path().join(format!("out/{id}.json")));
    assert_eq!(record["noise"]["samples_per_pixel"], 3);
    for key in ["noise", "max_samples"] {
        assert!(record["render"].get(key).is_none() && record["noise"].get("pixels").is_none(), "{record}");
    }
    let channels = read_exr_channels(&dir.path().join(format!("out/{id}.hdr.exr"))).expect("a readable file");
    assert!(channels["samples.Y"].values.iter().all(|&n| n == 3.0));
}
