//! What a sweep leaves on disk: the files and the pictures in them.

use crate::common::{folder, ids, names, run, sweep};
use fog_core::math;
use fog_dataset::{StoredFrame, read_frame};
use std::fs;
use std::path::Path;

const FRAME: [&str; 6] = ["done", "gt.exr", "hdr.exr", "json", "rgb.png", "timing.json"];
const FOLDER: [&str; 4] = ["config.resolved.yaml", "dataset.json", "index.csv", "plan.jsonl"];

/// Frames of clear air, of one fog above the camera and of one that ends below it.
fn three_frames() -> tempfile::TempDir {
    let dir = folder(
        "camera: {altitude_m: 30, heading_deg: 20, pitch_deg: -5, roll_deg: 3}\nsweep:\n  axes:\n    fog: [none, \
         {model: advection, height_m: 100}, \
         {model: homogeneous, height_m: 20, sigma_t_1_m: 0.03, phase: {hg: 0.83}}]\n",
    );
    sweep(dir.path(), "out").ok();
    dir
}

fn frames(dir: &Path) -> Vec<StoredFrame> {
    ids(dir).iter().map(|id| read_frame(&dir.join("out"), id).expect("readable")).collect()
}

fn channel<'a>(frame: &'a StoredFrame, name: &str) -> &'a [f32] {
    let channel = &frame.channels[name];
    assert_eq!((channel.width, channel.height), (24, 14), "{name}");
    &channel.values
}

/// All files of a data set of the frames given.
fn expected(ids: &[String], suffixes: &[&str]) -> Vec<String> {
    let own = ids.iter().flat_map(|id| suffixes.iter().map(move |suffix| format!("{id}.{suffix}")));
    let mut all: Vec<_> = own.chain(FOLDER.map(str::to_owned)).collect();
    all.sort();
    all
}

#[test]
fn files_and_channels() {
    let dir = three_frames();
    let ids = ids(dir.path());
    assert_eq!(names(&dir.path().join("out")), expected(&ids, &FRAME));
    for frame in frames(dir.path()) {
        let names: Vec<_> = frame.channels.keys().map(String::as_str).collect();
        assert_eq!(
            names,
            [
                "B",
                "G",
                "R",
                "airlight.B",
                "airlight.G",
                "airlight.R",
                "depth.Z",
                "direct.B",
                "direct.G",
                "direct.R",
                "distance.Z",
                "tau.Y",
                "transmittance.B",
                "transmittance.G",
                "transmittance.R",
            ]
        );
    }
    for id in ids {
        let png = fs::read(dir.path().join("out").join(format!("{id}.rgb.png"))).unwrap();
        assert_eq!(&png[..8], b"\x89PNG\r\n\x1a\n");
        // Width, height, 8 bits of RGB.
        assert_eq!(&png[16..26], b"\0\0\0\x18\0\0\0\x0e\x08\x02");
    }
}

#[test]
fn transmittance_is_that_of_the_optical_depth() {
    let dir = three_frames();
    let frames = frames(dir.path());
    for frame in &frames {
        for (t, tau) in channel(frame, "transmittance.G").iter().zip(channel(frame, "tau.Y")) {
            let expected = math::f64::exp(-f64::from(*tau));
            assert!((f64::from(*t) - expected).abs() < 1e-6, "{t} at {tau}");
        }
    }
    assert!(channel(&frames[0], "tau.Y").iter().all(|tau| *tau == 0.0));
    assert!(channel(&frames[1], "tau.Y").iter().all(|tau| *tau > 0.0));
}

#[test]
fn direct_and_airlight_make_the_image() {
    let dir = three_frames();
    let frames = frames(dir.path());
    for frame in &frames {
        for c in ["R", "G", "B"] {
            let (direct, airlight) =
                (channel(frame, &format!("direct.{c}")), channel(frame, &format!("airlight.{c}")));
            for (i, whole) in channel(frame, c).iter().enumerate() {
                let sum = direct[i] + airlight[i];
                assert!(
                    (sum - whole).abs() <= 2e-7 * whole.abs().max(direct[i].abs()),
                    "{sum} is not {whole}"
                );
            }
        }
    }
    let light = |frame| channel(frame, "airlight.G").iter().sum::<f32>();
    assert_eq!(light(&frames[0]), 0.0, "clear air has no airlight");
    assert!(light(&frames[1]) > 0.0 && light(&frames[2]) > 0.0);
}

#[test]
fn depth_and_distance_fit_the_intrinsics() {
    let dir = three_frames();
    for frame in frames(dir.path()) {
        let k = &frame.record["sensor"]["intrinsics"];
        let number = |key: &str| k[key].as_f64().expect(key);
        let (depth, distance) = (channel(&frame, "depth.Z"), channel(&frame, "distance.Z"));
        let mut surfaces = 0;
        for i in (0..depth.len()).filter(|&i| depth[i].is_finite()) {
            let x = ((i % 24) as f64 - number("cx_px")) / number("fx_px");
            let y = ((i / 24) as f64 - number("cy_px")) / number("fy_px");
            let expected = f64::from(depth[i]) * (1.0 + x * x + y * y).sqrt();
            assert!((f64::from(distance[i]) / expected - 1.0).abs() < 1e-5, "{} at {i}", distance[i]);
            surfaces += 1;
        }
        assert!(surfaces > 24, "the street is in view");
        assert!(depth.iter().zip(distance).all(|(z, r)| z.is_infinite() == r.is_infinite()));
    }
}

#[test]
fn one_wavelength() {
    let dir = folder("fog: {model: advection, height_m: 100}\n");
    let set = |out, set| {
        let args = ["sweep", "c.yaml", "--out", out, "--cache-dir", &crate::common::cache()];
        run(&[&args[..], &["--set", "render.wavelength_nm=550", "--set", set]].concat(), dir.path()).ok();
        let name = names(&dir.path().join(out)).into_iter().find(|n| n.ends_with(".hdr.exr")).expect("hdr");
        let id = name.trim_end_matches(".hdr.exr").to_owned();
        read_frame(&dir.path().join(out), &id).expect("readable")
    };
    let only = set("only", "outputs=[hdr]");
    assert_eq!(only.channels.keys().collect::<Vec<_>>(), ["Y"]);
    assert_eq!(only.record["render"]["wavelength_nm"], 550.0);
    let all = set("all", "seed=7");
    let names: Vec<_> = all.channels.keys().map(String::as_str).collect();
    assert_eq!(names, ["Y", "airlight.Y", "depth.Z", "direct.Y", "distance.Z", "tau.Y", "transmittance.Y"]);
    for (t, tau) in channel(&all, "transmittance.Y").iter().zip(channel(&all, "tau.Y")) {
        assert!((f64::from(*t) - math::f64::exp(-f64::from(*tau))).abs() < 1e-6, "{t} at {tau}");
    }
}

#[test]
fn only_what_was_asked_for() {
    let dir = folder("fog: none\noutputs: [depth]\n");
    sweep(dir.path(), "out").ok();
    let ids = ids(dir.path());
    assert_eq!(names(&dir.path().join("out")), expected(&ids, &["done", "gt.exr", "json", "timing.json"]));
    let frame = read_frame(&dir.path().join("out"), &ids[0]).unwrap();
    assert_eq!(frame.channels.keys().collect::<Vec<_>>(), ["depth.Z"]);
}
