//! The street in layered fog against Mitsuba 3 (tests/data/street_grey_*_reference.csv), as radiance and block by block.

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

/// Compares the means of the whole image (0.5 %) and of each block (1 % or 4 standard errors of both). Our own errors come
/// from the difference of two renderings.
fn compare(scene: &Scene, reference: &str, samples: u64, channels: &[usize]) {
    let camera = scenes::camera(1.7, 0.0, 0.0, 480, 270, 60.0);
    let frames = [1, 2].map(|seed| scenes::render(scene, &camera, samples, None, seed));
    let rows = csv::rows(reference);
    assert_eq!(rows.len(), COLUMNS * ROWS);
    for &c in channels {
        let name = ["r", "g", "b"][c];
        let [a, b] = frames.each_ref().map(|f| block_means(f, c));
        let half = |k: usize| 0.5 * (a[k] - b[k]).abs();
        let typical = ((0..rows.len()).map(|k| half(k).powi(2)).sum::<f64>() / rows.len() as f64).sqrt();
        let (mut sum, mut expected, mut worst) = (0.0, 0.0, 0.0f64);
        for (k, row) in rows.iter().enumerate() {
            let got = 0.5 * (a[k] + b[k]);
            let (want, se) = (row[&format!("mean_{name}")], row[&format!("se_{name}")]);
            let error = se.hypot(half(k).max(typical));
            let off = (got - want).abs();
            assert!(
                off < 0.01 * want || off < 4.0 * error,
                "{reference}, block {k} {name}: {got} for {want} ± {error}"
            );
            sum += got;
            expected += want;
            worst = worst.max(off / want);
        }
        let off = sum / expected - 1.0;
        println!("{reference} {name}: mean off by {:+.3} %, worst block {:.2} %", 100.0 * off, 100.0 * worst);
        assert!(off.abs() < 0.005, "{reference}: mean {name} off by {off}");
    }
}

#[test]
fn grey_day() {
    compare(&street("street_grey.glb", true), "street_grey_day_reference.csv", 48, &[0, 1, 2]);
}

#[test]
fn grey_night() {
    let scene = street("street_grey_night.glb", false);
    compare(&scene, "street_grey_night_reference.csv", 64, &[0, 2]);
}
