//! Patchy fog.

use crate::common::{cache, folder, ids, json, read_json, run, sweep};
use fogbank::dataset::read_exr_channels;

const FOG: &str = "fog: {model: homogeneous, height_m: 40, sigma_t_1_m: 0.03, phase: {hg: 0.8}, \
                   patchiness: {density_sd: 0.8, top_sd_m: 3, length_m: 60, octaves: 2}}\n\
                   sweep: {axes: {fog.patchiness.seed: [1, 2]}}\n";

#[test]
fn seeds_of_patches_are_frames_and_paths_are_told() {
    let dir = folder(FOG);
    sweep(dir.path(), "out");
    let ids = ids(dir.path());
    let record = |k: usize| read_json(&dir.path().join(format!("out/{}.json", ids[k])));
    let (one, two) = (record(0), record(1));
    assert_eq!(one["pair_id"], two["pair_id"]);
    assert_eq!(one["fog"]["patchiness"]["seed"], 1);
    assert_eq!(one["fog"]["patchiness"]["length_m"], 60.0);
    let over = |record: &serde_json::Value| record["fog_state"]["patchiness"]["over_camera"].clone();
    assert_ne!(over(&one), over(&two));
    assert!(over(&one)["density_factor"].as_f64().expect("a factor") > 0.0);
    assert!((over(&one)["top_m"].as_f64().expect("an altitude") - 40.0).abs() < 20.0);

    let channels = |k: usize| {
        let exr = |kind: &str| dir.path().join(format!("out/{}.{kind}.exr", ids[k]));
        (read_exr_channels(&exr("hdr")).expect("hdr"), read_exr_channels(&exr("gt")).expect("gt"))
    };
    let ((hdr, truth), (_, other)) = (channels(0), channels(1));
    assert_ne!(truth["tau.Y"].values, other["tau.Y"].values, "other patches, other depths");
    for i in 0..24 * 14 {
        let (tau, transmittance) = (truth["tau.Y"].values[i], truth["transmittance.G"].values[i]);
        assert!((transmittance - fog_core::math::f32::exp(-tau)).abs() < 1e-5, "pixel {i}");
        let sum = hdr["direct.G"].values[i] + hdr["airlight.G"].values[i];
        assert!((hdr["G"].values[i] - sum).abs() <= 1e-6 * sum.abs(), "pixel {i}");
    }

    let path =
        ["replay", "c.yaml", "--frame", &ids[0], "--pixel", "12,3", "--sample", "1", "--cache-dir", &cache()];
    let told = json(&run(&[&path[..], &["--json"]].concat(), dir.path()).ok().stdout);
    assert_eq!(told["steps"][0]["step"], "flight");
    let words = run(&path, dir.path()).ok().stdout;
    assert!(words.contains(&format!("frame {}, pixel 12,3, sample 1", ids[0])), "{words}");
}
