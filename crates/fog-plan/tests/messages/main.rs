//! Every kind of mistake, with the exact message.

mod cameras;
mod hostile;
mod includes;
mod labels;
mod lights;
mod runways;
mod scenes;
mod sensor;

/// The first five lines; tests add the rest, from line 6.
const HEAD: &str = "version: 1\nname: t\nscene: {file: a.glb}\nlighting: day\nrender: {samples: 4}\n";

fn errors_with(text: &str, sets: &[&str]) -> Vec<String> {
    let sets: Vec<String> = sets.iter().map(|s| (*s).to_owned()).collect();
    match fog_plan::parse(text, "configs/x.yaml", &sets) {
        Ok(plan) => panic!("no error, but {} frames", plan.len()),
        Err(error) => error.to_string().lines().map(str::to_owned).collect(),
    }
}

/// Errors of the head followed by `lines`.
fn errors(lines: &str) -> Vec<String> {
    errors_with(&format!("{HEAD}{lines}"), &[])
}

#[test]
fn unknown_keys() {
    assert_eq!(
        errors("fog:\n  model: advection\n  heigth_m: 100\n"),
        [
            "configs/x.yaml:8:3: fog.heigth_m: unknown key; expected one of model, height_m, number_density_scale, \
             coefficients, droplets, number_density_1_m3, vertical, sigma_t_1_m, sigma_t_base_1_m, sigma_t_top_1_m, file, \
             single_scattering_albedo, phase, coefficient, sampling, visibility, patchiness, datum_m; \
             did you mean `height_m`?"
        ]
    );
    assert_eq!(
        errors("fog: none\nweather: bad\n"),
        [
            "configs/x.yaml:7:1: weather: unknown key; expected one of include, version, name, seed, scene, fog, camera, path, \
             cameras, sensor, lighting, render, classes, labels, outputs, runway, sweep"
        ]
    );
}

#[test]
fn wrong_types() {
    assert_eq!(
        errors("fog: none\ncamera:\n  altitude_m: tall\n"),
        ["configs/x.yaml:8:15: camera.altitude_m: expected a number (metres), found text \"tall\""]
    );
    assert_eq!(
        errors("fog: none\nsensor: {width_px: 12.5, height_px: [1]}\n"),
        [
            "configs/x.yaml:7:20: sensor.width_px: expected a whole number (pixels), found 12.5",
            "configs/x.yaml:7:37: sensor.height_px: expected a whole number (pixels), found a list of 1 item",
        ]
    );
    assert_eq!(
        errors("fog: none\ncamera: {position_m: [0, 1]}\n"),
        [
            "configs/x.yaml:7:22: camera.position_m: expected a list of 3 numbers (metres), found a list of 2 items"
        ]
    );
    assert_eq!(
        errors("fog: none\ncamera: {position_m: [0, x, 1]}\n"),
        ["configs/x.yaml:7:26: camera.position_m.1: expected a number (metres), found text \"x\""]
    );
    assert_eq!(
        errors("fog: none\nsensor: wide\n"),
        [
            "configs/x.yaml:7:9: sensor: expected a map with keys width_px, height_px, horizontal_fov_deg, intrinsics, lens, shutter, exposure, model, \
          found text \"wide\""
        ]
    );
    assert_eq!(
        errors("fog: advection\n"),
        ["configs/x.yaml:6:6: fog: expected `none` or a map such as {model: advection, height_m: 180}, \
          found text \"advection\""]
    );
    assert_eq!(
        errors("fog: none\nseed: -1\n"),
        ["configs/x.yaml:7:7: seed: expected a whole number from 0 to 18446744073709551615, found -1"]
    );
}

#[test]
fn unknown_values() {
    let head = HEAD.replace("lighting: day", "lighting: niht");
    assert_eq!(
        errors_with(&format!("{head}fog: none\n"), &[]),
        [
            "configs/x.yaml:4:11: lighting: unknown value \"niht\"; expected one of day, overcast, clear, dusk, night, sunny, \
             night_street, night_runway, headlamps; did you mean `night`?"
        ]
    );
    assert_eq!(
        errors("fog: {model: advection, height_m: 9, phase: {hgg: 0.8}}\n"),
        [
            "configs/x.yaml:6:45: fog.phase: unknown value \"hgg\"; expected one of mie, hg, mie_mean_diameter, \
          jendersie_deon; \
          did you mean `hg`?"
        ]
    );
    assert_eq!(
        errors("fog: {model: advection, height_m: 9, phase: hg}\n"),
        ["configs/x.yaml:6:45: fog.phase: `hg` needs a value: {hg: …}"]
    );
    assert_eq!(
        errors("fog: {model: advection, height_m: 9, phase: {hg: own}}\n"),
        ["configs/x.yaml:6:50: fog.phase.hg: expected a number or `layer`, found text \"own\""]
    );
    assert_eq!(
        errors("fog: {model: advection, height_m: 9, phase: {jendersie_deon: {d_um: 3}}}\n"),
        ["configs/x.yaml:6:63: fog.phase.jendersie_deon.d_um: unknown key; expected diameter_um"]
    );
    assert_eq!(
        errors(
            "fog: {model: advection, height_m: 9, phase: {mie: 3}, coefficient: papr, sampling: diametr}\n"
        ),
        [
            "configs/x.yaml:6:45: fog.phase: `mie` takes no value",
            "configs/x.yaml:6:68: fog.coefficient: unknown value \"papr\"; expected one of integral, paper; \
             did you mean `paper`?",
            "configs/x.yaml:6:84: fog.sampling: unknown value \"diametr\"; expected one of table, diameter; \
             did you mean `diameter`?",
        ]
    );
    assert_eq!(
        errors("fog: none\noutputs: [image, image, tua]\n"),
        [
            "configs/x.yaml:7:25: outputs.2: unknown value \"tua\"; expected one of image, hdr, depth, distance, \
          transmittance, tau, direct, airlight, standard_error, samples, denoised, normals, position, albedo, semantic, instance, flow, objects, raw, pair; did you mean `tau`?"
        ]
    );
    assert_eq!(errors("fog: none\noutputs: [tau, tau]\n"), ["configs/x.yaml:7:16: outputs.1: named twice"]);
}

#[test]
fn ranges() {
    assert_eq!(
        errors("fog: {model: advection, height_m: -5}\n"),
        ["configs/x.yaml:6:35: fog.height_m: -5 m is out of range; valid: 1 to 5000 m"]
    );
    assert_eq!(
        errors("fog: {model: homogeneous, height_m: 50, sigma_t_1_m: 11, phase: {hg: 1}}\n"),
        [
            "configs/x.yaml:6:70: fog.phase.hg: 1 is out of range; valid: -0.999 to 0.999",
            "configs/x.yaml:6:54: fog.sigma_t_1_m: 11 1/m is out of range; valid: 0 to 10 1/m",
        ]
    );
    assert_eq!(
        errors("fog: none\nsensor: {exposure: 0, width_px: 0}\ncamera: {position_m: [0, 0, 1e9]}\n"),
        [
            "configs/x.yaml:7:33: sensor.width_px: 0 px is out of range; valid: 1 to 16384 px",
            "configs/x.yaml:7:20: sensor.exposure: 0 is out of range; valid: above 0 up to 1000000000",
            "configs/x.yaml:8:29: camera.position_m.2: 1000000000 m is out of range; valid: -10000000 to 10000000 m",
        ]
    );
    assert_eq!(
        errors("fog: {model: advection, height_m: 50, visibility: {mor_m: 300, altitude_m: 60}}\n"),
        ["configs/x.yaml:6:76: fog.visibility.altitude_m: 60 m is above the layer, whose height_m is 50 m"]
    );
}

#[test]
fn optics_of_the_droplets() {
    assert_eq!(
        errors("fog: {model: advection, height_m: 50, phase: {jendersie_deon: {diameter_um: 51}}}\n"),
        [
            "configs/x.yaml:6:77: fog.phase.jendersie_deon.diameter_um: 51 µm is out of range; valid: above 0 up to 50 µm"
        ]
    );
    assert_eq!(
        errors("fog: {model: advection, height_m: 50, phase: {hg: 0.83}, sampling: diameter}\n"),
        [
            "configs/x.yaml:6:68: fog.sampling: `diameter` draws droplets of the fog, which only `phase: mie` knows"
        ]
    );
    for (keys, column, given) in [
        ("model: homogeneous, height_m: 50, sigma_t_1_m: 0.1", 72, "sigma_t_1_m"),
        (
            "model: linear_gradient, height_m: 50, sigma_t_base_1_m: 0.1, sigma_t_top_1_m: 0.2",
            103,
            "sigma_t_base_1_m and sigma_t_top_1_m",
        ),
        ("model: layered, file: a.csv", 49, "file"),
    ] {
        assert_eq!(
            errors(&format!("fog: {{{keys}, coefficient: paper}}\n")),
            [format!(
                "configs/x.yaml:6:{column}: fog.coefficient: is about the extinction that droplets add up to, but here \
                 {given} says it"
            )]
        );
    }
}

#[test]
fn model_files_of_fogs_that_take_nothing_from_the_model() {
    let given = "is the file of the advection model, but this fog's extinction and phase function are given";
    for (keys, message) in [
        ("model: homogeneous, height_m: 50, sigma_t_1_m: 0.1, phase: {hg: 0.8}", given),
        ("model: layered, file: a.csv, phase: {jendersie_deon: {diameter_um: 9}}", given),
        (
            "model: droplets, height_m: 50, droplets: deirmendjian_haze_m",
            "is the file of the advection model, which `droplets` takes only `vertical: advection` from",
        ),
    ] {
        let lines = format!("fog: {{{keys}, coefficients: m.yaml}}\n");
        let column = lines.find("m.yaml").unwrap() + 1;
        assert_eq!(errors(&lines), [format!("configs/x.yaml:6:{column}: fog.coefficients: {message}")]);
    }
    assert_eq!(
        errors("fog: {model: advection, height_m: 50, coefficients: 3}\n"),
        ["configs/x.yaml:6:53: fog.coefficients: expected text, found 3"]
    );
}

#[test]
fn missing_keys() {
    assert_eq!(
        errors_with("seed: 3\n", &[]),
        [
            "configs/x.yaml:1:1: version: missing; write `version: 1`",
            "configs/x.yaml:1:1: name: missing; give the data set a name, such as `name: quickstart`",
            "configs/x.yaml:1:1: scene: missing; give {file: …}, {generate: …} or `none`",
            "configs/x.yaml:1:1: fog: missing; give `none` or a map such as {model: advection, height_m: 180}",
        ]
    );
    assert_eq!(
        errors("fog:\n  model: layered\n"),
        ["configs/x.yaml:7:3: fog.file: missing; path of a CSV file with columns altitude_m,sigma_t_1_m"]
    );
    assert_eq!(
        errors_with("version: 2\nname: a b\nscene: {file: a.obj}\nfog: none\n", &[]),
        [
            "configs/x.yaml:1:10: version: version 2 is unknown; expected 1; did you mean `1`?",
            "configs/x.yaml:2:7: name: \"a b\" is not a name: use 1 to 100 letters, digits, `.`, `_` and `-`",
            "configs/x.yaml:3:15: scene.file: \"a.obj\" is not a .glb or .gltf file",
        ]
    );
    assert_eq!(
        errors_with("[]", &[]),
        ["configs/x.yaml:1:1: expected a configuration (a map), found a list of 0 items"]
    );
    assert_eq!(errors_with("", &[]), ["configs/x.yaml:1:1: expected a configuration (a map), found nothing"]);
}

#[test]
fn keys_of_another_model() {
    assert_eq!(
        errors("fog: {model: advection, height_m: 9, sigma_t_1_m: 0.1, single_scattering_albedo: 1}\n"),
        [
            "configs/x.yaml:6:51: fog.sigma_t_1_m: `sigma_t_1_m` belongs to model homogeneous, not advection",
            "configs/x.yaml:6:82: fog.single_scattering_albedo: `single_scattering_albedo` belongs to models homogeneous, \
             linear_gradient, layered, not advection",
        ]
    );
}

#[test]
fn droplets() {
    let fog = |keys: &str| errors(&format!("fog: {{model: droplets, height_m: 9, {keys}}}\n"));
    let names = "shettle_fenn_advection_heavy, shettle_fenn_advection_moderate, shettle_fenn_radiation_heavy, \
                 shettle_fenn_radiation_moderate, deirmendjian_cloud_c1, deirmendjian_cloud_c2, deirmendjian_cloud_c3, \
                 deirmendjian_cloud_c5, deirmendjian_cloud_c6, deirmendjian_haze_m, deirmendjian_haze_l, \
                 deirmendjian_haze_h, gamma, modified_gamma, lognormals, file";
    assert_eq!(
        fog("droplets: deirmendjian_cloud_1"),
        [format!(
            "configs/x.yaml:6:47: fog.droplets: unknown value \"deirmendjian_cloud_1\"; expected one of {names}; did you \
             mean `deirmendjian_cloud_c1`?"
        )]
    );
    assert_eq!(
        fog("droplets: {gama: {}}"),
        [format!(
            "configs/x.yaml:6:47: fog.droplets: unknown value \"gama\"; expected one of {names}; did you mean `gamma`?"
        )]
    );
    assert_eq!(
        fog("droplets: {gamma: {effective_radius_um: 0, effective_varianc: 0.1}}"),
        [
            "configs/x.yaml:6:80: fog.droplets.gamma.effective_varianc: unknown key; expected one of effective_radius_um, \
             effective_variance; did you mean `effective_variance`?",
            "configs/x.yaml:6:77: fog.droplets.gamma.effective_radius_um: 0 µm is out of range; valid: 0.01 to 500 µm",
        ]
    );
    assert_eq!(
        fog("droplets: {modified_gamma: {alpha: 6, b: fast}}, number_density_1_m3: 0"),
        [
            "configs/x.yaml:6:78: fog.droplets.modified_gamma.b: expected a number, found text \"fast\"",
            "configs/x.yaml:6:107: fog.number_density_1_m3: 0 1/m³ is out of range; valid: above 0 up to 1e15 1/m³",
        ]
    );
    assert_eq!(
        fog("droplets: {lognormals: []}, number_density_1_m3: dense"),
        [
            "configs/x.yaml:6:86: fog.number_density_1_m3: expected a number (per cubic metre), found text \"dense\"",
            "configs/x.yaml:6:60: fog.droplets.lognormals: 0 lognormals; valid: 1 to 16",
        ]
    );
    assert_eq!(
        fog("droplets: {lognormals: [{median_diameter_um: 5, geometric_sd: 1.5}]}"),
        [
            "configs/x.yaml:6:6: fog.number_density_1_m3: missing; droplets per m³ in the mean over altitude, or give \
          fog.visibility"
        ]
    );
    assert_eq!(
        fog("number_density_1_m3: 1e8"),
        [
            "configs/x.yaml:6:6: fog.droplets: missing; a name such as shettle_fenn_radiation_heavy, or one of {gamma: …}, \
          {modified_gamma: …}, {lognormals: …}, {file: …}"
        ]
    );
    let vertical = |value: &str| fog(&format!("droplets: deirmendjian_haze_m, vertical: {value}"));
    assert_eq!(
        vertical("{thinning: 20}"),
        ["configs/x.yaml:6:89: fog.vertical.thinning: 20 is out of range; valid: 0.1 to 10"]
    );
    assert_eq!(
        vertical("{rows: [[0.5, 1], [0.2, -1]]}"),
        [
            "configs/x.yaml:6:102: fog.vertical.rows.1.1: -1 is out of range; valid: 0 to 1e30",
            "configs/x.yaml:6:97: fog.vertical.rows.1.0: 0.2 follows 0.5; valid: ascending",
        ]
    );
    assert_eq!(
        vertical("{rows: [[0, 1]]}"),
        ["configs/x.yaml:6:85: fog.vertical.rows: 1 rows; valid: at least 2"]
    );
    assert_eq!(
        errors("fog: {model: advection, height_m: 9, vertical: uniform}\n"),
        ["configs/x.yaml:6:48: fog.vertical: `vertical` belongs to model droplets, not advection"]
    );
}

#[test]
fn what_is_shared() {
    let head = HEAD.replace("samples: 4", "samples: 4, share: fogs");
    assert_eq!(
        errors_with(&format!("{head}fog: none\n"), &[]),
        [
            "configs/x.yaml:5:29: render.share: unknown value \"fogs\"; expected one of lights, fog; did you mean `fog`?"
        ]
    );
}

#[test]
fn yaml_mistakes() {
    assert_eq!(
        errors("fog: none\ncamera: {pitch_deg: 1, pitch_deg: 2}\n"),
        ["configs/x.yaml:7:24: duplicate key `pitch_deg`"]
    );
    assert_eq!(errors("fog: none\nfog: none\n"), ["configs/x.yaml:7:1: duplicate key `fog`"]);
    assert_eq!(errors("fog: [none\n"), ["configs/x.yaml:6:6: not valid YAML: unclosed bracket '['"]);
}

#[test]
fn overrides() {
    let text = format!("{HEAD}fog: none\n");
    assert_eq!(
        errors_with(&text, &["camera.altitude_m=high"]),
        ["--set camera.altitude_m=high: camera.altitude_m: expected a number (metres), found text \"high\""]
    );
    assert_eq!(
        errors_with(&text, &["camera.altitud_m=3"]),
        [
            "--set camera.altitud_m=3: camera.altitud_m: unknown key; expected one of altitude_m, position_m, heading_deg, \
             pitch_deg, roll_deg; did you mean `altitude_m`?"
        ]
    );
    assert_eq!(
        errors_with(&text, &["fog.height_m=260", "camera", "seed={"]),
        [
            "--set fog.height_m=260: fog.height_m: `fog` is text \"none\", so `height_m` cannot be set inside it",
            "--set camera: expected KEY=VALUE, such as camera.altitude_m=30",
            "--set seed={: seed: not valid YAML: unclosed bracket '{'",
        ]
    );
    assert_eq!(
        errors_with(&text, &["camera.position_m.3=1", "camera..x=1"]),
        [
            "--set camera.position_m.3=1: camera.position_m.3: `camera.position_m` is a list of 3 items; expected an index \
             from 0 to 2, found `3`",
            "--set camera..x=1: camera..x: `camera..x` is not a dotted path",
        ]
    );
    assert_eq!(
        errors_with(&text, &["fog.model=advection"]).len(),
        1,
        "fog is a word: its model cannot be set"
    );
}

#[test]
fn axis_values_point_at_themselves() {
    assert_eq!(
        errors("sweep:\n  axes:\n    fog:\n      - none\n      - {model: advection, height_m: 0}\n"),
        ["configs/x.yaml:10:38: fog.height_m: 0 m is out of range; valid: 1 to 5000 m (from axis `fog`)"]
    );
    assert_eq!(
        errors("fog: none\nsweep:\n  axes:\n    camera.altitude_m: [2, tall]\n"),
        ["configs/x.yaml:9:28: camera.altitude_m: expected a number (metres), found text \"tall\" \
          (from axis `camera.altitude_m`)"]
    );
    assert_eq!(
        errors("fog: none\nsweep:\n  axes:\n    camera.altitud_m: [2, 3, 4]\n"),
        [
            "configs/x.yaml:9:5: camera.altitud_m: unknown key; expected one of altitude_m, position_m, heading_deg, \
          pitch_deg, roll_deg; did you mean `altitude_m`? (from axis `camera.altitud_m`)"
        ]
    );
    assert_eq!(
        errors("fog: none\nsweep:\n  axes:\n    fog.height_m: [100]\n"),
        ["configs/x.yaml:9:20: fog.height_m: `fog` is text \"none\", so `height_m` cannot be set inside it \
          (from axis `fog.height_m`)"]
    );
}

#[test]
fn wrong_sweeps() {
    assert_eq!(
        errors(
            "fog: none\nsweep:\n  mode: zip\n  axes:\n    camera.altitude_m: [2, 3]\n    camera.pitch_deg: [1, 2, 3]\n"
        ),
        [
            "configs/x.yaml:10:5: sweep.axes: mode zip needs equally many values on every axis: camera.altitude_m has 2, \
          camera.pitch_deg has 3"
        ]
    );
    assert_eq!(
        errors("fog: none\nsweep:\n  mode: random\n  axes:\n    camera.altitude_m: {from: 2, to: 3}\n"),
        ["configs/x.yaml:8:3: sweep.count: missing; random and sobol need the number of frames"]
    );
    assert_eq!(
        errors("fog: none\nsweep:\n  axes:\n    camera.altitude_m: {from: 2, to: 3}\n"),
        [
            "configs/x.yaml:9:5: sweep.axes.camera.altitude_m: needs count or step: only modes random and sobol draw from \
          an interval"
        ]
    );
    assert_eq!(
        errors("fog: none\nsweep:\n  mode: gird\n  axes: {camera.altitude_m: [1]}\n"),
        [
            "configs/x.yaml:8:9: sweep.mode: unknown value \"gird\"; expected one of grid, zip, random, sobol; \
          did you mean `grid`?"
        ]
    );
    assert_eq!(
        errors("fog: none\nsweep:\n  axes: {seed: [1, 2], camera.altitude_m: {from: 1, step: 2}}\n"),
        [
            "configs/x.yaml:8:10: sweep.axes.seed: an axis cannot change `seed`; expected one of scene, fog, camera, \
             path, cameras, sensor, lighting, render, outputs, runway",
            "configs/x.yaml:8:43: sweep.axes.camera.altitude_m.to: missing; this key is required",
        ]
    );
    assert_eq!(
        errors("fog: none\nsweep:\n  axes:\n    camera.altitude_m: [2, 2.0]\n"),
        [
            "configs/x.yaml:9:5: sweep.axes: frames 0 and 1 are identical (camera.altitude_m = 2.0); every frame must \
          differ from all others"
        ]
    );
    assert_eq!(
        errors(
            "fog: none\nsweep:\n  axes:\n    camera.altitude_m: {from: 0, to: 1, count: 100000}\n    camera.pitch_deg: {from: 0, to: 1, count: 100000}\n"
        ),
        ["configs/x.yaml:9:5: sweep.axes: 100000 × 100000 frames are too many; at most 100000000"]
    );
    assert_eq!(
        errors("fog: none\nsweep:\n  axes:\n    \"camera.altitude_m, camera.pitch_deg\": [[1, 2], [3]]\n"),
        [
            "configs/x.yaml:9:53: sweep.axes.camera.altitude_m, camera.pitch_deg.1: expected a list of 2 values, one per \
          path, found a list of 1 item"
        ]
    );
}

#[test]
fn all_problems_at_once_but_not_too_many() {
    let found =
        errors("fog: {model: advection, height_m: -1}\ncamera: {altitude_m: x, pitch_deg: 100}\nsensr: {}\n");
    assert_eq!(found.len(), 4, "{found:#?}");
    let axis: Vec<String> = (0..50).map(|i| (i + 100).to_string()).collect();
    let many = errors(&format!("fog: none\nsweep:\n  axes:\n    camera.pitch_deg: [{}]\n", axis.join(", ")));
    assert_eq!(many.len(), 20);
}

#[test]
fn unreadable_file() {
    let error = fog_plan::load(std::path::Path::new("no/such.yaml"), &[]).unwrap_err().to_string();
    assert!(error.starts_with("no/such.yaml: cannot read the configuration: "), "{error}");
}

#[test]
fn sampling_by_noise() {
    let head = HEAD.replace("render: {samples: 4}\n", "fog: none\n");
    let of = |render: &str| errors_with(&format!("{head}{render}"), &[]);
    assert_eq!(
        of("render: {max_samples: 100}\n"),
        ["configs/x.yaml:6:23: render.max_samples: belongs to render.noise, which is absent; without it \
          render.samples is the number"]
    );
    assert_eq!(
        of("render: {samples: 8, noise: 0.02}\n"),
        [
            "configs/x.yaml:6:19: render.samples: 8 are too few to tell the noise from; with render.noise at least 16"
        ]
    );
    assert_eq!(
        of("render: {noise: 0.02, max_samples: 32}\n"),
        ["configs/x.yaml:6:36: render.max_samples: 32 is less than render.samples, which is 64"]
    );
    assert_eq!(
        of("render: {noise: 0.02, allocate: relative_error}\n"),
        ["configs/x.yaml:6:33: render.allocate: render.noise already says which pixels get more samples: \
          leave one of the two out"]
    );
    assert_eq!(
        of("render: {approximation: similarity, share: fog}\n"),
        [
            "configs/x.yaml:6:25: render.approximation: paths that several fogs share (render.share: fog) know none"
        ]
    );
    assert_eq!(
        of("render: {approximation: delta}\n"),
        ["configs/x.yaml:6:25: render.approximation: unknown value \"delta\"; expected similarity"]
    );
    assert_eq!(
        of("render: {allocate: noise}\n"),
        [
            "configs/x.yaml:6:20: render.allocate: unknown value \"noise\"; expected one of even, relative_error"
        ]
    );
    assert_eq!(
        of("render: {noise: 2, max_samples: 0}\n"),
        [
            "configs/x.yaml:6:17: render.noise: 2 is out of range; valid: above 0 up to 1",
            "configs/x.yaml:6:33: render.max_samples: 0 is out of range; valid: 1 to 1000000"
        ]
    );
}

#[test]
fn patchiness() {
    let fog = |keys: &str| {
        errors(&format!("fog: {{model: homogeneous, height_m: 50, sigma_t_1_m: 0.1, patchiness: {keys}}}\n"))
    };
    for (keys, message) in [
        ("{density_sd: 3, length_m: 100}", "84: fog.patchiness.density_sd: 3 is out of range; valid: 0 to 2"),
        (
            "{density_sd: 1}",
            "71: fog.patchiness.length_m: missing; the distance between the largest patches, 1 to 100000 m",
        ),
        (
            "{density_sd: 1, length_m: 0.5}",
            "97: fog.patchiness.length_m: 0.5 m is out of range; valid: 1 to 100000 m",
        ),
        (
            "{length_m: 100}",
            "71: fog.patchiness: density_sd and top_sd_m are both 0; give one of them, or `none` for even fog",
        ),
        (
            "{density_sd: 1, length_m: 20, octaves: 6}",
            "110: fog.patchiness.octaves: 6 octaves below 20 m reach down to 0.312 m; valid: 0.5 m and more",
        ),
        (
            "{density_sd: 1, length_m: 20, octaves: 9}",
            "110: fog.patchiness.octaves: 9 is out of range; valid: 1 to 8",
        ),
    ] {
        assert_eq!(fog(keys), [format!("configs/x.yaml:6:{message}")], "{keys}");
    }
    let [thin] = &fog("{top_sd_m: 20, length_m: 100}")[..] else { panic!("one problem") };
    assert!(thin.contains("fog.patchiness.top_sd_m: ") && thin.contains("layer's 50 m"), "{thin}");
}
