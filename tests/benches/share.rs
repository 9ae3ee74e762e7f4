//! What common paths bring (`render: {share: fog}`): eight fogs over the street, in one pass and one by one.
//!
//!     cargo bench -p fog-tests --bench share -- density 4
//!
//! Prints, for the set of fogs that is named, the seconds of processor time of both (Linux), the mean variance of a pixel over the
//! frames, and how many times less time the pass takes for the same variance.

use fog_core::colour::Observer;
use fog_film::Frame;
use fog_optics::advection::AdvectionModel;
use fog_optics::{layer, layer_csv, table};
use fog_scene::light::Environment;
use fog_scene::medium::Medium;
use fog_scene::phase::Phase;
use fog_scene::scene::Scene;
use fog_tests::{data, scenes};
use fog_tracer::render_shared::{Variant, render_shared};
use fog_tracer::settings::Settings;

/// The layers of tests/data/fog_layers.csv with this factor on their extinction and on their altitudes.
fn layered(density: f64, height: f64, g: f32) -> Medium {
    let text = std::fs::read_to_string(data("fog_layers.csv")).expect("fog_layers.csv");
    let rows = layer_csv::parse_layers(&text, "fog_layers.csv").expect("layers");
    let rows: Vec<_> = rows.into_iter().map(|(z, sigma)| (z * height, sigma * density)).collect();
    scenes::hg_fog(layer::layered(&rows, 1.0).expect("layer").profile(0.0).expect("profile"), g)
}

fn advection(heights_m: [f64; 8], densities: [f64; 8]) -> Vec<Medium> {
    let model = AdvectionModel::arcata().expect("model");
    let optics = table::build_table(&model, &table::TableSettings::visible(&model), &|_| ()).expect("table");
    let medium = |(&height, &density): (&f64, &f64)| {
        let layer = layer::advection(&optics, &model, height, density).expect("layer");
        Medium::new(layer.profile(0.0).expect("profile"), Phase::Table(optics.clone()))
    };
    heights_m.iter().zip(&densities).map(medium).collect()
}

fn media(name: &str) -> Option<Vec<Medium>> {
    let even =
        |from: f64, to: f64| -> [f64; 8] { std::array::from_fn(|i| from + (to - from) * i as f64 / 7.0) };
    Some(match name {
        "density" => even(0.8, 1.2).map(|d| layered(d, 1.0, 0.83)).to_vec(),
        "density_close" => even(0.95, 1.05).map(|d| layered(d, 1.0, 0.83)).to_vec(),
        "thin" => even(0.08, 0.12).map(|d| layered(d, 1.0, 0.83)).to_vec(),
        "height" => even(0.85, 1.15).map(|h| layered(1.0, h, 0.83)).to_vec(),
        "phase" => even(0.8, 0.87).map(|g| layered(1.0, 1.0, g as f32)).to_vec(),
        "advection_heights" => advection(even(150.0, 220.0), [1.0; 8]),
        "advection_thin" => advection(even(150.0, 220.0), [0.1; 8]),
        _ => return None,
    })
}

/// Processor time of this program so far, in seconds, by hundredths.
fn seconds() -> f64 {
    let stat = std::fs::read_to_string("/proc/self/stat").unwrap_or_default();
    // The 14th field, and the 12th after the name, which may hold spaces.
    let after_name = stat.rsplit(')').next().unwrap_or_default();
    after_name.split_whitespace().nth(11).and_then(|ticks| ticks.parse::<f64>().ok()).unwrap_or(0.0) / 100.0
}

fn variance(frame: &Frame) -> f64 {
    frame.standard_error.iter().map(|&e| f64::from(e).powi(2)).sum::<f64>() / frame.pixel_count() as f64
}

fn main() -> Result<(), String> {
    let mut words = std::env::args().skip(1).filter(|a| a != "--bench");
    let name = words.next().unwrap_or_else(|| "density".into());
    let samples = words.next().map_or(Ok(4), |n| n.parse::<u64>()).map_err(|e| format!("samples: {e}"))?;
    let media = media(&name).ok_or(format!("{name}: no such set"))?;
    let environment = Some(Environment { radiance: 1.0 });
    let scene = Scene::new(scenes::load("street_day.glb"), Some(media[0].clone()), environment, None, false);
    let camera = scenes::camera(1.7, 0.0, 0.0, 160, 90, 60.0);
    let observer = Observer::new();
    let settings = |samples| Settings { samples, max_depth: None, wavelength_nm: None, stop: None };
    let variants: Vec<Variant> = (0..media.len()).map(|fog| Variant { fog, factors: vec![] }).collect();

    let start = seconds();
    let view = (&camera, &observer);
    let together = render_shared(&scene, &media, &variants, view, &settings(samples), 1, &|_| true);
    let together = together.ok_or("cancelled")?.into_iter().collect::<Result<Vec<_>, _>>();
    let together = together.map_err(|e| e.to_string())?;
    let (shared, noise) = (seconds() - start, together.iter().map(variance).sum::<f64>() / 8.0);

    let start = seconds();
    let mut alone_noise = 0.0;
    for medium in &media {
        let mut scene = scene.clone();
        scene.medium = Some(medium.clone());
        let frame =
            fog_tracer::render::render(&scene, &camera, &observer, &settings(4 * samples), 2, &|_| true);
        alone_noise += variance(&frame.map_err(|e| e.to_string())?.ok_or("cancelled")?) / 8.0;
    }
    let alone = seconds() - start;
    let gain = alone * alone_noise / (shared * noise);
    println!(
        "{name}: together {shared:.2} s, variance {noise:.3e}; alone {alone:.2} s, variance {alone_noise:.3e}; gain {gain:.2}"
    );
    Ok(())
}
