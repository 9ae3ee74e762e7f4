//! Renders the street of `tests/data` in fog and tells how long the tracing took: our side of `tools/bench/mitsuba.py`.
//!
//!     cargo bench -p fog-tests --bench street -- --scene day --samples 16 --seed 1 --threads 2 --write image.f32
//!
//! Prints one line of JSON. The image is left as little-endian f32, three channels a pixel, row 0 at the top.

use fog_core::colour::Observer;
use fog_optics::advection::AdvectionModel;
use fog_optics::{layer, layer_csv, table};
use fog_scene::light::Environment;
use fog_scene::medium::Medium;
use fog_scene::phase::Phase;
use fog_scene::scene::Scene;
use fog_tests::{data, scenes};
use fog_tracer::settings::{Settings, Stop};
use std::fmt::Write as _;
use std::time::Instant;

/// Thickness of the advection layer, in metres.
const LAYER_M: f64 = 260.0;

struct Arguments {
    scene: String,
    samples: u64,
    /// In pixels; the height goes with it.
    width: u32,
    seed: u64,
    threads: usize,
    /// Gives pixels samples by their relative error.
    by_error: bool,
    /// Takes the fog for a similar one after some scatterings.
    similar: bool,
    write: Option<String>,
    describe: Option<String>,
}

fn arguments() -> Result<Arguments, String> {
    let mut out = Arguments {
        scene: "day".into(),
        samples: 16,
        width: 480,
        seed: 1,
        threads: 2,
        by_error: false,
        similar: false,
        write: None,
        describe: None,
    };
    let mut words = std::env::args().skip(1).filter(|a| a != "--bench");
    while let Some(key) = words.next() {
        let value = words.next().ok_or(format!("{key}: a value is missing"))?;
        let number = || value.parse::<u64>().map_err(|e| format!("{key} {value}: {e}"));
        match key.as_str() {
            "--scene" => out.scene = value,
            "--samples" => out.samples = number()?,
            "--width" => out.width = (number()? as u32).max(16),
            "--seed" => out.seed = number()?,
            "--threads" => out.threads = number()? as usize,
            "--allocate" if value == "even" => out.by_error = false,
            "--allocate" if value == "relative_error" => out.by_error = true,
            "--approximation" if value == "similarity" => out.similar = true,
            "--write" => out.write = Some(value),
            "--describe" => out.describe = Some(value),
            _ => {
                return Err(format!(
                    "{key} {value}: unknown; known: --scene --samples --width --seed --threads --allocate even or relative_error, --approximation similarity, --write --describe"
                ));
            }
        }
    }
    Ok(out)
}

/// Fog of tests/data/fog_layers.csv: grey, albedo 1, Henyey–Greenstein 0.83.
fn layered() -> Medium {
    let text = std::fs::read_to_string(data("fog_layers.csv")).expect("fog_layers.csv");
    let rows = layer_csv::parse_layers(&text, "fog_layers.csv").expect("layers");
    scenes::hg_fog(layer::layered(&rows, 1.0).expect("layer").profile(0.0).expect("profile"), 0.83)
}

/// The advection model's droplets with their Mie phase functions by altitude and wavelength.
fn advection() -> Medium {
    let model = AdvectionModel::arcata().expect("model");
    let optics = table::build_table(&model, &table::TableSettings::visible(&model), &|_| ()).expect("table");
    let layer = layer::advection(&optics, &model, LAYER_M, 1.0).expect("layer");
    Medium::new(layer.profile(0.0).expect("profile"), Phase::Table(optics))
}

fn scene(name: &str) -> Result<Scene, String> {
    let (file, medium, day) = match name {
        "day" => ("street_day.glb", layered(), true),
        "grey_day" => ("street_grey.glb", layered(), true),
        "night" => ("street_night.glb", layered(), false),
        "grey_night" => ("street_grey_night.glb", layered(), false),
        "mie" => ("street_day.glb", advection(), true),
        _ => return Err(format!("--scene {name}: one of day, grey_day, night, grey_night, mie")),
    };
    let environment = day.then_some(Environment { radiance: 1.0 });
    Ok(Scene::new(scenes::load(file), Some(medium), environment, None, !day))
}

/// σ_t at even altitudes and the phase function of the whole layer at 550 nm, for a renderer that has one of each.
fn describe(scene: &Scene) -> String {
    let medium = scene.medium.as_ref().expect("fog");
    let profile = medium.profile();
    let (layers, angles) = (104, 65_537);
    let mut out = String::from("{\"sigma_t_1_m\": [");
    for i in 0..layers {
        let y = LAYER_M * (f64::from(i) + 0.5) / f64::from(layers);
        let _ = write!(out, "{}{:.9e}", if i == 0 { "" } else { ", " }, profile.sigma_t_at(y, 550.0));
    }
    out.push_str("], \"phase\": [");
    let view = medium.view();
    let lanes = view.phase.lanes(&fog_core::spectrum::Wavelengths::monochromatic(550.0));
    let mut rng = fog_core::random::PathRng::new(0, 0, 0);
    let middle = view.phase.scatterer(0.5, &lanes, &mut rng);
    for i in 0..angles {
        let m = 2.0 - 2.0 * f64::from(i) / f64::from(angles - 1);
        let p = view.phase.eval(middle.row, m as f32, &middle.lanes)[0];
        let _ = write!(out, "{}{p:.6e}", if i == 0 { "" } else { ", " });
    }
    out.push_str("]}");
    out
}

fn main() -> Result<(), String> {
    let arguments = arguments()?;
    let scene = scene(&arguments.scene)?;
    let scene = if arguments.similar { scene.with_similar_fog() } else { scene };
    if let Some(path) = &arguments.describe {
        std::fs::write(path, describe(&scene)).map_err(|e| format!("{path}: {e}"))?;
    }
    let camera = scenes::camera(1.7, 0.0, 0.0, arguments.width, arguments.width * 9 / 16, 60.0);
    let stop = arguments.by_error.then_some(Stop::Budget);
    let settings = Settings { samples: arguments.samples, max_depth: None, wavelength_nm: None, stop };
    let observer = Observer::new();
    let pool = rayon::ThreadPoolBuilder::new().num_threads(arguments.threads).build();
    let pool = pool.map_err(|e| e.to_string())?;
    let start = Instant::now();
    let frame = pool.install(|| {
        fog_tracer::render::render(&scene, &camera, &observer, &settings, arguments.seed, &|_| true)
    });
    let seconds = start.elapsed().as_secs_f64();
    let frame = frame.map_err(|e| e.to_string())?.expect("not cancelled");
    if let Some(path) = &arguments.write {
        let image = (0..frame.pixel_count()).flat_map(|i| frame.image(i));
        let bytes: Vec<u8> = image.flat_map(f32::to_le_bytes).collect();
        std::fs::write(path, bytes).map_err(|e| format!("{path}: {e}"))?;
    }
    let variance: f64 = frame.standard_error.iter().map(|&e| f64::from(e).powi(2)).sum();
    let noise = variance * arguments.samples as f64 / frame.pixel_count() as f64;
    let means: [f64; 3] = std::array::from_fn(|c| scenes::mean(&frame, c));
    println!(
        "{{\"scene\": \"{}\", \"samples\": {}, \"threads\": {}, \"seconds\": {seconds:.4}, \"variance_per_sample\": {noise:.5}, \"mean\": {means:.5?}}}",
        arguments.scene, arguments.samples, arguments.threads
    );
    Ok(())
}
