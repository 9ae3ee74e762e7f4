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

/// A configuration of an even white view, with these keys of the sensor and other lines.
fn white(sensor: &str, lines: &str) -> tempfile::TempDir {
    let dir = tempfile::tempdir().expect("temporary folder");
    let config = format!(
        "version: 1\nname: t\nseed: 7\nscene: none\nlighting: {{environment: {{radiance: 1}}}}\nrender: {{samples: 64}}\n\
         sensor: {{width_px: 24, height_px: 14, {sensor}}}\n{lines}"
    );
    crate::common::write(dir.path(), "c.yaml", config);
    dir
}

/// Numbers of a 16-bit grey PNG, and the names of its chunks.
fn raw(path: &Path) -> (Vec<u16>, Vec<String>) {
    let bytes = std::fs::read(path).expect("a raw picture");
    let (mut chunks, mut at) = (Vec::new(), 8);
    while at < bytes.len() {
        let length = u32::from_be_bytes(bytes[at..at + 4].try_into().expect("four bytes")) as usize;
        chunks.push(String::from_utf8(bytes[at + 4..at + 8].to_vec()).expect("a name"));
        at += 12 + length;
    }
    let picture = image::load_from_memory(&bytes).expect("a PNG");
    let image::DynamicImage::ImageLuma16(grey) = picture else { panic!("not 16-bit grey") };
    (grey.into_raw(), chunks)
}

const QUIET: &str = "photon_noise: false, read_noise_e: 0, dark_current_e_s: 0";

#[test]
fn a_raw_picture_without_noise_is_arithmetic() {
    let dir = folder(&format!(
        "fog: none\noutputs: [image, hdr, raw]\n\
         sweep: {{axes: {{sensor.model: [{{bayer: grbg, adc_bits: 14, black_level: 100, gain: 4, {QUIET}}}, imx174, none]}}}}\n"
    ));
    let config = std::fs::read_to_string(dir.path().join("c.yaml")).expect("config").replace(", none]", "]");
    crate::common::write(dir.path(), "c.yaml", config);
    sweep(dir.path(), "out").ok();
    let (ids, out) = (ids(dir.path()), dir.path().join("out"));
    let (numbers, chunks) = raw(&out.join(format!("{}.raw.png", ids[0])));
    assert_eq!(chunks, ["IHDR", "IDAT", "IEND"]);
    let channels = hdr(dir.path(), &ids[0]);
    for (i, &number) in numbers.iter().enumerate() {
        // G R / B G.
        let c = [["G", "R"], ["B", "G"]][i / 24 % 2][i % 24 % 2];
        let value = f64::from(channels[c].values[i]).clamp(0.0, 1.0);
        let want = (100.0 + value * (16_383.0 - 100.0) + 0.5).floor() as u16;
        assert!(number.abs_diff(want) <= 1, "pixel {i}: {number} for {want}");
    }
    let record = read_json(&out.join(format!("{}.json", ids[0])));
    let taken = &record["sensor"]["raw"];
    assert_eq!((taken["black_level"].as_u64(), taken["white_level"].as_u64()), (Some(100), Some(16_383)));
    assert_eq!((&taken["pattern"], &taken["opencv_code"]), (&"GRBG".into(), &"COLOR_BayerGB2BGR".into()));
    assert_eq!(taken["saturation_e"], 2500.0);
    assert!((taken["gain_dn_per_e"].as_f64().expect("a number") - 16_283.0 / 2500.0).abs() < 1e-9);
    assert!(taken["noise"]["render_rms_e"].as_f64().expect("a number") > 0.0);
    assert_eq!(taken["noise"]["sensor_rms_e"], 0.0);
    // Listed where files are listed.
    let index = std::fs::read_to_string(out.join("index.csv")).expect("index");
    assert!(index.lines().next().expect("a head").ends_with("objects_file,raw_file"), "{index}");
    assert!(index.contains(&format!("{}.raw.png", ids[1])), "{index}");
    let marker = std::fs::read_to_string(out.join(format!("{}.done", ids[0]))).expect("marker");
    assert!(marker.contains(&format!("{}.raw.png", ids[0])));
    // The noisy one is 12 bits wide.
    let (noisy, _) = raw(&out.join(format!("{}.raw.png", ids[1])));
    assert!(noisy.iter().all(|&v| v <= 4095) && noisy != numbers);
}

#[test]
fn white_is_developed_to_white() {
    let models = ["cie", "nikon_d5100", "{file: curves.csv}"]
        .map(|response| format!("{{adc_bits: 14, response: {response}, {QUIET}}}"));
    let dir = white(
        "exposure: 0.5",
        &format!(
            "fog: none\noutputs: [image, raw]\nsweep: {{axes: {{sensor.model: [{}]}}}}\n",
            models.join(", ")
        ),
    );
    let curves = "wavelength_nm,qe_red,qe_green,qe_blue\n400,0,0,0.3\n500,0,0.4,0.4\n550,0.1,0.5,0.1\n600,0.3,0.2,0\n700,0.1,0,0\n";
    crate::common::write(dir.path(), "curves.csv", curves);
    sweep(dir.path(), "out").ok();
    for id in ids(dir.path()) {
        let picture =
            image::open(dir.path().join(format!("out/{id}.rgb.png"))).expect("a picture").into_rgb8();
        // Colour noise of the paths' wavelengths remains.
        assert!(picture.as_raw().iter().all(|v| v.abs_diff(188) <= 3), "{id}: {:?}", &picture.as_raw()[..12]);
        let record = read_json(&dir.path().join(format!("out/{id}.json")));
        let balance = record["sensor"]["raw"]["white_balance"].as_array().expect("three factors");
        assert!((balance[1].as_f64().expect("a number") - 1.0).abs() < 1e-6);
        let with_file = record["sensor"]["model"]["response"].get("file").is_some();
        assert_eq!(record["sensor"]["raw"].get("response_blake3").is_some(), with_file);
    }
    // Other curves under the same name are noticed.
    crate::common::write(dir.path(), "curves.csv", curves.replace("0.5", "0.6"));
    let again = sweep(dir.path(), "out");
    assert_ne!(again.code, Some(0));
    assert!(again.stderr.contains("curves.csv"), "{}", again.stderr);
}

#[test]
fn curves_that_cannot_be_had_are_named() {
    let dir = white("model: {response: {file: none.csv}}", "fog: none\noutputs: [raw]\n");
    let run = sweep(dir.path(), "out");
    assert_eq!(run.code, Some(2), "{}", run.stderr);
    assert!(
        run.stderr.contains("sensor.model.response") && run.stderr.contains("none.csv"),
        "{}",
        run.stderr
    );
    crate::common::write(dir.path(), "none.csv", "wavelength_nm,red,green,blue\n400,1,1\n");
    let run = sweep(dir.path(), "out");
    let want = "sensor.model.response: none.csv: line 2: expected 4 numbers, found 3";
    assert!(run.stderr.contains(want), "{}", run.stderr);
}

#[test]
fn noise_is_of_the_physical_exposure_and_of_the_seed() {
    // D65 of 1000 cd/m² at ISO 800, 1/100 s, f/4: 78/800 lx·s saturate.
    let exposure = "exposure: {iso: 800, shutter_s: 0.01, f_number: 4, lens_transmission: 0.64}";
    let model = "model: {adc_bits: 16, pixel_um: 3, quantum_efficiency: 0.5, full_well_e: 100000, read_noise_e: 0, \
                 dark_current_e_s: 0";
    let sensor = |more: &str| format!("{exposure}, {model}{more}}}");
    let lines = "fog: none\noutputs: [raw]\n";
    let dir = white(&sensor(""), lines);
    let config = std::fs::read_to_string(dir.path().join("c.yaml")).expect("config");
    let config = config
        .replace("environment: {radiance: 1}", "environment: {radiance: 1}, luminance_of_one_cd_m2: 100");
    let config = config.replace("width_px: 24, height_px: 14", "width_px: 64, height_px: 64");
    crate::common::write(dir.path(), "c.yaml", &config);
    sweep(dir.path(), "out").ok();
    let id = &ids(dir.path())[0];
    let record = read_json(&dir.path().join(format!("out/{id}.json")));
    let taken = &record["sensor"]["raw"];
    let number = |key: &str| taken[key].as_f64().expect("a number");
    // Electrons of saturation: 78/800 lx·s × 9 µm² × 0.5 × photons of D65 weighed with V (4.1e15 per lx·s·m², 2 %).
    assert!((number("saturation_e") / (0.0975 * 9e-12 * 0.5 * 4.09e15) - 1.0).abs() < 0.02, "{taken}");
    assert_eq!(number("iso"), 800.0);
    let (numbers, _) = raw(&dir.path().join(format!("out/{id}.raw.png")));
    let k = number("gain_dn_per_e");
    let electrons: Vec<f64> = numbers.iter().map(|&v| (f64::from(v) - number("black_level")) / k).collect();
    let mean = electrons.iter().sum::<f64>() / 4096.0;
    let lx_s = 100.0 * std::f64::consts::FRAC_PI_4 * 0.64 * 0.01 / 16.0;
    let want = number("saturation_e") * lx_s / 0.0975;
    assert!((mean / want - 1.0).abs() < 0.02, "{mean} {want}");
    // The variance is the mean's, and a little of the rendering's.
    let variance = electrons.iter().map(|e| (e - mean).powi(2)).sum::<f64>() / 4095.0;
    assert!((variance / mean - 1.0).abs() < 0.15, "{variance} {mean}");
    // The same for one thread and for two, other for another seed of the noise, which does not touch the light.
    let args = ["--threads", "1"];
    let cache = crate::common::cache();
    let one = [&["sweep", "c.yaml", "--out", "one", "--cache-dir", &cache], &args[..]].concat();
    crate::common::run(&one, dir.path()).ok();
    crate::common::assert_same(&dir.path().join("out"), &dir.path().join("one"));
}

#[test]
fn clear_air_beside_fog() {
    let dir = white(
        "horizontal_fov_deg: 60",
        "outputs: [image, hdr, transmittance, direct, pair]\ncamera: {pitch_deg: 45}\n\
         sweep: {axes: {fog: [none, {model: homogeneous, height_m: 60, sigma_t_1_m: 0.01, phase: {hg: 0.8}}]}}\n",
    );
    sweep(dir.path(), "out").ok();
    let (ids, out) = (ids(dir.path()), dir.path().join("out"));
    let clear = |k: usize| read_exr_channels(&out.join(format!("{}.clear.exr", ids[k]))).expect("clear.exr");
    // Without fog it is the frame itself.
    assert_eq!(clear(0)["G"].values, hdr(dir.path(), &ids[0])["G"].values);
    let png =
        |k: usize, kind: &str| std::fs::read(out.join(format!("{}.{kind}", ids[k]))).expect("a picture");
    assert_eq!(png(0, "rgb.png"), png(0, "clear.rgb.png"));
    // In fog the sky is as bright as without, and what comes straight from it is transmittance times that.
    let clear = clear(1);
    let foggy = hdr(dir.path(), &ids[1]);
    let truth = read_exr_channels(&out.join(format!("{}.gt.exr", ids[1]))).expect("gt.exr");
    let mean = |values: &[f32]| values.iter().map(|&v| f64::from(v)).sum::<f64>() / values.len() as f64;
    assert!((mean(&clear["G"].values) - 1.0).abs() < 0.01);
    let want = mean(&truth["transmittance.G"].values) * mean(&clear["G"].values);
    let got = mean(&foggy["direct.G"].values);
    // 336 pixels of 64 paths, each through or not.
    assert!((got - want).abs() < 5.0 * 0.5 / (336.0f64 * 64.0).sqrt(), "{got} {want}");
    let record = read_json(&out.join(format!("{}.json", ids[1])));
    assert_eq!(record["pair"]["files"][0], format!("{}.clear.exr", ids[1]));
    let index = std::fs::read_to_string(out.join("index.csv")).expect("index");
    assert!(
        index.lines().next().expect("a head").ends_with("objects_file,clear_file,clear_image_file"),
        "{index}"
    );
}
