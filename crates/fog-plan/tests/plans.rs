//! Plans: order, values, identity, and the resolved configuration.

#[path = "plans/cameras.rs"]
mod cameras;

use std::path::Path;

use fog_plan::{Coefficient, FogModel, FrameSpec, MeanCosine, Output, Phase, Plan, Sampling, SceneSource};

const BASE: &str = "version: 1\nname: t\nscene: none\nfog: {model: advection, height_m: 180}\n";

fn plan(sweep: &str) -> Plan {
    fog_plan::parse(&format!("{BASE}{sweep}"), "t.yaml", &[]).unwrap_or_else(|error| panic!("{error}"))
}

fn frames(plan: &Plan) -> Vec<FrameSpec> {
    plan.frames().map(|frame| frame.unwrap_or_else(|error| panic!("{error}"))).collect()
}

fn config(name: &str) -> Plan {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../configs").join(name);
    fog_plan::load(&path, &[]).unwrap_or_else(|error| panic!("{error}"))
}

#[test]
fn quickstart_has_twelve_pinned_frames() {
    // Ids are pinned for a fixed number of samples, so that the example may change its own.
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../configs/quickstart.yaml");
    let plan = fog_plan::load(&path, &["render.samples=64".to_owned()]).expect("valid configuration");
    let frames = frames(&plan);
    let ids: Vec<&str> = frames.iter().map(|frame| frame.id.as_str()).collect();
    assert_eq!(
        ids,
        [
            "none_2_day-0c729c1b56b99ad3",
            "none_2_night-0bb3b85f8a987658",
            "none_30_day-96e5d28e72b2e458",
            "none_30_night-2bc8f935d4e26349",
            "advection-100_2_day-efeb02f88b14cdb8",
            "advection-100_2_night-75fc51e48f37639b",
            "advection-100_30_day-bab7018d205c1129",
            "advection-100_30_night-8273da5801fe90c9",
            "advection-260_2_day-e51a2cb8bf917375",
            "advection-260_2_night-ccb389e4b540eb0c",
            "advection-260_30_day-6282c69392ef7bb3",
            "advection-260_30_night-287cca9251d93c7e"
        ]
    );
    assert_eq!(
        (frames[0].seed, frames[0].pair_id.as_str()),
        (10_802_444_987_229_188_710, "2b781ff982eb993d")
    );
    let street = SceneSource::File { file: "scenes/street.glb".into() };
    assert_eq!(frames[0].scene.as_ref().map(|scene| &scene.source), Some(&street));
    assert_eq!(frames[0].outputs.len(), 8);
}

#[test]
fn approach_descends_on_the_glide_path() {
    let frames = frames(&config("approach.yaml"));
    assert_eq!(frames.len(), 3 * 2 * 13);
    for frame in &frames {
        let [_, y, z] = frame.camera.position_m;
        assert_eq!(y, frame.camera.altitude_m);
        // The aiming point is 311 m beyond the threshold, where z is 0.
        assert!((y / (z + 311.0) - 0.052_407_8).abs() < 2e-5, "3 degrees");
    }
    for (index, z) in [(0, 2689.0), (12, -191.0), (13, 2689.0)] {
        assert!((frames[index].camera.position_m[2] - z).abs() < 1e-9, "{index}");
    }
}

#[test]
fn grid_changes_the_first_axis_slowest() {
    let plan =
        plan("sweep: {axes: {camera.altitude_m: [1, 2], camera.pitch_deg: {from: 0, to: 10, step: 5}}}\n");
    let poses: Vec<_> = frames(&plan).iter().map(|f| (f.camera.altitude_m, f.camera.pitch_deg)).collect();
    assert_eq!(poses, [(1.0, 0.0), (1.0, 5.0), (1.0, 10.0), (2.0, 0.0), (2.0, 5.0), (2.0, 10.0)]);
    assert_eq!(plan.axes()[1].values, ["0", "5", "10"]);
    assert_eq!(plan.mode(), Some("grid"));
}

#[test]
fn zip_and_linked_axes_move_together() {
    let zip = plan("sweep: {mode: zip, axes: {camera.altitude_m: [1, 2], camera.pitch_deg: [3, 4]}}\n");
    let linked = plan("sweep: {axes: {\"camera.altitude_m, camera.pitch_deg\": [[1, 3], [2, 4]]}}\n");
    let poses = |plan: &Plan| -> Vec<_> {
        frames(plan).iter().map(|f| (f.camera.altitude_m, f.camera.pitch_deg)).collect()
    };
    assert_eq!(poses(&zip), [(1.0, 3.0), (2.0, 4.0)]);
    assert_eq!(poses(&zip), poses(&linked));
    assert_eq!(frames(&linked)[0].axes[1], ("camera.pitch_deg".to_owned(), 3.into()));
}

#[test]
fn draws_are_functions_of_seed_and_index() {
    for mode in ["random", "sobol"] {
        let sweep = format!(
            "sweep: {{mode: {mode}, count: 500, axes: {{camera.altitude_m: {{from: 2, to: 30}}, lighting: [day, night]}}}}\n"
        );
        let first = plan(&sweep);
        let all = frames(&first);
        assert_eq!(all.len(), 500);
        assert!(all.iter().all(|f| (2.0..30.0).contains(&f.camera.altitude_m)));
        let nights = all.iter().filter(|f| f.lighting.preset == Some("night")).count();
        assert!((200..300).contains(&nights), "{nights}");
        let mean = all.iter().map(|f| f.camera.altitude_m).sum::<f64>() / 500.0;
        assert!((mean - 16.0).abs() < 1.5, "{mean}");
        assert_eq!(plan(&sweep).frame(77).unwrap(), all[77]);
        let other = fog_plan::parse(&format!("{BASE}{sweep}"), "t.yaml", &["seed=2".to_owned()]).unwrap();
        assert_ne!(other.frame(77).unwrap().camera, all[77].camera);
    }
}

#[test]
fn pairs_differ_in_fog_alone() {
    let plan = plan(
        "sweep: {axes: {fog: [none, {model: advection, height_m: 99}, {model: homogeneous, height_m: 99}], camera.altitude_m: [2, 30]}}\n",
    );
    let frames = frames(&plan);
    for a in &frames {
        for b in &frames {
            assert_eq!(a.pair_id == b.pair_id, a.camera == b.camera);
            assert_eq!(a.digest == b.digest, a.index == b.index);
            assert_eq!(a.seed == b.seed, a.index == b.index);
        }
    }
}

#[test]
fn the_way_of_writing_does_not_matter_to_identity() {
    let bare = plan("");
    let explicit = plan(
        "# comment\nrender: {samples: 64.0}\nsensor: {height_px: 180, width_px: 0x140}\ncamera: {altitude_m: 2.0}\nlighting: day\n",
    );
    assert_eq!(bare.frame(0).unwrap(), explicit.frame(0).unwrap());
    assert_eq!(bare.config_digest(), explicit.config_digest());
    assert!(bare.frame(0).unwrap().id.starts_with("t-"));
}

#[test]
fn resolved_yaml_is_the_same_plan() {
    let sweeps = [
        "",
        "sweep: {axes: {fog: [none, {model: advection, height_m: 100}], lighting: [night, day]}}\n",
        "sweep: {mode: sobol, count: 8, axes: {camera.position_m.2: {from: -5, to: 5}, fog.height_m: [100, 200]}}\n",
        "sweep: {mode: zip, axes: {fog.model: [advection, homogeneous], camera.roll_deg: {from: 0, to: 0.3, count: 2}}}\n",
    ];
    for sweep in sweeps {
        let plan = plan(sweep);
        let yaml = plan.resolved_yaml();
        let again =
            fog_plan::parse(&yaml, "resolved.yaml", &[]).unwrap_or_else(|error| panic!("{yaml}\n{error}"));
        assert_eq!(frames(&plan), frames(&again), "{yaml}");
        assert_eq!(plan.config_digest(), again.config_digest());
        assert_eq!(again.resolved_yaml(), yaml);
        assert_eq!(again.differing_keys(&yaml).unwrap(), Vec::<String>::new());
    }
}

#[test]
fn resolved_yaml_shows_every_default() {
    let yaml = plan("").resolved_yaml();
    let expected = "version: 1\nname: t\nseed: 1\nscene: none\nfog:\n  model: advection\n  height_m: 180\n";
    assert!(yaml.starts_with(expected), "{yaml}");
    for key in
        ["number_density_scale: 1", "phase: mie", "datum_m: 0", "samples: 64", "lighting: day", "exposure: 1"]
    {
        assert!(yaml.contains(key), "{key} in\n{yaml}");
    }
}

#[test]
fn changed_keys_are_named() {
    let old = plan("sweep: {axes: {camera.altitude_m: [2, 30], lighting: [day, night]}}\n");
    let new = |text: &str, sets: &[&str]| {
        let sets: Vec<String> = sets.iter().map(|s| (*s).to_owned()).collect();
        let plan = fog_plan::parse(&format!("{BASE}{text}"), "t.yaml", &sets).unwrap();
        plan.differing_keys(&old.resolved_yaml()).unwrap()
    };
    assert_eq!(
        new("sweep: {axes: {camera.altitude_m: [2, 31], lighting: [day, night]}}\n", &["fog.height_m=260"]),
        ["fog.height_m: was 180, is now 260", "sweep.axes.camera.altitude_m.1: was 30, is now 31"]
    );
    assert_eq!(
        new("sweep: {axes: {lighting: [day, night], camera.altitude_m: [2, 30]}}\n", &[]),
        ["sweep.axes: the axes are in another order"]
    );
    assert_eq!(
        new(
            "sweep: {axes: {camera.altitude_m: [2.0, 30], lighting: [day, night]}}\n",
            &["render.max_depth=3"]
        ),
        ["render.max_depth: was absent, is now 3"]
    );
}

#[test]
fn a_million_frames_are_cheap() {
    let plan = plan(
        "sweep: {axes: {camera.altitude_m: {from: 1, to: 100, count: 1000}, camera.heading_deg: {from: 0, to: 359.64, count: 1000}}}\n",
    );
    assert_eq!(plan.len(), 1_000_000);
    assert_eq!(plan.frames().len(), 1_000_000);
    let frame = plan.frame(999_999).unwrap();
    assert_eq!((frame.camera.altitude_m, frame.camera.heading_deg), (100.0, 359.64));
    assert_eq!(frame.index, 999_999);
    assert!(plan.frame(1_000_000).is_err());
}

#[test]
fn long_plans_still_find_bad_values() {
    let text = format!(
        "{BASE}sweep: {{axes: {{camera.altitude_m: {{from: 1, to: 100, count: 1000}}, camera.pitch_deg: {{from: 0, to: 91, count: 1000}}}}}}\n"
    );
    let error = fog_plan::parse(&text, "t.yaml", &[]).unwrap_err().to_string();
    assert!(error.contains("camera.pitch_deg: 90"), "{error}");
}

#[test]
fn values_are_resolved() {
    let text = "version: 1\nname: t\nscene: none\nfog: {model: linear_gradient, height_m: 50, sigma_t_top_1_m: 0.1, \
                phase: {hg: 0.83}, datum_m: 10}\nlighting: sunny\noutputs: [tau, image]\n\
                camera: {altitude_m: 3, position_m: [1, 99, 2]}\n";
    let frame = fog_plan::parse(text, "t.yaml", &[]).unwrap().frame(0).unwrap();
    assert_eq!(frame.scene, None);
    assert_eq!(
        frame.fog.model,
        FogModel::LinearGradient {
            height_m: 50.0,
            sigma_t_base_1_m: None,
            sigma_t_top_1_m: Some(0.1),
            single_scattering_albedo: 1.0
        }
    );
    assert_eq!(frame.fog.phase, Phase::Hg(MeanCosine::Value(0.83)));
    assert_eq!(frame.camera.position_m, [1.0, 13.0, 2.0]);
    assert_eq!(frame.outputs, [Output::Image, Output::Tau]);
    let json = serde_json::to_value(&frame).unwrap();
    assert_eq!(json["fog"]["model"], "linear_gradient");
    assert_eq!(json["fog"]["phase"]["hg"], 0.83);
    assert_eq!(json["lighting"]["sun"]["irradiance"], 2.0);
    assert_eq!(json["axes"], serde_json::json!({}));
}

#[test]
fn model_files_are_kept_as_written_and_absent_ones_leave_no_trace() {
    let fogs = [
        "{model: advection, height_m: 50}",
        "{model: advection, height_m: 50, coefficients: a/m.yaml}",
        "{model: homogeneous, height_m: 50, sigma_t_1_m: 0.1, coefficients: m.yaml}",
        "{model: linear_gradient, height_m: 50, sigma_t_top_1_m: 0.1, phase: {hg: 0}, coefficients: m.yaml}",
        "{model: layered, file: l.csv, phase: jendersie_deon, coefficients: m.yaml}",
        "{model: droplets, height_m: 50, droplets: {file: s.csv}, number_density_1_m3: 1e8, vertical: advection, \
         coefficients: m.yaml}",
    ];
    let fogs = plan(&format!("sweep: {{axes: {{fog: [{}]}}}}\n", fogs.join(", ")));
    let fogs: Vec<_> = frames(&fogs).into_iter().map(|frame| frame.fog).collect();
    let files = |i: usize| -> Vec<&str> { fogs[i].files().iter().filter_map(|file| file.to_str()).collect() };
    assert_eq!(serde_json::to_value(&fogs[0]).unwrap().get("coefficients"), None);
    assert_eq!(serde_json::to_value(&fogs[1]).unwrap()["coefficients"], "a/m.yaml");
    assert_eq!(files(0), [""; 0]);
    assert_eq!((files(1), files(4)), (vec!["a/m.yaml"], vec!["m.yaml", "l.csv"]));
    assert_eq!(files(5), ["m.yaml", "s.csv"]);

    // An axis may name models, and `null` for the shipped one.
    let axis = plan("sweep: {axes: {fog.coefficients: [null, m.yaml]}}\n");
    let axis = frames(&axis);
    let shipped = plan("").frame(0).unwrap();
    assert_eq!((&axis[0].digest, axis[0].seed), (&shipped.digest, shipped.seed));
    assert!(axis[1].digest != shipped.digest && axis[1].pair_id == shipped.pair_id);
}

#[test]
fn skies_are_resolved_and_absent_ones_leave_no_trace() {
    let with = |lighting: &str, sets: &[&str]| {
        let sets: Vec<String> = sets.iter().map(|s| (*s).to_owned()).collect();
        let text = format!("version: 1\nname: t\nscene: none\nfog: none\nlighting: {lighting}\n");
        fog_plan::parse(&text, "t.yaml", &sets).unwrap_or_else(|error| panic!("{error}"))
    };
    let clear = with(
        "{sky: {model: clear}, sun: {elevation_deg: -4, azimuth_deg: 9}, moon: {elevation_deg: 5, azimuth_deg: 1}}",
        &["lighting.sky.ozone_du=350"],
    );
    let lighting = serde_json::to_value(&clear.frame(0).unwrap().lighting).unwrap();
    let sky = serde_json::json!({"model": "clear", "aerosol_optical_depth": 0.1, "ozone_du": 350.0,
        "night_luminance_cd_m2": 1.7e-4, "ground_albedo": 0.2});
    assert_eq!(lighting["sky"], sky);
    assert_eq!(lighting["sun"]["irradiance"], serde_json::Value::Null);
    assert_eq!(lighting["moon"]["phase_deg"], 0.0);
    assert!(clear.resolved_yaml().contains("aerosol_optical_depth: 0.1"), "{}", clear.resolved_yaml());
    let cie = with("{sky: {model: cie, cie_type: 3, horizontal_illuminance_lx: 9000}}", &[]);
    let cie = serde_json::to_value(cie.frame(0).unwrap().lighting.sky).unwrap();
    assert_eq!(cie["horizontal_illuminance_lx"], 9000.0);
    assert_eq!((cie["cie_type"].as_u64(), cie.get("zenith_luminance_cd_m2")), (Some(3), None));
    let day = serde_json::to_value(&with("day", &[]).frame(0).unwrap().lighting).unwrap();
    let keys: Vec<&String> = day.as_object().unwrap().keys().collect();
    assert_eq!(keys, ["preset", "environment", "sun", "scene_emitters"]);
    let sunny = serde_json::to_value(with("sunny", &[]).frame(0).unwrap().lighting.sun).unwrap();
    assert!(sunny.get("color_temperature_k").is_none());
}

#[test]
fn merge_keys_work() {
    let text = format!(
        "{BASE}sweep:\n  axes:\n    fog:\n      - &thin {{model: advection, height_m: 100}}\n      - {{<<: *thin, number_density_scale: 2}}\n"
    );
    let plan = fog_plan::parse(&text, "t.yaml", &[]).unwrap();
    assert_eq!(
        frames(&plan)[1].fog.model,
        FogModel::Advection { height_m: 100.0, number_density_scale: 2.0 }
    );
}

#[test]
fn overrides_apply_in_order_and_can_drop_the_sweep() {
    let text = format!("{BASE}sweep: {{axes: {{camera.altitude_m: [1, 2]}}}}\n");
    let parse = |sets: &[&str]| {
        let sets: Vec<String> = sets.iter().map(|s| (*s).to_owned()).collect();
        fog_plan::parse(&text, "t.yaml", &sets).unwrap_or_else(|error| panic!("{error}"))
    };
    let single = parse(&["sweep=null", "camera.altitude_m=5", "camera.altitude_m=6"]);
    assert_eq!((single.len(), single.frame(0).unwrap().camera.altitude_m), (1, 6.0));
    assert_eq!(parse(&["sweep.axes.camera.altitude_m=[1, 2, 3]"]).len(), 3);
    let model = parse(&["fog.model=homogeneous", "fog.sigma_t_1_m=0.01"]);
    assert_eq!(model.frame(0).unwrap().fog.model.name(), "homogeneous");
}

#[test]
fn phases_coefficients_and_sampling() {
    let fogs = [
        "{model: advection, height_m: 50, phase: {hg: layer}}",
        "{model: advection, height_m: 50, phase: jendersie_deon}",
        "{model: advection, height_m: 50, phase: {jendersie_deon: {}}, coefficient: paper}",
        "{model: advection, height_m: 50, phase: {jendersie_deon: {diameter_um: 12}}}",
        "{model: advection, height_m: 50, phase: mie, sampling: diameter}",
        "{model: linear_gradient, height_m: 50, sigma_t_top_1_m: 0.1, coefficient: paper, sampling: diameter}",
        "{model: advection, height_m: 50, sampling: table, coefficient: integral}",
    ];
    let plan = plan(&format!("sweep: {{axes: {{fog: [{}]}}}}\n", fogs.join(", ")));
    let frames = frames(&plan);
    let fit = |diameter_um| Phase::JendersieDeon { diameter_um };
    let phases: Vec<Phase> = frames.iter().map(|f| f.fog.phase).collect();
    assert_eq!(phases[..4], [Phase::Hg(MeanCosine::Layer), fit(None), fit(None), fit(Some(12.0))]);
    let optics: Vec<_> = frames.iter().map(|f| (f.fog.coefficient, f.fog.sampling)).collect();
    assert_eq!(optics[2], (Coefficient::Paper, Sampling::Table));
    assert_eq!(optics[4], (Coefficient::Integral, Sampling::Diameter));
    assert_eq!(optics[5], (Coefficient::Paper, Sampling::Diameter));
    let json: Vec<_> = frames.iter().map(|f| serde_json::to_value(&f.fog).unwrap()).collect();
    assert_eq!(json[0]["phase"]["hg"], "layer");
    assert_eq!(json[5]["sampling"], "diameter");
    // Defaults are no part of what a frame's digest covers: frames keep the names that they had before these keys.
    assert!(json[6].get("coefficient").is_none() && json[6].get("sampling").is_none(), "{}", json[6]);
}

#[test]
fn a_noise_target_has_a_limit_and_without_one_nothing_is_new() {
    let head = "version: 1\nname: t\nscene: none\nfog: none\nlighting: day\ncamera: {altitude_m: 2}\n";
    let plan = |render: &str| fog_plan::parse(&format!("{head}{render}"), "x.yaml", &[]).expect("valid");
    let stop = |plan: &Plan| plan.frame(0).expect("frame").render.stop.map(|s| (s.noise, s.max_samples));
    let plain = plan("render: {samples: 20}\n");
    assert_eq!(stop(&plain), None);
    assert_eq!(plain.resolved_json()["render"], serde_json::json!({ "samples": 20 }));
    let keys = serde_json::to_value(plain.frame(0).expect("frame").render).expect("json");
    assert_eq!(keys, serde_json::json!({ "samples": 20, "max_depth": null, "wavelength_nm": null }));
    // The limit is written into the resolved configuration, whoever set it.
    for (text, limit) in [("", 8192), (", samples: 10000", 10_000), (", max_samples: 300", 300)] {
        let plan = plan(&format!("render: {{noise: 0.02{text}}}\n"));
        assert_eq!(stop(&plan), Some((0.02, limit)), "{text}");
        assert_eq!(plan.resolved_json()["render"]["max_samples"], limit, "{text}");
    }
    let swept = plan("sweep: {axes: {render.noise: [0.1, 0.05]}}\n");
    assert_eq!(stop(&swept), Some((0.1, 8192)));
}

#[test]
fn budgets_and_approximations_are_part_of_a_frame_only_where_asked_for() {
    let head = "version: 1\nname: t\nscene: none\nfog: none\nlighting: day\ncamera: {altitude_m: 2}\n";
    let frame = |render: &str| {
        let plan = fog_plan::parse(&format!("{head}{render}"), "x.yaml", &[]).expect("valid");
        plan.frame(0).expect("frame").clone()
    };
    let plain = frame("");
    assert_eq!(plain.render.allocate, None);
    assert_eq!(plain.digest, frame("render: {allocate: even}\n").digest);
    let by_error = frame("render: {allocate: relative_error}\n");
    assert_eq!(by_error.render.allocate, Some(fog_plan::Allocate::RelativeError));
    assert_eq!(serde_json::to_value(by_error.render).expect("json")["allocate"], "relative_error");
    assert_ne!(plain.digest, by_error.digest);
    let similar = frame("render: {approximation: similarity}\n");
    assert_eq!(plain.render.approximation, None);
    assert_eq!(serde_json::to_value(similar.render).expect("json")["approximation"], "similarity");
    assert_ne!(plain.digest, similar.digest);
}

#[test]
fn light_groups_are_part_of_a_frame_only_where_there_are_some() {
    let json = |lighting: &str| {
        let plan = plan(&format!("lighting: {lighting}\n"));
        let frame = frames(&plan).remove(0);
        (serde_json::to_value(&frame.lighting).expect("JSON"), frame.digest)
    };
    let (plain, digest) = json("{environment: {radiance: 1}}");
    assert!(plain.get("groups").is_none());
    assert_eq!(json("{environment: {radiance: 1}, groups: []}").1, digest);
    let (grouped, other) = json(
        "{groups: [{name: a, lights: [sun, \"node:x*\"]}, {name: b, lights: [directional, \"material:y\"], intensity: 2}]}",
    );
    assert_ne!(other, digest);
    assert_eq!(
        grouped["groups"],
        serde_json::json!([
            {"name": "a", "lights": ["sun", "node:x*"]},
            {"name": "b", "lights": ["directional", "material:y"], "intensity": 2.0}
        ])
    );
}

#[test]
fn intensities_of_groups_are_axes() {
    let plan = plan(
        "lighting: {environment: {radiance: 1}, groups: [{name: sky, lights: [environment]}]}\n\
         sweep: {axes: {lighting.groups.0.intensity: [0.5, 1]}}\n",
    );
    let intensities: Vec<_> = frames(&plan).iter().map(|f| f.lighting.groups[0].intensity).collect();
    assert_eq!(intensities, [0.5, 1.0]);
}

#[test]
fn labels_are_written_only_where_something_is_said() {
    let frame = |lines: &str| {
        let text = format!("version: 1\nname: t\nscene: none\nfog: none\n{lines}");
        let plan = fog_plan::parse(&text, "t.yaml", &[]).unwrap();
        (plan.config_digest(), plan.frames().next().unwrap().unwrap())
    };
    let (plain_config, plain) = frame("");
    assert!(serde_json::to_value(&plain).unwrap().get("labels").is_none());
    let (_, same) = frame("labels: {min_pixels: 10}\n");
    assert_eq!(plain.id, same.id);
    let (one_config, one) = frame("classes: {car: \"car_*\", road: [\"road*\", {material: \"asphalt*\"}]}\n");
    let labels = serde_json::to_value(&one).unwrap()["labels"].clone();
    let classes = serde_json::json!([{"class": "car", "patterns": ["car_*"]},
        {"class": "road", "patterns": ["road*", "material:asphalt*"]}]);
    assert_eq!(labels, serde_json::json!({ "classes": classes }));
    // The order of classes is that of their numbers.
    let (other_config, other) =
        frame("classes: {road: [\"road*\", {material: \"asphalt*\"}], car: \"car_*\"}\n");
    assert!(one.id != plain.id && one.id != other.id);
    assert!(one_config != plain_config && one_config != other_config);
}
