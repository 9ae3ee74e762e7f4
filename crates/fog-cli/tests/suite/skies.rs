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
