//! The street in layered fog against Mitsuba 3 (tests/data/street_*_reference.csv), as radiance and block by block: grey,
//! where a spectral and an RGB renderer must agree, and in colours. `tools/bench/street_reference.py` makes such files.

use fog_film::Frame;
use fog_optics::{layer, layer_csv};
use fog_scene::light::Environment;
use fog_scene::scene::Scene;
use fog_tests::{csv, data, scenes};

const COLUMNS: usize = 16;
const ROWS: usize = 9;
const BLOCK: usize = 30;

fn street(file: &str, day: bool) -> Scene {
    let text = std::fs::read_to_string(data("fog_layers.csv")).unwrap();
    let rows = layer_csv::parse_layers(&text, "fog_layers.csv").unwrap();
    let profile = layer::layered(&rows, 1.0).unwrap().profile(0.0).unwrap();
    let environment = day.then_some(Environment { radiance: 1.0 });
    Scene::new(scenes::load(file), Some(scenes::hg_fog(profile, 0.83)), environment, None, !day)
}

/// Means of one channel in the blocks.
fn block_means(frame: &Frame, channel: usize) -> Vec<f64> {
    let block = |k: usize| {
        let (x0, y0) = (k % COLUMNS * BLOCK, k / COLUMNS * BLOCK);
        let pixels = (0..BLOCK * BLOCK).map(|i| (y0 + i / BLOCK) * 480 + x0 + i % BLOCK);
        pixels.map(|i| f64::from(frame.image(i)[channel])).sum::<f64>() / (BLOCK * BLOCK) as f64
    };
    (0..COLUMNS * ROWS).map(block).collect()
}

/// How near a picture must be.
struct Bar {
    /// Relative difference of the image's mean.
    mean: f64,
    /// Of a block's, where noise does not hide it (four standard errors of both sides together).
    block: f64,
    /// Root mean square over the blocks of what noise does not explain.
    unexplained: f64,
    /// Samples a pixel in each of two renderings, whose difference tells our own errors.
    samples: u64,
    /// Noise excuses no block.
    strict: bool,
}

const GREY: Bar = Bar { mean: 0.003, block: 0.01, unexplained: 0.003, samples: 48, strict: false };
const COLOUR: Bar = Bar { mean: 0.03, block: 0.03, unexplained: 0.02, samples: 12, strict: false };

fn compare(scene: &Scene, reference: &str, bar: &Bar, channels: &[usize]) {
    let camera = scenes::camera(1.7, 0.0, 0.0, 480, 270, 60.0);
    let frames = [1, 2].map(|seed| scenes::render(scene, &camera, bar.samples, None, seed));
    let rows = csv::rows(reference);
    assert_eq!(rows.len(), COLUMNS * ROWS);
    for &c in channels {
        let name = ["r", "g", "b"][c];
        let [a, b] = frames.each_ref().map(|f| block_means(f, c));
        let half = |k: usize| 0.5 * (a[k] - b[k]).abs();
        let typical = ((0..rows.len()).map(|k| half(k).powi(2)).sum::<f64>() / rows.len() as f64).sqrt();
        let (mut sum, mut expected, mut worst) = (0.0, 0.0, 0.0f64);
        let (mut unexplained, mut noise) = (0.0, 0.0);
        for (k, row) in rows.iter().enumerate() {
            let got = 0.5 * (a[k] + b[k]);
            let (want, se) = (row[&format!("mean_{name}")], row[&format!("se_{name}")]);
            let error = se.hypot(half(k).max(typical));
            let off = (got - want).abs();
            assert!(
                off < bar.block * want || (!bar.strict && off < 4.0 * error),
                "{reference}, block {k} {name}: {got} for {want} ± {error}"
            );
            let variance = se * se + typical * typical;
            unexplained += (off * off - variance) / (want * want) / rows.len() as f64;
            noise += variance / (want * want) / rows.len() as f64;
            sum += got;
            expected += want;
            worst = worst.max(off / want);
        }
        let off = sum / expected - 1.0;
        let [unexplained, noise] = [unexplained, noise].map(|x: f64| 100.0 * x.abs().sqrt().copysign(x));
        println!(
            "{reference} {name}: mean off by {:+.3} %, worst block {:.2} %, rms beyond noise {unexplained:.2} % (noise {noise:.2} %)",
            100.0 * off,
            100.0 * worst
        );
        assert!(off.abs() < bar.mean, "{reference}: mean {name} off by {off}");
        assert!(unexplained < 100.0 * bar.unexplained, "{reference}: {name} differs by {unexplained} %");
    }
}

#[test]
fn grey_day() {
    compare(&street("street_grey.glb", true), "street_grey_day_reference.csv", &GREY, &[0, 1, 2]);
}

#[test]
fn grey_night() {
    let scene = street("street_grey_night.glb", false);
    compare(&scene, "street_grey_night_reference.csv", &Bar { samples: 64, ..GREY }, &[0, 2]);
}

/// 1 % in every block, which noise cannot excuse: with 512 samples in each rendering both sides' standard errors together
/// are a quarter of that. On 2026-11-24 the day passed (worst block 0.71 %). By night red did (0.57 %); one block of blue was off by
/// 1.5 %, four of its standard errors, which there are twice those of the other blocks.
#[test]
#[ignore = "takes ten minutes of one core"]
fn grey_in_every_block() {
    let bar = Bar { samples: 512, strict: true, ..GREY };
    compare(&street("street_grey.glb", true), "street_grey_day_reference.csv", &bar, &[1]);
    compare(&street("street_grey_night.glb", false), "street_grey_night_reference.csv", &bar, &[0, 2]);
}

#[test]
fn colour_day() {
    compare(&street("street_day.glb", true), "street_day_reference.csv", &COLOUR, &[0, 1, 2]);
}

#[test]
fn colour_night() {
    compare(&street("street_night.glb", false), "street_night_reference.csv", &COLOUR, &[0, 2]);
}
