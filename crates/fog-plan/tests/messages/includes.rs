//! Files that include one another, and presets that keys are laid over.

use fog_plan::{EnvironmentSpec, FogModel, Plan, PlanError, SkySpec};
use std::path::Path;

/// A configuration of empty space without fog.
const HEAD: &str = "version: 1\nname: t\nscene: none\nfog: none\n";

fn folder(files: &[(&str, &str)]) -> tempfile::TempDir {
    let dir = tempfile::tempdir().expect("temporary folder");
    for (name, text) in files {
        let path = dir.path().join(name);
        std::fs::create_dir_all(path.parent().expect("a folder")).expect("folder");
        std::fs::write(path, text).expect("write");
    }
    dir
}

fn load(dir: &Path, sets: &[&str]) -> Result<Plan, PlanError> {
    let sets: Vec<String> = sets.iter().map(|s| (*s).to_owned()).collect();
    fog_plan::load(&dir.join("c.yaml"), &sets)
}

/// The messages about `c.yaml`, without the folder.
fn refused(files: &[(&str, &str)]) -> Vec<String> {
    let dir = folder(files);
    let text = load(dir.path(), &[]).expect_err("must be refused").to_string();
    let prefix = format!("{}/", dir.path().display());
    text.lines().map(|line| line.replace(&prefix, "")).collect()
}

#[test]
fn later_and_own_keys_win() {
    let dir = folder(&[
        (
            "c.yaml",
            &format!("{HEAD}include: [a.yaml, b/b.yaml]\ncamera: {{altitude_m: 3}}\noutputs: [tau]\n"),
        ),
        (
            "a.yaml",
            "camera: {altitude_m: 1, heading_deg: 10, pitch_deg: 5}\nname: other\noutputs: [image, hdr]\n",
        ),
        ("b/b.yaml", "include: c.yaml\ncamera: {heading_deg: 20}\n"),
        ("b/c.yaml", "camera: {heading_deg: 30, roll_deg: 7}\nsweep: {axes: {camera.altitude_m: [1, 2]}}\n"),
    ]);
    let plan = load(dir.path(), &["sweep.axes.camera.altitude_m=[4]"]).expect("a plan");
    assert_eq!((plan.name(), plan.len()), ("t", 1));
    let frame = plan.frame(0).expect("a frame");
    let camera = frame.camera;
    assert_eq!(
        (camera.altitude_m, camera.heading_deg, camera.pitch_deg, camera.roll_deg),
        (4.0, 20.0, 5.0, 7.0)
    );
    assert_eq!(frame.outputs, [fog_plan::Output::Tau]);
    // What is stored needs no other file.
    let again = fog_plan::parse(&plan.resolved_yaml(), "config.resolved.yaml", &[]).expect("a plan");
    assert_eq!(again.config_digest(), plan.config_digest());
}

#[test]
fn values_of_included_files_are_named_by_their_place() {
    assert_eq!(
        refused(&[
            ("c.yaml", &format!("{HEAD}include: light/a.yaml\n")),
            ("light/a.yaml", "include:\n  - b.yaml\ncamera:\n  heigth_m: 3\n"),
            (
                "light/b.yaml",
                "\nfog: {model: advection, height_m: -5}\nlighting: {sun: {elevation_deg: 100}}\n"
            ),
        ]),
        [
            "light/a.yaml:4:3: camera.heigth_m: unknown key; expected one of altitude_m, position_m, heading_deg, pitch_deg, \
             roll_deg (included at c.yaml:5:10)",
            "light/b.yaml:3:33: lighting.sun.elevation_deg: 100 deg is out of range; valid: -90 to 90 deg (included at \
             light/a.yaml:2:5, included at c.yaml:5:10)",
            "light/b.yaml:3:17: lighting.sun.azimuth_deg: missing; heading towards the sun in degrees, 0 = -Z, 90 = +X \
             (included at light/a.yaml:2:5, included at c.yaml:5:10)",
            "light/b.yaml:3:17: lighting.sun.irradiance: missing; irradiance on a plane normal to the beam, 0 or more \
             (included at light/a.yaml:2:5, included at c.yaml:5:10)",
        ]
    );
}

#[test]
fn what_cannot_be_included() {
    let all = refused(&[
        (
            "c.yaml",
            &format!("{HEAD}include: [none.yaml, 3, a.yaml, list.yaml, bad.yaml, c.yaml, empty.yaml]\n"),
        ),
        ("a.yaml", "include: b.yaml\n"),
        ("b.yaml", "include: a.yaml\n"),
        ("list.yaml", "[1, 2]\n"),
        ("bad.yaml", "camera: {altitude_m: 2\n"),
        ("empty.yaml", "# nothing\n"),
    ]);
    let begins = [
        "c.yaml:5:11: include: cannot read none.yaml: No such file",
        "c.yaml:5:22: include: expected the path of a file, found 3",
        "b.yaml:1:10: include: a.yaml includes itself (included at a.yaml:1:10, included at c.yaml:5:25)",
        "c.yaml:5:33: include: list.yaml is a list of 2 items; expected a map",
        "bad.yaml:",
        "c.yaml:5:54: include: c.yaml includes itself",
    ];
    assert_eq!(all.len(), begins.len(), "{all:#?}");
    for (line, begin) in all.iter().zip(begins) {
        assert!(line.starts_with(begin), "{line}");
    }
    let wrong = refused(&[("c.yaml", &format!("{HEAD}include: {{a: 1}}\n"))]);
    assert_eq!(wrong, ["c.yaml:5:10: include: expected the path of a file or a list of paths, found a map"]);

    // A long chain, and a bush of files.
    let chain: Vec<(String, String)> =
        (0..20).map(|i| (format!("{i}.yaml"), format!("include: {}.yaml\n", i + 1))).collect();
    let mut files: Vec<(&str, &str)> = chain.iter().map(|(a, b)| (a.as_str(), b.as_str())).collect();
    let head = format!("{HEAD}include: 0.yaml\n");
    files.push(("c.yaml", &head));
    assert!(
        refused(&files)[0].contains("14.yaml:1:10: include: 15.yaml is the 17th file"),
        "{:?}",
        refused(&files)
    );
    let bush: Vec<(String, String)> =
        (0..9).map(|i| (format!("{i}.yaml"), format!("include: [{0}.yaml, {0}.yaml]\n", i + 1))).collect();
    let mut files: Vec<(&str, &str)> = bush.iter().map(|(a, b)| (a.as_str(), b.as_str())).collect();
    files.extend([("c.yaml", head.as_str()), ("9.yaml", "")]);
    assert!(refused(&files)[0].contains("more than 100 files in all"));

    let dir = folder(&[("c.yaml", HEAD)]);
    let message = load(dir.path(), &["include=a.yaml"]).expect_err("must be refused").to_string();
    assert_eq!(
        message,
        "--set include=a.yaml: include: can only be written in a file: its files are read before anything is set"
    );
}

#[test]
fn files_that_are_no_configuration() {
    let dir = tempfile::tempdir().expect("temporary folder");
    let message = |bytes: &[u8]| {
        std::fs::write(dir.path().join("c.yaml"), bytes).expect("write");
        load(dir.path(), &[]).expect_err("must be refused").to_string()
    };
    assert!(message(&[0xff, 0xfe, 0]).ends_with("cannot read the configuration: not UTF-8 text"));
    assert!(message(&vec![b' '; (16 << 20) + 1]).ends_with("larger than 16 MiB: not a configuration"));
    assert!(fog_plan::load("/dev/zero".as_ref(), &[]).expect_err("endless").to_string().contains("16 MiB"));
}

#[test]
fn presets_by_name_by_file_and_overridden() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../configs/lighting");
    let lighting = |lines: &str| {
        let plan = fog_plan::parse(&format!("{HEAD}{lines}\n"), "c.yaml", &[]).expect("a plan");
        plan.frame(0).expect("a frame").lighting
    };
    let names =
        ["day", "overcast", "clear", "dusk", "night", "sunny", "night_street", "night_runway", "headlamps"];
    for name in names {
        let by_name = lighting(&format!("lighting: {name}"));
        assert_eq!(by_name.preset, Some(name));
        let file = lighting(&format!("include: {:?}", root.join(format!("{name}.yaml"))));
        assert_eq!(fog_plan::LightingSpec { preset: Some(name), ..file }, by_name);
    }
    let low = lighting("lighting: {preset: clear, sun: {elevation_deg: 10}}");
    assert_eq!(low.sun.map(|sun| (sun.elevation_deg, sun.azimuth_deg)), Some((10.0, 140.0)));
    assert!(matches!(low.sky, Some(SkySpec::Clear { .. })) && !low.scene_emitters);
    let grey = lighting("lighting: {preset: clear, sky: ~, sun: ~, environment: {radiance: 2}}");
    assert_eq!(grey.environment, Some(EnvironmentSpec::Uniform { radiance: 2.0, wavelength_nm: None }));

    // Axes step into a name.
    let axes = "lighting: dusk\nsweep: {axes: {lighting.sun.elevation_deg: [-4, -6], lighting.preset: [dusk, clear]}}\n";
    let plan = fog_plan::parse(&format!("{HEAD}{axes}"), "c.yaml", &[]).expect("a plan");
    let frames: Vec<_> = plan.frames().map(|frame| frame.expect("a frame").lighting).collect();
    assert_eq!((frames[2].preset, frames[3].preset), (Some("dusk"), Some("clear")));
    assert_eq!(frames[3].sun.map(|sun| (sun.elevation_deg, sun.azimuth_deg)), Some((-6.0, 140.0)));
}

#[test]
fn another_model_takes_the_place_of_the_included_one() {
    let dir = folder(&[
        (
            "c.yaml",
            "version: 1\nname: t\nscene: none\ninclude: a.yaml\nfog: {model: homogeneous, height_m: 5, sigma_t_1_m: 1}\n",
        ),
        ("a.yaml", "fog: {model: advection, height_m: 100, number_density_scale: 2}\n"),
    ]);
    let fog = load(dir.path(), &[]).expect("a plan").frame(0).expect("a frame").fog;
    assert!(matches!(fog.model, FogModel::Homogeneous { height_m: 5.0, .. }));
}
