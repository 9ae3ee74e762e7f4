//! Groups of lights.

use crate::common::{cache, config, folder, ids, json, read_json, run, sweep, write};
use fogbank::dataset::read_exr_channels;

/// Two lamps over nothing, in fog.
const LAMPS: &str = r#"{"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1]}],
  "extensionsUsed": ["KHR_lights_punctual"],
  "extensions": {"KHR_lights_punctual": {"lights": [{"type": "point", "intensity": 100},
    {"type": "point", "intensity": 100, "color": [1, 0.2, 0.1]}]}},
  "nodes": [{"name": "left lamp", "translation": [-4, 3, -15], "extensions": {"KHR_lights_punctual": {"light": 0}}},
    {"name": "right lamp", "translation": [4, 3, -15], "extensions": {"KHR_lights_punctual": {"light": 1}}}]}"#;

const LINES: &str = "scene: {file: lamps.gltf}\n\
    fog: {model: homogeneous, height_m: 50, sigma_t_1_m: 0.02, phase: {hg: 0.8}}\n\
    camera: {altitude_m: 2}\noutputs: [hdr, direct, airlight]\n\
    lighting: {environment: {radiance: 0.01}, groups: [{name: left, lights: [\"node:left*\"]}, \
    {name: sky, lights: [environment, sun]}]}\n";

fn channels(dir: &std::path::Path, id: &str) -> std::collections::BTreeMap<String, Vec<f32>> {
    let file = dir.join(format!("out/{id}.hdr.exr"));
    let channels = read_exr_channels(&file).expect("a readable file");
    channels.into_iter().map(|(name, channel)| (name, channel.values)).collect()
}

#[test]
fn groups_add_up_to_the_image() {
    let dir = tempfile::tempdir().expect("temporary folder");
    write(dir.path(), "lamps.gltf", LAMPS);
    write(
        dir.path(),
        "c.yaml",
        config(&format!("{LINES}sweep: {{axes: {{lighting.groups.0.intensity: [1, 0]}}}}\n"))
            .replace("samples: 3", "samples: 32"),
    );
    sweep(dir.path(), "out").ok();
    let ids = ids(dir.path());
    let lit = channels(dir.path(), &ids[0]);
    let names: Vec<&str> = lit.keys().map(String::as_str).filter(|name| name.starts_with("group.")).collect();
    let of = |group: &str| ["B", "G", "R"].map(|c| format!("group.{group}.{c}"));
    assert_eq!(names, [of("left"), of("rest"), of("sky")].concat());
    for c in ["R", "G", "B"] {
        for i in 0..lit[c].len() {
            let parts = ["left", "sky", "rest"].map(|group| lit[&format!("group.{group}.{c}")][i]);
            let (sum, image) = (parts.iter().sum::<f32>(), lit[c][i]);
            let size = parts.iter().map(|v| v.abs()).sum::<f32>();
            assert!((sum - image).abs() <= 1e-5 * size, "pixel {i}: {parts:?} for {image}");
        }
    }
    // The left lamp lights the left half more, the right one, which is red, the right half.
    let half = |name: &str, right: bool| {
        let inside = |i: &usize| (i % 24 >= 12) == right;
        (0..24 * 14).filter(inside).map(|i| f64::from(lit[name][i])).sum::<f64>()
    };
    assert!(half("group.left.G", false) > 2.0 * half("group.left.G", true));
    assert!(half("group.rest.R", true) > 2.0 * half("group.rest.R", false));
    let record = |k: usize| read_json(&dir.path().join(format!("out/{}.json", ids[k])));
    assert_eq!(record(0)["lighting"]["lights_in_group"], json(r#"{"left": 1, "sky": 1, "rest": 1}"#));
    assert_eq!(record(1)["lighting"]["lights_in_group"], json(r#"{"left": 0, "sky": 1, "rest": 1}"#));
    assert!(channels(dir.path(), &ids[1])["group.left.G"].iter().all(|&v| v == 0.0));
}

#[test]
fn names_that_fit_nothing_are_told() {
    let dir = folder(
        "fog: none\noutputs: [image]\n\
         sweep: {axes: {lighting: [{groups: [{name: signs, lights: [\"material:sign*\", emitters]}]}]}}\n",
    );
    let args = ["sweep", "c.yaml", "--out", "out", "--cache-dir", &cache()];
    let out = run(&args, dir.path());
    assert_eq!(out.code, Some(0), "{}", out.stderr);
    let said = format!("{}{}", out.stdout, out.stderr);
    assert!(said.contains("has nothing like \"material:sign*\" of group `signs`"), "{said}");
    let files = crate::common::names(&dir.path().join("out"));
    assert!(files.iter().any(|f| f.ends_with(".hdr.exr")), "{files:?}");
}
