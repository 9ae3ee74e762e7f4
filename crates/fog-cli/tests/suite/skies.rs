//! Surroundings of a scene.

use crate::common::{config, ids, read_json, run, sweep, write};
use fogbank::dataset::read_picture;
use std::path::Path;

/// A configuration of empty space with this lighting, and its lines.
fn lit(lighting: &str, lines: &str) -> String {
    config(&format!("scene: none\nfog: none\nlighting: {lighting}\noutputs: [image, hdr]\n{lines}"))
}

/// Renders a picture of 48 × 24 px into `dir/image.exr`: fog towards the horizon under an even sky and a low sun.
fn make_image(dir: &Path) {
    let text =
        lit("{environment: {radiance: 0.5}, sun: {elevation_deg: 10, azimuth_deg: 20, irradiance: 3}}", "")
            .replace(
                "fog: none",
                "fog: {model: homogeneous, height_m: 50, sigma_t_1_m: 0.02, phase: {hg: 0.6}}",
            )
            .replace("width_px: 24, height_px: 14", "width_px: 48, height_px: 24");
    write(dir, "c.yaml", text);
    sweep(dir, "first").ok();
    let id = ids(dir)[0].clone();
    std::fs::copy(dir.join(format!("first/{id}.hdr.exr")), dir.join("image.exr")).expect("copy");
}

#[test]
fn an_image_around_the_scene() {
    let dir = tempfile::tempdir().expect("temporary folder");
    make_image(dir.path());
    let image = read_picture(&dir.path().join("image.exr")).expect("a picture");
    // The camera looks at the column 90° right of the image's centre, by itself or by the image's rotation.
    let axes = "sweep: {axes: {lighting.environment.rotation_deg: [0, -90], camera.heading_deg: [0, 90]}}\n";
    write(dir.path(), "c.yaml", lit("{environment: {image: image.exr, scale: 2}}", axes));
    sweep(dir.path(), "out").ok();
    let ids = ids(dir.path());
    let frame =
        |k: usize| read_picture(&dir.path().join(format!("out/{}.hdr.exr", ids[k]))).expect("a picture");
    // Frames 1 and 2 see the same, through other samples.
    let at = |picture: &fogbank::film::Picture, x: u32, y: u32| picture.rgb[(y * picture.width + x) as usize];
    for k in [1, 2] {
        let seen = at(&frame(k), 12, 5);
        let there = at(&image, 36, 10);
        for c in 0..3 {
            let ratio = seen[c] / there[c];
            assert!((1.6..2.4).contains(&ratio), "frame {k}, channel {c}: {seen:?} for twice {there:?}");
        }
    }
    let record = read_json(&dir.path().join(format!("out/{}.json", ids[2])));
    let environment = &record["lighting"]["environment"];
    assert_eq!(environment["image"], "image.exr");
    assert_eq!(environment["scale"], 2.0);
    assert_eq!(environment["rotation_deg"], -90.0);
    assert_eq!(environment["blake3"].as_str().map(str::len), Some(64));

    let args = ["replay", "c.yaml", "--frame", "0", "--pixel", "3,4", "--sample", "1"];
    let told = run(&args, dir.path()).ok().stdout;
    assert!(told.contains("the sky\n     shines and adds"), "{told}");

    // Another content of the file is another data set.
    std::fs::remove_file(dir.path().join(format!("out/{}.done", ids[0]))).expect("remove");
    let mut bytes = std::fs::read(dir.path().join("image.exr")).expect("read");
    let last = bytes.len() - 1;
    bytes[last] ^= 1;
    write(dir.path(), "image.exr", bytes);
    let again = sweep(dir.path(), "out");
    assert_ne!(again.code, Some(0));
    assert!(again.stderr.contains("image.exr"), "{}", again.stderr);
}

#[test]
fn images_that_cannot_be_used() {
    let dir = tempfile::tempdir().expect("temporary folder");
    let refused = |image: &str| {
        write(dir.path(), "c.yaml", lit(&format!("{{environment: {{image: {image}}}}}"), ""));
        let run = sweep(dir.path(), "out");
        assert_ne!(run.code, Some(0));
        run.stderr
    };
    let missing = refused("missing.exr");
    assert!(missing.contains("lighting.environment.image: missing.exr: cannot be read"), "{missing}");
    write(dir.path(), "text.exr", "no picture");
    let text = refused("text.exr");
    assert!(text.contains("it is neither PNG nor JPEG nor Radiance HDR nor OpenEXR"), "{text}");
    // Radiance HDR: 2 × 1 and 1 × 1 px of RGBE (1, 1, 1); the first is too small.
    let hdr = |size: &str, pixels: &[u8]| {
        [format!("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n{size}\n").as_bytes(), pixels].concat()
    };
    write(dir.path(), "square.hdr", hdr("-Y 1 +X 1", &[128, 128, 128, 129]));
    let square = refused("square.hdr");
    assert!(square.contains("1 × 1 px; an equirectangular image is twice as wide as high"), "{square}");
    write(dir.path(), "small.hdr", hdr("-Y 1 +X 2", &[128, 128, 128, 129, 128, 128, 128, 129]));
    let small = refused("small.hdr");
    assert!(small.contains("2 × 1 px is no size for an environment"), "{small}");
    write(dir.path(), "black.hdr", hdr("-Y 2 +X 4", &[0; 32]));
    assert!(refused("black.hdr").contains("it is black everywhere"));
}

#[test]
fn skies_by_day_and_night() {
    let dir = tempfile::tempdir().expect("temporary folder");
    let lightings = [
        "{sky: {model: overcast, zenith_luminance_cd_m2: 4000, color_temperature_k: 6000}, luminance_of_one_cd_m2: 4000}",
        "{sky: {model: cie, cie_type: 12, horizontal_illuminance_lx: 15000}, luminance_of_one_cd_m2: 1000, \
         sun: {elevation_deg: 40, azimuth_deg: 90, irradiance: 20, color_temperature_k: 5000}}",
        "{sky: {model: clear}, luminance_of_one_cd_m2: 1000, sun: {elevation_deg: 40, azimuth_deg: 90}}",
        "{sky: {model: clear}, luminance_of_one_cd_m2: 1, sun: {elevation_deg: -6, azimuth_deg: 90}}",
        "{sky: {model: clear}, luminance_of_one_cd_m2: 1e-3, sun: {elevation_deg: -50, azimuth_deg: 0}, \
         moon: {elevation_deg: 80, azimuth_deg: 180}}",
        "{sky: {model: clear}, luminance_of_one_cd_m2: 1e-4}",
    ];
    // The camera looks straight up, away from the discs; 60 paths, for colours by eight wavelengths are noisy.
    let text = lit(
        "day",
        &format!("camera: {{pitch_deg: 90}}\nsweep: {{axes: {{lighting: [{}]}}}}\n", lightings.join(", ")),
    )
    .replace("samples: 3", "samples: 60")
    .replace("horizontal_fov_deg: 60", "horizontal_fov_deg: 4");
    write(dir.path(), "c.yaml", text);
    sweep(dir.path(), "out").ok();
    let ids = ids(dir.path());
    let state = |k: usize| {
        let record = read_json(&dir.path().join(format!("out/{}.json", ids[k])));
        let of_one = record["lighting"]["luminance_of_one_cd_m2"].as_f64().unwrap_or(1.0);
        (record["lighting"]["sky"]["state"].clone(), of_one)
    };
    for k in 0..lightings.len() {
        let picture = read_picture(&dir.path().join(format!("out/{}.hdr.exr", ids[k]))).expect("a picture");
        let (state, of_one) = state(k);
        // What is seen, times what 1 stands for, is the sky that the record tells of.
        let count = picture.rgb.len() as f64;
        for c in 0..3 {
            let seen = picture.rgb.iter().map(|p| f64::from(p[c])).sum::<f64>() / count * of_one;
            let told = state["zenith_linear_srgb"][c].as_f64().expect("a number");
            assert!((seen / told - 1.0).abs() < 0.06, "sky {k}, channel {c}: {seen} for {told}; {state}");
        }
    }
    let number = |k: usize, path: &str| state(k).0.pointer(path).and_then(|v| v.as_f64()).unwrap_or(f64::NAN);
    let near = |value: f64, want: f64, share: f64| {
        assert!((value / want - 1.0).abs() < share, "{value} for {want}");
    };
    near(number(0, "/zenith_luminance_cd_m2"), 4000.0, 2e-3);
    near(number(0, "/horizontal_illuminance_lx"), 4000.0 * 7.0 / 9.0 * std::f64::consts::PI, 2e-3);
    near(number(1, "/horizontal_illuminance_lx"), 15_000.0, 1e-3);
    // Noon, the end of civil twilight (3.4 lx), the full moon (0.27 lx in the zenith), a moonless night (6e-4 lx): Seidelmann 1992.
    near(
        number(2, "/horizontal_illuminance_lx") + number(2, "/disc/horizontal_illuminance_lx"),
        66_000.0,
        0.3,
    );
    near(number(3, "/horizontal_illuminance_lx"), 3.4, 0.3);
    assert!(state(3).0["disc"].is_null(), "{}", state(3).0);
    assert_eq!(state(4).0["disc"]["source"], "moon");
    near(number(4, "/horizontal_illuminance_lx") + number(4, "/disc/horizontal_illuminance_lx"), 0.267, 0.25);
    near(number(5, "/horizontal_illuminance_lx"), 6e-4, 0.3);
}
