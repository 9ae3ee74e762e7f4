//! Test frames and data sets.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use fog_dataset::{
    Attribute, CameraPicture, ClearPicture, DataSet, DataSetInfo, DenoisedPicture, FrameFiles, Opening,
    OutputSet, PlanFrame, Result, View,
};
use fog_film::{Channels, Frame, GroupLayer, PixelFilm, SurfaceTruth, Truth};
use serde_json::{Map, Value, json};

/// A deterministic number in [0, 1).
fn noise(state: &mut u64) -> f32 {
    *state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
    (*state >> 40) as f32 / (1u64 << 24) as f32
}

/// A street in fog, roughly: sky above, walls beside, a ground below, all checkered, airlight that grows with distance, noise of `samples`.
pub(crate) fn frame(width: u32, height: u32, channels: Channels, samples: u32) -> Frame {
    let n = (width * height) as usize;
    let mut pixels = vec![PixelFilm::default(); n];
    let mut truth = Truth::default();
    let mut state = 1;
    for (i, pixel) in pixels.iter_mut().enumerate() {
        let (x, y) = (i as u32 % width, i as u32 / width);
        let below = 2.0 * (y as f32 + 0.5) / height as f32 - 1.0;
        let slope = (2 * x) as f32 / width as f32 - 1.0;
        let ground = if below > 0.0 { 2.0 / below } else { f32::INFINITY };
        let wall = if below > -0.7 && slope.abs() > 0.1 { 8.0 / slope.abs() } else { f32::INFINITY };
        let depth = ground.min(wall);
        let distance = depth * (1.0 + slope * slope).sqrt();
        let t = 1.0 / (1.0 + 0.05 * distance.min(1.0e4));
        truth.depth_m.push(depth);
        truth.distance_m.push(distance);
        truth.transmittance.push([t, 0.99 * t, 0.98 * t]);
        truth.tau.push(0.05 * distance.min(1.0e4));
        add_surface(&mut truth.surface, [below, slope, depth], ground < wall);
        let check = if (x / 8 + y / 8) % 2 == 0 { 0.8 } else { 0.2 };
        for _ in 0..samples {
            let direct = t * check * 2.0 * noise(&mut state);
            let air = (1.0 - t) * 2.0 * noise(&mut state);
            match channels {
                Channels::Rgb => {
                    pixel
                        .add([direct, 0.9 * direct * noise(&mut state), 0.8 * direct], [air, air, 1.1 * air]);
                }
                Channels::Mono { .. } => pixel.add_mono(direct, air),
            }
        }
    }
    let mut frame = Frame::from_pixels(width, height, channels, &pixels, truth).expect("a valid frame");
    // Two groups of lights: one made the direct light, one the rest.
    frame.groups = [("lamps", &frame.direct), ("rest", &frame.airlight)]
        .map(|(name, radiance)| GroupLayer { name: name.to_owned(), radiance: radiance.clone() })
        .to_vec();
    frame
}

/// What is at a pixel: ground or wall or sky, and how it moves as the camera goes on.
fn add_surface(truth: &mut SurfaceTruth, [below, slope, depth]: [f32; 3], ground: bool) {
    let sky = depth.is_infinite();
    let normal = if ground { [0.0, 1.0, 0.0] } else { [-slope.signum(), 0.0, 0.0] };
    truth.normal.push(if sky { [0.0; 3] } else { normal });
    let position = [slope * depth, 2.0 - below * depth, -depth];
    truth.position.push(if sky { [f32::NAN; 3] } else { position });
    truth.albedo.push(if sky { [0.0; 3] } else { [0.4, 0.3, 0.2] });
    truth.semantic.push(if sky { 23 } else { 7 + 4 * u8::from(!ground) });
    truth.instance.push(if sky { 0 } else { 1 + 300 * u16::from(!ground) });
    truth.flow.push(if sky { [0.0; 2] } else { [100.0 * slope / depth, 100.0 * below / depth] });
    truth.flow_valid.push(f32::from(depth < 50.0));
}

/// One frame of a plan.
pub(crate) fn planned(id: &str, outputs: OutputSet) -> PlanFrame {
    let mut axes = Map::new();
    axes.insert("camera.altitude_m".to_owned(), json!(2));
    PlanFrame { id: id.to_owned(), pair_id: Some("p0".to_owned()), axes, outputs, spec: json!({ "seed": 1 }) }
}

/// Opens a data set with the given configuration; the difference of two is their whole text.
pub(crate) fn open_with(dir: &Path, config: &str, code: &str, plan: Vec<PlanFrame>) -> Result<DataSet> {
    let digest = format!("digest of {config}");
    let info = DataSetInfo {
        name: "test",
        config_yaml: config,
        config_digest: &digest,
        code_digest: code,
        plan,
        classes: Some(&json!([{ "id": 7, "name": "road" }])),
        details: &json!({ "title": "a test" }),
    };
    DataSet::create_or_open(dir, info, Opening::Resume, &|old| {
        vec![format!("{} -> {}", old.trim(), config.trim())]
    })
}

/// Opens the usual data set with frames `f0`, `f1`, … of all outputs.
pub(crate) fn open(dir: &Path, frames: usize) -> DataSet {
    let plan = (0..frames).map(|i| planned(&format!("f{i}"), OutputSet::all())).collect();
    open_with(dir, "seed: 1\n", "code-1", plan).expect("a data set")
}

/// Writes a frame with the usual record and attributes.
pub(crate) fn store(set: &DataSet, id: &str, frame: &Frame) -> Result<()> {
    store_timed(set, id, frame, 1.5)
}

/// As [`store`], with a time.
pub(crate) fn store_timed(set: &DataSet, id: &str, frame: &Frame, seconds: f64) -> Result<()> {
    with_files(id, frame, seconds, |files| set.write_frame(files))
}

/// What is stored of a frame.
pub(crate) fn with_files<T>(
    id: &str,
    frame: &Frame,
    seconds: f64,
    then: impl FnOnce(&FrameFiles<'_>) -> T,
) -> T {
    let attributes: BTreeMap<String, Attribute> = [
        ("camera_altitude_m".to_owned(), Attribute::Number(2.0)),
        ("scene".to_owned(), Attribute::Text("stra\u{df}e.glb".to_owned())),
    ]
    .into();
    let rgb = frame.direct.iter().map(|rgb| rgb.map(|v| 0.5 * v)).collect();
    let denoised = DenoisedPicture { rgb, details: json!({ "library": "half" }) };
    // Noise of some bits, as raw pictures have.
    let raw = frame.direct.iter().map(|rgb| 64 + (rgb[1] * 1000.0) as u16).collect();
    let srgb8 = if frame.check().is_ok() { frame.to_srgb8(1.25) } else { Vec::new() };
    let camera = CameraPicture { raw, srgb8: srgb8.clone() };
    let clear = ClearPicture { frame: frame.clone(), srgb8 };
    then(&FrameFiles {
        id,
        camera: Some(&camera),
        clear: Some(&clear),
        denoised: Some(&denoised),
        objects: Some(&json!({ "objects": [] })),
        frame,
        record: &json!({ "id": id, "samples": frame.samples[0] }),
        exposure: 1.25,
        instances: &instances(),
        view: View {
            world_to_camera: Some(std::array::from_fn(|i| i as f32)),
            world_to_ndc: None,
            white_luminance_cd_m2: Some(100.0),
        },
        seconds,
        attributes: &attributes,
    })
}

/// Names of the things in a test frame.
pub(crate) fn instances() -> Vec<String> {
    (1..=301).map(|i| format!("thing {i}")).collect()
}

/// All files of a folder by name, but the timings.
pub(crate) fn contents(dir: &Path) -> BTreeMap<String, Vec<u8>> {
    let entries = fs::read_dir(dir).expect("a folder").map(|e| e.expect("an entry"));
    let named = entries.map(|e| (e.file_name().into_string().expect("a name"), e.path()));
    let kept = named.filter(|(name, _)| !name.ends_with(".timing.json"));
    kept.map(|(name, path)| (name, fs::read(path).expect("a file"))).collect()
}

/// A JSON file.
pub(crate) fn read_json(path: &Path) -> Value {
    serde_json::from_slice(&fs::read(path).expect("a file")).expect("JSON")
}
