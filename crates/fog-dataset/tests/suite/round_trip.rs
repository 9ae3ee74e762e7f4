//! What is written is what is read, bit by bit, and the same in every run.

use std::collections::BTreeMap;

use fog_dataset::{
    DataSet, OutputSet, Raster, Reader, StoredFrame, Values, file_of_raster, raster_names, read_exr_channels,
    read_frame, read_header, read_plan, verify,
};
use fog_film::{Channels, Frame};
use serde_json::json;

use crate::common::{contents, frame, open, open_with, planned, read_json, store, store_timed, with_files};

const MONO: Channels = Channels::Mono { wavelength_nm: 550.0 };

/// Compares one stored channel with the frame, bit by bit.
fn same(stored: &StoredFrame, name: &str, want: impl Fn(usize) -> f32) {
    let channel = stored.channels.get(name).unwrap_or_else(|| panic!("no channel {name}"));
    for (i, got) in channel.values.iter().enumerate() {
        assert_eq!(got.to_bits(), want(i).to_bits(), "{name} pixel {i}");
    }
}

fn stored(set: &DataSet, f: &Frame) -> StoredFrame {
    store(set, "f0", f).expect("written");
    read_frame(set.dir(), "f0").expect("read")
}

#[test]
fn rasters_are_alike_stored_and_not() {
    let dir = tempfile::tempdir().expect("temporary folder");
    for (folder, channels, components) in [("rgb", Channels::Rgb, 3), ("mono", MONO, 1)] {
        let (set, f) = (open(&dir.path().join(folder), 1), frame(5, 4, channels, 4));
        store(&set, "f0", &f).expect("written");
        let reader = Reader::open(set.dir()).expect("a data set");
        let mut planned = set.plan()[0].clone();
        planned.spec = json!({"lighting": {"groups": [{"name": "lamps"}, {"name": "rest"}]}});
        let unstored = with_files("f0", &f, 1.5, |files| Raster::of_frame(files, planned.outputs));
        let names = raster_names(&planned);
        assert_eq!(names.len(), unstored.len());
        for name in [
            "image",
            "hdr",
            "depth",
            "tau",
            "normals",
            "flow",
            "flow_valid",
            "instance",
            "semantic",
            "group.lamps",
        ] {
            assert!(names.iter().any(|known| known == name), "{name}");
        }
        for name in names {
            let kind = file_of_raster(&name).expect("a file");
            let path = reader.path(&planned, kind);
            let raster = if path.extension().is_some_and(|e| e == "exr") {
                Raster::take(&name, &mut reader.channels(&planned, kind).expect("read"))
                    .expect("its channels")
            } else {
                reader.raster(&planned, kind).expect("read")
            };
            let want = unstored.get(&name).unwrap_or_else(|| panic!("{name} is not there"));
            assert_eq!(format!("{raster:?}"), format!("{want:?}"), "{name}");
        }
        assert_eq!(unstored["hdr"].components, components);
        let Values::F32(hdr) = &unstored["hdr"].values else { panic!("radiance is f32") };
        assert_eq!(hdr[7 * components..8 * components], f.image(7)[..components]);
    }
    assert_eq!((file_of_raster("objects"), file_of_raster("depht")), (None, None));
}

#[test]
fn every_channel_comes_back_bit_by_bit() {
    let dir = tempfile::tempdir().expect("temporary folder");
    let f = frame(33, 17, Channels::Rgb, 4);
    let s = stored(&open(dir.path(), 1), &f);
    assert_eq!(s.channels.len(), 11 + 6 + 6 + 12 + 4);
    for (c, name) in ["R", "G", "B"].into_iter().enumerate() {
        same(&s, name, |i| f.image(i)[c]);
        same(&s, &format!("direct.{name}"), |i| f.direct[i][c]);
        same(&s, &format!("airlight.{name}"), |i| f.airlight[i][c]);
        same(&s, &format!("transmittance.{name}"), |i| f.truth.transmittance[i][c]);
        same(&s, &format!("group.lamps.{name}"), |i| f.groups[0].radiance[i][c]);
        same(&s, &format!("group.rest.{name}"), |i| f.groups[1].radiance[i][c]);
        let (d, a) = (&s.channels[&format!("direct.{name}")], &s.channels[&format!("airlight.{name}")]);
        same(&s, name, |i| d.values[i] + a.values[i]);
    }
    same(&s, "standard_error.Y", |i| f.standard_error[i]);
    same(&s, "samples.Y", |i| f.samples[i] as f32);
    same(&s, "depth.Z", |i| f.truth.depth_m[i]);
    same(&s, "distance.Z", |i| f.truth.distance_m[i]);
    same(&s, "tau.Y", |i| f.truth.tau[i]);
    for (c, name) in ["X", "Y", "Z"].into_iter().enumerate() {
        same(&s, &format!("N.{name}"), |i| f.truth.surface.normal[i][c]);
        same(&s, &format!("P.{name}"), |i| f.truth.surface.position[i][c]);
    }
    same(&s, "albedo.G", |i| f.truth.surface.albedo[i][1]);
    same(&s, "flow.Y", |i| f.truth.surface.flow[i][1]);
    same(&s, "flow_valid.Y", |i| f.truth.surface.flow_valid[i]);
    let instance = |i: usize| f.truth.surface.instance[i];
    same(&s, "CryptoObject00.G", |i| f32::from(instance(i).min(1)));
    let id = |i: usize| s.channels["CryptoObject00.R"].values[i].to_bits();
    let ids: BTreeMap<u16, u32> = (0..33 * 17).map(|i| (instance(i), id(i))).collect();
    same(&s, "CryptoObject00.R", |i| f32::from_bits(ids[&instance(i)]));
    assert_eq!((ids.len(), ids[&0]), (3, 0));
    assert!(ids[&1] != ids[&301] && ids[&1] != 0 && ids[&301] != 0);
    let labels = |kind: &str| image::open(dir.path().join(format!("f0.{kind}.png"))).expect("a PNG");
    let (semantic, instance) = (labels("semantic"), labels("instance"));
    assert_eq!(semantic.color(), image::ColorType::L8);
    assert_eq!(semantic.into_luma8().into_raw(), f.truth.surface.semantic);
    assert_eq!(instance.color(), image::ColorType::L16);
    assert_eq!(instance.into_luma16().into_raw(), f.truth.surface.instance);
    let depth = &s.channels["depth.Z"];
    assert_eq!((depth.width, depth.height), (33, 17));
    assert_eq!(depth.values[0], f32::INFINITY, "sky, in row 0 at the top");
    assert!(depth.values[32 + 16 * 33].is_finite());

    let png = image::open(dir.path().join("f0.rgb.png")).expect("a PNG").into_rgb8();
    assert_eq!(png.dimensions(), (33, 17));
    assert_eq!(png.into_raw(), f.to_srgb8(1.25));
    assert_eq!(s.record, read_json(&dir.path().join("f0.json")));
}

#[test]
fn one_wavelength_has_one_channel() {
    let dir = tempfile::tempdir().expect("temporary folder");
    let f = frame(8, 6, MONO, 4);
    let s = stored(&open(dir.path(), 1), &f);
    let names: Vec<&str> = s.channels.keys().map(String::as_str).collect();
    assert_eq!(
        names,
        [
            "CryptoObject00.A",
            "CryptoObject00.B",
            "CryptoObject00.G",
            "CryptoObject00.R",
            "N.X",
            "N.Y",
            "N.Z",
            "P.X",
            "P.Y",
            "P.Z",
            "Y",
            "airlight.Y",
            "albedo.B",
            "albedo.G",
            "albedo.R",
            "depth.Z",
            "direct.Y",
            "distance.Z",
            "flow.X",
            "flow.Y",
            "flow_valid.Y",
            "group.lamps.Y",
            "group.rest.Y",
            "samples.Y",
            "standard_error.Y",
            "tau.Y",
            "transmittance.Y"
        ]
    );
    same(&s, "Y", |i| f.image(i)[0]);
    same(&s, "transmittance.Y", |i| f.truth.transmittance[i][0]);
}

#[test]
fn only_the_wanted_outputs_are_written() {
    let dir = tempfile::tempdir().expect("temporary folder");
    let sets = [["airlight", "tau"], ["image", "image"], ["depth", "depth"]];
    let plan = sets.iter().enumerate();
    let plan = plan.map(|(i, s)| planned(&format!("f{i}"), OutputSet::from_names(s).expect("known")));
    let set = open_with(dir.path(), "a: 1\n", "c", plan.collect()).expect("a data set");
    for i in 0..3 {
        store(&set, &format!("f{i}"), &frame(8, 6, Channels::Rgb, 2)).expect("written");
    }
    let pictures: Vec<String> =
        contents(dir.path()).into_keys().filter(|n| n.matches('.').count() == 2).collect();
    assert_eq!(pictures, ["config.resolved.yaml", "f0.gt.exr", "f0.hdr.exr", "f1.rgb.png", "f2.gt.exr"]);
    let s = read_frame(dir.path(), "f0").expect("read");
    let names: Vec<&str> = s.channels.keys().map(String::as_str).collect();
    assert_eq!(names, ["airlight.B", "airlight.G", "airlight.R", "tau.Y"]);
    assert_eq!(set.finish().expect("an index").done, 3);
}

#[test]
fn a_denoised_picture_is_kept_beside_the_rendered() {
    let dir = tempfile::tempdir().expect("temporary folder");
    let set = open(dir.path(), 1);
    let f = frame(8, 6, Channels::Rgb, 4);
    store(&set, "f0", &f).expect("written");
    let channels = |file: &str| read_exr_channels(&dir.path().join(file)).expect("channels");
    let (rendered, denoised) = (channels("f0.hdr.exr"), channels("f0.denoised.exr"));
    assert_eq!(denoised.len(), 3);
    for (name, channel) in &denoised {
        let half: Vec<f32> =
            f.direct.iter().map(|rgb| 0.5 * rgb["RGB".find(name.as_str()).unwrap()]).collect();
        assert!(channel.values == half && rendered[name].values != half, "{name}");
    }
    let details = read_json(&dir.path().join("f0.denoised.json"));
    assert_eq!(
        (&details["library"], &details["files"][1]["name"]),
        (&json!("half"), &json!("f0.denoised.png"))
    );
    // The marker does not know them, but a frame that lacks them is not done, and changes are found.
    assert!(!contents(dir.path())["f0.done"].windows(8).any(|word| word == b"denoised"));
    assert!(set.is_intact("f0"));
    std::fs::write(dir.path().join("f0.denoised.exr"), "").expect("written");
    assert!(!set.is_done("f0"));
    let problems = verify(dir.path()).expect("readable").problems;
    assert_eq!(problems.iter().map(|p| p.file.as_str()).collect::<Vec<_>>(), ["f0.denoised.exr"]);
    std::fs::remove_file(dir.path().join("f0.denoised.json")).expect("removed");
    assert!(!set.is_done("f0"));
}

#[test]
fn two_runs_give_the_same_bytes() {
    let run = |seconds: f64| -> BTreeMap<String, Vec<u8>> {
        let dir = tempfile::tempdir().expect("temporary folder");
        let set = open(dir.path(), 2);
        store_timed(&set, "f0", &frame(64, 36, Channels::Rgb, 4), seconds).expect("written");
        store_timed(&set, "f1", &frame(16, 9, MONO, 4), seconds).expect("written");
        set.finish().expect("an index");
        contents(dir.path())
    };
    let first = run(1.0);
    assert_eq!(first.len(), 5 + 2 * 14);
    for i in 0..8 {
        assert!(run(f64::from(i)) == first, "run {i} differs");
    }
}

#[test]
fn marker_timing_and_headers_say_what_they_should() {
    let dir = tempfile::tempdir().expect("temporary folder");
    let set = open(dir.path(), 1);
    store(&set, "f0", &frame(16, 9, Channels::Rgb, 4)).expect("written");
    let timing = read_json(&dir.path().join("f0.timing.json"));
    assert_eq!(timing["seconds"], 1.5);
    assert_eq!(timing["samples_per_second"], 384.0);
    let marker = read_json(&dir.path().join("f0.done"));
    assert_eq!(marker["code_digest"], "code-1");
    let names: Vec<&str> = marker["files"]
        .as_array()
        .expect("files")
        .iter()
        .map(|f| f["name"].as_str().expect("a name"))
        .collect();
    assert_eq!(
        names,
        [
            "f0.rgb.png",
            "f0.hdr.exr",
            "f0.gt.exr",
            "f0.json",
            "f0.semantic.png",
            "f0.instance.png",
            "f0.objects.json",
            "f0.raw.png",
            "f0.clear.exr",
            "f0.clear.rgb.png"
        ]
    );
    let record = std::fs::read_to_string(dir.path().join("f0.json")).expect("a record");
    assert_eq!(record, "{\n  \"id\": \"f0\",\n  \"samples\": 4\n}\n");

    let header = read_header(dir.path()).expect("a header");
    assert_eq!((header.name.as_str(), header.frames), ("test", 1));
    assert_eq!(read_plan(dir.path()).expect("a plan"), set.plan());
    assert!(read_frame(dir.path(), "../f0").is_err());
}

#[test]
fn classes_belong_to_the_data_set_and_layers_that_are_asked_for_must_be_there() {
    let dir = tempfile::tempdir().expect("temporary folder");
    let set = open(dir.path(), 1);
    let classes = dir.path().join("classes.json");
    assert_eq!(read_json(&classes), json!([{ "id": 7, "name": "road" }]));
    let mut f = frame(8, 6, Channels::Rgb, 2);
    store(&set, "f0", &f).expect("written");
    set.finish().expect("an index");
    assert!(verify(dir.path()).expect("readable").is_complete());
    std::fs::write(&classes, "[]").expect("written");
    std::fs::write(dir.path().join("f0.instance.png"), "").expect("written");
    let problems = verify(dir.path()).expect("readable").problems;
    let files: Vec<_> = problems.iter().map(|p| p.file.as_str()).collect();
    assert_eq!(files, ["classes.json", "f0.instance.png"]);
    assert!(!set.is_done("f0"));
    open(dir.path(), 1);
    assert_eq!(read_json(&classes), json!([{ "id": 7, "name": "road" }]));

    f.truth.surface.semantic.pop();
    let e = store(&set, "f0", &f).expect_err("too short").to_string();
    assert!(e.contains("semantic"), "{e}");
    f.truth.surface.semantic.clear();
    let e = store(&set, "f0", &f).expect_err("not there").to_string();
    assert!(e.contains("f0.semantic.png") && e.contains("was not given"), "{e}");
    f.truth.surface.normal.clear();
    let e = store(&set, "f0", &f).expect_err("not there").to_string();
    assert!(e.contains("f0.gt.exr") && e.contains("was not given"), "{e}");
    f.truth.surface.instance[0] = 302;
    let e = store(&set, "f0", &f).expect_err("one name too few").to_string();
    assert!(e.contains("f0.gt.exr") && e.contains("has no name"), "{e}");
}
